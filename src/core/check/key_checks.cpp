#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

// What is odd about the keys that tasks, behaviors and lists need not have (docs/semantics.md,
// "Tasks and behaviors").

namespace cbc {
namespace {

class KeyChecks {
 public:
  KeyChecks(const Catalog& catalog, Reporter& reporter)
      : catalog_(catalog),
        reporter_(reporter),
        behaviors_of_(catalog.tasks.size()),
        lists_of_(catalog.tasks.size()) {
    for (const Behavior& behavior : catalog.behaviors) {
      for (const Performance& performance : behavior.performs) {
        behaviors_of_[performance.task].push_back(&behavior);
      }
    }
    for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
      for (const TaskIndex task : distinct_tasks(catalog.exclusivity[list])) {
        lists_of_[task].push_back(list);
      }
    }
  }

  void run() {
    for (const ExclusivityList& list : catalog_.exclusivity) check_limit(list);
    for (const Behavior& behavior : catalog_.behaviors) check_retry(behavior);
    for (TaskIndex task = 0; task < catalog_.tasks.size(); ++task) {
      if (catalog_.tasks[task].is_unclear || catalog_.tasks[task].rules == TaskRules()) continue;
      check_ratchet(task);
      check_resume(task);
      check_return(task);
    }
  }

 private:
  [[nodiscard]] std::string name_of(TaskIndex task) const {
    return "task " + quote(catalog_.tasks[task].name);
  }

  void check_limit(const ExclusivityList& list) {
    const std::size_t tasks = distinct_tasks(list).size();
    if (list.at_most == 1 || !list.is_complete || tasks < 2 || list.at_most < tasks) return;
    reporter_.report(rule::idle_limit, list.at_most_range,
                     "the list has " + quantity(tasks, "task") + ", and lets " +
                         std::to_string(list.at_most) + " run: it says nothing");
  }

  void check_retry(const Behavior& behavior) {
    if (behavior.retry != Retry::at_events) return;
    for (const Performance& performance : behavior.performs) {
      const Behavior* const other = find_fallback(performance);
      if (other == nullptr) continue;
      reporter_.report_as({.severity = rule::returning_behavior.severity, .is_off = true},
                          rule::returning_behavior, behavior.range,
                          "after a failure behavior " + quote(behavior.name) +
                              " is tried again at any event, and takes over from " +
                              quote(other->name));
      return;
    }
  }

  /// A behavior of the task that is less suited, and always possible.
  [[nodiscard]] const Behavior* find_fallback(const Performance& performance) const {
    for (const Behavior* other : behaviors_of_[performance.task]) {
      if (!other->requirements.empty() || !other->situation.empty()) continue;
      for (const Performance& of_other : other->performs) {
        if (of_other.task == performance.task && of_other.suitability < performance.suitability) {
          return other;
        }
      }
    }
    return nullptr;
  }

  void check_ratchet(TaskIndex task) {
    const Task& of = catalog_.tasks[task];
    if (!of.own_improve_range || of.rules.improve != Improve::when_started) return;
    const std::string begin = name_of(task) + " gets better only when it is started, but ";
    if (of.rules.requestable == 0) {
      reporter_.report(rule::idle_ratchet, *of.own_improve_range, begin + "nobody can request it");
    } else if (has_one_suitability(task)) {
      reporter_.report(rule::idle_ratchet, *of.own_improve_range,
                       begin + "all of its behaviors suit it equally");
    }
  }

  [[nodiscard]] bool has_one_suitability(TaskIndex task) const {
    std::optional<Millionths> first;
    for (const Behavior* behavior : behaviors_of_[task]) {
      for (const Performance& performance : behavior->performs) {
        if (performance.task != task) continue;
        if (performance.suitability != first.value_or(performance.suitability)) return false;
        first = performance.suitability;
      }
    }
    return true;
  }

