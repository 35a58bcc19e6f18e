// See proofs.h.
#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ask/conflict/reasons.h"
#include "core/catalog/catalog.h"
#include "core/check/proofs.h"
#include "core/diagnostic/rules.h"
#include "runtime/base/natural.h"
#include "runtime/base/text.h"
#include "runtime/solver/objective.h"

namespace cbc {
namespace {

/// Tasks and behaviors that no assignment has, each with a minimal conflict set. A fault is
/// reported where it is, and not again where it shows.
///
/// What is explained is a value: a behavior of several tasks may be dead as a value of one of them
/// for one reason, and as a value of another for another.
class DeadCheck {
 public:
  explicit DeadCheck(ProofContext& proof)
      : proof_(proof),
        catalog_(proof.compiled()),
        is_explained_below_(catalog_.values.items.size()) {
    for (TaskId task(0); task < catalog_.tasks.size(); ++task) {
      is_dead_.push_back(proof.liveness().of_task(task) == Liveness::State::dead);
    }
  }

  /// From the lowest level up, so that the reason is known where something dead is required.
  void check() {
    for (const TaskId task : tasks_by_level(catalog_)) {
      if (catalog_.values[task].empty()) continue;  // reported as task-without-behavior
      // A behavior of several tasks explains all of them at once.
      check_behaviors(task, true);
      if (is_dead_[task]) check_task(task);
      check_behaviors(task, false);
    }
  }

 private:
  void check_task(TaskId task) {
    if (proof_.is_explained_task(task)) return;
    for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
         ++value) {
      if (requires_only_dead_tasks(value)) return;
    }
    const Demand goal{Demand::Kind::run, task, none};
    const std::vector<Reason> constraints = unexplained_constraints({&goal, 1}, none);
    if (is_reachable({&goal, 1}, constraints)) return;
    const std::vector<Note> notes = find_reason({&goal, 1}, constraints);
    proof_.reporter().report(
        rule::dead_task, proof_.task(task).range,
        "task " + quote(proof_.task(task).name) + " can never run" +
            (notes.empty() ? "" : ": together these constraints exclude all of its behaviors"),
        notes);
    proof_.explain_task(task);
  }

  void check_behaviors(TaskId task, bool of_several_tasks) {
    for (const Value& value : catalog_.values[task]) {
      const bool has_several = catalog_.performs[value.behavior].size() > 1;
      if (has_several == of_several_tasks) check_behavior(value.behavior);
    }
  }

  void check_behavior(BehaviorId id) {
    if (proof_.is_explained_behavior(id)) return;
    const Liveness::State state = proof_.liveness().of_behavior(id);
    if (state == Liveness::State::live) return;
    const Behavior& behavior = proof_.behavior(id);
    if (state == Liveness::State::undecided) {
      proof_.report_undecided(behavior.range,
                              "whether behavior " + quote(behavior.name) + " can be active");
      proof_.explain_behavior(id);
      return;
    }
    if (catalog_.performs[id].size() == 1 && requires_only_dead_tasks(catalog_.performs[id][0])) {
      is_explained_below_[catalog_.performs[id][0]] = true;
      return;
    }
    Demands goals;
    for (const ValueId value : catalog_.performs[id]) goals.push_back(proof_.has(value));
    const std::vector<Reason> constraints = unexplained_constraints(goals, id);
    if (is_explained_elsewhere(id, goals, constraints)) return;
    const std::vector<Note> notes = find_reason(goals, constraints);
    proof_.reporter().report(rule::dead_behavior, behavior.range,
                             "behavior " + quote(behavior.name) + " can never be active" +
                                 (notes.empty() ? "" : ": together these constraints exclude it"),
                             notes);
    proof_.explain_behavior(id);
  }

  /// Whether another finding, on one of its tasks or on something it needs, is why a behavior is
  /// dead: it may come to life once that is mended.
  bool is_explained_elsewhere(BehaviorId id, std::span<const Demand> goals,
                              const std::vector<Reason>& constraints) {
    bool is_explained = false;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const ValueId value = catalog_.performs[id][i];
      if (is_reachable({&goals[i], 1}, constraints)) is_explained_below_[value] = true;
      is_explained |= is_explained_value(value);
    }
    return is_explained;
  }

