#include "core/report/failure_explanation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/explain/reasons.h"

namespace cbc {
namespace {

/// More differences would hide the rest.
constexpr std::size_t most_differences = 20;

std::string describe_place(const CompiledCatalog& catalog, const EventRecord& event) {
  return fmt::format("event {} at {} s ({})", event.index, format_time(event.time),
                     describe_event(catalog, event, nullptr));
}

std::string value_text(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  if (place == none) return "not running";
  const Value& value = catalog.values[task][place];
  return fmt::format("{} ({} %)", printable(catalog.name_of_behavior(value.behavior)),
                     format_decimal(value.suitability, 4));
}

/// "decided by ...": the objective, and its values in both answers.
std::string describe_decision(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected) {
  const State& state = *unexpected.why_unmet.before;
  const Configuration& chosen = unexpected.why_unmet.event->explanation.chosen;
  const Configuration& other = *unexpected.why_unmet.why_not.alternative;
  const Difference& difference = unexpected.why_unmet.why_not.difference;
  const auto both = [](std::string_view what, const auto& ours, const auto& theirs) {
    return fmt::format("by {}: {}; with what is expected, {} at best", what, ours, theirs);
  };
  switch (difference.criterion) {
    case Criterion::requests:
      return both("the requests served",
                  fmt::format("{} of {}", chosen.objective.satisfied, chosen.objective.requests),
                  fmt::format("{} of {}", other.objective.satisfied, other.objective.requests));
    case Criterion::request_order:
      return fmt::format(
          "by the order of requests: {} is served; with what is expected, {} at best, whose "
          "request "
          "comes later",
          task_name(catalog, difference.task), task_name(catalog, difference.other_task));
    case Criterion::suitability: {
      const auto [ours, theirs] =
          shorten_both(exact_suitability(catalog, state, unexpected.group, chosen.assignment),
                       exact_suitability(catalog, state, unexpected.group, other.assignment));
      return both("the suitability of all that runs", ours, theirs);
    }
    case Criterion::idle:
      return both("the supporting tasks running", supporting_text(chosen.objective),
                  supporting_text(other.objective));
    case Criterion::changes:
      return both("the behaviors activated or deactivated", chosen.objective.changes,
                  other.objective.changes);
    case Criterion::canonical:
      return fmt::format("by the canonical order of {}, since all objectives are equal",
                         task_name(catalog, difference.task));
  }
  return {};
}

Sentences describe_decided(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected) {
  const EventRecord& event = *unexpected.why_unmet.event;
  const WhyNot& why_not = unexpected.why_unmet.why_not;
  Sentences text;
  if (why_not.is_cut) {
    const bool is_proven = event.search->result.status == SearchStatus::optimal;
    text.first = fmt::format("decided at {}: {}", describe_place(catalog, event),
                             is_proven ? "a search limit was reached before the reason was found"
                                       : "a search limit was reached, so it is not proven best");
    return text;
  }
  if (!why_not.alternative) {
    text.more = describe_reasons(catalog, event, why_not.conflict, unexpected.tasks);
    text.first = fmt::format("decided at {}: no answer meets the expectation{}",
                             describe_place(catalog, event),
                             text.more.empty() ? ", since the event leaves no other choice" : ":");
    return text;
  }
  const std::vector<TaskId> unneeded = unneeded_tasks(catalog, event, why_not, unexpected.tasks);
  text.first = fmt::format("decided at {}{} {}:", describe_place(catalog, event),
                           unneeded.empty() ? std::string()
                                            : fmt::format(", where nothing that ran required {},",
                                                          list_tasks(catalog, unneeded, "or")),
                           describe_decision(catalog, unexpected));
  std::size_t count = 0;
  for (const TaskId task :
       differing_tasks(catalog, unexpected.group, event.explanation.chosen.assignment,
                       why_not.alternative->assignment)) {
    if (++count > most_differences) continue;
    const TaskId first = catalog.group_tasks[unexpected.group];
    text.more.push_back(
        fmt::format("{}: {} instead of {}", task_name(catalog, task),
                    value_text(catalog, task, event.explanation.chosen.assignment[task - first]),
                    value_text(catalog, task, why_not.alternative->assignment[task - first])));
  }
  if (count > most_differences) {
    text.more.push_back(fmt::format("and {} more", count - most_differences));
  }
  return text;
}

/// Whether all that is missing is a request for some tasks.
bool needs_request_only(const WhyUnmet& why_unmet) {
  const std::vector<Reason>& conflict = why_unmet.why_not.conflict;
  return why_unmet.kind == WhyUnmet::Kind::decided && !conflict.empty() &&
         std::all_of(conflict.begin(), conflict.end(),
                     [](const Reason& reason) { return reason.kind == Reason::Kind::on_request; });
}

/// Whether what stood in the way of an event no longer does.
bool is_over(const Reason& reason, const State& state) {
  switch (reason.kind) {
    case Reason::Kind::unavailable:
      return !state.is_denied(reason.behavior);
    case Reason::Kind::situation:
      return state.fits(reason.behavior);
    case Reason::Kind::faulty:
      return !state.is_faulty(reason.behavior);
    default:
      return false;
  }
}

Sentences describe_unmet(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected) {
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  switch (why_unmet.kind) {
    case WhyUnmet::Kind::undecided:
      return {"no event so far has started " + list_tasks(catalog, unexpected.tasks, "or") +
                  ", or what requires it",
              {}};
    case WhyUnmet::Kind::due:
      return {fmt::format("{} is due to start by itself at {} s",
                          task_name(catalog, why_unmet.queued_task), format_time(why_unmet.due)),
              {}};
    case WhyUnmet::Kind::rejected:
      return {describe_place(catalog, *why_unmet.event) + " was rejected:",
              describe_rejection(catalog, *why_unmet.event)};
    case WhyUnmet::Kind::decided:
      return describe_decided(catalog, unexpected);
  }
  return {};
}

void add_lines(const Sentences& sentences, std::vector<std::string>& lines) {
  lines.push_back(sentences.first);
  for (const std::string& sentence : sentences.more) lines.push_back("  " + sentence);
}

std::vector<std::string_view> sorted_reasons(const Sentences& sentences) {
  std::vector<std::string_view> reasons;
  for (const std::string& line : sentences.more) reasons.push_back(without_indentation(line));
  std::sort(reasons.begin(), reasons.end());
  return reasons;
}

/// Adds an explanation; if another one has the same reasons, without these.
void add_once(Sentences sentences, std::vector<Sentences>& all) {
  const std::vector<std::string_view> reasons = sorted_reasons(sentences);
  const bool is_known = std::any_of(all.begin(), all.end(), [&reasons](const Sentences& other) {
    return sorted_reasons(other) == reasons;
  });
  if (!reasons.empty() && is_known) {
    sentences.first.back() = ',';
    sentences.first += reasons.size() == 1 ? " for the same reason" : " for the same reasons";
    sentences.more.clear();
  }
  all.push_back(std::move(sentences));
}

/// The event whose rejection explains why tasks are not as expected, or 0.
std::uint64_t rejection_of(const WhyUnmet& why_unmet) {
  return why_unmet.kind == WhyUnmet::Kind::rejected ? why_unmet.event->index : 0;
}

}  // namespace

std::vector<TaskId> differing_tasks(const CompiledCatalog& catalog, std::uint32_t group,
                                    const Assignment& one, const Assignment& other) {
  std::vector<TaskId> tasks;
  const TaskId first = catalog.group_tasks[group];
  for (std::uint32_t task = 0; task < one.size(); ++task) {
    if (one[task] != other[task]) tasks.push_back(first + task);
  }
  std::sort(tasks.begin(), tasks.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].catalog_index < catalog.tasks[b].catalog_index;
  });
  return tasks;
}

