// Mutation analysis (R. A. DeMillo, R. J. Lipton and F. G. Sayward, "Hints on test data selection:
// help for the practicing programmer", Computer 11 (1978)) of a catalog in place of a program: one
// thing is changed at a time, in a way in which people err, and tests should notice. A change is
// made where it takes effect: a suitability goes just below the next one, so that two behaviors
// change places; a pair of tasks is taken out of all lists that have both.
//
// Changes of the text would be easier to make, but many would be no catalog or the same one.
// Several changes at once would be far more mutants, and tests that notice each alone notice nearly
// all of them together (A. J. Offutt, "Investigations of the software testing coupling effect", ACM
// Transactions on Software Engineering and Methodology 1 (1992)).

#include "coverage/engine/mutants/mutants.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/text.h"

namespace cbc {
namespace {

/// In the order of the enumerators.
constexpr std::array<std::string_view, Mutant::kinds> mutant_kinds = {
    "behavior_removed",      "suitability_lowered",       "requirement_removed",
    "minimum_removed",       "condition_removed",         "exclusion_removed",
    "exclusion_narrowed",    "timeout_removed",           "start_on_request_turned",
    "reactive_start_turned", "execution_goal_turned",     "improve_removed",
    "resume_removed",        "reactive_priority_removed", "retry_removed",
    "limit_raised",
};

class MutantFinder {
 public:
  explicit MutantFinder(const Catalog& catalog)
      : catalog_(catalog), performances_(catalog.tasks.size()) {
    for (BehaviorIndex behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
      for (const Performance& performance : catalog.behaviors[behavior].performs) {
        performances_[performance.task].push_back({behavior, &performance});
      }
    }
  }

  std::vector<Mutant> find() {
    for (BehaviorIndex behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      add_changes_of_behavior(behavior);
    }
    for (TaskIndex task = 0; task < catalog_.tasks.size(); ++task) {
      add_suitabilities(task);
      add_changes_of_task(task);
    }
    add_exclusions();
    std::stable_sort(mutants_.begin(), mutants_.end(), [](const Mutant& a, const Mutant& b) {
      return a.lines.front() < b.lines.front();
    });
    return std::move(mutants_);
  }

 private:
  /// A behavior among those of a task.
  struct Performing {
    BehaviorIndex behavior = 0;
    const Performance* performance = nullptr;
  };

  Mutant& add(Mutant::Kind kind, const Range& range) {
    Mutant& mutant = mutants_.emplace_back();
    mutant.kind = kind;
    mutant.lines.push_back(range.begin.line);
    return mutant;
  }
  Mutant& add_for_task(Mutant::Kind kind, TaskIndex task, const Range& range) {
    Mutant& mutant = add(kind, range);
    mutant.task = task;
    return mutant;
  }
  Mutant& add_for_behavior(Mutant::Kind kind, BehaviorIndex behavior, const Range& range) {
    Mutant& mutant = add(kind, range);
    mutant.behavior = behavior;
    return mutant;
  }

  void add_changes_of_behavior(BehaviorIndex index) {
    const Behavior& behavior = catalog_.behaviors[index];
    add_for_behavior(Mutant::Kind::behavior_removed, index, behavior.range);
    std::set<TaskIndex> required;
    for (const Requirement& entry : behavior.requirements) {
      if (!required.insert(entry.task).second) continue;
      const Requirement& requirement = strongest_requirement(behavior, entry.task);
      add_for_behavior(Mutant::Kind::requirement_removed, index, requirement.range).task =
          entry.task;
      if (requirement.minimum_performance == 0) continue;
      add_for_behavior(Mutant::Kind::minimum_removed, index, requirement.minimum_performance_range)
          .task = entry.task;
    }
    for (const Condition& condition : behavior.situation) {
      add_for_behavior(Mutant::Kind::condition_removed, index, condition.range).variable =
          condition.variable;
    }
    if (behavior.retry != Retry::at_events) {
      add_for_behavior(Mutant::Kind::retry_removed, index, behavior.retry_range);
    }
    if (behavior.timeout && performs_any_to_achieve(behavior)) {
      add_for_behavior(Mutant::Kind::timeout_removed, index, behavior.timeout_range);
    }
  }

  [[nodiscard]] bool performs_any_to_achieve(const Behavior& behavior) const {
    return std::any_of(
        behavior.performs.begin(), behavior.performs.end(), [&](const Performance& performance) {
          return catalog_.tasks[performance.task].execution_goal == ExecutionGoal::achieve_goal;
        });
  }