  /// Whether nothing but that tasks it requires are dead, which has findings of its own, keeps a
  /// value from being reached. This is what is_reachable() would find, without a look at all that
  /// these tasks require in turn: in a long chain above a dead task there are many such values.
  [[nodiscard]] bool requires_only_dead_tasks(ValueId value) {
    const auto has_minimum = [this](TaskId task) {
      return catalog_.tasks[task].minimum_performance > 0 || !catalog_.limits_of(task).empty();
    };
    const TaskId task = catalog_.task_of(value);
    const auto requirements = catalog_.requirements[catalog_.values.items[value].behavior];
    if (requirements.empty() || has_minimum(task)) return false;
    const auto cliques_of = [this](TaskId one) { return catalog_.task_cliques[one]; };
    used_cliques_.assign(cliques_of(task).begin(), cliques_of(task).end());
    for (const CompiledRequirement& requirement : requirements) {
      const TaskId required = requirement.task;
      if (requirement.minimum_performance > 0 || has_minimum(required) || !is_dead_[required] ||
          catalog_.values[required].empty()) {
        return false;
      }
      const auto cliques = cliques_of(required);
      used_cliques_.insert(used_cliques_.end(), cliques.begin(), cliques.end());
    }
    std::sort(used_cliques_.begin(), used_cliques_.end());
    return std::adjacent_find(used_cliques_.begin(), used_cliques_.end()) == used_cliques_.end();
  }

  bool is_reachable(std::span<const Demand> goals, const std::vector<Reason>& constraints) {
    return constraints.size() <= most_constraints &&
           proof_.relaxed(goals).solve(constraints) == Feasibility::yes;
  }

  /// A minimal conflict set: why none of the goals can be reached. Empty if it takes too long to
  /// find.
  std::vector<Note> find_reason(std::span<const Demand> goals,
                                const std::vector<Reason>& constraints) {
    return proof_.notes_of(proof_.relaxed(goals).conflict(constraints));
  }

  /// The constraints that bear on the goals, except those of what is explained already. `own`: the
  /// behavior in question, if there is one.
  std::vector<Reason> unexplained_constraints(std::span<const Demand> goals, BehaviorId own) {
    RelevantTasks relevant(catalog_, catalog_.tasks[goals.front().task].group);
    if (own == none) {
      relevant.add(goals.front().task);
    } else {
      for (const CompiledRequirement& requirement : catalog_.requirements[own]) {
        relevant.add(requirement.task);
      }
    }
    relevant.close();
    const std::vector<BehaviorId> behaviors = relevant.behaviors();
    for (const Demand& goal : goals) relevant.add(goal.task);

    std::vector<Reason> reasons;
    for (const TaskId task : relevant.tasks()) {
      add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
      if (!proof_.is_explained_task(task)) add_minimum(catalog_, task, reasons);
    }
    if (own != none) add_requirements(catalog_, own, reasons);
    for (const BehaviorId behavior : behaviors) {
      if (is_explained(behavior, goals, relevant)) continue;
      add_requirements(catalog_, behavior, reasons);
    }
    std::erase_if(reasons, [this](const Reason& reason) {
      return reason.behavior != none && catalog_.values[reason.task].empty();
    });
    return reasons;
  }

  /// Whether the requirements of a behavior no longer count as reasons: it is dead, which is
  /// explained, or it performs a dead task that the goals may require.
  [[nodiscard]] bool is_explained(BehaviorId behavior, std::span<const Demand> goals,
                                  const RelevantTasks& relevant) const {
    if (proof_.is_explained_behavior(behavior)) return true;
    const auto performed = catalog_.performs[behavior];
    const auto is_below = [&](TaskId task) {
      return relevant.contains(task) &&
             std::none_of(goals.begin(), goals.end(),
                          [task](const Demand& goal) { return goal.task == task; });
    };
    return std::any_of(performed.begin(), performed.end(),
                       [&](ValueId value) {
                         const TaskId task = catalog_.task_of(value);
                         return is_dead_[task] && is_below(task);
                       }) ||
           std::all_of(performed.begin(), performed.end(),
                       [this](ValueId value) { return is_explained_value(value); });
  }

