#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "base/text.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/read_files.h"
#include "cli/solve.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"
#include "report/solve_report.h"
#include "script/event_lines.h"
#include "script/reader.h"
#include "script/runner.h"
#include "yaml/document.h"

namespace cbc::cli {
namespace {

// The beginning and the end of streams and replays. Problems go to standard error.

/// Whether the file of --state-out, if the option is given, can be written. All has been read.
bool can_save_state(const StreamOptions& options) {
  return !options.state_out || can_write_output(*options.state_out);
}

/// Loads the state of --state-in, if the option is given. False if it cannot be used.
bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                std::optional<Snapshot>& state) {
  if (!options.state_in) return true;
  const std::optional<std::string> text = read_replaceable_input(*options.state_in);
  if (!text) return false;
  StateReading reading = read_state(*text, catalog);
  if (!reading.snapshot) {
    complain("cannot use the state {}: {}", quote(display_name(*options.state_in)), reading.error);
    return false;
  }
  state = std::move(reading.snapshot);
  return true;
}

/// Writes the state of --state-out, if the option is given, however the run ended: only after a
/// fault of cbc there is none. False after an error.
bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                const Runner& runner) {
  if (!options.state_out || runner.result().status == Coordinator::Status::refused_answer) {
    return true;
  }
  return write_output(*options.state_out, write_state(catalog, runner.snapshot())) == exit_ok;
}

/// Reports why a run ended early, if it did. Returns the exit status of the run.
int report_end(const Runner& runner, const CoordinatorOptions& options) {
  const RunResult& result = runner.result();
  const std::string reason = describe_end(result, options);
  if (!reason.empty()) complain(reason);
  if (result.status == Coordinator::Status::refused_answer) {
    complain("this is a fault of cbc, not of the catalog; please report it");
  }
  return status_of(result);
}

/// Longer lines are refused, to bound the memory.
constexpr std::size_t longest_event = std::size_t{1} << 20;
/// More warnings about a stream would only hide other messages.
constexpr int most_warnings = 20;

class Stream {
 public:
  Stream(const CompiledCatalog& catalog, const SolveOptions& options,
         const CoordinatorOptions& of_coordinator, const std::optional<Snapshot>& state,
         std::string script)
      : catalog_(catalog),
        options_(options),
        of_coordinator_(of_coordinator),
        state_(state),
        script_(std::move(script)),
        events_(
            catalog, event_additions(options),
            [this](std::string_view line) { output_.write(line); },
            [this](const Failure& failure) {
              complain_of_line(failure.range.begin.line, failure.message);
            }),
        runner_(catalog, stopping(of_coordinator), events_) {}

  void begin(const Situation& situation) {
    if (state_) {
      runner_.resume(*state_);
    } else {
      runner_.begin(situation);
    }
    output_.write(stream_header(catalog_, catalog_.file, of_coordinator_, situation,
                                runner_.coordinator().state().variables(), has_real_clock()));
    begin_ = std::chrono::steady_clock::now();
    first_ = runner_.coordinator().now();
  }

  void run(const Script& script) {
    begin(script.situation);
    for (const Step& step : script.steps) {
      if (is_stopped() || !runner_.take(step)) return;
    }
  }

  void run_standard_input() {
    begin({});
    LineInput input(STDIN_FILENO, signals_.descriptor(), longest_event,
                    [this] { output_.flush(); });
    EventLines lines(catalog_);
    lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    while (!is_stopped()) {
      switch (input.next(longest_wait())) {
        case LineInput::Status::waiting:
          if (!run_clock()) return;
          lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
          break;
        case LineInput::Status::line:
          if (!take(lines.read(input.line(), static_cast<std::uint32_t>(input.number())),
                    input.number(), lines)) {
            return;
          }
          break;
        case LineInput::Status::too_long:
          refuse(fmt::format("the line is longer than {} bytes", longest_event), input.number());
          break;
        case LineInput::Status::failed:
          complain("cannot read standard input: " + input.error());
          status_ = exit_unusable;
          return;
        case LineInput::Status::end:
        case LineInput::Status::stopped:
          return;
      }
    }
  }

