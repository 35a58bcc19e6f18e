#include "core/words/failure_explanation.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "ask/conflict/reasons.h"
#include "core/words/layout.h"
#include "core/words/reason_words.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

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

void FailureExplanation::begin_stream(const CompiledCatalog& catalog) {
  *this = {};
  catalog_ = &catalog;
  is_needed_ = true;
}

void FailureExplanation::begin_run(const CompiledCatalog& catalog, const Script& script) {
  begin_stream(catalog);
  is_needed_ = std::any_of(script.steps.begin(), script.steps.end(),
                           [](const Step& step) { return step.expect.has_value(); });
}

void FailureExplanation::add(const ExplainedRecord& record, const Step* step, const State& state) {
  if (!is_needed_) return;
  last_ = &record;
  last_step_ = step;
  note_stops(record, state);
  note_waits(record, state);
  note_changes(record, step, state);
  note_timeouts(record, state);
  if (record.origin != Origin::script || !form_of(record.verb).is_decided) return;
  rejected_.clear();
  conflict_.clear();
  reasons_.clear();
  if (record.outcome != Outcome::rejected) return;
  rejected_ = time_and_event(record, step);
  rejected_index_ = record.index;
  rejected_task_ = record.task;
  is_start_rejected_ = record.verb == Verb::start;
  conflict_ = record.conflict;
  reasons_ = describe_rejection(*catalog_, record);
}

void FailureExplanation::note_stops(const ExplainedRecord& record, const State& state) {
  std::erase_if(stops_, [&state](const auto& stop) { return state.is_running(stop.first); });
  for (auto& [task, stop] : stops_) {
    if (!stop.is_suspended || state.is_suspended(task)) continue;
    stop.is_suspended = false;
    stop.ended = place_of(*catalog_, record);
  }
  for (const StoppedTask& stopped : record.stopped_tasks) {
    Stop& stop = stops_[stopped.task];
    stop = {};
    stop.event = record.index;
    stop.what = place_of(*catalog_, record);
    stop.priority = stopped.priority.value_or(0);
    stop.is_suspended = state.is_suspended(stopped.task);
    stop.is_own_end = stopped.has_finished ? stopped.cause == FinishCause::goal_achieved
                                           : record.task == stopped.task;
    const auto timeout = timeouts_.find(stopped.task);
    const bool has_timed_out = stopped.has_finished && record.origin == Origin::timeout;
    if (has_timed_out && timeout != timeouts_.end()) {
      stop.timeout = describe_timeout(stopped.task, timeout->second);
    }
  }
  for (const Displacement& displaced : record.explanation.displaced) {
    stops_[displaced.task].why = describe_displacement(*catalog_, record, displaced, state);
  }
}

/// Notes of the behaviors that an event concerns what it changed.
void FailureExplanation::note_changes(const EventRecord& record, const Step* step,
                                      const State& state) {
  if (step == nullptr || form_of(record.verb).is_decided) return;
  const auto note = [&](BehaviorId behavior, const std::string& what) {
    Change& change = changes_[behavior];
    const bool is_same_event = change.event == record.index;
    change = {record.index, record.time, is_same_event ? change.what + " and " + what : what};
  };
  if (record.verb == Verb::repair) {
    note(record.behavior, behavior_name(*catalog_, record.behavior) + " was repaired");
  }
  for (const Availability& entry : step->situation.availability) {
    const BehaviorId behavior = catalog_->behavior_ids[entry.behavior];
    note(behavior, fmt::format("{} became {}available", behavior_name(*catalog_, behavior),
                               entry.available ? "" : "un"));
  }
  for (const VariableValue& value : step->situation.variables) {
    std::set<BehaviorId> concerned;
    for (const FittingValue& fitting : state.fitting(value.variable)) {
      concerned.insert(fitting.behavior);
    }
    for (const BehaviorId behavior : concerned) {
      note(behavior, printable(catalog_->name_of_variable(value.variable)) + " changed");
    }
  }
}