  [[nodiscard]] bool is_explained_value(ValueId value) const {
    return is_explained_below_[value] || proof_.is_explained_task(catalog_.task_of(value));
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  std::vector<bool> is_dead_;             ///< by task
  std::vector<bool> is_explained_below_;  ///< by value: what it needs is dead, which is explained
  std::vector<std::uint32_t> used_cliques_;
};

/// A product of degrees, rounded down to four places.
std::string show_product(const std::vector<Millionths>& factors) {
  if (factors.empty()) return format_percent(one_million);
  Natural product;
  for (const Millionths factor : factors) product.multiply(factor);
  std::string digits = product.digits();
  const std::size_t dropped = 6 * (factors.size() - 1);
  digits.resize(digits.size() > dropped ? digits.size() - dropped : 0);
  return format_percent(digits.empty() ? 0 : std::stoll(digits));
}

bool is_below(const std::vector<Millionths>& factors, Millionths minimum) {
  ExactProduct product;
  for (const Millionths factor : factors) product.multiply(factor);
  ExactProduct least;
  least.multiply(minimum);
  return ExactProduct::compare(product, least) < 0;
}

/// Minimum performances that no choice of behaviors reaches, with the best that is reached.
class MinimumCheck {
 public:
  explicit MinimumCheck(ProofContext& proof) : proof_(proof), catalog_(proof.compiled()) {}

  void check() {
    for (TaskId task(0); task < catalog_.tasks.size(); ++task) check_task(task);
    for (BehaviorId id(0); id < catalog_.behaviors.size(); ++id) check_behavior(id);
  }

 private:
  void check_task(TaskId id) {
    const Task& task = proof_.task(id);
    if (task.minimum_performance == 0 || catalog_.values[id].empty()) return;
    if (proof_.liveness().of_task(id) != Liveness::State::dead) return;
    const AssignmentSearch::Best best = proof_.search().best_performance(id, true);
    if (is_unreachable(best, id, task.minimum_performance, task.minimum_performance_range,
                       "task " + quote(task.name) + " must perform")) {
      proof_.explain_task(id);
    }
  }

  /// The minimums of a live behavior are reached. If the required task cannot run at all, that is
  /// the mistake.
  void check_behavior(BehaviorId id) {
    if (proof_.liveness().of_behavior(id) != Liveness::State::dead) return;
    const Behavior& behavior = proof_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.minimum_performance == 0) continue;
      const TaskId task = catalog_.task_ids[requirement.task];
      if (proof_.liveness().of_task(task) != Liveness::State::live) continue;
      if (is_unreachable(
              best_of(task), task, requirement.minimum_performance,
              requirement.minimum_performance_range,
              "behavior " + quote(behavior.name) + " requires " + quote(proof_.task(task).name))) {
        proof_.explain_behavior(id);
      }
    }
  }

  /// Reports a minimum that is not reached, or that may not be. `demand` begins the sentence.
  bool is_unreachable(const AssignmentSearch::Best& best, TaskId task, Millionths minimum,
                      const Range& range, const std::string& demand) {
    if (best.exists == Feasibility::unknown) {
      proof_.report_undecided(range, "whether " + quote(proof_.task(task).name) + " can reach " +
                                         format_percent(minimum));
    }
    if (best.exists != Feasibility::yes || !is_below(best.factors, minimum)) return false;
    proof_.reporter().report(rule::unreachable_performance, range,
                             demand + " with at least " + format_percent(minimum) +
                                 ", but the best that can be reached is " +
                                 show_product(best.factors));
    return true;
  }

  const AssignmentSearch::Best& best_of(TaskId task) {
    const auto [entry, is_new] = best_.try_emplace(task);
    if (is_new) entry->second = proof_.search().best_performance(task, false);
    return entry->second;
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  std::unordered_map<TaskId, AssignmentSearch::Best> best_;
};