  /// What is due at the last instant is left to the continued mission, if the state is saved.
  int end() {
    const bool goes_on = runner_.result().status == Coordinator::Status::ok;
    if (goes_on && !options_.stream.state_out && !output_.has_failed()) {
      static_cast<void>(runner_.settle());
    }
    output_.flush();
    if (!output_.has_failed() || runner_.result().status != Coordinator::Status::stopped) {
      status_ = std::max(status_, report_end(runner_, of_coordinator_));
    }
    if (const auto& totals = runner_.result().totals) output_.write(stream_totals(*totals));
    output_.flush();
    if (!save_state(options_.stream, catalog_, runner_) || output_.has_failed()) {
      status_ = std::max<int>(status_, exit_unusable);
    }
    return status_;
  }

 private:
  /// False if the run ended early.
  bool take(const EventLines::Reading& reading, std::uint64_t number, EventLines& lines) {
    for (const std::string& warning : reading.warnings) {
      if (++warnings_ > most_warnings) break;
      complain_of_line(number, "warning: " + warning);
      if (warnings_ < most_warnings) continue;
      complain("further warnings are not shown");
      lines.stop_warnings();
    }
    if (!reading.error.empty()) {
      refuse(reading.error, number);
      lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    }
    if (!reading.step) return true;
    // The limit of clock events applies to each line, since a stream has no end.
    runner_.restart_count();
    if (!has_real_clock() || reading.step->time) return runner_.take(*reading.step);
    Step now = *reading.step;
    now.time = std::max({clock_time(), settled_ + 1, runner_.coordinator().now()});
    const bool goes_on = runner_.take(now);
    // Times of lines are relative to the real clock.
    lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    return goes_on;
  }

  [[nodiscard]] bool is_stopped() const { return signals_.have_come() || output_.has_failed(); }

  /// The same options, for a coordinator that stops with the stream.
  [[nodiscard]] CoordinatorOptions stopping(CoordinatorOptions options) const {
    options.is_stopped = [this] { return is_stopped(); };
    return options;
  }

  [[nodiscard]] bool has_real_clock() const { return options_.stream.clock == "real"; }

  /// Time since the beginning, which is that of the saved state if there is one.
  [[nodiscard]] Microseconds clock_time() const {
    const auto passed = std::chrono::steady_clock::now() - begin_;
    return std::min(longest_time,
                    first_ + std::chrono::duration_cast<std::chrono::microseconds>(passed).count());
  }

  /// Milliseconds until something falls due, for LineInput: negative if nothing will.
  [[nodiscard]] int longest_wait() const {
    const auto due = runner_.coordinator().next_due();
    if (!has_real_clock() || !due) return -1;
    constexpr Microseconds longest = 60'000'000;
    const Microseconds wait = std::clamp<Microseconds>(*due - clock_time(), 0, longest);
    return static_cast<int>((wait + 999) / 1000);
  }

  /// Runs what has fallen due while no line came, each at its own time. False if the run ended.
  bool run_clock() {
    runner_.restart_count();
    for (;;) {
      if (is_stopped()) return false;
      const auto due = runner_.coordinator().next_due();
      if (!due || *due > clock_time()) return true;
      Step nothing;
      nothing.time = *due;
      nothing.expect.emplace();
      if (!runner_.take(nothing) || !runner_.settle()) return false;
      // A replay runs what is due at the time of a line after it, so no line may have this time.
      settled_ = *due;
    }
  }

  void refuse(const std::string& error, std::uint64_t number) {
    output_.write(stream_error(error, number));
    status_ = exit_unusable;
  }

  /// The lines before the message come first, also where both go to the same place.
  void complain_of_line(std::uint64_t number, const std::string& message) {
    output_.flush();
    complain("{}:{}: {}", printable(script_), number, message);
  }

  const CompiledCatalog& catalog_;
  const SolveOptions& options_;
  const CoordinatorOptions& of_coordinator_;
  const std::optional<Snapshot>& state_;
  const std::string script_;
  StopSignals signals_;
  LineOutput output_;
  EventStream events_;
  Runner runner_;
  std::chrono::steady_clock::time_point begin_;
  Microseconds first_ = 0;     ///< the time at begin_
  Microseconds settled_ = -1;  ///< all that was due until then is done
  int status_ = exit_ok;
  int warnings_ = 0;
};

std::optional<Script> load_script(const std::string& path, const CompiledCatalog& catalog,
                                  const std::optional<Snapshot>& state) {
  InputFiles files;
  std::optional<Script> script;
  const std::optional<InputFile> file = files.read(path);
  if (file && file->document == nullptr) {
    complain("{} is a catalog; expected a script here", quote(display_name(path)));
  } else if (file) {
    Diagnostics diagnostics;
    script = read_script(*file->document, catalog, Severity::warning, diagnostics,
                         state ? &*state : nullptr);
    const bool is_complete =
        script && !state;  // with another situation there may be other findings
    if (!files.take_findings(path, *file->document, std::move(diagnostics), is_complete)) {
      script.reset();
    }
  }
  files.print_findings();
  return script;
}

