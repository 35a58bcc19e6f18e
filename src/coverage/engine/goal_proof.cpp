// A goal that no move of a complete exploration meets is unreachable, and does not count: adequacy
// for what is feasible, and not for what can be written down (P. G. Frankl and E. J. Weyuker, "An
// applicable family of data flow testing criteria", IEEE Transactions on Software Engineering 14
// (1988)). For programs that is undecidable; here the states are finite. The reason comes from
// facts that were noted on the way, such as which tasks ran and which starts were accepted: the
// first part of what the goal needs that was never seen.
//
// A minimal conflict set, as for a rejected event, would be a reason in terms of the catalog. But
// it explains one state, and a goal is unreachable for other reasons in other states; what they
// have in common is what never happens.

#include "coverage/engine/goal_proof.h"

#include <algorithm>

#include <fmt/format.h>

namespace cbc {
namespace {

/// The values whose time the goal of a timeout is about.
std::vector<ValueId> timed_values(const CompiledCatalog& catalog, const Goal& goal) {
  std::vector<ValueId> values;
  if (goal.behavior != none) {
    for (const ValueId value : catalog.performs[goal.behavior]) {
      if (timeout_of(catalog, catalog.task_of(value), goal.behavior) > 0) values.push_back(value);
    }
    return values;
  }
  for (ValueId value(catalog.values.begin[goal.task]); value < catalog.values.begin[goal.task + 1];
       ++value) {
    const BehaviorId behavior = catalog.values.items[value].behavior;
    if (catalog.behaviors[behavior].timeout == 0) values.push_back(value);
  }
  return values;
}

class ReasonFinder {
 public:
  ReasonFinder(const CompiledCatalog& catalog, const Assumptions& assumptions,
               const GoalFacts& facts)
      : catalog_(catalog), assumptions_(assumptions), facts_(facts) {}

  [[nodiscard]] std::string find(const Goal& goal, bool was_asked) const {
    switch (goal.kind) {
      case Goal::Kind::task_ran:
        return why_never_ran(goal.task);
      case Goal::Kind::behavior_active:
      case Goal::Kind::requirement_used:
        return why_never_active(goal.behavior);
      case Goal::Kind::behavior_succeeded:
        if (!was_active(goal.behavior)) return why_never_active(goal.behavior);
        if (!assumptions_.successes) return "no behavior achieves its goal";
        return fmt::format("whenever {} is active, it performs a task that is to keep running",
                           behavior_name(goal.behavior));
      case Goal::Kind::behavior_failed:
        if (!was_active(goal.behavior)) return why_never_active(goal.behavior);
        if (assumptions_.faults == 0) return "no behavior fails";
        return fmt::format("no active behavior fails, and no attempt to activate {} does",
                           behavior_name(goal.behavior));
      case Goal::Kind::failure_remembered:
        if (!was_active(goal.behavior)) return why_never_active(goal.behavior);
        return "no behavior fails";
      case Goal::Kind::improved_at_once:
        if (!ran(goal.task)) return why_never_ran(goal.task);
        return fmt::format("nothing better becomes available while task {} runs",
                           task_name(goal.task));
      case Goal::Kind::request_suspended:
        if (!ran(goal.task)) return why_never_ran(goal.task);
        return fmt::format("only its own stop and the end of its behavior stop task {}",
                           task_name(goal.task));
      case Goal::Kind::request_resumed:
        return fmt::format("the request of {} is never suspended, or what it needs never comes",
                           task_name(goal.task));
      case Goal::Kind::behavior_replaced:
        return why_never_replaced(goal.behavior);
      case Goal::Kind::requirement_decided:
      case Goal::Kind::minimum_decided:
      case Goal::Kind::exclusion_decided:
        return why_never_decided(goal, was_asked);
      case Goal::Kind::timeout_fired:
        return why_never_timed_out(goal);
      case Goal::Kind::reactive_started:
        if (!ran(goal.task)) return why_never_ran(goal.task);
        return fmt::format("whenever task {} is due to start, it runs or cannot",
                           task_name(goal.task));
      case Goal::Kind::reactive_gave_way:
        if (!ran(goal.task)) return why_never_ran(goal.task);
        return fmt::format("only its own stop and the end of its behavior stop task {}",
                           task_name(goal.task));
      case Goal::Kind::reactive_returned:
        return why_never_returned(goal.task);
      case Goal::Kind::variable_value:
        return why_never_value(goal);
      case Goal::Kind::behavior_began_to_fit:
        if (const auto reason = why_always_or_never_fits(goal.behavior)) return *reason;
        return fmt::format("no change leads to a situation that {} fits from another one",
                           behavior_name(goal.behavior));
      case Goal::Kind::behavior_ceased_to_fit:
        if (!was_active(goal.behavior)) return why_never_active(goal.behavior);
        if (const auto reason = why_always_or_never_fits(goal.behavior)) return *reason;
        return fmt::format(
            "while {} is active, no change leads to a situation that it does not fit",
            behavior_name(goal.behavior));
      case Goal::Kind::higher_displaced:
      case Goal::Kind::lower_rejected:
      case Goal::Kind::equal_displaced:
        return why_never_decided_by_priority(goal);
    }
    return {};
  }

