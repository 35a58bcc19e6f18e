// See proofs.h, check_situations and check_together.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ask/together.h"
#include "core/check/proofs.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// What the constraints allow is dead nevertheless if it takes behaviors that fit in no common
/// situation. As with the constraints, a fault is reported where it is, and not again above.
class SituationCheck {
 public:
  explicit SituationCheck(ProofContext& proof)
      : proof_(proof),
        catalog_(proof.compiled()),
        ask_(proof.search(), proof.space()),
        is_dead_(catalog_.tasks.size(), false) {}

  void check() {
    if (catalog_.variables.empty()) return;
    for (const TaskId task : tasks_by_level(catalog_)) check_task(task);
  }

 private:
  void check_task(TaskId task) {
    if (proof_.liveness().of_task(task) == Liveness::State::dead) return;
    if (variables_of(catalog_, {&task, 1}).empty()) return;
    std::vector<BehaviorId> dead;
    const std::span<const Value> values = catalog_.values[task];
    for (const Value& value : values) {
      const bool is_dead_already =
          proof_.liveness().of_behavior(value.behavior) == Liveness::State::dead;
      if (is_dead_already || can_be_active(value.behavior)) continue;
      dead.push_back(value.behavior);
    }
    if (dead.empty()) return;
    is_dead_[task] = !is_possible({Demand::Kind::run, task, none});
    if (is_dead_[task]) {
      if (!std::all_of(dead.begin(), dead.end(), [this](BehaviorId id) { return is_told(id); })) {
        report_task(task);
      }
      for (const BehaviorId behavior : dead) proof_.explain_behavior(behavior);
      return;
    }
    for (const BehaviorId behavior : dead) {
      if (!is_told(behavior)) report_behavior(behavior);
      proof_.explain_behavior(behavior);
    }
  }

  /// Whether a finding says so already: about the behavior, or about what it requires.
  [[nodiscard]] bool is_told(BehaviorId behavior) const {
    const auto requirements = catalog_.requirements[behavior];
    return proof_.is_explained_behavior(behavior) ||
           std::any_of(
               requirements.begin(), requirements.end(),
               [this](const CompiledRequirement& required) { return is_dead_[required.task]; });
  }

  /// True if that is not known.
  [[nodiscard]] bool is_possible(const Demand& demand) {
    return ask_.find(asked_of(catalog_, {&demand, 1})) != Feasibility::no;
  }

  /// For any of its tasks.
  [[nodiscard]] bool can_be_active(BehaviorId behavior) {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return is_possible(proof_.has(value)); });
  }

  [[nodiscard]] std::vector<Note> why_not(const Demand& demand) {
    const Asked question = asked_of(catalog_, {&demand, 1});
    return proof_.notes_of(
        proof_.relaxed({&demand, 1}).conflict(constraints_on(catalog_, question, true)));
  }

  void report_task(TaskId id) {
    const Task& task = proof_.task(id);
    proof_.reporter().report(rule::dead_task, task.range,
                             "task " + quote(task.name) +
                                 " can never run: what it takes to run fits in no common situation",
                             why_not({Demand::Kind::run, id, none}));
  }

  void report_behavior(BehaviorId id) {
    const Behavior& behavior = proof_.behavior(id);
    proof_.reporter().report(
        rule::dead_behavior, behavior.range,
        "behavior " + quote(behavior.name) +
            " can never be active: it fits in no situation in which what it requires does",
        why_not(proof_.has(catalog_.performs[id].front())));
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  Ask ask_;
  std::vector<bool> is_dead_;  ///< by task, because of the situation
};

/// The names in messages: a task and a behavior may have the same one.
std::string name_of_task(const ProofContext& proof, const Task& task) {
  return (proof.compiled().find_behavior(task.name) ? "task " : "") + quote(task.name);
}
std::string name_of_behavior(const ProofContext& proof, const Behavior& behavior) {
  return (proof.compiled().find_task(behavior.name) ? "behavior " : "") + quote(behavior.name);
}

/// Reactive tasks that must wait while a task runs that no exclusivity list names with them.
class BlockedReactiveCheck {
 public:
  BlockedReactiveCheck(ProofContext& proof, TogetherSearch& together)
      : proof_(proof), catalog_(proof.compiled()), together_(together) {}

  void check() {
    for (const TaskId task : catalog_.task_ids) {
      if (catalog_.tasks[task].reactive_start == 0 || !is_of_interest(task)) continue;
      check_task(task);
    }
    report_undecided();
  }

 private:
  [[nodiscard]] bool is_of_interest(TaskId task) const {
    return !proof_.task(task).is_unclear &&
           proof_.liveness().of_task(task) != Liveness::State::dead;
  }

  void check_task(TaskId reactive) {
    std::vector<TaskId> blocking;
    const GroupId group = catalog_.tasks[reactive].group;
    for (TaskId other = catalog_.group_tasks[group]; other < catalog_.group_tasks[group + 1];
         ++other) {
      if (catalog_.tasks[other].start_on_request == 0 || !is_of_interest(other)) continue;
      if (together_.find_list(reactive, other)) continue;
      const Feasibility answer = together_.decide_by_constraints(reactive, other);
      if (answer == Feasibility::no) blocking.push_back(other);
      if (answer == Feasibility::unknown && undecided_++ == 0) {
        first_undecided_ = {reactive, other};
      }
    }
    std::sort(blocking.begin(), blocking.end(), [this](TaskId a, TaskId b) {
      return catalog_.tasks[a].catalog_index < catalog_.tasks[b].catalog_index;
    });
    if (!blocking.empty()) report(reactive, blocking);
  }