/// A script, on its own, from a state, or with its own situation.
int run_script_of(const Script& script, const CompiledCatalog& catalog, const SolveOptions& options,
                  const std::optional<Snapshot>& state) {
  if (!knows_names(catalog, options.explain)) return exit_unusable;
  CoordinatorOptions coordinator = coordinator_options(options, catalog);
  coordinator.reactive_delay = state ? state->reactive_delay : script.reactive_delay;
  coordinator.timeouts = state ? state->timeouts : script.timeouts;
  if (state && !script.situation.is_empty()) {
    return complain("script {} has a situation to begin with, but --state-in has one already",
                    quote(script.file));
  }
  if (!can_save_state(options.stream)) return exit_unusable;
  Stream stream(catalog, options, coordinator, state, script.file);
  stream.run(script);
  return stream.end();
}

/// A script that names its catalog.
int solve_mission(const SolveOptions& options) {
  if (options.stream.state_in) {
    return complain("--state-in needs a catalog and a script: cbc solve CATALOG SCRIPT");
  }
  const auto missions = MissionLoader().load(options.paths);
  if (!missions) return exit_unusable;
  if (missions->size() != 1) {
    return complain("--format jsonl runs one script at a time");
  }
  return run_script_of(missions->front().script, *missions->front().catalog, options, {});
}

int run_standard_input(const CompiledCatalog& catalog, const SolveOptions& options,
                       const std::optional<Snapshot>& state) {
  if (!knows_names(catalog, options.explain)) return exit_unusable;
  CoordinatorOptions coordinator = coordinator_options(options, catalog);
  if (state) {
    coordinator.reactive_delay = state->reactive_delay;
    coordinator.timeouts = state->timeouts;
  }
  if (!can_save_state(options.stream)) return exit_unusable;
  Stream stream(catalog, options, coordinator, state, display_name("-"));
  stream.run_standard_input();
  return stream.end();
}

/// Event lines name all running tasks, so they may be long.
constexpr std::size_t longest_line = std::size_t{64} << 20;

bool is_same(const yaml::Node& left, const yaml::Node& right) {
  const auto same_entry = [](const auto& one, const auto& other) {
    return one.first->text == other.first->text && is_same(*one.second, *other.second);
  };
  return left.kind == right.kind && left.plain == right.plain && left.text == right.text &&
         std::equal(left.items.begin(), left.items.end(), right.items.begin(), right.items.end(),
                    [](const auto* one, const auto* other) { return is_same(*one, *other); }) &&
         std::equal(left.entries.begin(), left.entries.end(), right.entries.begin(),
                    right.entries.end(), same_entry);
}

/// The names of the members that differ, "'running', 'changes'".
std::string find_differences(std::string_view logged, std::string_view found) {
  yaml::JsonReader left_reader;
  yaml::JsonReader right_reader;
  const yaml::Node* const left = left_reader.read(logged);
  const yaml::Node* const right = right_reader.read(found);
  if (left == nullptr || right == nullptr || left->kind != yaml::Kind::mapping ||
      right->kind != yaml::Kind::mapping) {
    return "the form of the line";
  }
  const auto find = [](const yaml::Node& object, const std::string& name) {
    return std::find_if(object.entries.begin(), object.entries.end(),
                        [&name](const auto& entry) { return entry.first->text == name; });
  };
  std::string names;
  const auto add = [&names](const std::string& name) {
    names += (names.empty() ? "" : ", ") + quote(name);
  };
  for (const auto& [name, value] : left->entries) {
    const auto other = find(*right, name->text);
    if (other == right->entries.end() || !is_same(*value, *other->second)) add(name->text);
  }
  for (const auto& entry : right->entries) {
    const std::string& name = entry.first->text;
    if (find(*left, name) == left->entries.end()) add(name);
  }
  return names.empty() ? "the order or the spelling of the line" : names;
}

class Replay {
 public:
  Replay(int descriptor, std::string name, CompiledCatalog catalog, const SolveOptions& options)
      : name_(std::move(name)),
        catalog_(std::move(catalog)),
        options_(options),
        input_(descriptor, -1, longest_line, [this] { output_.flush(); }),
        log_(catalog_) {}

