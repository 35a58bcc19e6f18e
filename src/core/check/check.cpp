#include "core/check/check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/catalog/allowed_values.h"
#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/check/allow_comments.h"
#include "core/check/proofs.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

std::size_t count(const LintedFile& file, Severity severity) {
  return static_cast<std::size_t>(std::count_if(
      file.findings.begin(), file.findings.end(),
      [severity](const Diagnostic& finding) { return finding.severity == severity; }));
}

std::size_t count(const std::vector<LintedFile>& files, Severity severity) {
  std::size_t sum = 0;
  for (const LintedFile& file : files) sum += count(file, severity);
  return sum;
}

namespace {

/// Whether a percentage is over 0 and at most 1, so that it is probably meant as a fraction.
bool looks_like_fraction(Millionths degree) { return degree > 0 && degree <= one_percent; }

void check_suspicious_minimum(Millionths minimum, const Range& range, Reporter& reporter) {
  if (!looks_like_fraction(minimum)) return;
  reporter.report(rule::suspicious_minimum, range,
                  "a minimum_performance of " + format_percent(minimum) +
                      " is very low; did you mean " + format_percent(std::int64_t{minimum} * 100) +
                      "?");
}

void check_suitability(const Performance& performance, Reporter& reporter) {
  if (!performance.suitability_range) return;
  const Millionths suitability = performance.suitability;
  // One number may be that of many behaviors, so the message names none.
  if (suitability == 0) {
    reporter.report(
        rule::suspicious_suitability, *performance.suitability_range,
        "a suitability of 0 % makes the performance of everything that depends on it 0");
  } else if (looks_like_fraction(suitability)) {
    reporter.report(rule::suspicious_suitability, *performance.suitability_range,
                    "a suitability of " + format_percent(suitability) +
                        " is very low; did you mean " +
                        format_percent(std::int64_t{suitability} * 100) + "?");
  }
}

void check_timeout(const Catalog& catalog, const Behavior& behavior, Reporter& reporter) {
  if (!behavior.timeout || behavior.performs.empty()) return;
  const bool has_effect = std::any_of(behavior.performs.begin(), behavior.performs.end(),
                                      [&catalog](const Performance& performance) {
                                        return catalog.tasks[performance.task].execution_goal ==
                                               ExecutionGoal::achieve_goal;
                                      });
  if (has_effect) return;
  reporter.report(rule::no_timeout_effect, behavior.timeout_range,
                  "the timeout of behavior " + quote(behavior.name) +
                      " has no effect: the execution_goal of what it performs is keep_running");
}

/// Reports what is odd about behaviors, each by itself.
void check_behaviors(const Catalog& catalog, bool is_complete, Reporter& reporter) {
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      check_suitability(performance, reporter);
    }
    for (const Requirement& requirement : behavior.requirements) {
      check_suspicious_minimum(requirement.minimum_performance,
                               requirement.minimum_performance_range, reporter);
    }
    if (is_complete) check_timeout(catalog, behavior, reporter);
  }
}

/// What behaviors say about a task.
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

/// A file that gives no goal at all, as generated ones do, says nothing about this one either.
void check_required_goal(const Catalog& catalog, const Task& task, const Use& use,
                         Reporter& reporter) {
  if (use.requirements == 0 || task.execution_goal == ExecutionGoal::keep_running) return;
  std::string who = describe(*use.required_by) + " requires it";
  if (use.requirements > 1) {
    who += ", and " + std::to_string(use.requirements - 1) + " more";
  }
  reporter.report_as({.severity = rule::required_goal.severity, .is_off = !catalog.gives_goals},
                     rule::required_goal, task.range,
                     "task " + quote(task.name) +
                         " is required, but ends when its goal is achieved; what requires it then "
                         "stops too",
                     {reporter.note(use.required_at, std::move(who))});
}

/// Reports tasks that nothing starts but a request, though start_on_request is false. In a catalog
/// in which all tasks are like that, one finding says so for all of them.
void check_started(const Catalog& catalog, const std::vector<Use>& uses, Reporter& reporter) {
  std::vector<const Task*> never_started;
  bool has_other_starts = false;
  for (std::size_t index = 0; index < catalog.tasks.size(); ++index) {
    const Task& task = catalog.tasks[index];
    const bool starts = task.is_unclear || task.start_on_request || task.reactive_start;
    has_other_starts |= starts;
    if (starts || uses[index].requirements > 0 || uses[index].behaviors == 0) continue;
    never_started.push_back(&task);
  }
  const std::size_t findings =
      has_other_starts ? never_started.size() : std::min<std::size_t>(never_started.size(), 1);
  for (std::size_t i = 0; i < findings; ++i) {
    const Task& task = *never_started[i];
    std::string message = "task " + quote(task.name) +
                          " never starts without a request: start_on_request is false, but it has "
                          "no reactive_start, and no behavior requires it";
    if (!has_other_starts && never_started.size() > 1) {
      message += "; the same is true of " + quantity(never_started.size() - 1, "other task");
    }
    reporter.report(rule::never_started, task.range, std::move(message));
  }
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
                        ", so it can end and start again forever");
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