 private:
  [[nodiscard]] std::string task_name(TaskId task) const {
    return printable(catalog_.name_of_task(task));
  }
  [[nodiscard]] std::string behavior_name(BehaviorId behavior) const {
    return printable(catalog_.name_of_behavior(behavior));
  }

  [[nodiscard]] bool ran(TaskId task) const {
    const auto begin = facts_.performed.begin();
    return std::any_of(begin + catalog_.values.begin[task], begin + catalog_.values.begin[task + 1],
                       [](std::uint8_t performed) { return performed != 0; });
  }
  [[nodiscard]] bool was_active(BehaviorId behavior) const {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return facts_.performed[value] != 0; });
  }
  [[nodiscard]] const Assumptions::Start* start_of(TaskId task) const {
    const auto found =
        std::find_if(assumptions_.start.begin(), assumptions_.start.end(),
                     [task](const Assumptions::Start& start) { return start.task == task; });
    return found == assumptions_.start.end() ? nullptr : &*found;
  }

  [[nodiscard]] std::string why_never_ran(TaskId task) const {
    const auto values = catalog_.values[task];
    if (values.empty()) return fmt::format("no behavior performs task {}", task_name(task));
    const bool fits_any = std::any_of(values.begin(), values.end(), [&](const Value& value) {
      return facts_.fitted[value.behavior] != 0;
    });
    if (!fits_any) {
      return values.size() == 1 ? why_never_fits(values.front().behavior)
                                : fmt::format("no behavior of task {} fits any reachable situation",
                                              task_name(task));
    }
    if (start_of(task) != nullptr) {
      return fmt::format("every start of task {} is rejected", task_name(task));
    }
    if (catalog_.tasks[task].reactive_start != 0) {
      return fmt::format("whenever task {} is due to start, it cannot", task_name(task));
    }
    if (catalog_.incoming[task].empty()) {
      return fmt::format("no event requests task {}, and no behavior requires it", task_name(task));
    }
    return fmt::format("no event requests task {}, and no behavior that requires it is ever active",
                       task_name(task));
  }

  [[nodiscard]] std::string why_never_fits(BehaviorId behavior) const {
    return fmt::format("{} fits no reachable situation", behavior_name(behavior));
  }
  [[nodiscard]] std::optional<std::string> why_always_or_never_fits(BehaviorId behavior) const {
    if (facts_.fitted[behavior] == 0) return why_never_fits(behavior);
    if (facts_.misfitted[behavior] != 0) return std::nullopt;
    return fmt::format("{} fits every reachable situation", behavior_name(behavior));
  }