bool is_on_request(const Task& task) { return task.start_on_request && !task.is_unclear; }

void report(const Behavior& behavior, const Requirement& requirement, const Task& task,
            const std::string& first, Reporter& reporter) {
  reporter.report(rule::requires_on_request, requirement.range,
                  describe(behavior) + " requires " + quote(task.name) +
                      ", which starts only on request: request " + first + " first",
                  {reporter.note(task.range, quote(task.name) + " is defined here")});
}

/// Requirements of tasks that start on request only, and what has to be requested first.
class OnRequestCheck {
 public:
  explicit OnRequestCheck(ProofContext& proof) : proof_(proof), catalog_(proof.compiled()) {}

  void check() {
    for (BehaviorId id(0); id < catalog_.behaviors.size(); ++id) check_behavior(id);
  }

 private:
  void check_behavior(BehaviorId id) {
    if (proof_.liveness().of_behavior(id) == Liveness::State::dead) return;
    const Behavior& behavior = proof_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      const Task& task = proof_.catalog().tasks[requirement.task];
      if (!is_on_request(task)) continue;
      report(behavior, requirement, task,
             list_in_order(tasks_to_request(id, catalog_.task_ids[requirement.task])),
             proof_.reporter());
    }
  }

  /// A set of tasks that start on request, none of which can be left out if the behavior is to be
  /// active: `task`, and what that requires. In the order in which they can be requested.
  std::vector<TaskId> tasks_to_request(BehaviorId behavior, TaskId task) {
    constexpr std::size_t most_candidates = 100;  // enough for a sentence
    RelevantTasks relevant(catalog_, catalog_.tasks[task].group);
    relevant.add(task);
    std::vector<TaskId> needed;
    if (relevant.close(most_candidates)) {
      std::vector<TaskId> candidates;
      for (const TaskId other : relevant.tasks()) {
        if (other != task && catalog_.tasks[other].start_on_request) candidates.push_back(other);
      }
      std::vector<TaskId> closed;
      for (const TaskId candidate : candidates) {
        closed.push_back(candidate);
        if (is_possible(behavior, closed)) continue;
        closed.pop_back();
        needed.push_back(candidate);
      }
    }
    needed.push_back(task);
    std::stable_sort(needed.begin(), needed.end(), [this](TaskId a, TaskId b) {
      return catalog_.tasks[a].level < catalog_.tasks[b].level;
    });
    return needed;
  }

  bool is_possible(BehaviorId behavior, const std::vector<TaskId>& closed) {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(), [&](ValueId value) {
      Demands demands{proof_.has(value)};
      for (const TaskId task : closed) demands.push_back({Demand::Kind::stop, task, none});
      return proof_.search().find(catalog_.group_of(behavior), demands, solution_) ==
             Feasibility::yes;
    });
  }

  [[nodiscard]] std::string list_in_order(const std::vector<TaskId>& tasks) const {
    constexpr std::size_t most_names = 10;
    std::string text;
    for (std::size_t place = 0; place < tasks.size(); ++place) {
      // A long list is shown by its beginning and its last task.
      if (tasks.size() > most_names && place == most_names - 1) {
        text += ", then " + std::to_string(tasks.size() - most_names) + " more";
        place = tasks.size() - 1;
      }
      if (!text.empty()) text += ", then ";
      text += quote(proof_.task(tasks[place]).name);
    }
    return text;
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  Assignment solution_;
};

/// Requirements that are satisfied wherever the behavior and all other constraints are.
class RedundancyCheck {
 public:
  explicit RedundancyCheck(ProofContext& proof) : proof_(proof), catalog_(proof.compiled()) {}

  void check() {
    for (BehaviorId id(0); id < catalog_.behaviors.size(); ++id) check_behavior(id);
    report_undecided();
  }

 private:
  void check_behavior(BehaviorId id) {
    if (proof_.liveness().of_behavior(id) != Liveness::State::live) return;
    check_repetitions(proof_.behavior(id));
    if (catalog_.requirements[id].size() < 2) return;
    if (proof_.effort().left() == 0) {
      note_undecided(id, catalog_.requirements[id].front());
      return;
    }
    for (const CompiledRequirement& requirement : doubtful_requirements(id)) {
      check_requirement(id, requirement);
    }
  }