  /// Each is moved just below the next lower one, as far as there is something below that.
  void add_suitabilities(TaskIndex task) {
    std::vector<Performing> ranked = performances_[task];
    std::stable_sort(ranked.begin(), ranked.end(), [](const Performing& a, const Performing& b) {
      return a.performance->suitability > b.performance->suitability;
    });
    for (std::size_t place = 0; place + 1 < ranked.size(); ++place) {
      const Performing& moved = ranked[place];
      const Millionths next = ranked[place + 1].performance->suitability;
      if (next == 0) continue;
      const Range& range = moved.performance->suitability_range.value_or(moved.performance->range);
      Mutant& mutant = add_for_behavior(Mutant::Kind::suitability_lowered, moved.behavior, range);
      mutant.task = task;
      mutant.other = ranked[place + 1].behavior;
      mutant.suitability = next - 1;
    }
  }

  void add_changes_of_task(TaskIndex index) {
    const Task& task = catalog_.tasks[index];
    if (task.minimum_performance > 0) {
      add_for_task(Mutant::Kind::minimum_removed, index, task.minimum_performance_range);
    }
    const auto has_own_timeout = [&](const Performing& performing) {
      return catalog_.behaviors[performing.behavior].timeout.has_value();
    };
    const std::vector<Performing>& behaviors = performances_[index];
    const bool uses_timeout =
        task.timeout && !std::all_of(behaviors.begin(), behaviors.end(), has_own_timeout);
    if (uses_timeout && task.execution_goal == ExecutionGoal::achieve_goal) {
      add_for_task(Mutant::Kind::timeout_removed, index,
                   task.own_timeout_range.value_or(task.range));
    }
    add_changes_of_rules(index);
    // A task with both flags is refused, and so are a task that starts on request and that nobody
    // may request, and one that resumes and starts by itself.
    if (!task.reactive_start && task.rules.requestable != 0) {
      add_for_task(Mutant::Kind::start_on_request_turned, index, task.range);
    }
    if (!task.start_on_request && task.rules.resume == 0) {
      add_for_task(Mutant::Kind::reactive_start_turned, index, task.range);
    }
    // The goal decides nothing but whether timeouts count. The other way is their removal.
    const bool has_timeout =
        uses_timeout || std::any_of(behaviors.begin(), behaviors.end(), has_own_timeout);
    if (task.execution_goal == ExecutionGoal::keep_running && has_timeout) {
      add_for_task(Mutant::Kind::execution_goal_turned, index, task.range);
    }
  }

  void add_changes_of_rules(TaskIndex index) {
    const Task& task = catalog_.tasks[index];
    if (task.rules.improve != Improve::at_events) {
      add_for_task(Mutant::Kind::improve_removed, index, task.improve_range);
    }
    if (task.rules.resume != 0) {
      add_for_task(Mutant::Kind::resume_removed, index, task.own_resume_range.value_or(task.range));
    }
    if (task.rules.reactive_priority > 0) {
      add_for_task(Mutant::Kind::reactive_priority_removed, index, task.reactive_priority_range);
    }
  }

  void add_exclusions() {
    std::set<std::pair<TaskIndex, TaskIndex>> pairs;
    for (std::uint32_t place = 0; place < catalog_.exclusivity.size(); ++place) {
      const ExclusivityList& list = catalog_.exclusivity[place];
      const std::vector<TaskIndex> tasks = distinct_tasks(list);
      for (auto a = tasks.begin(); a != tasks.end(); ++a) {
        for (auto b = a + 1; b != tasks.end(); ++b) {
          if (list.at_most == 1 && pairs.emplace(*a, *b).second) add_pair(list, *a, *b);
        }
        // Of two tasks it would be the pair.
        if (tasks.size() <= 2) continue;
        if (list.at_most >= tasks.size()) continue;
        add_for_task(Mutant::Kind::exclusion_narrowed, *a, range_in(list, *a)).list = place;
      }
      if (list.at_most > 1 && list.at_most < tasks.size()) {
        add_for_task(Mutant::Kind::limit_raised, tasks.front(), list.at_most_range).list = place;
      }
    }
  }

  /// `list`: the first one that has both.
  void add_pair(const ExclusivityList& list, TaskIndex a, TaskIndex b) {
    const auto [first, last] = std::minmax(range_in(list, a).begin, range_in(list, b).begin);
    Mutant& mutant = add_for_task(Mutant::Kind::exclusion_removed, a, {first, first});
    mutant.other = b;
    if (last.line != first.line) mutant.lines.push_back(last.line);
  }