std::vector<std::string> notes_of(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected,
                                  const State& state) {
  std::vector<std::string> notes;
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  const std::vector<Reason>& reasons = why_unmet.kind == WhyUnmet::Kind::rejected
                                           ? why_unmet.event->conflict
                                           : why_unmet.why_not.conflict;
  if (std::any_of(reasons.begin(), reasons.end(),
                  [&state](const Reason& reason) { return is_over(reason, state); })) {
    notes.emplace_back("this has changed since, but no later event has decided it anew");
  }
  for (const TaskId task : unexpected.tasks) {
    if (!state.is_running(task) || !state.is_faulty(state.behavior(task))) continue;
    std::string note = describe_late_fault(catalog, state.behavior(task));
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) {
      notes.push_back(std::move(note));
    }
  }
  return notes;
}

namespace {

void add_notes(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected,
               const State& state, Sentences& text) {
  for (std::string& note : notes_of(catalog, unexpected, state))
    text.more.push_back(std::move(note));
}

}  // namespace

Sentences describe_unexpected(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected,
                              const State& state) {
  Sentences text = describe_unmet(catalog, unexpected);
  add_notes(catalog, unexpected, state, text);
  return text;
}

void FailureExplanation::begin_run(const CompiledCatalog& catalog) {
  catalog_ = &catalog;
  last_ = nullptr;
  rejected_.clear();
  reasons_.clear();
  stops_.clear();
  waits_.clear();
}