/// Reports tasks that no behavior performs. Behaviors that lack a task may have been meant to
/// perform some of them: the one whose name theirs begins with, or any other.
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

/// The behaviors and exclusivity lists that name each task.
class Namings {
 public:
  explicit Namings(const Catalog& catalog) : of_task_(catalog.tasks.size()) {
    for (const Behavior& behavior : catalog.behaviors) {
      for (const Performance& performance : behavior.performs) add(performance.task);
      for (const Requirement& requirement : behavior.requirements) add(requirement.task);
      ++count_;
    }
    for (const ExclusivityList& list : catalog.exclusivity) {
      for (const TaskIndex task : list.tasks) add(task);
      ++count_;
    }
  }

  /// Whether one of them names both tasks, so that neither is a misspelling of the other.
  [[nodiscard]] bool have_in_common(TaskIndex a, TaskIndex b) const {
    const std::vector<std::size_t>& of_b = of_task_[b];
    return std::any_of(of_task_[a].begin(), of_task_[a].end(), [&of_b](std::size_t naming) {
      return std::binary_search(of_b.begin(), of_b.end(), naming);
    });
  }

 private:
  void add(TaskIndex task) {
    std::vector<std::size_t>& of_task = of_task_[task];
    if (of_task.empty() || of_task.back() != count_) of_task.push_back(count_);
  }

  std::vector<std::vector<std::size_t>> of_task_;  ///< ascending
  std::size_t count_ = 0;
};

/// In a file without a section of tasks, one finding says so for all of them.
void check_implicit_tasks(const Catalog& catalog, Reporter& reporter) {
  std::vector<std::string_view> listed;
  std::unordered_map<std::string_view, TaskIndex> places;
  for (TaskIndex place = 0; place < catalog.tasks.size(); ++place) {
    const Task& task = catalog.tasks[place];
    if (!task.implicit) listed.push_back(task.name);
    places.try_emplace(task.name, place);
  }
  if (listed.size() == catalog.tasks.size()) return;
  Suggestions suggestions(std::move(listed));
  const Namings namings(catalog);
  for (TaskIndex place = 0; place < catalog.tasks.size(); ++place) {
    const Task& task = catalog.tasks[place];
    if (!task.implicit) continue;
    if (!catalog.has_task_section) {
      reporter.report(rule::implicit_task, task.range,
                      "there is no 'tasks' section: all tasks are named only by behaviors, and "
                      "have the default attributes");
      return;
    }
    std::string message =
        "task " + quote(task.name) + " is named only by a behavior, and has the default attributes";
    message += did_you_mean(suggestions.nearest(task.name, [&](std::string_view other) {
      return namings.have_in_common(place, places.at(other));
    }));
    reporter.report(rule::implicit_task, task.range, std::move(message));
  }
}

/// Reports what is odd about tasks and their parameters, each by itself.
void check_tasks(const CatalogReading& reading, Reporter& reporter) {
  const Catalog& catalog = reading.catalog;
  const std::vector<Use> uses = find_uses(catalog);
  for (std::size_t index = 0; index < catalog.tasks.size(); ++index) {
    const Task& task = catalog.tasks[index];
    const Use& use = uses[index];
    check_suspicious_minimum(task.minimum_performance, task.minimum_performance_range, reporter);
    if (!task.is_unclear) {
      check_required_goal(catalog, task, use, reporter);
      check_timeout(task, use, reporter);
    }
    check_parameters(task, reporter);
  }
  check_performed(reading, uses, reporter);
  // What could not be read may require the task.
  if (reading.has_all_names && reading.has_all_behaviors) check_started(catalog, uses, reporter);
  if (reading.has_all_names) check_implicit_tasks(catalog, reporter);
}

