// Each entry keeps the state after it, so to go back is to resume there, and to ask about an event
// is to do its entry once more. A coordinator does the same whenever it resumes the same state.
#include "wasm/session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/files/check_file.h"
#include "core/files/file_set.h"
#include "core/script/reader.h"
#include "lint/report/lint_report.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "solve/engine/what_if.h"
#include "solve/report/what_if_report.h"

namespace cbc::play {
namespace {

using yaml::JsonFault;
using yaml::JsonValue;

constexpr double latest = 1e9;                       // seconds
constexpr std::uint64_t most_clock_events = 20'000;  // of an entry: nobody looks at more of them

Microseconds read_time(const JsonValue& value) {
  constexpr double microseconds = 1e6;
  return std::llround(value.number(0, latest, "of seconds from 0 to 1000000000") * microseconds);
}

std::string name_or(const JsonValue& request, std::string_view otherwise) {
  const auto value = request.find("name");
  return value ? value->text() : std::string(otherwise);
}

std::size_t count_errors(const std::vector<Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const Diagnostic& finding) { return finding.severity == Severity::error; }));
}

/// What has come of an entry, as an expectation that holds.
Expectation expectation_of(const CompiledCatalog& catalog, const Step& step, const State& state,
                           std::optional<Outcome> outcome) {
  Expectation reached;
  if (!step.expect && form_of(step.verb).is_decided) reached.outcome = outcome;
  for (const std::uint32_t task : state.running()) {
    const BehaviorId behavior = state.behavior(catalog.task_ids[task]);
    reached.running.push_back({task, {catalog.behaviors[behavior].catalog_index}});
  }
  reached.active.emplace();
  for (std::uint32_t index = 0; index < catalog.behavior_ids.size(); ++index) {
    if (state.is_active(catalog.behavior_ids[index])) reached.active->push_back(index);
  }
  return reached;
}

}  // namespace

std::string Session::answer(std::string_view text) {
  std::string answer;
  std::string error;
  try {
    yaml::JsonReader reader;
    const yaml::Node* const root = reader.read(text);
    if (root == nullptr) throw JsonFault("the request is no JSON: " + reader.fault());
    const JsonValue request(*root);
    const std::string what = request["do"].text();
    JsonWriter json(answer);
    json.open('{');
    if (what == "open") {
      open(request, json);
    } else if (catalog_ == nullptr) {
      throw JsonFault("expected an 'open' first, found " + quote(what));
    } else if (what == "load") {
      load(request, json);
    } else if (what == "properties") {
      check_properties(request, json);
    } else if (what == "apply") {
      apply(request, json);
    } else if (what == "advance") {
      advance(request, json);
    } else if (what == "goto") {
      go_to(request, json);
    } else if (what == "what_if") {
      what_if(request, json);
    } else if (what == "state") {
      tell_state(json);
    } else if (what == "why") {
      why(request, json);
    } else if (what == "mission") {
      write_mission(json);
    } else {
      JsonValue::refuse_word("request", what);
    }
    json.close('}');
    json.flush();
    return answer;
  } catch (const JsonFault& fault) {
    error = fault.what();
  }
  answer.clear();
  JsonWriter json(answer);
  json.write_object({{"error", error}});
  json.flush();
  return answer;
}

void Session::open(const JsonValue& request, JsonWriter& answer) {
  const std::string name = name_or(request, "catalog.yaml");
  cli::FileSet files(cli::FileSet::Findings::dropped);
  const auto file = files.parse(name, request["catalog"].text());
  auto checked = std::make_shared<CheckedCatalog>(cli::check_catalog_file(*file, {}, {}));
  LintedFile linted{name, *file->text, checked->findings, {}, LintedFile::Kind::catalog};
  if (checked->compiled != nullptr) linted.summary = summarize(*checked->compiled);
  answer.write_json("lint", lint_json({linted}));
  if (checked->errors > 0 || checked->compiled == nullptr) return;
  source_ = std::move(checked);
  catalog_ = source_->compiled.get();
  begin({});
  answer.write_json("catalog", catalog_of_page(*catalog_));
  answer.open("requestable", '[');
  for (const TaskId task : catalog_->task_ids) {
    if (catalog_->tasks[task].start_on_request != 0 && catalog_->rules_of(task).requestable != 0) {
      answer.write(catalog_->name_of_task(task));
    }
  }
  answer.close(']');
  tell_present(answer);
}