/// Notes when the timeouts of the tasks begin whose behavior an event has decided.
void FailureExplanation::note_timeouts(const EventRecord& record, const State& state) {
  if (record.outcome != Outcome::accepted || record.search == nullptr) return;
  if (state.timeouts().empty()) return timeouts_.clear();
  const GroupId group = record.search->group;
  for (TaskId task = catalog_->group_tasks[group]; task < catalog_->group_tasks[group + 1];
       ++task) {
    const std::uint32_t index = catalog_->tasks[task].catalog_index;
    if (!state.timeouts().has(index)) {
      timeouts_.erase(task);
      continue;
    }
    const Microseconds length = timeout_of(*catalog_, task, state.behavior(task));
    const Microseconds begin = state.timeouts().due(index) - length;
    Timeout& timeout = timeouts_[task];
    if (timeout.behavior == state.behavior(task) && timeout.begin == begin) continue;
    const bool is_anew = timeout.behavior != none;
    const std::string_view how = !is_anew                                   ? "began"
                                 : timeout.behavior == state.behavior(task) ? "was restarted"
                                                                            : "took over";
    timeout = {begin, length, record.index, state.behavior(task), how, is_anew};
  }
}

void FailureExplanation::note_waits(const ExplainedRecord& record, const State& state) {
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
    Story story = explain(failure, unexpected);
    for (Sentences& sentences : story.sentences) add_once(std::move(sentences), lines);
    for (std::string& note : story.notes) lines.back().more.push_back(std::move(note));
  }
  return lines;
}

FailureExplanation::Story FailureExplanation::explain(const Failure& failure,
                                                      const UnexpectedTasks& unexpected) const {
  Story story;
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  const bool needs_request = needs_request_only(why_unmet);
  // The reasons of the event that decided are those of the stops in it, unless one task that nobody
  // requested is reason enough.
  const std::uint64_t told =
      why_unmet.event == nullptr || needs_request ? 0 : why_unmet.event->index;
  std::vector<TaskId> stopped;
  for (const TaskId task : unexpected.tasks) {
    const auto wait = waits_.find(task);
    if (wait != waits_.end() && wait->second.event != rejection_of(why_unmet)) {
      tell_wait(task, story.sentences);
    }
    if (why_unmet.kind == WhyUnmet::Kind::due) continue;
    if (tell_stop(task, told, story.sentences)) stopped.push_back(task);
  }
  const auto is_told = [&stopped](TaskId task) {
    return std::count(stopped.begin(), stopped.end(), task) > 0;
  };
  const std::vector<Reason>& conflict = why_unmet.why_not.conflict;
  const bool lacks_told_requests =
      needs_request && std::all_of(conflict.begin(), conflict.end(),
                                   [&](const Reason& reason) { return is_told(reason.task); });
  const bool are_ends_told =
      why_unmet.kind == WhyUnmet::Kind::decided &&
      std::all_of(unexpected.tasks.begin(), unexpected.tasks.end(), [&](TaskId task) {
        if (!is_told(task)) return false;
        const Stop& stop = stops_.at(task);
        return stop.event == why_unmet.event->index && stop.is_own_end;
      });
  if (!lacks_told_requests && !are_ends_told) {
    add_once(describe_unmet(*catalog_, unexpected, *failure.state), story.sentences);
  }
  story.notes = notes_on(failure, unexpected);
  return story;
}

std::vector<std::string> FailureExplanation::notes_on(const Failure& failure,
                                                      const UnexpectedTasks& unexpected) const {
  std::vector<std::string> notes = notes_of(*catalog_, unexpected, *failure.state);
  if (std::string note = note_of_change(unexpected); !note.empty()) {
    notes.push_back(std::move(note));
  }
  const std::vector<std::uint32_t>& stopped = failure.step->expect->stopped;
  for (const TaskId task : unexpected.tasks) {
    const auto timeout = timeouts_.find(task);
    const std::uint32_t index = catalog_->tasks[task].catalog_index;
    // Whoever expects the task to run does not wait for its end.
    const bool is_to_end = std::find(stopped.begin(), stopped.end(), index) != stopped.end();
    if (timeout == timeouts_.end() || !is_to_end) continue;
    notes.push_back(fmt::format("{}, and is due at {} s", describe_timeout(task, timeout->second),
                                format_time(timeout->second.begin + timeout->second.length)));
  }
  return notes;
}