  [[nodiscard]] std::string why_never_active(BehaviorId behavior) const {
    if (facts_.fitted[behavior] == 0) return why_never_fits(behavior);
    const auto values = catalog_.performs[behavior];
    const bool any_ran = std::any_of(values.begin(), values.end(),
                                     [&](ValueId value) { return ran(catalog_.task_of(value)); });
    const TaskId first = catalog_.task_of(values.front());
    if (!any_ran && values.size() == 1 && catalog_.values[first].size() > 1) {
      return fmt::format("task {} never runs", task_name(first));
    }
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      if (ran(requirement.task)) continue;
      return fmt::format("{} requires task {}, which never runs", behavior_name(behavior),
                         task_name(requirement.task));
    }
    if (!any_ran) {
      return values.size() == 1 ? why_never_ran(first)
                                : fmt::format("no task of {} ever runs", behavior_name(behavior));
    }
    if (values.size() == 1) {
      return fmt::format("task {} always runs with another behavior", task_name(first));
    }
    return fmt::format("the tasks of {} always run with other behaviors", behavior_name(behavior));
  }

  [[nodiscard]] std::string why_never_replaced(BehaviorId behavior) const {
    if (!was_active(behavior)) return why_never_active(behavior);
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId task = catalog_.task_of(value);
      for (ValueId other(catalog_.values.begin[task]); other < catalog_.values.begin[task + 1];
           ++other) {
        if (other == value || facts_.performed[other] == 0) continue;
        return fmt::format("when {} ends, no task goes on with another behavior",
                           behavior_name(behavior));
      }
    }
    const auto values = catalog_.performs[behavior];
    return values.size() == 1 ? fmt::format("task {} never runs with another behavior",
                                            task_name(catalog_.task_of(values.front())))
                              : fmt::format("the tasks of {} never run with other behaviors",
                                            behavior_name(behavior));
  }

  [[nodiscard]] std::string why_never_decided(const Goal& goal, bool was_asked) const {
    if (was_asked) return why_superfluous(goal);
    if (goal.kind == Goal::Kind::exclusion_decided) {
      return fmt::format("{} and {} never compete: in no event may both run", task_name(goal.task),
                         task_name(goal.other_task));
    }
    if (goal.behavior == none) {
      return fmt::format("in no event may task {} run", task_name(goal.task));
    }
    if (facts_.fitted[goal.behavior] == 0) return why_never_fits(goal.behavior);
    return fmt::format("in no event may {} be active", behavior_name(goal.behavior));
  }

  /// Without the constraint, an answer is another one only if it violates the constraint.
  [[nodiscard]] std::string why_superfluous(const Goal& goal) const {
    const std::string task = task_name(goal.task);
    if (goal.kind == Goal::Kind::exclusion_decided) {
      return fmt::format("even without that no event would run both {} and {}", task,
                         task_name(goal.other_task));
    }
    if (goal.behavior == none) {
      return fmt::format("even without it no event would run {} below it", task);
    }
    if (!was_active(goal.behavior)) {
      return fmt::format("even without {}, {} would never be active",
                         goal.kind == Goal::Kind::requirement_decided ? "that" : "it",
                         behavior_name(goal.behavior));
    }
    return fmt::format("even without {}, wherever {} is active, {} would {}",
                       goal.kind == Goal::Kind::requirement_decided ? "that" : "it",
                       behavior_name(goal.behavior), task,
                       goal.kind == Goal::Kind::requirement_decided ? "run" : "reach it");
  }

  [[nodiscard]] std::string why_never_timed_out(const Goal& goal) const {
    const std::vector<ValueId> values = timed_values(catalog_, goal);
    const auto performed = std::find_if(
        values.begin(), values.end(), [&](ValueId value) { return facts_.performed[value] != 0; });
    if (performed == values.end()) {
      if (goal.behavior != none) {
        return was_active(goal.behavior)
                   ? fmt::format("{} only performs tasks that are to keep running",
                                 behavior_name(goal.behavior))
                   : why_never_active(goal.behavior);
      }
      return ran(goal.task) ? fmt::format(
                                  "task {} only runs with behaviors that have timeouts of "
                                  "their own",
                                  task_name(goal.task))
                            : why_never_ran(goal.task);
    }
    if (!assumptions_.failures) return "no behavior fails, and so none runs into a timeout";
    const ValueId first = facts_.forestalled_by[*performed];
    const TaskId task = catalog_.task_of(first);
    const BehaviorId behavior = catalog_.values.items[first].behavior;
    const bool is_own = catalog_.behaviors[behavior].timeout > 0;
    return fmt::format("the timeout of {} ({} s) always comes first",
                       is_own ? behavior_name(behavior) : "task " + task_name(task),
                       format_decimal(timeout_of(catalog_, task, behavior), 6));
  }

  [[nodiscard]] std::string why_never_returned(TaskId task) const {
    if (facts_.gave_way[task] == 0) {
      return ran(task) ? fmt::format("task {} never gives way", task_name(task))
                       : why_never_ran(task);
    }
    if (facts_.started_itself[task] == 0) {
      return fmt::format("task {} never starts by itself", task_name(task));
    }
    return fmt::format("after task {} gave way, it never starts by itself", task_name(task));
  }

  [[nodiscard]] std::string why_never_value(const Goal& goal) const {
    const std::string variable = printable(catalog_.name_of_variable(goal.variable));
    if (!may_change(assumptions_, goal.variable)) {
      return fmt::format("{} always is {}", variable,
                         printable(catalog_.name_of_value(
                             {goal.variable, initial_value(assumptions_, goal.variable)})));
    }
    return fmt::format("no situation in which {} is {} can be reached", variable,
                       printable(catalog_.name_of_value({goal.variable, goal.value})));
  }

  [[nodiscard]] std::string why_never_decided_by_priority(const Goal& goal) const {
    const std::string task = task_name(goal.task);
    const Assumptions::Start* const start = start_of(goal.task);
    if (start == nullptr) return fmt::format("no event requests task {}", task);
    if (goal.kind == Goal::Kind::lower_rejected) {
      return facts_.start_rejected[goal.task] == 0
                 ? fmt::format("no start of task {} is rejected", task)
                 : fmt::format(
                       "every rejected start of task {} would be rejected even if no "
                       "priority were higher",
                       task);
    }
    if (facts_.start_accepted[goal.task] == 0) {
      return fmt::format("every start of task {} is rejected", task);
    }
    return fmt::format("no start of task {} stops a task with {} priority", task,
                       goal.kind == Goal::Kind::higher_displaced ? "a lower" : "the same");
  }

  const CompiledCatalog& catalog_;
  const Assumptions& assumptions_;
  const GoalFacts& facts_;
};

