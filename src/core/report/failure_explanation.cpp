#include "core/report/failure_explanation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/report/layout.h"
#include "core/report/reason_words.h"
#include "core/report/words.h"
#include "runtime/explain/reasons.h"

namespace cbc {
namespace {

/// Whether all that is missing is a request for some tasks.
bool needs_request_only(const WhyUnmet& why_unmet) {
  const std::vector<Reason>& conflict = why_unmet.why_not.conflict;
  return why_unmet.kind == WhyUnmet::Kind::decided && !conflict.empty() &&
         std::all_of(conflict.begin(), conflict.end(),
                     [](const Reason& reason) { return reason.kind == Reason::Kind::on_request; });
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
  rejected_ = time_and_event(record, step);
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
    stop = {record.index, {}, time_and_event(record, step)};
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
    for (std::string& note : notes_of(*catalog_, unexpected, *failure.state)) {
      lines.back().more.push_back(std::move(note));
    }
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
  const std::string last = time_and_event(*last_, last_step_);
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

std::string FailureExplanation::time_and_event(const EventRecord& record, const Step* step) const {
  return fmt::format("event {} at {} s: {}", record.index, format_time(record.time),
                     event_and_outcome(*catalog_, record, step));
}

}  // namespace cbc