void FailureExplanation::add(const EventRecord& record, const Step* step, const State& state) {
  last_ = &record;
  last_step_ = step;
  note_stops(record, step, state);
  note_waits(record, state);
  if (record.origin != Origin::script || !form_of(record.verb).is_decided) return;
  rejected_.clear();
  reasons_.clear();
  if (record.outcome != Outcome::rejected) return;
  rejected_ = describe(record, step);
  rejected_index_ = record.index;
  rejected_task_ = record.task;
  is_start_rejected_ = record.verb == Verb::start;
  reasons_ = describe_rejection(*catalog_, record);
}

void FailureExplanation::note_stops(const EventRecord& record, const Step* step,
                                    const State& state) {
  std::erase_if(stops_, [&state](const auto& stop) { return state.is_running(stop.first); });
  for (const StoppedTask& stopped : record.stopped_tasks) {
    Stop& stop = stops_[stopped.task];
    stop = {record.index, {}, describe(record, step)};
  }
  for (const Displacement& displaced : record.explanation.displaced) {
    stops_[displaced.task].why = describe_displacement(*catalog_, record, displaced, state);
  }
}

void FailureExplanation::note_waits(const EventRecord& record, const State& state) {
  std::erase_if(waits_, [&state](const auto& wait) { return !state.is_waiting(wait.first); });
  if (record.origin != Origin::reactive || record.outcome != Outcome::rejected) return;
  if (!state.is_waiting(record.task)) return;
  waits_[record.task] = {
      record.index,
      {fmt::format("{} has waited since event {} at {} s, a start that was rejected:",
                   task_name(*catalog_, record.task), record.index, format_time(record.time)),
       describe_rejection(*catalog_, record)}};
}

std::vector<std::string> FailureExplanation::tell(const Expectation& failed) const {
  std::vector<std::string> lines = tell_events(true);
  std::vector<Sentences> more;
  for (const Expectation::Running& expected : failed.running) {
    const TaskId task = catalog_->task_ids[expected.task];
    tell_wait(task, more);
    tell_stop(task, 0, more);
  }
  for (const Sentences& sentences : more) add_lines(sentences, lines);
  return lines;
}

std::vector<std::string> FailureExplanation::tell(const Failure& failure) const {
  std::vector<std::string> lines = tell_events(is_rejection_of_interest(failure));
  for (const Sentences& sentences : explain(failure)) add_lines(sentences, lines);
  return lines;
}

