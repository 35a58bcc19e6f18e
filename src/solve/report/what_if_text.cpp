#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/layout.h"
#include "core/words/reason_words.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "solve/report/what_if_report.h"

namespace cbc {
namespace {

std::string behavior_of(const CompiledCatalog& catalog, const State& state, TaskId task) {
  return printable(catalog.name_of_behavior(state.behavior(task)));
}

/// "HOVER (HOVER_WITH_PID)"; the name alone if both are the same.
std::string running_task(const CompiledCatalog& catalog, const State& state, TaskId task) {
  const std::string name = printable(catalog.name_of_task(task));
  const std::string behavior = behavior_of(catalog, state, task);
  return name == behavior ? name : fmt::format("{} ({})", name, behavior);
}

/// The kind of a move, as the title of a section.
std::string title_of(const EventRecord& record) {
  if (record.origin == Origin::timeout || record.origin == Origin::reactive) {
    return fmt::format("the clock, at {} s", format_time(record.time));
  }
  std::string title(name_of(record.verb));
  if (form_of(record.verb).has_cause) title += fmt::format(", {}", name_of(record.cause));
  return title;
}

/// The name of a move in its section.
std::string name_of_move(const CompiledCatalog& catalog, const KeptEvent& event) {
  const EventRecord& record = event.record;
  if (record.verb == Verb::situation) {
    return std::string(without_indentation(describe_situation(catalog, event.step->situation)));
  }
  std::string name = printable(record.behavior != none ? catalog.name_of_behavior(record.behavior)
                                                       : catalog.name_of_task(record.task));
  if (record.origin == Origin::timeout) return name + " times out";
  if (record.origin == Origin::reactive) return name + " starts";
  return name;
}

/// The first reasons of a rejection, which are those that the others lead to.
std::string short_reason(const CompiledCatalog& catalog, const ExplainedRecord& record) {
  constexpr std::size_t most = 3;
  std::vector<std::string> reasons = describe_rejection(catalog, record);
  const std::size_t count = reasons.size();
  reasons.resize(std::min(count, most));
  std::string text = join(reasons, "; ", without_indentation);
  if (count > most) text += fmt::format("; and {}", quantity(count - most, "more reason"));
  return text;
}

/// Whether a limit ended a search, and the answer is the best so far.
bool is_cut(const PossibleMove& move) {
  return std::any_of(move.events.begin(), move.events.end(), [](const KeptEvent& event) {
    return event.search != nullptr && event.search->result.status == SearchStatus::feasible;
  });
}

/// What a move would do; empty if it changes nothing.
std::string describe_effect(const CompiledCatalog& catalog, const PossibleMove& move) {
  std::vector<std::string> parts;
  const State& after = move.after();
  const ExplainedRecord& record = move.events.front().record;
  const bool is_rejected = record.outcome == Outcome::rejected;
  if (is_rejected) parts.push_back(short_reason(catalog, record));
  if (is_cut(move)) parts.emplace_back("not proven best, as a search limit was reached");
  const MoveEffects effects = effects_of(catalog, move);
  for (const BehaviorId behavior : effects.failed) {
    // The reasons of a rejection tell of the others.
    if (is_rejected && !move.before.is_active(behavior)) continue;
    parts.push_back(fmt::format("{} fails", behavior_name(catalog, behavior)));
  }
  if (!effects.stopped.empty()) {
    parts.push_back("stops " + join(names_of_tasks(catalog, effects.stopped), ", "));
  }
  const auto started = [&](TaskId task) { return running_task(catalog, after, task); };
  if (!effects.started.empty()) parts.push_back("starts " + join(effects.started, ", ", started));
  for (const TaskId task : effects.changed) {
    parts.push_back(fmt::format("{}: {} instead of {}", printable(catalog.name_of_task(task)),
                                behavior_of(catalog, after, task),
                                behavior_of(catalog, move.before, task)));
  }
  for (const TaskId task : effects.requested) {
    parts.push_back(fmt::format("{} goes on with priority {}", task_name(catalog, task),
                                after.request(task).priority));
  }
  if (!effects.suspended.empty()) {
    parts.push_back("suspends the request of " +
                    join(names_of_tasks(catalog, effects.suspended), ", "));
  }
  if (!effects.ended.empty()) {
    parts.push_back("ends the request of " + join(names_of_tasks(catalog, effects.ended), ", "));
  }
  if (!effects.forgiven.empty()) {
    parts.push_back(join(names_of_behaviors(catalog, effects.forgiven), ", ") + " is tried again");
  }
  if (!effects.not_retried.empty()) {
    parts.push_back("remembers the failure of " +
                    join(names_of_behaviors(catalog, effects.not_retried), ", "));
  }
  for (const TaskId task : effects.queued) {
    // It would be dropped when it is due.
    if (after.is_blocked(task, catalog.rules_of(task).reactive_priority) ||
        !after.has_available_behavior(task))
      continue;
    const Microseconds due = after.queue().due(catalog.tasks[task].catalog_index);
    parts.push_back(
        fmt::format("{} may start by itself at {} s", task_name(catalog, task), format_time(due)));
  }
  return join(parts, "; ");
}

}  // namespace

WhatIfText::WhatIfText(const WhatIfState& of, const Style& style, std::size_t columns)
    : of_(of), style_(style), columns_(columns == 0 ? text_width : columns) {}

void WhatIfText::add(const PossibleMove& move) {
  const EventRecord& record = move.events.front().record;
  const std::string title = title_of(record);
  if (sections_.empty() || sections_.back().title != title) sections_.push_back({title, {}, {}});
  Section& section = sections_.back();
  Row row;
  row.name = name_of_move(of_.catalog, move.events.front());
  if (form_of(record.verb).is_decided) row.outcome = name_of(record.outcome);
  row.effect = describe_effect(of_.catalog, move);
  if (record.verb != Verb::start || record.origin != Origin::script) {
    section.rows.push_back(std::move(row));
    return;
  }
  const std::string priority = std::to_string(record.priority);
  if (std::count(section.priorities.begin(), section.priorities.end(), priority) == 0) {
    section.priorities.push_back(priority);
  }
  // The starts of a task stand side by side.
  for (Row& other : section.rows) {
    if (other.name == row.name && other.outcome == row.outcome && other.effect == row.effect) {
      other.priorities.push_back(priority);
      return;
    }
  }
  row.priorities.push_back(priority);
  section.rows.push_back(std::move(row));
}

/// With the priorities, unless all do the same.
std::string WhatIfText::name_in(const Row& row, const Section& section) {
  if (row.priorities.size() == section.priorities.size()) return row.name;
  return fmt::format("{} ({})", row.name, list_with_and(row.priorities));
}

/// The state that the moves are tried in.
std::string WhatIfText::header() const {
  const CompiledCatalog& catalog = of_.catalog;
  const Snapshot& snapshot = of_.moment.snapshot;
  Text text(style_, columns_);
  text.add(fmt::format("{} with {}\n\n", style_.paint(style_.strong, printable(of_.script.file)),
                       printable(catalog.file)));
  const std::string time = format_time(snapshot.now);
  if (of_.moment.event) {
    const KeptEvent& event = *of_.moment.event;
    text.line("after event {}, at {} s: {}", snapshot.events, time,
              event_and_outcome(catalog, event.record, event.step));
    if (follows_at_once(event.record)) {
      text.line("it follows at once from the one before, so nothing can happen between them");
    }
  } else {
    text.line("before the first event, at {} s", time);
  }
  const auto running = [&](std::uint32_t index) {
    const TaskId task = catalog.task_ids[index];
    const Request* const request = of_.state.find_request(task);
    return running_task(catalog, of_.state, task) +
           (request == nullptr ? "" : fmt::format(" with priority {}", request->priority));
  };
  const std::vector<std::uint32_t> all = of_.state.running();
  text.line("running: {}", all.empty() ? "nothing" : join(all, ", ", running));
  std::vector<std::string> situation;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    situation.push_back(
        describe_value(catalog, VariableValue{variable, of_.state.value_of(variable)}));
  }
  if (!situation.empty()) text.line("situation: {}", join(situation, ", "));
  std::vector<TaskId> suspended;
  for (const TaskId task : catalog.task_ids) {
    if (of_.state.is_suspended(task)) suspended.push_back(task);
  }
  const auto waiting = [&](TaskId task) {
    return fmt::format("{} with priority {}", task_name(catalog, task),
                       of_.state.find_own_request(task)->priority);
  };
  if (!suspended.empty()) text.line("suspended: {}", join(suspended, ", ", waiting));
  std::vector<BehaviorId> unavailable;
  std::vector<BehaviorId> faulty;
  std::vector<BehaviorId> failed;
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (of_.state.is_denied(behavior)) unavailable.push_back(behavior);
    if (of_.state.is_faulty(behavior)) faulty.push_back(behavior);
    if (of_.state.has_failed(behavior)) failed.push_back(behavior);
  }
  if (!unavailable.empty()) {
    text.line("unavailable: {}", join(names_of_behaviors(catalog, unavailable), ", "));
  }
  if (!faulty.empty()) text.line("faulty: {}", join(names_of_behaviors(catalog, faulty), ", "));
  const auto since = [&](BehaviorId behavior) {
    return fmt::format("{} at {} s", behavior_name(catalog, behavior),
                       format_time(of_.state.failed_at(behavior)));
  };
  if (!failed.empty()) text.line("failed, not tried again: {}", join(failed, ", ", since));
  return text.take();
}