void check_own_tasks(const Catalog& catalog, const ExclusivityList& list, Reporter& reporter) {
  std::unordered_map<TaskIndex, Range> known;
  bool has_repetition = false;
  // A list of one task, given twice, was meant to have another one.
  const bool is_mendable = distinct_tasks(list).size() > 1;
  for (std::size_t place = 0; place < list.tasks.size(); ++place) {
    const auto [first, is_new] = known.try_emplace(list.tasks[place], list.ranges[place]);
    if (is_new) continue;
    has_repetition = true;
    std::vector<Edit> edits;
    if (is_mendable) edits.push_back({Edit::Kind::remove_entry, list.ranges[place], {}});
    reporter.report(rule::self_exclusion, list.ranges[place],
                    "task " + quote(catalog.tasks[list.tasks[place]].name) +
                        " is listed twice; a task does not exclude itself",
                    {reporter.note(first->second, "first given here")}, std::move(edits));
  }
  if (known.size() < 2 && !has_repetition && list.is_complete) {
    reporter.report(rule::trivial_exclusion, list.range,
                    list.tasks.empty() ? "the list has no task, so it excludes nothing"
                                       : "the list has only one task, so it excludes nothing");
  }
}

/// Finds lists that another list contains. Each list is compared only with those that have its
/// rarest task.
class Containment {
 public:
  explicit Containment(const Catalog& catalog)
      : catalog_(catalog), lists_of_(catalog.tasks.size()) {
    for (const ExclusivityList& list : catalog.exclusivity) tasks_.push_back(distinct_tasks(list));
    for (std::size_t list = 0; list < tasks_.size(); ++list) {
      for (const TaskIndex task : tasks_[list]) lists_of_[task].push_back(list);
    }
  }

  void report(Reporter& reporter) {
    for (std::size_t list = 0; list < tasks_.size(); ++list) {
      if (tasks_[list].size() < 2 || !catalog_.exclusivity[list].is_complete) continue;
      const std::size_t other = find_container(list);
      if (other == tasks_.size()) continue;
      std::vector<Edit> edits;
      if (const auto& entry = catalog_.exclusivity[list].entry) {
        edits.push_back({Edit::Kind::remove_entry, *entry, {}});
      }
      const bool has_more =
          tasks_[other].size() > tasks_[list].size() || !catalog_.exclusivity[other].is_complete;
      reporter.report(
          rule::duplicate_exclusion, catalog_.exclusivity[list].range,
          std::string("another list has ") + (has_more ? "all of these tasks" : "the same tasks") +
              ", so this one excludes nothing new",
          {reporter.note(catalog_.exclusivity[other].range, "it is here")}, std::move(edits));
    }
  }

 private:
  /// A list with all tasks of `list` that lets no more of them run; of equal lists an earlier one.
  /// The number of lists if there is none.
  std::size_t find_container(std::size_t list) {
    const auto rarest = *std::min_element(
        tasks_[list].begin(), tasks_[list].end(),
        [this](TaskIndex a, TaskIndex b) { return lists_of_[a].size() < lists_of_[b].size(); });
    for (const std::size_t other : lists_of_[rarest]) {
      if (other == list || tasks_[other].size() < tasks_[list].size()) continue;
      if (most(other) > most(list)) continue;
      if (tasks_[other].size() == tasks_[list].size() && most(other) == most(list) &&
          other > list) {
        continue;
      }
      if (work_left_ < tasks_[list].size() + tasks_[other].size()) break;
      work_left_ -= tasks_[list].size() + tasks_[other].size();
      if (std::includes(tasks_[other].begin(), tasks_[other].end(), tasks_[list].begin(),
                        tasks_[list].end())) {
        return other;
      }
    }
    return tasks_.size();
  }

  [[nodiscard]] std::uint32_t most(std::size_t list) const {
    return catalog_.exclusivity[list].at_most;
  }

  const Catalog& catalog_;
  std::vector<std::vector<TaskIndex>> tasks_;       ///< by list
  std::vector<std::vector<std::size_t>> lists_of_;  ///< by task
  std::size_t work_left_ = 100'000'000;             ///< bounds the time; the finding is only advice
};

/// Reports exclusivity lists that exclude nothing, or nothing new.
void check_exclusivity(const Catalog& catalog, Reporter& reporter) {
  for (const ExclusivityList& list : catalog.exclusivity) {
    check_own_tasks(catalog, list, reporter);
  }
  Containment(catalog).report(reporter);
}

/// The places of findings.
using Positions = std::set<Position>;

/// Finds behaviors that require two tasks which exclude one another.
class ConflictCheck {
 public:
  /// `exclusive`: the requirements that the findings of exclusive-requirement are about.
  ConflictCheck(const Catalog& catalog, const Positions& exclusive, Reporter& reporter)
      : catalog_(catalog), exclusive_(exclusive), reporter_(reporter), exclusions_(catalog) {}