  int run(const std::optional<Snapshot>& state) {
    CoordinatorOptions of_coordinator = coordinator_options(options_, catalog_);
    const auto header = read_header(state, of_coordinator);
    if (!header) return exit_unusable;
    catalog_.file = header->catalog;  // some messages name it
    if (state && state->reactive_delay != header->reactive_delay) {
      return refuse("its reactive delay is not that of the state");
    }
    if (state && state->timeouts != header->timeouts) {
      return refuse(header->timeouts ? "it has timeouts, but the state has none"
                                     : "it has no timeouts, but the state has");
    }
    EventStream events(
        catalog_, event_additions(options_), [this](std::string_view line) { compare(line); },
        [](const Failure&) {});
    Runner runner(catalog_, of_coordinator, events);
    if (state) {
      runner.resume(*state);
    } else {
      runner.begin(header->situation);
    }
    run_steps(runner);
    if (!is_over() && runner.result().status == Coordinator::Status::ok) run_to_end(runner);
    output_.flush();
    if (!is_over()) look_for_rest();
    output_.flush();
    if (!is_over()) {
      status_ = report_end(runner, of_coordinator);
      if (!save_state(options_.stream, catalog_, runner)) status_ = exit_unusable;
    }
    return output_.has_failed() ? std::max<int>(status_, exit_unusable) : status_;
  }

 private:
  struct Line {
    std::string text;
    std::uint64_t number = 0;
    EventLog::Entry entry;
  };

  /// Sets the options that the header has.
  [[nodiscard]] std::optional<EventLog::Header> read_header(const std::optional<Snapshot>& state,
                                                            CoordinatorOptions& of_coordinator) {
    if (input_.next() != LineInput::Status::line) {
      refuse("it has no header");
      return std::nullopt;
    }
    auto header = log_.read_header(input_.line());
    if (!header) {
      refuse(log_.error());
      return std::nullopt;
    }
    of_coordinator.reactive_delay = header->reactive_delay;
    of_coordinator.timeouts = header->timeouts;
    State first(catalog_);
    first.change_situation(header->situation.availability, header->situation.variables);
    std::string text =
        stream_header(catalog_, header->catalog, of_coordinator, header->situation,
                      state ? state->variables : first.variables(), header->has_real_clock);
    output_.write(text);
    text.pop_back();
    if (text != input_.line()) {
      tell_difference(1, std::string(input_.line()), text, "the header differs");
    }
    return header;
  }

  /// Runs each scripted event after reading the log up to it.
  void run_steps(Runner& runner) {
    while (!is_over() && read_line()) {
      if (!expected_.back().entry.step) {
        pass_answers();
        continue;
      }
      const Step step = *expected_.back().entry.step;
      if (step.time && *step.time < runner.coordinator().now()) {
        refuse(fmt::format("line {}: time goes back", expected_.back().number));
        return;
      }
      runner.restart_count();
      if (!runner.take(step)) return;
    }
  }

  /// Runs the clock events after the last scripted event: up to the time of an expectation, which
  /// logs do not contain, or to the last instant.
  void run_to_end(Runner& runner) {
    runner.restart_count();
    const auto last = std::find_if(expected_.rbegin(), expected_.rend(),
                                   [](const Line& line) { return line.entry.is_event; });
    if (last != expected_.rend()) {
      Step nothing;
      nothing.time = std::max(last->entry.time, runner.coordinator().now());
      nothing.expect.emplace();
      if (!runner.take(nothing)) return;
    } else if (options_.stream.state_out) {
      return;
    }
    is_at_end_ = true;
    static_cast<void>(runner.settle());
  }

  /// Adds the next line of the log to the expected ones.
  bool read_line() {
    switch (input_.next()) {
      case LineInput::Status::line:
        break;
      case LineInput::Status::too_long:
        refuse(
            fmt::format("line {}: it is longer than {} MiB", input_.number(), longest_line >> 20));
        return false;
      case LineInput::Status::failed:
        refuse(input_.error());
        return false;
      case LineInput::Status::waiting:
      case LineInput::Status::end:
      case LineInput::Status::stopped:
        return false;
    }
    const auto number = static_cast<std::uint32_t>(input_.number());
    auto entry = log_.read_entry(input_.line(), number);
    if (!entry) {
      refuse(fmt::format("line {}: {}", input_.number(), log_.error()));
      return false;
    }
    expected_.push_back({std::string(input_.line()), input_.number(), std::move(*entry)});
    return true;
  }