void Session::load(const JsonValue& request, JsonWriter& answer) {
  const std::string name = name_or(request, "mission.yaml");
  cli::FileSet files(cli::FileSet::Findings::dropped);
  const auto file = files.parse(name, request["mission"].text());
  LintedFile linted{name, *file->text, {}, {}, LintedFile::Kind::script};
  std::optional<Script> script;
  if (file->document == nullptr) {
    linted.findings = file->diagnostics.all();
  } else {
    linted.findings = cli::check_about_catalog(*file, *catalog_, {});
    Diagnostics diagnostics;
    script = read_script(*file->document, *catalog_, Severity::warning, diagnostics);
  }
  answer.write_json("lint", lint_json({linted}));
  if (!script || count_errors(linted.findings) > 0) return;
  std::vector<Step> steps = std::exchange(script->steps, {});
  begin(std::move(*script));
  tell_present(answer);
  std::string obstacle;
  try {
    for (Step& step : steps) take({std::move(step)});
  } catch (const JsonFault& fault) {
    obstacle = fault.what();
  }
  tell_news(0, answer);
  if (!obstacle.empty()) answer.write("stopped", obstacle);
}

void Session::check_properties(const JsonValue& request, JsonWriter& answer) const {
  cli::FileSet files(cli::FileSet::Findings::dropped);
  const auto file = files.parse(name_or(request, "properties.yaml"), request["properties"].text());
  LintedFile linted{
      file->name, *file->text, file->diagnostics.all(), {}, LintedFile::Kind::properties};
  if (file->is(cli::FileKind::properties)) {
    linted.findings = cli::check_about_catalog(*file, *catalog_, {});
  }
  answer.write_json("lint", lint_json({linted}));
}

CoordinatorOptions Session::options() const {
  CoordinatorOptions options = options_of(script_);
  options.max_clock_events = most_clock_events;
  return options;
}

Questions Session::questions() { return {.rejections = true, .displaced = true, .failures = true}; }

/// Begins anew.
void Session::begin(Script script) {
  script_ = std::move(script);
  entries_.clear();
  events_.clear();
  position_ = 0;
  cut_.reset();
  stream_.emplace(
      *catalog_, EventAdditions{false, false, true},
      [this](const EventStream::Line& line) {
        explanation_.add(line.record, line.step, line.state);
        const bool is_rejected = line.record.outcome == Outcome::rejected;
        const SearchRecord* const search = line.record.search;
        events_.push_back({line.record.time, search == nullptr ? GroupId(none) : search->group,
                           is_rejected ? line.record.task : TaskId(none)});
        new_events_.emplace_back(line.text.substr(0, line.text.size() - 1));
      },
      [this](const Failure& failure) {
        append_failure(new_failures_.emplace_back(), *catalog_, failure, explanation_);
      });
  runner_.emplace(*catalog_, options(), *stream_, questions());
  explanation_.begin_stream(*catalog_);
  runner_->begin(script_.situation);
  start_ = runner_->snapshot();
}

const Snapshot& Session::present() const {
  if (cut_) return cut_->after;
  return position_ == 0 ? start_ : entries_[position_ - 1]->after;
}

/// Goes back to the present state, whatever was done after it.
void Session::resume() {
  runner_.emplace(*catalog_, options(), *stream_, questions());
  runner_->resume(present());
  explanation_.begin_stream(*catalog_);
}

/// The earliest time of another entry.
Microseconds Session::next_time() const {
  if (!cut_ && position_ == 0) return present().now;
  return present().now + ((cut_ ? *cut_ : *entries_[position_ - 1]).is_settled ? 1 : 0);
}

void Session::run(Entry& entry) {
  runner_->restart_count();
  bool is_done = runner_->take(entry.step);
  if (is_done && entry.is_clock) {
    entry.is_settled = runner_->coordinator().next_due() == entry.step.time;
    is_done = runner_->settle();
  }
  if (!is_done) {
    const bool is_fault = !runner_->result().internal_error.empty();
    throw JsonFault(is_fault
                        ? "internal error: " + runner_->result().internal_error
                        : "the clock makes too many events until then; move it in smaller steps");
  }
  entry.after = runner_->snapshot();
  entry.reached =
      expectation_of(*catalog_, entry.step, runner_->coordinator().state(), entry.after.outcome);
}

