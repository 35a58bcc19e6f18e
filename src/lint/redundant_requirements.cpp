#include "lint/redundant_requirements.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "explain/constraints.h"
#include "explain/minimal_set.h"
#include "lint/constraint_notes.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

class RedundancyCheck {
 public:
  explicit RedundancyCheck(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  void check(BehaviorId id) {
    if (semantics_.liveness().of_behavior(id) != Liveness::State::live) return;
    check_repetitions(semantics_.behavior(id));
    if (catalog_.requirements[id].size() < 2) return;
    for (const CompiledRequirement& requirement : doubtful_requirements(id)) {
      check_requirement(id, requirement);
    }
  }

  /// One note for all, at the first one: such catalogs are large.
  void report_undecided() {
    if (undecided_ == 0) return;
    const Behavior& behavior = semantics_.behavior(undecided_behavior_);
    const TaskIndex task = catalog_.tasks[undecided_task_].catalog_index;
    semantics_.reporter().report(
        rule::undecided, strongest_requirement(behavior, task).range,
        "whether the requirement of " + quote(semantics_.catalog().tasks[task].name) +
            (undecided_ > 1 ? ", and " + std::to_string(undecided_ - 1) + " others," : "") +
            " is redundant could not be decided: there is too much to search");
  }

 private:
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
             {semantics_.reporter().note(kept.range, "it is required here already")},
             std::move(edits));
    }
  }

  /// The requirements whose tasks may be required by what the behavior requires otherwise, too. No
  /// other can be redundant. As requirements form no cycle, what leads to a task is not led to by
  /// it.
  [[nodiscard]] std::vector<CompiledRequirement> doubtful_requirements(BehaviorId id) const {
    RelevantTasks all(catalog_, catalog_.group_of(id));
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      all.add(requirement.task);
    }
    all.close();
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
    std::vector<Reason> others;
    for (const ValueId value : catalog_.performs[id]) relevant.add(catalog_.task_of(value));
    relevant.close();
    for (const TaskId task : relevant.tasks()) {
      add_exclusions(catalog_, task, relevant, most_constraints, others);
      add_minimum(catalog_, task, others);
    }
    for (const BehaviorId behavior : relevant.behaviors()) {
      add_requirements(catalog_, behavior, others);
    }
    if (others.size() >= most_constraints) {
      note_undecided(id, requirement);
      return;
    }
    others.erase(std::remove_if(others.begin(), others.end(),
                                [&](const Reason& reason) {
                                  return reason.behavior == id && reason.task == requirement.task;
                                }),
                 others.end());
    const Feasibility answer = can_be_broken(id, requirement, others);
    if (answer == Feasibility::unknown) note_undecided(id, requirement);
    if (answer != Feasibility::no) return;

    const std::vector<Reason> reason = minimal_set(others, [&](std::span<const Reason> some) {
      return can_be_broken(id, requirement, some) != Feasibility::no;
    });
    const Behavior& behavior = semantics_.behavior(id);
    const TaskIndex task = catalog_.tasks[requirement.task].catalog_index;
    report(behavior, strongest_requirement(behavior, task),
           constraint_notes(reason, semantics_.catalog(), catalog_, semantics_.reporter()), {});
  }

  /// What the behavior requires apart from a task, with all that leads to.
  [[nodiscard]] RelevantTasks others_of(BehaviorId id, TaskId task) const {
    RelevantTasks relevant(catalog_, catalog_.group_of(id));
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      if (requirement.task != task) relevant.add(requirement.task);
    }
    relevant.close();
    return relevant;
  }

  /// Whether the behavior can be active with the requirement not satisfied.
  Feasibility can_be_broken(BehaviorId id, const CompiledRequirement& requirement,
                            std::span<const Reason> others) {
    Feasibility answer = Feasibility::no;
    const auto add = [&answer](Feasibility one) {
      if (one == Feasibility::yes || answer == Feasibility::no) answer = one;
    };
    Reason closed;
    closed.kind = Reason::Kind::on_request;
    closed.task = requirement.task;
    std::vector<Reason> without(others.begin(), others.end());
    without.push_back(closed);
    for (const ValueId value : catalog_.performs[id]) {
      const TaskId task = catalog_.task_of(value);
      RelaxedProblem problem = semantics_.relaxed({task, value - catalog_.values.begin[task]});
      add(semantics_.solve(problem, without));
      if (answer == Feasibility::yes) return answer;
      if (requirement.minimum_performance == 0) continue;
      problem.keep_below(requirement.task, requirement.minimum_performance);
      add(semantics_.solve(problem, others));
      if (answer == Feasibility::yes) return answer;
    }
    return answer;
  }

  void report(const Behavior& behavior, const Requirement& requirement, std::vector<Note> notes,
              std::vector<Edit> edits) {
    const std::string task = quote(semantics_.catalog().tasks[requirement.task].name);
    semantics_.reporter().report(
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

  /// With more constraints than this a group is too large for the question.
  static constexpr std::size_t most_constraints = 20'000;

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  std::size_t undecided_ = 0;
  BehaviorId undecided_behavior_ = none;  ///< of the first one
  TaskId undecided_task_ = none;
};

}  // namespace

void check_redundant_requirements(Semantics& semantics) {
  RedundancyCheck check(semantics);
  for (BehaviorId id = 0; id < semantics.compiled().behaviors.size(); ++id) check.check(id);
  check.report_undecided();
}

}  // namespace cbc
