#include "core/check/proofs.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Reasons that may be examined in total; past them, questions stay open.
constexpr std::uint64_t most_effort_of_reasons = 400'000'000;

}  // namespace

ProofContext::ProofContext(const Catalog& catalog, AssignmentSearch& search,
                           const Liveness& liveness, const LintOptions& options, Reporter& reporter)
    : catalog_(catalog),
      search_(search),
      liveness_(liveness),
      space_(search.catalog(), {}, {}),
      max_nodes_(options.max_nodes),
      reporter_(reporter),
      behaviors_(compiled().behaviors.size()),
      tasks_(compiled().tasks.size()),
      effort_(most_effort_of_reasons, options.is_stopped) {}

RelaxedQuestions ProofContext::relaxed(std::span<const Demand> demands) {
  RelaxedQuestions questions(space_, effort_);
  for (const Demand& demand : demands) questions.add(asked_of(compiled(), {&demand, 1}));
  return questions;
}

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

}  // namespace

/// A condition of a behavior on a situation variable.
Note ProofContext::note_of_condition(const Reason& reason) const {
  const Behavior& fitting = behavior(reason.behavior);
  const auto condition =
      std::find_if(fitting.situation.begin(), fitting.situation.end(),
                   [&reason](const Condition& one) { return one.variable == reason.variable; });
  const Variable& variable = catalog_.variables[reason.variable];
  std::vector<std::string> values;
  for (const std::uint32_t value : condition->values) {
    values.push_back(quote(variable.values[value]));
  }
  return reporter_.note(condition->range, "behavior " + quote(fitting.name) + " fits only where " +
                                              quote(variable.name) + " is " + list_with_or(values));
}

Note ProofContext::note_of(const Reason& reason) const {
  if (reason.kind == Reason::Kind::situation) return note_of_condition(reason);
  const TaskIndex task_index = compiled().tasks[reason.task].catalog_index;
  const Task& required = task(reason.task);
  if (reason.kind == Reason::Kind::exclusive) {
    const TaskIndex other = compiled().tasks[reason.other_task].catalog_index;
    return reporter_.note(
        range_of_list(catalog_, task_index, other),
        quote(required.name) + " excludes " + quote(task(reason.other_task).name));
  }
  if (reason.kind == Reason::Kind::limited) {
    std::vector<std::string> names;
    std::vector<TaskIndex> members;
    for (const TaskId member : compiled().limited[reason.limit]) {
      members.push_back(compiled().tasks[member].catalog_index);
    }
    std::sort(members.begin(), members.end());
    for (const TaskIndex member : members) names.push_back(quote(catalog_.tasks[member].name));
    const auto list = std::find_if(
        catalog_.exclusivity.begin(), catalog_.exclusivity.end(), [&](const ExclusivityList& one) {
          return one.range.begin.line == reason.line && distinct_tasks(one) == members;
        });
    return reporter_.note(list->range, "at most " +
                                           std::to_string(compiled().limits[reason.limit].most) +
                                           " of " + list_with_and(names) + " run");
  }
  if (reason.behavior == none) {
    return reporter_.note(
        required.minimum_performance_range,
        quote(required.name) + " runs with at least " + format_percent(reason.minimum_performance));
  }
  const Requirement& requirement = strongest_requirement(behavior(reason.behavior), task_index);
  const std::string who = "behavior " + quote(behavior(reason.behavior).name);
  if (reason.kind == Reason::Kind::performance) {
    return reporter_.note(requirement.minimum_performance_range,
                          who + " requires " + quote(required.name) + " with at least " +
                              format_percent(reason.minimum_performance));
  }
  return reporter_.note(requirement.range, who + " requires " + quote(required.name));
}

std::vector<Note> ProofContext::notes_of(std::span<const Reason> constraints) const {
  struct Entry {
    bool requires_task = false;
    std::uint32_t level = 0;
    Note note;
  };
  std::vector<Entry> entries;
  for (const Reason& reason : constraints) {
    const std::uint32_t level =
        reason.behavior == none ? 0 : compiled().behaviors[reason.behavior].level;
    entries.push_back({reason.kind == Reason::Kind::requires_task, level, note_of(reason)});
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

void ProofContext::report_undecided(const Range& range, const std::string& question) {
  if (search_.is_exhausted()) {
    if (!std::exchange(has_told_exhaustion_, true)) {
      reporter_.report(
          rule::undecided, range,
          question + " and other questions could not be decided: there is too much to search");
    }
    return;
  }
  reporter_.report(
      rule::undecided, range,
      question + " could not be decided with --max-nodes " + std::to_string(max_nodes_));
}

}  // namespace cbc