  void check_resume(TaskIndex task) {
    const Task& of = catalog_.tasks[task];
    if (of.rules.resume == 0) return;
    const auto& behaviors = behaviors_of_[task];
    const bool always_runs =
        lists_of_[task].empty() &&
        std::all_of(behaviors.begin(), behaviors.end(), [](const Behavior* behavior) {
          return behavior->requirements.empty() && behavior->situation.empty();
        });
    if (always_runs && of.own_resume_range) {
      reporter_.report(rule::idle_resume, *of.own_resume_range,
                       name_of(task) +
                           " never has to resume: no list has it, it requires nothing, and its "
                           "behaviors always fit");
    }
    for (const std::size_t list : lists_of_[task]) {
      for (const TaskIndex other : distinct_tasks(catalog_.exclusivity[list])) {
        const Task& reaction = catalog_.tasks[other];
        if (other == task || reaction.rules.reactive_priority == 0 || !fit_together(task, other)) {
          continue;
        }
        reporter_.report(
            rule::resume_beside_reaction, of.own_resume_range.value_or(of.range),
            name_of(task) + " resumes at once, where " + name_of(other) +
                " starts by itself a little later and may end it again: both fit one situation",
            {reporter_.note(catalog_.exclusivity[list].range, "this list has both")});
        return;
      }
    }
  }

  /// Whether a behavior of each fits in one situation.
  [[nodiscard]] bool fit_together(TaskIndex a, TaskIndex b) const {
    for (const Behavior* of_a : behaviors_of_[a]) {
      for (const Behavior* of_b : behaviors_of_[b]) {
        if (fit_together(*of_a, *of_b)) return true;
      }
    }
    return false;
  }

  [[nodiscard]] static bool fit_together(const Behavior& a, const Behavior& b) {
    return std::all_of(a.situation.begin(), a.situation.end(), [&](const Condition& of_a) {
      return std::all_of(b.situation.begin(), b.situation.end(), [&](const Condition& of_b) {
        return of_a.variable != of_b.variable ||
               std::find_first_of(of_a.values.begin(), of_a.values.end(), of_b.values.begin(),
                                  of_b.values.end()) != of_a.values.end();
      });
    });
  }

  void check_return(TaskIndex task) {
    const Task& of = catalog_.tasks[task];
    if (of.rules.resume == 0 && of.rules.reactive_priority == 0) return;
    std::vector<bool> is_needed(catalog_.tasks.size(), false);
    std::vector<TaskIndex> open{task};
    is_needed[task] = true;
    while (!open.empty()) {
      const TaskIndex next = open.back();
      open.pop_back();
      if (next != task && is_ended_again_and_again(next)) {
        const Range place = of.rules.resume != 0 ? of.own_resume_range.value_or(of.range)
                                                 : of.reactive_priority_range;
        reporter_.report(rule::endless_return, place,
                         name_of(task) + " comes back by itself, and may need " + name_of(next) +
                             ", which a timeout ends and any event may start again",
                         {reporter_.note(catalog_.tasks[next].range, "it is here")});
        return;
      }
      for (const Behavior* behavior : behaviors_of_[next]) {
        for (const Requirement& requirement : behavior->requirements) {
          if (is_needed[requirement.task]) continue;
          is_needed[requirement.task] = true;
          open.push_back(requirement.task);
        }
      }
    }
  }

  /// Whether a timeout ends the task, and all of its behaviors are tried again at any event.
  [[nodiscard]] bool is_ended_again_and_again(TaskIndex task) const {
    const Task& of = catalog_.tasks[task];
    if (of.execution_goal == ExecutionGoal::keep_running) return false;
    const auto& behaviors = behaviors_of_[task];
    return std::any_of(behaviors.begin(), behaviors.end(),
                       [&of](const Behavior* behavior) {
                         return behavior->timeout.has_value() || of.timeout.has_value();
                       }) &&
           std::all_of(behaviors.begin(), behaviors.end(), [](const Behavior* behavior) {
             return behavior->retry == Retry::at_events;
           });
  }

  const Catalog& catalog_;
  Reporter& reporter_;
  std::vector<std::vector<const Behavior*>> behaviors_of_;  ///< by task
  std::vector<std::vector<std::size_t>> lists_of_;          ///< by task
};

}  // namespace

void check_keys(const Catalog& catalog, Reporter& reporter) { KeyChecks(catalog, reporter).run(); }

}  // namespace cbc