  /// Reports each requirement that conflicts with an earlier one, once. Whether a finding says that
  /// the behavior can never be active.
  bool check(const Behavior& behavior) {
    bool has_conflict = false;
    std::unordered_set<TaskIndex> explained;
    std::unordered_map<std::size_t, const Requirement*> first_in;  // by list
    for (const Requirement& requirement : behavior.requirements) {
      // The first requirement of a task has the finding, if there is one.
      if (exclusive_.contains(requirement.range.begin) &&
          exclusions_.find_for_all(behavior, requirement.task)) {
        explained.insert(requirement.task);
      }
      if (explained.contains(requirement.task)) {
        has_conflict = true;
        continue;
      }
      bool is_reported = false;
      for (const std::size_t list : exclusions_.lists_of(requirement.task)) {
        const Requirement*& first = first_in.try_emplace(list, &requirement).first->second;
        if (first->task == requirement.task || is_reported) continue;
        report(behavior, requirement, *first, list);
        is_reported = true;
      }
      has_conflict |= is_reported;
    }
    return has_conflict;
  }

 private:
  void report(const Behavior& behavior, const Requirement& requirement, const Requirement& other,
              std::size_t list) {
    const std::string name = quote(catalog_.tasks[requirement.task].name);
    const std::string other_name = quote(catalog_.tasks[other.task].name);
    reporter_.report(
        rule::conflicting_requirements, requirement.range,
        describe(behavior) + " requires both " + other_name + " and " + name +
            ", which exclude one another, so it can never be active",
        {reporter_.note(other.range, other_name + " is required here"),
         reporter_.note(catalog_.exclusivity[list].range, "mutually exclusive by this list")});
  }

  const Catalog& catalog_;
  const Positions& exclusive_;
  Reporter& reporter_;
  Exclusions exclusions_;
};

/// The requirements that are reported because the task excludes what requires it. The reader has
/// found them.
Positions find_exclusive_requirements(const Diagnostics& diagnostics, const std::string& file,
                                      const LintOptions& options) {
  std::vector<Diagnostic> findings;
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.rule == rule::exclusive_requirement.name && finding.file == file) {
      findings.push_back(finding);
    }
  }
  if (options.control && !findings.empty()) findings = options.control(std::move(findings));
  Positions places;
  for (const Diagnostic& finding : findings) {
    if (finding.rule == rule::exclusive_requirement.name) places.insert(finding.range.begin);
  }
  return places;
}

/// Returns, by behavior, whether a finding says that it can never be active: because of conflicting
/// requirements, or because it requires a task that excludes its own.
std::vector<bool> check_conflicting_requirements(const Catalog& catalog, const Positions& exclusive,
                                                 Reporter& reporter) {
  ConflictCheck check(catalog, exclusive, reporter);
  std::vector<bool> conflicts;
  for (const Behavior& behavior : catalog.behaviors) conflicts.push_back(check.check(behavior));
  return conflicts;
}

}  // namespace

CheckedCatalog lint_catalog(const yaml::Document& document, const LintOptions& options,
                            Diagnostics& diagnostics) {
  CheckedCatalog result;
  result.reading = understand_catalog(document, diagnostics);
  if (options.depth == CheckDepth::reading) return result;
  const bool searches = options.depth == CheckDepth::searches;
  const CatalogReading& reading = result.reading;
  const Catalog& catalog = reading.catalog;
  Reporter reporter(document.file(), diagnostics);
  check_tasks(reading, reporter);
  check_behaviors(catalog, reading.is_complete, reporter);
  check_exclusivity(catalog, reporter);
  check_keys(catalog, reporter);
  check_names(catalog, reporter);
  const Positions exclusive = find_exclusive_requirements(diagnostics, document.file(), options);
  const std::vector<bool> conflicts = check_conflicting_requirements(catalog, exclusive, reporter);
  if (!reading.has_all_names || !reading.is_acyclic) {
    // Anything else that could be found may be due to what is missing.
    if (searches) check_on_request_requirements(catalog, conflicts, reporter);
    return result;
  }
  if (!searches) return result;
  const auto compiled = std::make_shared<const CompiledCatalog>(compile(catalog));
  check_by_proof(reading, *compiled, conflicts, options, reporter);
  if (reading.is_complete) result.compiled = compiled;
  return result;
}

CheckedCatalog check_catalog(const yaml::Document& document, std::string_view text,
                             const SeveritySettings& settings, LintOptions options,
                             Diagnostics diagnostics) {
  options.never_together = settings.never_together();
  options.control = [&](std::vector<Diagnostic> findings) {
    return control_findings(std::move(findings), {document.file(), text, &document, false},
                            settings);
  };
  CheckedCatalog checked = lint_catalog(document, options, diagnostics);
  checked.errors = diagnostics.count(Severity::error);
  const CommentedFile file{document.file(), text, &document, checked.compiled != nullptr};
  checked.findings = control_findings(diagnostics.release(), file, settings);
  return checked;
}

}  // namespace cbc