  /// One finding for all, at the first one: such catalogs are large.
  void report_undecided() {
    if (undecided_ == 0) return;
    const Behavior& behavior = proof_.behavior(undecided_behavior_);
    const TaskIndex task = catalog_.tasks[undecided_task_].catalog_index;
    proof_.reporter().report(
        rule::undecided, strongest_requirement(behavior, task).range,
        "whether the requirement of " + quote(proof_.catalog().tasks[task].name) +
            (undecided_ > 1 ? ", and " + std::to_string(undecided_ - 1) + " others," : "") +
            " is redundant could not be decided: there is too much to search");
  }

  /// Of the requirements of one task all but the strongest are redundant; of equal ones all but the
  /// first.
  void check_repetitions(const Behavior& behavior) {
    std::unordered_map<TaskIndex, const Requirement*> strongest;
    for (const Requirement& requirement : behavior.requirements) {
      const Requirement*& so_far =
          strongest.try_emplace(requirement.task, &requirement).first->second;
      if (requirement.minimum_performance > so_far->minimum_performance) so_far = &requirement;
    }
    for (const Requirement& requirement : behavior.requirements) {
      const Requirement& kept = *strongest.at(requirement.task);
      if (&kept == &requirement) continue;
      std::vector<Edit> edits;
      if (requirement.entry) edits.push_back({Edit::Kind::remove_entry, *requirement.entry, {}});
      report(behavior, requirement,
             {proof_.reporter().note(kept.range, "it is required here already")}, std::move(edits));
    }
  }