std::vector<Sentences> FailureExplanation::explain(const Failure& failure) const {
  std::vector<Sentences> lines;
  if (failure.number == most_explained + 1) {
    lines.push_back({fmt::format("not explained, as only the first {} of a script are; nor are "
                                 "the following ones",
                                 most_explained),
                     {}});
  }
  for (const UnexpectedTasks& unexpected : failure.unexpected) {
    const WhyUnmet& why_unmet = unexpected.why_unmet;
    const bool needs_request = needs_request_only(why_unmet);
    // The reasons of the event that decided are those of the stops in it, unless one task that
    // nobody requested is reason enough.
    const std::uint64_t told =
        why_unmet.event == nullptr || needs_request ? 0 : why_unmet.event->index;
    std::vector<TaskId> stopped;
    for (const TaskId task : unexpected.tasks) {
      const auto wait = waits_.find(task);
      if (wait != waits_.end() && wait->second.event != rejection_of(why_unmet)) {
        tell_wait(task, lines);
      }
      if (why_unmet.kind == WhyUnmet::Kind::due) continue;
      if (tell_stop(task, told, lines)) stopped.push_back(task);
    }
    const std::vector<Reason>& conflict = why_unmet.why_not.conflict;
    if (needs_request &&
        std::all_of(conflict.begin(), conflict.end(), [&stopped](const Reason& reason) {
          return std::count(stopped.begin(), stopped.end(), reason.task) > 0;
        })) {
      continue;
    }
    add_once(describe_unmet(*catalog_, unexpected), lines);
    add_notes(*catalog_, unexpected, *failure.state, lines.back());
  }
  return lines;
}

bool FailureExplanation::is_rejection_of_interest(const Failure& failure) const {
  if (rejected_.empty()) return false;
  for (const UnexpectedTasks& unexpected : failure.unexpected) {
    // Told with the tasks.
    if (rejection_of(unexpected.why_unmet) == rejected_index_) return false;
  }
  const Expectation& expected = *failure.step->expect;
  if (expected.outcome || failure.unexpected.empty()) return true;
  // A rejected start does not explain why something runs, nor a rejected stop why it does not.
  RelevantTasks relevant(*catalog_, catalog_->tasks[rejected_task_].group);
  relevant.add(rejected_task_);
  relevant.close();
  return std::any_of(
      failure.unexpected.begin(), failure.unexpected.end(), [&](const UnexpectedTasks& unexpected) {
        return unexpected.group == catalog_->tasks[rejected_task_].group &&
               std::any_of(unexpected.tasks.begin(), unexpected.tasks.end(), [&](TaskId task) {
                 return relevant.contains(task) &&
                        failure.state->is_running(task) != is_start_rejected_;
               });
      });
}

std::vector<std::string> FailureExplanation::tell_events(bool tells_rejection) const {
  if (last_ == nullptr) return {"before the first event"};
  const std::string last = describe(*last_, last_step_);
  std::vector<std::string> lines{"after " + last};
  if (!tells_rejection || rejected_.empty()) return lines;
  if (rejected_ != last) lines.push_back("and after " + rejected_);
  add_lines({"rejected:", reasons_}, lines);
  return lines;
}

void FailureExplanation::tell_wait(TaskId task, std::vector<Sentences>& lines) const {
  const auto wait = waits_.find(task);
  if (wait != waits_.end()) add_once(wait->second.why, lines);
}

bool FailureExplanation::tell_stop(TaskId task, std::uint64_t told,
                                   std::vector<Sentences>& lines) const {
  const auto found = stops_.find(task);
  if (found == stops_.end() || found->second.event == told) return false;
  const Stop& stop = found->second;
  if (stop.event != last_->index) {
    lines.push_back({task_name(*catalog_, task) + " stopped with " + stop.what, {}});
  }
  if (stop.why) add_once(*stop.why, lines);
  return true;
}

std::string FailureExplanation::describe(const EventRecord& record, const Step* step) const {
  const std::string outcome = ": " + std::string(name_of(record.outcome));
  return fmt::format("event {} at {} s: {}{}", record.index, format_time(record.time),
                     describe_event(*catalog_, record, step),
                     form_of(record.verb).is_decided ? outcome : "");
}

}  // namespace cbc
