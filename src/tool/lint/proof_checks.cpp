#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text.h"
#include "catalog/catalog.h"
#include "diagnostic/rules.h"
#include "explain/reasons.h"
#include "lint/checks.h"
#include "lint/proofs.h"
#include "solver/objective.h"

namespace cbc {
namespace {

/// The first list that has both tasks.
Range range_of_list(const Catalog& catalog, TaskIndex a, TaskIndex b) {
  for (const ExclusivityList& list : catalog.exclusivity) {
    const auto has = [&list](TaskIndex task) {
      return std::find(list.tasks.begin(), list.tasks.end(), task) != list.tasks.end();
    };
    if (has(a) && has(b)) return list.range;
  }
  return {};
}

Note to_note(const Reason& reason, const Catalog& catalog, const CompiledCatalog& compiled,
             const Reporter& reporter) {
  const TaskIndex task_index = compiled.tasks[reason.task].catalog_index;
  const Task& task = catalog.tasks[task_index];
  if (reason.kind == Reason::Kind::exclusive) {
    const TaskIndex other = compiled.tasks[reason.other_task].catalog_index;
    return reporter.note(range_of_list(catalog, task_index, other),
                         quote(task.name) + " excludes " + quote(catalog.tasks[other].name));
  }
  if (reason.behavior == none) {
    return reporter.note(
        task.minimum_performance_range,
        quote(task.name) + " runs with at least " + format_percent(reason.minimum_performance));
  }
  const Behavior& behavior = catalog.behaviors[compiled.behaviors[reason.behavior].catalog_index];
  const Requirement& requirement = strongest_requirement(behavior, task_index);
  if (reason.kind == Reason::Kind::performance) {
    return reporter.note(requirement.minimum_performance_range,
                         "behavior " + quote(behavior.name) + " requires " + quote(task.name) +
                             " with at least " + format_percent(reason.minimum_performance));
  }
  return reporter.note(requirement.range,
                       "behavior " + quote(behavior.name) + " requires " + quote(task.name));
}

}  // namespace

const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task) {
  const Requirement* found = nullptr;
  for (const Requirement& requirement : behavior.requirements) {
    if (requirement.task != task) continue;
    if (found == nullptr || requirement.minimum_performance > found->minimum_performance) {
      found = &requirement;
    }
  }
  return *found;  // NOLINT(clang-analyzer-core.uninitialized.UndefReturn): there is one
}

std::vector<Note> constraint_notes(std::span<const Reason> constraints, const Catalog& catalog,
                                   const CompiledCatalog& compiled, const Reporter& reporter) {
  struct Entry {
    bool requires_task = false;
    std::uint32_t level = 0;
    Note note;
  };
  std::vector<Entry> entries;
  for (const Reason& reason : constraints) {
    const std::uint32_t level =
        reason.behavior == none ? 0 : compiled.behaviors[reason.behavior].level;
    entries.push_back({reason.kind == Reason::Kind::requires_task, level,
                       to_note(reason, catalog, compiled, reporter)});
  }
  // Requirements from the top down, then what they lead to; otherwise as in the file.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.requires_task != b.requires_task) return a.requires_task;
    return a.level != b.level ? a.level > b.level : a.note.range < b.note.range;
  });
  std::vector<Note> notes;
  notes.reserve(entries.size());
  for (Entry& entry : entries) notes.push_back(std::move(entry.note));
  return notes;
}

namespace {

/// With more constraints than this, finding a minimal set takes too long.
constexpr std::size_t most_constraints = 20'000;

/// A value is what is explained: a behavior of several tasks may be dead as a value of one of them
/// for one reason, and as a value of another for another.
class DeadChecks {
 public:
  explicit DeadChecks(Semantics& semantics)
      : semantics_(semantics),
        catalog_(semantics.compiled()),
        is_explained_below_(catalog_.values.items.size()) {
    for (TaskId task = 0; task < catalog_.tasks.size(); ++task) {
      is_dead_.push_back(semantics.liveness().of_task(task) == Liveness::State::dead);
    }
  }