/// Does an entry in the present state; those that came after it are gone.
void Session::take(Call call) {
  const auto entry = std::make_shared<Entry>(Entry{std::move(call)});
  entry->step.time = std::max(entry->step.time.value_or(0), next_time());
  const auto now = events_.begin() + static_cast<std::ptrdiff_t>(present().events);
  const std::vector<Happened> later(now, events_.end());
  const std::size_t told = new_events_.size();
  const std::size_t failed = new_failures_.size();
  events_.erase(now, events_.end());
  try {
    run(*entry);
  } catch (...) {
    events_.resize(static_cast<std::size_t>(present().events));
    events_.insert(events_.end(), later.begin(), later.end());
    new_events_.resize(told);
    new_failures_.resize(failed);
    resume();
    throw;
  }
  entries_.resize(position_);
  if (cut_) entries_.push_back(std::exchange(cut_, nullptr));
  entries_.push_back(entry);
  position_ = entries_.size();
}

void Session::tell_present(JsonWriter& answer) const {
  answer.write_json("begin", state_of_page(*catalog_, present().events, present().now,
                                           runner_->coordinator().state()));
}

void Session::tell_place(JsonWriter& answer) const {
  answer.write("index", present().events);
  answer.write_seconds("time", present().now);
  answer.write("entry", static_cast<std::uint64_t>(position_));
  answer.write("entries", static_cast<std::uint64_t>(entries_.size()));
}

void Session::tell_news(std::uint64_t first, JsonWriter& answer) {
  tell_place(answer);
  answer.write("first", first + 1);
  const auto write_all = [&](std::string_view name, std::vector<std::string>& items) {
    answer.open(name, '[');
    for (const std::string& item : std::exchange(items, {})) answer.write_json(item);
    answer.close(']');
  };
  write_all("events", new_events_);
  write_all("failures", new_failures_);
  const auto expectations = std::count_if(
      entries_.begin(), entries_.end(), [](const auto& entry) { return entry->is_expectation(); });
  answer.write("expectations", static_cast<std::uint64_t>(expectations));
}

namespace {

/// Reads an entry of a script.
EventLines::Reading read_entry(const JsonValue& entry, const CompiledCatalog& catalog,
                               const Coordinator& coordinator) {
  EventLines lines(catalog);
  lines.resume(coordinator.now(), coordinator.state());
  EventLines::Reading reading = lines.read(entry.text(), 1);
  if (reading.error.empty() && !reading.step) reading.error = "expected an event, found nothing";
  return reading;
}

}  // namespace

void Session::apply(const JsonValue& request, JsonWriter& answer) {
  EventLines::Reading reading = read_entry(request["event"], *catalog_, runner_->coordinator());
  if (!reading.step) throw JsonFault(reading.error);
  const std::uint64_t before = present().events;
  take({std::move(*reading.step)});
  tell_news(before, answer);
  answer.write_list("warnings", reading.warnings);
}

void Session::advance(const JsonValue& request, JsonWriter& answer) {
  const auto to = request.find("to");
  const auto time = to ? read_time(*to) : runner_->coordinator().next_due();
  if (!time) throw JsonFault("nothing falls due");
  if (*time < present().now) throw JsonFault("the clock cannot go back");
  const std::uint64_t before = present().events;
  take(clock_call(*time));
  tell_news(before, answer);
}

void Session::go_to(const JsonValue& request, JsonWriter& answer) {
  if (const auto done = request.find("entry")) {
    position_ = done->integer<std::size_t>(0, entries_.size());
    cut_.reset();
    resume();
    return tell_place(answer);
  }
  const auto most = static_cast<std::size_t>(entries_.empty() ? 0 : entries_.back()->after.events);
  const auto index = request["index"].integer<std::size_t>(0, most);
  const auto entry = std::lower_bound(
      entries_.begin(), entries_.end(), index,
      [](const auto& one, std::uint64_t number) { return one->after.events < number; });
  cut_.reset();
  position_ = index == 0 ? 0 : static_cast<std::size_t>(entry - entries_.begin()) + 1;
  if (index > 0 && events_[index - 1].time < *(*entry)->step.time) {
    // The clock made the event on its way to the entry.
    --position_;
    resume();
    const auto part = std::make_shared<Entry>(Entry{clock_call(events_[index - 1].time)});
    const std::size_t known = events_.size();
    run(*part);
    events_.resize(known);
    new_events_.clear();
    new_failures_.clear();
    cut_ = part;
  } else {
    const auto belongs = [&](const Entry& other) {
      return other.is_expectation() && other.after.events == index &&
             other.after.now == present().now;
    };
    while (position_ < entries_.size() && belongs(*entries_[position_])) ++position_;
  }
  resume();
  tell_place(answer);
}

