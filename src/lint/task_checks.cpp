#include "lint/task_checks.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "catalog/allowed_values.h"
#include "catalog/describe.h"
#include "cbc/rules.h"
#include "lint/percent.h"
#include "text/decimal.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// What behaviors say about each task.
struct Use {
  std::size_t behaviors = 0;  ///< that perform it
  bool has_behavior_timeout = false;
  const Behavior* required_by = nullptr;  ///< the first one
  Range required_at;
  std::size_t requirements = 0;
};

std::vector<Use> find_uses(const Catalog& catalog) {
  std::vector<Use> uses(catalog.tasks.size());
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      ++uses[performance.task].behaviors;
      uses[performance.task].has_behavior_timeout |= behavior.timeout.has_value();
    }
    for (const Requirement& requirement : behavior.requirements) {
      Use& use = uses[requirement.task];
      if (use.requirements++ > 0) continue;
      use.required_by = &behavior;
      use.required_at = requirement.range;
    }
  }
  return uses;
}

void check_required_goal(const Task& task, const Use& use, Reporter& reporter) {
  if (use.requirements == 0 || task.execution_goal == ExecutionGoal::keep_running) return;
  std::string who = describe(*use.required_by) + " requires it";
  if (use.requirements > 1) {
    who += ", and " + std::to_string(use.requirements - 1) + " more";
  }
  reporter.report(rule::required_goal, task.range,
                  "task " + quote(task.name) +
                      " is required, but ends when its goal is achieved; what requires it then "
                      "stops too",
                  {reporter.note(use.required_at, std::move(who))});
}

void check_timeout(const Task& task, const Use& use, Reporter& reporter) {
  if (task.execution_goal == ExecutionGoal::keep_running) {
    if (task.own_timeout_range) {
      reporter.report(rule::no_timeout_effect, *task.own_timeout_range,
                      "the timeout of task " + quote(task.name) +
                          " has no effect: its execution_goal is keep_running");
    }
    return;
  }
  if (task.reactive_start && (task.timeout || use.has_behavior_timeout)) {
    const std::string after = task.timeout ? "after " + format_decimal(*task.timeout, 6) + " s"
                                           : "by the timeout of a behavior";
    reporter.report(rule::reactive_timeout, task.range,
                    "task " + quote(task.name) + " starts reactively and is ended " + after +
                        ", so it can end and start again for ever");
  }
}

void check_allowed_values(const Task& task, const Parameter& parameter, Reporter& reporter) {
  const std::string name = "parameter " + quote(parameter.name) + " of task " + quote(task.name);
  if (is_empty_range(parameter)) {
    reporter.report(rule::empty_range, parameter.allowed_range,
                    name + " has no allowed value: the range goes from " +
                        quote(parameter.allowed_values[0]) + " down to " +
                        quote(parameter.allowed_values[1]));
  } else if (is_unknown_type(parameter)) {
    std::string message = name + " has a type that is not known, " +
                          quote(parameter.allowed_values[0]) + ", so its values are not checked";
    message += did_you_mean(nearest_type(parameter.allowed_values[0]));
    reporter.report(rule::unknown_type, parameter.allowed_range, std::move(message));
  }
}

bool allow_the_same(const Parameter& a, const Parameter& b) {
  return a.allowed_values == b.allowed_values && a.allowed_is_list == b.allowed_is_list;
}

void check_parameters(const Task& task, Reporter& reporter) {
  struct Known {
    const Parameter* first = nullptr;
    const Parameter* last = nullptr;
  };
  std::unordered_map<std::string_view, Known> known;
  for (const Parameter& parameter : task.parameters) {
    check_allowed_values(task, parameter, reporter);
    if (parameter.name.empty()) continue;
    const auto [entry, is_new] = known.try_emplace(parameter.name, Known{&parameter, &parameter});
    if (is_new) continue;
    Known& same_name = entry->second;
    std::vector<Edit> edits;
    if (parameter.entry && allow_the_same(*same_name.last, parameter)) {
      edits.push_back({Edit::Kind::remove_entry, *parameter.entry, {}});
    }
    same_name.last = &parameter;
    reporter.report(
        rule::duplicate_parameter, parameter.range,
        "parameter " + quote(parameter.name) + " of task " + quote(task.name) + " is listed twice",
        {reporter.note(same_name.first->range, "first listed here")}, std::move(edits));
  }
}

/// Reports tasks that no behavior performs. Of those, behaviors whose task is missing in the file
/// may have been meant to perform some: the task whose name begins theirs, or any one.
void check_performed(const CatalogReading& reading, const std::vector<Use>& uses,
                     Reporter& reporter) {
  if (!reading.has_all_behaviors) return;
  std::vector<const Task*> not_performed;
  for (std::size_t index = 0; index < uses.size(); ++index) {
    if (uses[index].behaviors == 0) not_performed.push_back(&reading.catalog.tasks[index]);
  }
  std::size_t without_task = 0;
  for (const Behavior& behavior : reading.catalog.behaviors) {
    if (!behavior.performs.empty()) continue;
    const auto meant = std::find_if(
        not_performed.begin(), not_performed.end(),
        [&behavior](const Task* task) { return behavior.name.starts_with(task->name); });
    if (meant == not_performed.end()) {
      ++without_task;
    } else {
      not_performed.erase(meant);
    }
  }
  if (not_performed.size() <= without_task) return;
  for (const Task* task : not_performed) {
    reporter.report(rule::task_without_behavior, task->range,
                    "no behavior performs task " + quote(task->name));
  }
}

/// Without a section of tasks all of them are named by behaviors only, and one finding says so.
void check_implicit_tasks(const Catalog& catalog, Reporter& reporter) {
  std::vector<std::string_view> listed;
  for (const Task& task : catalog.tasks) {
    if (!task.implicit) listed.push_back(task.name);
  }
  Suggestions suggestions(std::move(listed));
  for (const Task& task : catalog.tasks) {
    if (!task.implicit) continue;
    if (!catalog.has_task_section) {
      reporter.report(rule::implicit_task, task.range,
                      "there is no 'tasks' section: all tasks are named by behaviors only, and "
                      "have the default attributes");
      return;
    }
    std::string message =
        "task " + quote(task.name) + " is named by a behavior only, and has the default attributes";
    message += did_you_mean(suggestions.nearest(task.name));
    reporter.report(rule::implicit_task, task.range, std::move(message));
  }
}

}  // namespace

void check_tasks(const CatalogReading& reading, Reporter& reporter) {
  const Catalog& catalog = reading.catalog;
  const std::vector<Use> uses = find_uses(catalog);
  for (std::size_t index = 0; index < catalog.tasks.size(); ++index) {
    const Task& task = catalog.tasks[index];
    const Use& use = uses[index];
    check_suspicious_minimum(task.minimum_performance, task.minimum_performance_range, reporter);
    if (!task.is_unclear) {
      check_required_goal(task, use, reporter);
      check_timeout(task, use, reporter);
    }
    check_parameters(task, reporter);
  }
  check_performed(reading, uses, reporter);
  if (reading.has_all_names) check_implicit_tasks(catalog, reporter);
}

}  // namespace cbc