  /// From the lowest level up: where something dead is required, the reason for that is known.
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
    if (semantics_.is_explained_task(task)) return;
    const Semantics::Goal goal{task, none};
    const std::vector<Reason> constraints = unexplained_constraints({&goal, 1}, none);
    if (can_be_had({&goal, 1}, constraints)) return;
    const std::vector<Note> notes = find_reason({&goal, 1}, constraints);
    semantics_.reporter().report(
        rule::dead_task, semantics_.task(task).range,
        "task " + quote(semantics_.task(task).name) + " can never run" +
            (notes.empty() ? "" : ": together these constraints exclude all of its behaviors"),
        notes);
    semantics_.explain_task(task);
  }

  void check_behaviors(TaskId task, bool of_several_tasks) {
    for (const Value& value : catalog_.values[task]) {
      const bool has_several = catalog_.performs[value.behavior].size() > 1;
      if (has_several == of_several_tasks) check_behavior(value.behavior);
    }
  }

  void check_behavior(BehaviorId id) {
    if (semantics_.is_explained_behavior(id)) return;
    const Liveness::State state = semantics_.liveness().of_behavior(id);
    if (state == Liveness::State::live) return;
    const Behavior& behavior = semantics_.behavior(id);
    if (state == Liveness::State::undecided) {
      semantics_.report_undecided(behavior.range,
                                  "whether behavior " + quote(behavior.name) + " can be active");
      semantics_.explain_behavior(id);
      return;
    }
    std::vector<Semantics::Goal> goals;
    for (const ValueId value : catalog_.performs[id]) {
      const TaskId task = catalog_.task_of(value);
      goals.push_back({task, value - catalog_.values.begin[task]});
    }
    const std::vector<Reason> constraints = unexplained_constraints(goals, id);
    if (is_explained_elsewhere(id, goals, constraints)) return;
    const std::vector<Note> notes = find_reason(goals, constraints);
    semantics_.reporter().report(
        rule::dead_behavior, behavior.range,
        "behavior " + quote(behavior.name) + " can never be active" +
            (notes.empty() ? "" : ": together these constraints exclude it"),
        notes);
    semantics_.explain_behavior(id);
  }

  /// Whether a finding on one of its tasks, or what is explained below it, is why a behavior is
  /// dead: then it may come to life once that is mended.
  bool is_explained_elsewhere(BehaviorId id, std::span<const Semantics::Goal> goals,
                              const std::vector<Reason>& constraints) {
    bool is_explained = false;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const ValueId value = catalog_.performs[id][i];
      if (can_be_had(goals.subspan(i, 1), constraints)) is_explained_below_[value] = true;
      is_explained |= is_explained_value(value);
    }
    return is_explained;
  }

  bool can_be_had(std::span<const Semantics::Goal> goals, const std::vector<Reason>& constraints) {
    return constraints.size() <= most_constraints &&
           semantics_.solve(goals, constraints) == Feasibility::yes;
  }

  /// Why none of the goals can be had. Empty if the reason is beyond reach.
  std::vector<Note> find_reason(std::span<const Semantics::Goal> goals,
                                const std::vector<Reason>& constraints) {
    if (constraints.size() > most_constraints ||
        semantics_.solve(goals, constraints) != Feasibility::no) {
      return {};
    }
    const std::vector<Reason> reason =
        minimal_conflict_set(constraints, [&](std::span<const Reason> some) {
          return semantics_.solve(goals, some) != Feasibility::no;
        });
    return constraint_notes(reason, semantics_.catalog(), catalog_, semantics_.reporter());
  }

  /// The constraints that bear on the goals, but for those of what is explained already. `own`: the
  /// behavior that it is about, if it is about one.
  std::vector<Reason> unexplained_constraints(std::span<const Semantics::Goal> goals,
                                              BehaviorId own) {
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
    for (const Semantics::Goal& goal : goals) relevant.add(goal.task);

    std::vector<Reason> reasons;
    for (const TaskId task : relevant.tasks()) {
      add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
      if (!semantics_.is_explained_task(task)) add_minimum(catalog_, task, reasons);
    }
    if (own != none) add_requirements(catalog_, own, reasons);
    for (const BehaviorId behavior : behaviors) {
      if (is_explained(behavior, goals, relevant)) continue;
      add_requirements(catalog_, behavior, reasons);
    }
    reasons.erase(std::remove_if(reasons.begin(), reasons.end(),
                                 [this](const Reason& reason) {
                                   return reason.behavior != none &&
                                          catalog_.values[reason.task].empty();
                                 }),
                  reasons.end());
    return reasons;
  }

  /// Whether what a behavior requires is no reason any more: it is dead, and that is explained, or
  /// it performs a task that is dead, and that the goals may require.
  [[nodiscard]] bool is_explained(BehaviorId behavior, std::span<const Semantics::Goal> goals,
                                  const RelevantTasks& relevant) const {
    if (semantics_.is_explained_behavior(behavior)) return true;
    const auto performed = catalog_.performs[behavior];
    const auto is_below = [&](TaskId task) {
      return relevant.contains(task) &&
             std::none_of(goals.begin(), goals.end(),
                          [task](const Semantics::Goal& goal) { return goal.task == task; });
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
    return is_explained_below_[value] || semantics_.is_explained_task(catalog_.task_of(value));
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  std::vector<bool> is_dead_;             ///< by task
  std::vector<bool> is_explained_below_;  ///< by value: what it needs is dead, which is explained
};

}  // namespace