/// That the situation changed after the last decision, where that says nothing of it: the last
/// change of the behaviors that could start, or of any in the group.
std::string FailureExplanation::note_of_change(const UnexpectedTasks& unexpected) const {
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  const bool is_blocked = !why_unmet.blocked.empty();
  const bool is_without_choice = why_unmet.kind == WhyUnmet::Kind::decided &&
                                 !why_unmet.why_not.is_cut && !why_unmet.why_not.alternative &&
                                 why_unmet.why_not.conflict.empty();
  if (!is_blocked && !is_without_choice) return {};
  const Change* last = nullptr;
  const auto look_at = [&](BehaviorId behavior) {
    const auto change = changes_.find(behavior);
    if (change == changes_.end() || change->second.event <= why_unmet.last_event) return;
    if (last == nullptr || change->second.event > last->event) last = &change->second;
  };
  if (is_blocked) {
    for (const BlockedStart& start : why_unmet.blocked) {
      for (const Value& value : catalog_->values[start.task]) look_at(value.behavior);
    }
  } else {
    for (BehaviorId behavior = catalog_->group_behaviors[unexpected.group];
         behavior < catalog_->group_behaviors[unexpected.group + 1]; ++behavior) {
      look_at(behavior);
    }
  }
  if (last == nullptr) return {};
  return fmt::format("nothing was decided after {} at {} s", last->what, format_time(last->time));
}

/// "the timeout of HOVER (10 s) began anew at 5.000 s, when SLOW took over (event 3)"
std::string FailureExplanation::describe_timeout(TaskId task, const Timeout& timeout) const {
  return fmt::format("the timeout of {} ({} s) began {}at {} s, when {} {} (event {})",
                     task_name(*catalog_, task), format_decimal(timeout.length, 6),
                     timeout.is_anew ? "anew " : "", format_time(timeout.begin),
                     behavior_name(*catalog_, timeout.behavior), timeout.how, timeout.event);
}

bool FailureExplanation::is_rejection_of_interest(const Failure& failure) const {
  if (rejected_.empty()) return false;
  for (const UnexpectedTasks& unexpected : failure.unexpected) {
    // Told with the tasks.
    if (rejection_of(unexpected.why_unmet) == rejected_index_) return false;
  }
  const Expectation& expected = *failure.step->expect;
  if (expected.outcome || failure.unexpected.empty()) return true;
  if (std::any_of(conflict_.begin(), conflict_.end(),
                  [&](const Reason& reason) { return is_over(reason, *failure.state); })) {
    return false;
  }
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
  if (found == stops_.end()) return false;
  const Stop& stop = found->second;
  const bool is_told = stop.event == told;
  if (is_told && stop.priority == 0 && stop.timeout.empty()) return false;
  if (stop.event != last_->index || stop.priority > 0 || !stop.timeout.empty()) {
    std::string line = fmt::format("{} stopped with {}", task_name(*catalog_, task), stop.what);
    if (stop.is_suspended) {
      line += fmt::format(", and its request (priority {}) waits", stop.priority);
    } else if (stop.priority > 0) {
      line += fmt::format(", and its request (priority {}) ended {}", stop.priority,
                          stop.ended.empty() ? "there" : "with " + stop.ended);
      // Of the last event of the script another answer was expected, not another event.
      const bool is_answer = stop.event == last_->index && last_->origin == Origin::script &&
                             last_->verb != Verb::finish;
      const bool helps = !is_answer && catalog_->tasks[task].start_on_request != 0;
      if (helps) line += "; request it again";
    }
    if (!stop.timeout.empty()) line += "; " + stop.timeout;
    lines.push_back({std::move(line), {}});
  }
  if (stop.why && !is_told) add_once(*stop.why, lines);
  return true;
}

std::string FailureExplanation::time_and_event(const EventRecord& record, const Step* step) const {
  return fmt::format("event {} at {} s: {}", record.index, format_time(record.time),
                     event_and_outcome(*catalog_, record, step));
}

}  // namespace cbc