void WhatIfText::write(const Section& section, Text& text) const {
  constexpr std::size_t widest_name = 28;
  constexpr std::size_t indent = 6;
  text.title(section.priorities.empty()
                 ? section.title
                 : fmt::format("{}, priority {}", section.title, list_with_or(section.priorities)));
  std::size_t width = 0;
  for (const Row& row : section.rows) {
    if (!row.effect.empty()) width = std::max(width, width_of(name_in(row, section)));
  }
  const Table table(style_, {{{}, {}, std::min(width, widest_name)}, {}, {}});
  std::vector<std::string> accepted;  // that change nothing
  std::vector<std::string> others;
  for (const Row& row : section.rows) {
    const std::string name = name_in(row, section);
    const bool is_accepted = row.outcome == name_of(Outcome::accepted);
    if (row.effect.empty()) {
      (is_accepted ? accepted : others).push_back(name);
      continue;
    }
    const std::string line =
        table.line({name, {row.outcome, is_accepted ? style_.good : style_.bad}, row.effect});
    text.add(wrap_line(std::string_view(line).substr(0, line.size() - 1), columns_, indent) + "\n");
  }
  const bool is_fault = section.title == name_of(Verb::fault);
  if (!accepted.empty()) text.line("  accepted, but nothing changes: {}", join(accepted, ", "));
  if (!others.empty()) {
    text.line("  nothing changes{}: {}", is_fault ? " before the next activation" : "",
              join(others, ", "));
  }
  if (is_fault) text.line("  where a fault ends a behavior, see 'finish, process_failure'");
}

std::string WhatIfText::finish() {
  Text text(style_, columns_);
  text.add(header());
  for (const Section& section : sections_) write(section, text);
  return text.take();
}

}  // namespace cbc