void check_dead(Semantics& semantics) { DeadChecks(semantics).check(); }

namespace {

bool is_below(const std::vector<Millionths>& factors, Millionths minimum) {
  ExactProduct product;
  for (const Millionths factor : factors) product.multiply(factor);
  ExactProduct least;
  least.multiply(minimum);
  return ExactProduct::compare(product, least) < 0;
}

class MinimumCheck {
 public:
  explicit MinimumCheck(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  /// What a live behavior requires is reached. Where the required task cannot run at all, that is
  /// the fault.
  void check_behavior(BehaviorId id) {
    if (semantics_.liveness().of_behavior(id) != Liveness::State::dead) return;
    const Behavior& behavior = semantics_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.minimum_performance == 0) continue;
      const TaskId task = catalog_.task_ids[requirement.task];
      if (semantics_.liveness().of_task(task) != Liveness::State::live) continue;
      const AssignmentSearch::Best& best = best_of(task);
      const std::string name = quote(semantics_.task(task).name);
      if (best.exists == Feasibility::unknown) {
        semantics_.report_undecided(
            requirement.minimum_performance_range,
            "whether " + name + " can reach " + format_percent(requirement.minimum_performance));
      } else if (best.exists == Feasibility::yes &&
                 is_below(best.factors, requirement.minimum_performance)) {
        semantics_.reporter().report(
            rule::unreachable_performance, requirement.minimum_performance_range,
            "behavior " + quote(behavior.name) + " requires " + name + " with at least " +
                format_percent(requirement.minimum_performance) +
                ", but the best that can be reached is " + show_product(best.factors));
        semantics_.explain_behavior(id);
      }
    }
  }

  void check_task(TaskId id) {
    const Task& task = semantics_.task(id);
    if (task.minimum_performance == 0 || catalog_.values[id].empty()) return;
    if (semantics_.liveness().of_task(id) != Liveness::State::dead) return;
    const AssignmentSearch::Best best = semantics_.search().best_performance(id, true);
    if (best.exists == Feasibility::unknown) {
      semantics_.report_undecided(
          task.minimum_performance_range,
          "whether " + quote(task.name) + " can reach " + format_percent(task.minimum_performance));
    } else if (best.exists == Feasibility::yes) {
      semantics_.reporter().report(rule::unreachable_performance, task.minimum_performance_range,
                                   "task " + quote(task.name) + " must perform with at least " +
                                       format_percent(task.minimum_performance) +
                                       ", but the best that can be reached is " +
                                       show_product(best.factors));
      semantics_.explain_task(id);
    }
  }