  /// The requirements whose tasks may also be required by something else that the behavior
  /// requires. No other can be redundant. Requirements form no cycle, so the task itself need not
  /// be left out.
  [[nodiscard]] std::vector<CompiledRequirement> doubtful_requirements(BehaviorId id) {
    RelevantTasks all(catalog_, catalog_.group_of(id));
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      all.add(requirement.task);
    }
    all.close();
    proof_.effort().spend(4 * all.tasks().size());
    RelevantTasks led_to(catalog_, catalog_.group_of(id));
    for (const TaskId task : all.tasks()) {
      for (const Arc& arc : catalog_.arcs[task]) led_to.add(arc.target);
    }
    std::vector<CompiledRequirement> doubtful;
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      if (led_to.contains(requirement.task)) doubtful.push_back(requirement);
    }
    return doubtful;
  }

  void check_requirement(BehaviorId id, const CompiledRequirement& requirement) {
    RelevantTasks relevant = others_of(id, requirement.task);
    for (const ValueId value : catalog_.performs[id]) relevant.add(catalog_.task_of(value));
    relevant.close();
    std::vector<Reason> others = constraints_on(catalog_, relevant);
    proof_.effort().spend(4 * others.size());
    if (proof_.effort().left() == 0 || others.size() > most_constraints) {
      note_undecided(id, requirement);
      return;
    }
    std::erase_if(others, [&](const Reason& reason) {
      return reason.behavior == id && reason.task == requirement.task;
    });
    RelaxedQuestions broken = broken_by(id, requirement);
    const Feasibility answer = broken.solve(others);
    if (answer == Feasibility::unknown) note_undecided(id, requirement);
    if (answer != Feasibility::no || is_margin(id, requirement, others)) return;
    const Behavior& behavior = proof_.behavior(id);
    const TaskIndex task = catalog_.tasks[requirement.task].catalog_index;
    report(behavior, strongest_requirement(behavior, task),
           proof_.notes_of(broken.conflict(others)), {});
  }

  /// What the behavior requires apart from a task, with all that is required in turn.
  [[nodiscard]] RelevantTasks others_of(BehaviorId id, TaskId task) const {
    RelevantTasks relevant(catalog_, catalog_.group_of(id));
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      if (requirement.task != task) relevant.add(requirement.task);
    }
    relevant.close();
    return relevant;
  }

  /// Whether the behavior can be active with the requirement not satisfied: the task does not run,
  /// or it runs below the minimum.
  RelaxedQuestions broken_by(BehaviorId id, const CompiledRequirement& requirement) {
    RelaxedQuestions questions = low_performances(id, requirement);
    for (const ValueId value : catalog_.performs[id]) {
      questions.add({{catalog_.group_of(id),
                      {proof_.has(value), {Demand::Kind::stop, requirement.task, none}}}});
    }
    return questions;
  }

  RelaxedQuestions low_performances(BehaviorId id, const CompiledRequirement& requirement) {
    RelaxedQuestions questions(proof_.space(), proof_.effort());
    if (requirement.minimum_performance == 0) return questions;
    for (const ValueId value : catalog_.performs[id]) {
      questions.add({{catalog_.group_of(id),
                      {proof_.has(value)},
                      requirement.task,
                      requirement.minimum_performance}});
    }
    return questions;
  }

  /// Whether the task performs well enough whatever minimums there are: then the minimum is a
  /// margin for other suitabilities, which no other constraint ensures.
  bool is_margin(BehaviorId id, const CompiledRequirement& requirement,
                 std::vector<Reason> others) {
    if (requirement.minimum_performance == 0) return false;
    std::erase_if(others,
                  [](const Reason& reason) { return reason.kind == Reason::Kind::performance; });
    return low_performances(id, requirement).solve(others) == Feasibility::no;
  }

  void report(const Behavior& behavior, const Requirement& requirement, std::vector<Note> notes,
              std::vector<Edit> edits) {
    const std::string task = quote(proof_.catalog().tasks[requirement.task].name);
    proof_.reporter().report(
        rule::redundant_requirement, requirement.range,
        "the requirement of " + task + " is redundant: wherever behavior " + quote(behavior.name) +
            " is active, " + task +
            (requirement.minimum_performance > 0
                 ? " performs with at least " + format_percent(requirement.minimum_performance)
                 : std::string(" runs")) +
            " anyway",
        std::move(notes), std::move(edits));
  }

  void note_undecided(BehaviorId id, const CompiledRequirement& requirement) {
    if (undecided_++ > 0) return;
    undecided_behavior_ = id;
    undecided_task_ = requirement.task;
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  std::size_t undecided_ = 0;
  BehaviorId undecided_behavior_ = none;  ///< of the first one
  TaskId undecided_task_ = none;
};

}  // namespace

void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter) {
  const std::vector<std::vector<bool>> in_cycle = requirements_in_cycles(catalog);
  for (std::size_t index = 0; index < catalog.behaviors.size(); ++index) {
    if (conflicts[index]) continue;
    const std::vector<Requirement>& requirements = catalog.behaviors[index].requirements;
    for (std::size_t place = 0; place < requirements.size(); ++place) {
      const Requirement& requirement = requirements[place];
      const Task& task = catalog.tasks[requirement.task];
      // No task of a cycle can be requested first.
      if (!is_on_request(task) || in_cycle[index][place]) continue;
      report(catalog.behaviors[index], requirement, task, quote(task.name), reporter);
    }
  }
}

void check_by_proof(const CatalogReading& reading, const CompiledCatalog& compiled,
                    const std::vector<bool>& conflicts, const LintOptions& options,
                    Reporter& reporter) {
  AssignmentSearch search(compiled, options.max_nodes,
                          Effort(most_effort_of_assignments, options.is_stopped));
  const Liveness liveness(search);
  ProofContext proof(reading.catalog, search, liveness, options, reporter);
  for (std::size_t behavior = 0; behavior < conflicts.size(); ++behavior) {
    if (conflicts[behavior]) proof.explain_behavior(compiled.behavior_ids[behavior]);
  }
  MinimumCheck(proof).check();
  DeadCheck(proof).check();
  OnRequestCheck(proof).check();
  // A value that could not be read excludes nothing, so more requirements may seem redundant.
  if (reading.is_complete) {
    check_situations(proof);
    RedundancyCheck(proof).check();
  }
  check_together(proof, options, reading.is_complete);
}

}  // namespace cbc