  /// Compares a line of the run with the log.
  void compare(std::string_view line) {
    if (is_over()) return;
    pass_answers();
    // Clock events that follow a scripted one have not been read yet.
    while (expected_.empty() && read_line()) pass_answers();
    if (is_over()) return;
    output_.write(line);
    line.remove_suffix(1);
    if (expected_.empty()) {
      tell_difference(input_.number() + 1, "", std::string(line),
                      is_at_end_ ? "the log ends here, before the events due at its last "
                                   "instant; replay a log made with --state-out with the same "
                                   "option"
                                 : "the log ends here");
    } else if (expected_.front().text != line) {
      std::string names = find_differences(expected_.front().text, line);
      if (!options_.stream.state_in && names.starts_with("'index'")) {
        names += "; replay a log that continues from a saved state with --state-in";
      }
      tell_difference(expected_.front().number, expected_.front().text, std::string(line),
                      "they differ in " + names);
    } else {
      expected_.pop_front();
    }
  }

  /// Nothing of the log may be left.
  void look_for_rest() {
    pass_answers();
    if (expected_.empty()) return;
    tell_difference(expected_.front().number, expected_.front().text, "", "the replay ends here");
  }

  /// Skips answers to lines that were not events, which a replay cannot reproduce.
  void pass_answers() {
    while (!expected_.empty() && !expected_.front().entry.is_event) {
      output_.write(expected_.front().text + "\n");
      expected_.pop_front();
    }
  }

  [[nodiscard]] bool is_over() const { return status_ != exit_ok || output_.has_failed(); }

  int refuse(const std::string& reason) {
    output_.flush();
    complain("cannot replay {}: {}", quote(name_), reason);
    return status_ = exit_unusable;
  }

  void tell_difference(std::uint64_t number, const std::string& logged, const std::string& found,
                       const std::string& what) {
    std::string message =
        fmt::format("{}:{}: the first difference: {}", printable(name_), number, what);
    if (!logged.empty()) message += "\n  log:    " + printable(logged);
    if (!found.empty()) message += "\n  replay: " + printable(found);
    output_.flush();
    complain(message);
    status_ = exit_no;
  }

  const std::string name_;
  CompiledCatalog catalog_;
  const SolveOptions& options_;
  LineInput input_;
  LineOutput output_;
  EventLog log_;
  std::deque<Line> expected_;  ///< lines of the log that are not compared yet
  bool is_at_end_ = false;     ///< of the log
  int status_ = exit_ok;
};

}  // namespace

int solve_stream(const SolveOptions& options) {
  const std::vector<std::string>& paths = options.paths;
  if (paths.size() > 2) {
    return complain("--format jsonl runs one script at a time: cbc solve CATALOG SCRIPT");
  }
  const bool is_stream = paths.back() == "-";
  if (!is_stream && options.stream.clock == "real") {
    return complain("--clock real needs a stream of events: cbc solve CATALOG - --format jsonl");
  }
  if (paths.size() == 1) {
    if (!is_stream) return solve_mission(options);
    return complain("a stream of events needs a catalog: cbc solve CATALOG - --format jsonl");
  }
  const auto catalog = load_catalog(paths.front());
  std::optional<Snapshot> state;
  if (catalog == nullptr || !load_state(options.stream, *catalog, state)) return exit_unusable;
  if (is_stream) return run_standard_input(*catalog, options, state);
  const auto script = load_script(paths.back(), *catalog, state);
  return script ? run_script_of(*script, *catalog, options, state) : exit_unusable;
}

int replay_stream(const SolveOptions& options) {
  if (options.paths.size() != 1) {
    return complain("--replay needs a log and its catalog: cbc solve --replay LOG CATALOG");
  }
  const std::string& path = *options.stream.replay;
  const auto catalog = load_catalog(options.paths.front());
  std::optional<Snapshot> state;
  if (catalog == nullptr || !load_state(options.stream, *catalog, state) ||
      !knows_names(*catalog, options.explain)) {
    return exit_unusable;
  }
  if (const auto refusal = find_confinement(path)) {
    return complain("cannot read {}: {}", quote(path), *refusal);
  }
  const int file = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return complain("cannot read {}: {}", quote(path), std::strerror(errno));
  }
  note_read(path);
  if (!can_save_state(options.stream)) return exit_unusable;
  const int status = Replay(file, display_name(path), *catalog, options).run(state);
  if (file != STDIN_FILENO) ::close(file);
  return status;
}

}  // namespace cbc::cli