 private:
  const AssignmentSearch::Best& best_of(TaskId task) {
    const auto [entry, is_new] = best_.try_emplace(task);
    if (is_new) entry->second = semantics_.search().best_performance(task, false);
    return entry->second;
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  std::unordered_map<TaskId, AssignmentSearch::Best> best_;
};

}  // namespace

void check_minimum_performances(Semantics& semantics) {
  MinimumCheck check(semantics);
  const CompiledCatalog& catalog = semantics.compiled();
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) check.check_task(task);
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    check.check_behavior(behavior);
  }
}

namespace {

bool is_on_request(const Task& task) { return task.start_on_request && !task.is_unclear; }

void report(const Behavior& behavior, const Requirement& requirement, const Task& task,
            const std::string& first, Reporter& reporter) {
  reporter.report(rule::requires_on_request, requirement.range,
                  describe(behavior) + " requires " + quote(task.name) +
                      ", which starts on request only: request " + first + " first",
                  {reporter.note(task.range, quote(task.name) + " is defined here")});
}

class OnRequestCheck {
 public:
  explicit OnRequestCheck(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  void check(BehaviorId id) {
    if (semantics_.liveness().of_behavior(id) == Liveness::State::dead) return;
    const Behavior& behavior = semantics_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      const Task& task = semantics_.catalog().tasks[requirement.task];
      if (!is_on_request(task)) continue;
      report(behavior, requirement, task,
             join(tasks_to_request(id, catalog_.task_ids[requirement.task])),
             semantics_.reporter());
    }
  }

 private:
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
      return semantics_.search().find(value, closed, solution_) == Feasibility::yes;
    });
  }

  [[nodiscard]] std::string join(const std::vector<TaskId>& tasks) const {
    constexpr std::size_t most_names = 10;
    std::string text;
    for (std::size_t place = 0; place < tasks.size(); ++place) {
      // Of a long list the beginning, and what is required in the end.
      if (tasks.size() > most_names && place == most_names - 1) {
        text += ", then " + std::to_string(tasks.size() - most_names) + " more";
        place = tasks.size() - 1;
      }
      if (!text.empty()) text += ", then ";
      text += quote(semantics_.task(tasks[place]).name);
    }
    return text;
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  Assignment solution_;
};

}  // namespace

void check_on_request_requirements(Semantics& semantics) {
  OnRequestCheck check(semantics);
  for (BehaviorId id = 0; id < semantics.compiled().behaviors.size(); ++id) check.check(id);
}

void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter) {
  for (std::size_t index = 0; index < catalog.behaviors.size(); ++index) {
    if (conflicts[index]) continue;
    for (const Requirement& requirement : catalog.behaviors[index].requirements) {
      const Task& task = catalog.tasks[requirement.task];
      if (!is_on_request(task)) continue;
      report(catalog.behaviors[index], requirement, task, quote(task.name), reporter);
    }
  }
}

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

    const std::vector<Reason> reason =
        minimal_conflict_set(others, [&](std::span<const Reason> some) {
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
      ConflictSearch problem = semantics_.relaxed({task, value - catalog_.values.begin[task]});
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

void check_semantics(const CatalogReading& reading, const CompiledCatalog& compiled,
                     const std::vector<bool>& conflicts, const LintOptions& options,
                     Reporter& reporter) {
  AssignmentSearch search(compiled, options.max_nodes);
  const Liveness liveness(search);
  Semantics semantics(reading.catalog, search, liveness, options.max_nodes, reporter);
  // The special cases first: what they explain is not explained again.
  for (std::size_t behavior = 0; behavior < conflicts.size(); ++behavior) {
    if (conflicts[behavior]) semantics.explain_behavior(compiled.behavior_ids[behavior]);
  }
  check_minimum_performances(semantics);
  check_dead(semantics);
  check_on_request_requirements(semantics);
  // A value that could not be read excludes nothing, so that more may seem to hold anyway.
  if (reading.is_complete) check_redundant_requirements(semantics);
}

}  // namespace cbc