std::string Session::what_if_report(const std::vector<Step>& moves) const {
  const MissionMoment moment{present(), std::nullopt};
  WhatIfJson report({*catalog_, script_, moment, runner_->coordinator().state()});
  if (!moves.empty()) {
    const RunResult result = try_moves(*catalog_, options_of(script_), moment.snapshot, moves,
                                       [&report](const PossibleMove& move) { report.add(move); });
    if (!result.internal_error.empty()) throw JsonFault("internal error: " + result.internal_error);
  }
  return report.finish();
}

void Session::what_if(const JsonValue& request, JsonWriter& answer) {
  EventLines::Reading reading = read_entry(request["event"], *catalog_, runner_->coordinator());
  if (!reading.step) throw JsonFault(reading.error);
  if (reading.step->expect) throw JsonFault("expected an event, found an expectation");
  answer.write_json("report", what_if_report({std::move(*reading.step)}));
}

void Session::tell_state(JsonWriter& answer) {
  answer.write_json("report", what_if_report({}));
  answer.open("timeouts", '{');
  for (const auto& [due, task] : runner_->coordinator().state().timeouts().entries()) {
    answer.write_seconds(catalog_->task_names[task], due);
  }
  answer.close('}');
  if (const auto due = runner_->coordinator().next_due()) {
    answer.write_seconds("next_due", *due);
  } else {
    answer.write_json("next_due", "null");
  }
}

/// The last event up to this one that decided about the group of a task, or that asked for the task
/// and was rejected; 0: none.
std::size_t Session::decider_of(TaskId task, std::size_t index) const {
  const GroupId group = catalog_->tasks[task].group;
  for (; index > 0; --index) {
    const Happened& event = events_[index - 1];
    if (event.group == group && (event.rejected == none || event.rejected == task)) return index;
  }
  return 0;
}

void Session::why(const JsonValue& request, JsonWriter& answer) {
  const std::string name = request["task"].text();
  const auto task = catalog_->find_task(name);
  if (!task) throw JsonFault("catalog " + quote(catalog_->file) + " has no task " + quote(name));
  const auto given = request.find("index");
  const auto last = static_cast<std::size_t>(present().events);
  const std::size_t index = given ? given->integer<std::size_t>(0, last) : last;
  const std::size_t wanted = decider_of(catalog_->task_ids[*task], index);
  if (wanted == 0) return answer.write_json("event", "null");
  std::size_t place = 0;
  while (place < position_ && entries_[place]->after.events < wanted) ++place;
  const Entry& entry = place < position_ ? *entries_[place] : *cut_;
  Questions of_repetition = questions();
  of_repetition.why = {{true, *task}};
  std::string text;
  repeat(*catalog_, options(), place == 0 ? start_ : entries_[place - 1]->after, entry,
         of_repetition, [&](const ExplainedRecord& record, const Step* step, const State& state) {
           if (record.index != wanted) return;
           append_event(text, *catalog_, record, step, state, {true, false, true});
         });
  answer.write_json("event", text);
}

void Session::write_mission(JsonWriter& answer) const {
  Script mission = script_;
  auto done =
      std::vector(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(position_));
  if (cut_) done.push_back(cut_);
  for (std::size_t place = 0; place < done.size(); ++place) {
    const Entry& entry = *done[place];
    if (!entry.is_clock) mission.steps.push_back(entry.step);
    // What a mission that was loaded expects stands for itself.
    const bool is_followed = place + 1 < done.size() && done[place + 1]->is_expectation();
    if (is_followed || entry.is_expectation()) continue;
    Step expectation;
    expectation.time = *entry.step.time + (entry.is_settled ? 1 : 0);
    expectation.expect = entry.reached;
    mission.steps.push_back(std::move(expectation));
  }
  answer.write("mission", write_script(*catalog_, mission, ""));
}

}  // namespace cbc::play