  static const Range& range_in(const ExclusivityList& list, TaskIndex task) {
    const auto found = std::find(list.tasks.begin(), list.tasks.end(), task);
    return list.ranges[static_cast<std::size_t>(found - list.tasks.begin())];
  }

  const Catalog& catalog_;
  std::vector<std::vector<Performing>> performances_;  ///< by task, in catalog order
  std::vector<Mutant> mutants_;
};

void remove_from(ExclusivityList& list, TaskIndex task) {
  for (std::size_t place = list.tasks.size(); place-- > 0;) {
    if (list.tasks[place] != task) continue;
    list.tasks.erase(list.tasks.begin() + static_cast<std::ptrdiff_t>(place));
    list.ranges.erase(list.ranges.begin() + static_cast<std::ptrdiff_t>(place));
  }
}

/// A list with both tasks becomes two, each without one of them.
void remove_pair(std::vector<ExclusivityList>& lists, TaskIndex a, TaskIndex b) {
  std::vector<ExclusivityList> result;
  for (ExclusivityList& list : lists) {
    const auto has = [&](TaskIndex task) {
      return std::find(list.tasks.begin(), list.tasks.end(), task) != list.tasks.end();
    };
    if (list.at_most == 1 && has(a) && has(b)) {
      remove_from(result.emplace_back(list), a);
      remove_from(list, b);
    }
    result.push_back(std::move(list));
  }
  lists = std::move(result);
}

/// Lets the behavior fit in no situation: it needs a value that a new variable never gets. Its name
/// stays, so that scripts can name it.
void remove_for_ever(Catalog& catalog, Behavior& behavior) {
  Variable variable;
  variable.name = "a catalog with " + behavior.name;
  variable.values = {"no", "yes"};
  const auto is_taken = [&](const Variable& other) { return other.name == variable.name; };
  while (std::any_of(catalog.variables.begin(), catalog.variables.end(), is_taken)) {
    variable.name += "'";
  }
  Condition condition;
  condition.variable = static_cast<std::uint32_t>(catalog.variables.size());
  condition.values = {1};
  catalog.variables.push_back(std::move(variable));
  behavior.situation.push_back(std::move(condition));
}

std::string percent(Millionths suitability) { return format_decimal(suitability, 4) + " %"; }

const Performance& performance_of(const Behavior& behavior, TaskIndex task) {
  return *std::find_if(behavior.performs.begin(), behavior.performs.end(),
                       [task](const Performance& performance) { return performance.task == task; });
}

std::string describe_flag(std::string_view flag, const std::string& task, bool before) {
  return fmt::format("{} of {}: {} instead of {}", flag, task, !before, before);
}

}  // namespace

std::string_view name_of(Mutant::Kind kind) { return mutant_kinds[static_cast<std::size_t>(kind)]; }

std::vector<Mutant> find_mutants(const Catalog& catalog) { return MutantFinder(catalog).find(); }

Catalog mutate(const Catalog& catalog, const Mutant& mutant) {
  Catalog changed = catalog;
  const bool is_of_task = mutant.behavior == Mutant::none;
  const auto task = [&]() -> Task& { return changed.tasks[mutant.task]; };
  const auto behavior = [&]() -> Behavior& { return changed.behaviors[mutant.behavior]; };
  switch (mutant.kind) {
    case Mutant::Kind::behavior_removed:
      remove_for_ever(changed, behavior());
      break;
    case Mutant::Kind::suitability_lowered:
      for (Performance& performance : behavior().performs) {
        if (performance.task == mutant.task) performance.suitability = mutant.suitability;
      }
      break;
    case Mutant::Kind::requirement_removed:
      std::erase_if(behavior().requirements, [&](const Requirement& requirement) {
        return requirement.task == mutant.task;
      });
      break;
    case Mutant::Kind::minimum_removed:
      if (is_of_task) {
        task().minimum_performance = 0;
        break;
      }
      for (Requirement& requirement : behavior().requirements) {
        if (requirement.task == mutant.task) requirement.minimum_performance = 0;
      }
      break;
    case Mutant::Kind::condition_removed:
      std::erase_if(behavior().situation, [&](const Condition& condition) {
        return condition.variable == mutant.variable;
      });
      break;
    case Mutant::Kind::exclusion_removed:
      remove_pair(changed.exclusivity, mutant.task, mutant.other);
      break;
    case Mutant::Kind::exclusion_narrowed:
      remove_from(changed.exclusivity[mutant.list], mutant.task);
      break;
    case Mutant::Kind::timeout_removed:
      (is_of_task ? task().timeout : behavior().timeout).reset();
      break;
    case Mutant::Kind::start_on_request_turned:
      task().start_on_request = !task().start_on_request;
      break;
    case Mutant::Kind::reactive_start_turned:
      task().reactive_start = !task().reactive_start;
      task().rules.reactive_priority = 0;
      break;
    case Mutant::Kind::execution_goal_turned:
      task().execution_goal = ExecutionGoal::achieve_goal;
      break;
    case Mutant::Kind::improve_removed:
      task().rules.improve = Improve::at_events;
      break;
    case Mutant::Kind::resume_removed:
      task().rules.resume = 0;
      break;
    case Mutant::Kind::reactive_priority_removed:
      task().rules.reactive_priority = 0;
      break;
    case Mutant::Kind::retry_removed:
      behavior().retry = Retry::at_events;
      break;
    case Mutant::Kind::limit_raised:
      ++changed.exclusivity[mutant.list].at_most;
      break;
  }
  return changed;
}

std::string describe(const Catalog& catalog, const Mutant& mutant) {
  const auto name = [](const auto& entries, std::uint32_t place) {
    return place == Mutant::none ? std::string() : printable(entries[place].name);
  };
  const std::string task = name(catalog.tasks, mutant.task);
  const std::string behavior = name(catalog.behaviors, mutant.behavior);
  switch (mutant.kind) {
    case Mutant::Kind::behavior_removed:
      return fmt::format("{} removed", behavior);
    case Mutant::Kind::suitability_lowered:
      return fmt::format(
          "suitability of {}{}: {} instead of {}, just below {}", behavior,
          catalog.behaviors[mutant.behavior].performs.size() > 1 ? " for " + task : "",
          percent(mutant.suitability),
          percent(performance_of(catalog.behaviors[mutant.behavior], mutant.task).suitability),
          name(catalog.behaviors, mutant.other));
    case Mutant::Kind::requirement_removed:
      return fmt::format("{} no longer requires {}", behavior, task);
    case Mutant::Kind::minimum_removed:
      if (behavior.empty()) return fmt::format("no minimum performance of {}", task);
      return fmt::format("{} requires {} without a minimum performance", behavior, task);
    case Mutant::Kind::condition_removed:
      return fmt::format("{} fits whatever {} is", behavior,
                         name(catalog.variables, mutant.variable));
    case Mutant::Kind::exclusion_removed:
      return fmt::format("{} no longer excludes {}", task, name(catalog.tasks, mutant.other));
    case Mutant::Kind::exclusion_narrowed:
      return fmt::format("{} taken out of the list of {} tasks", task,
                         distinct_tasks(catalog.exclusivity[mutant.list]).size());
    case Mutant::Kind::timeout_removed:
      return fmt::format("no timeout of {}", behavior.empty() ? task : behavior);
    case Mutant::Kind::start_on_request_turned:
      return describe_flag("start_on_request", task, catalog.tasks[mutant.task].start_on_request);
    case Mutant::Kind::reactive_start_turned:
      return describe_flag("reactive_start", task, catalog.tasks[mutant.task].reactive_start);
    case Mutant::Kind::execution_goal_turned:
      return fmt::format("execution_goal of {}: achieve_goal instead of keep_running", task);
    case Mutant::Kind::improve_removed:
      return fmt::format("improve of {}: at_events instead of {}", task,
                         word_of(catalog.tasks[mutant.task].rules.improve));
    case Mutant::Kind::resume_removed:
      return fmt::format("{} does not resume", task);
    case Mutant::Kind::reactive_priority_removed:
      return fmt::format("reactive_priority of {}: 0 instead of {}", task,
                         catalog.tasks[mutant.task].rules.reactive_priority);
    case Mutant::Kind::retry_removed:
      return fmt::format("retry of {}: at_events instead of {}", behavior,
                         word_of(catalog.behaviors[mutant.behavior].retry));
    case Mutant::Kind::limit_raised:
      return fmt::format("at most {} of the list of {} tasks instead of {}",
                         catalog.exclusivity[mutant.list].at_most + 1,
                         distinct_tasks(catalog.exclusivity[mutant.list]).size(),
                         catalog.exclusivity[mutant.list].at_most);
  }
  return {};
}

}  // namespace cbc