/// Of a variable that neither a behavior nor `never` names.
bool may_have(const Assumptions& assumptions, const Goal& goal) {
  return initial_value(assumptions, goal.variable) == goal.value ||
         may_change(assumptions, goal.variable);
}

}  // namespace

std::vector<GroupId> groups_of(const CompiledCatalog& catalog, const Goal& goal) {
  if (goal.task != none) return {catalog.tasks[goal.task].group};
  if (goal.behavior != none) return {catalog.group_of(goal.behavior)};
  std::vector<GroupId> groups;
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (fitting.variable == goal.variable) groups.push_back(catalog.group_of(fitting.behavior));
  }
  return groups;
}

Assumptions assumptions_of_goals(const CompiledCatalog& catalog) {
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : catalog.task_ids) {
    const CompiledTask& compiled = catalog.tasks[task];
    const bool starts_otherwise = compiled.reactive_start != 0 || !catalog.incoming[task].empty();
    if (compiled.start_on_request == 0 && starts_otherwise) continue;
    if (catalog.rules_of(task).requestable == 0) continue;
    assumptions.start.push_back({task, {1, 2}});
    assumptions.stop.push_back(task);
  }
  return assumptions;
}

GoalProof prove_unreachable(const CompiledCatalog& catalog, std::span<const Goal> goals,
                            const Assumptions& assumptions, const GoalSearchOptions& options) {
  GoalProof proof;
  proof.unreachable.resize(goals.size());
  proof.groups.resize(catalog.group_count());
  proof.facts = GoalFacts(catalog, goals.size());
  std::vector<std::uint8_t> met(goals.size(), 0);
  const GoalQuestion question{goals, std::vector<std::uint8_t>(goals.size(), 1)};
  const auto search = [&](GoalScope scope) {
    GoalSearch found(catalog, scope, assumptions, question, options);
    GoalSearchResult result = found.run(proof.facts, met);
    proof.error = result.error;
    return result;
  };
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    if (options.budget_of(group, catalog.group_count()).find_end()) break;
    proof.groups[group] = search({group});
    if (proof.error) return proof;
  }
  const std::vector<std::uint32_t> bound = bound_variables(catalog, assumptions);
  for (std::size_t number = 0; number < goals.size(); ++number) {
    const std::uint32_t variable = goals[number].variable;
    if (met[number] != 0 || proof.situations.contains(variable) ||
        !std::binary_search(bound.begin(), bound.end(), variable) ||
        initial_value(assumptions, variable) == goals[number].value) {
      continue;
    }
    proof.situations[variable] = search({std::nullopt, variable});
    if (proof.error) return proof;
  }
  for (std::size_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    const std::vector<GroupId> groups = groups_of(catalog, goal);
    const auto situation = proof.situations.find(goal.variable);
    const bool is_bound = goal.variable != none && situation != proof.situations.end();
    const bool is_proven =
        std::all_of(groups.begin(), groups.end(),
                    [&](GroupId group) { return proof.groups[group].is_complete; }) &&
        (!is_bound || situation->second.is_complete);
    const bool is_free = groups.empty() && !is_bound && may_have(assumptions, goal);
    const bool is_met = met[number] != 0 && !is_forestalled(catalog, goal, proof.facts);
    if (is_met || !is_proven || is_free) continue;
    proof.unreachable[number] = why_unreachable(catalog, goals, number, assumptions, proof.facts);
  }
  return proof;
}

bool is_forestalled(const CompiledCatalog& catalog, const Goal& goal, const GoalFacts& facts) {
  if (goal.kind != Goal::Kind::timeout_fired) return false;
  std::vector<ValueId> values = timed_values(catalog, goal);
  std::erase_if(values, [&](ValueId value) { return facts.performed[value] == 0; });
  return !values.empty() && std::all_of(values.begin(), values.end(), [&](ValueId value) {
    return facts.forestalled_by[value] != none;
  });
}

std::string why_unreachable(const CompiledCatalog& catalog, std::span<const Goal> goals,
                            std::size_t number, const Assumptions& assumptions,
                            const GoalFacts& facts) {
  return ReasonFinder(catalog, assumptions, facts)
      .find(goals[number], facts.was_asked[number] != 0);
}

}  // namespace cbc