  void report(TaskId reactive, const std::vector<TaskId>& blocking) {
    constexpr std::size_t most_names = 5;
    const std::size_t named = std::min(blocking.size(), most_names);
    std::string names;
    std::vector<Reason> reasons;
    for (std::size_t i = 0; i < named; ++i) {
      const bool is_last = i + 1 == blocking.size();
      if (i > 0) names += is_last ? " or " : ", ";
      names += name_of_task(proof_, proof_.task(blocking[i]));
      for (const Reason& reason : together_.find_reasons(reactive, blocking[i])) {
        if (!contains(reasons, reason)) reasons.push_back(reason);
      }
    }
    if (blocking.size() > named) {
      names += " or " + std::to_string(blocking.size() - named) + " more";
    }
    const Task& task = proof_.task(reactive);
    proof_.reporter().report(rule::blocked_reactive, task.range,
                             "reactive task " + quote(task.name) + " cannot run beside " + names +
                                 ", though no exclusivity list says so: what they require does",
                             proof_.notes_of(reasons));
  }

  static bool contains(const std::vector<Reason>& reasons, const Reason& reason) {
    return std::any_of(reasons.begin(), reasons.end(), [&reason](const Reason& other) {
      return other.kind == reason.kind && other.task == reason.task &&
             other.other_task == reason.other_task && other.behavior == reason.behavior;
    });
  }

  /// One finding for all: such catalogs are large.
  void report_undecided() {
    if (undecided_ == 0) return;
    const Task& reactive = proof_.task(first_undecided_.first);
    std::string question = "whether reactive task " + quote(reactive.name) + " can run beside " +
                           name_of_task(proof_, proof_.task(first_undecided_.second));
    if (undecided_ > 1)
      question += ", and the same of " + quantity(undecided_ - 1, "other pair") + ",";
    proof_.report_undecided(reactive.range, question);
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  TogetherSearch& together_;
  std::size_t undecided_ = 0;  ///< pairs
  std::pair<TaskId, TaskId> first_undecided_;
};

/// Tasks that the settings say never run together, but can.
class NeverTogetherCheck {
 public:
  NeverTogetherCheck(ProofContext& proof, TogetherSearch& together)
      : proof_(proof), together_(together) {
    const std::vector<Task>& tasks = proof.catalog().tasks;
    for (std::size_t index = 0; index < tasks.size(); ++index) {
      tasks_.emplace(tasks[index].name, proof.compiled().task_ids[index]);
    }
  }

  /// Names that the catalog does not have may be those of another one.
  void check(const NeverTogether& list) {
    std::vector<TaskId> known;
    for (const std::string& name : list.tasks) {
      if (const auto found = tasks_.find(name); found != tasks_.end()) {
        known.push_back(found->second);
      }
    }
    for (std::size_t a = 0; a < known.size(); ++a) {
      for (std::size_t b = a + 1; b < known.size(); ++b) check_pair(known[a], known[b], list);
    }
  }

 private:
  void check_pair(TaskId a, TaskId b, const NeverTogether& list) {
    const Task& first = proof_.task(a);
    const Task& second = proof_.task(b);
    const Together answer = together_.decide(a, b);
    if (answer == Together::undecided) {
      proof_.report_undecided(first.range, "whether " + name_of_task(proof_, first) +
                                               " can run beside " + name_of_task(proof_, second));
    }
    if (answer != Together::possible) return;
    const TogetherSearch::Witness witness = together_.find_witness(a, b);
    const auto with = [this](const Task& task, BehaviorId behavior) {
      return name_of_task(proof_, task) + " with " +
             name_of_behavior(proof_, proof_.behavior(behavior));
    };
    std::string message =
        name_of_task(proof_, first) + " can run beside " + name_of_task(proof_, second);
    if (witness.a != none && witness.b != none) {
      message += ": " + with(first, witness.a) + ", " + with(second, witness.b);
    }
    proof_.reporter().report(
        rule::can_run_together, first.range, std::move(message),
        {proof_.reporter().note(second.range, name_of_task(proof_, second) + " is defined here"),
         {list.file, list.range, "these tasks must never run together"}});
  }

  ProofContext& proof_;
  TogetherSearch& together_;
  std::unordered_map<std::string_view, TaskId> tasks_;
};

}  // namespace

void check_situations(ProofContext& proof) { SituationCheck(proof).check(); }

void check_together(ProofContext& proof, const LintOptions& options, bool is_complete) {
  TogetherSearch together(proof.search(), proof.space(), proof.liveness(), proof.effort());
  BlockedReactiveCheck(proof, together).check();
  // A value that could not be read excludes nothing, so more tasks may seem to go together.
  if (!is_complete) return;
  NeverTogetherCheck never(proof, together);
  for (const NeverTogether& list : options.never_together) never.check(list);
}

}  // namespace cbc
