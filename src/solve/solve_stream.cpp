#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "core/files/file_set.h"
#include "core/files/line_input.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/files/signals.h"
#include "core/report/event_json.h"
#include "core/script/event_lines.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/support/json.h"
#include "core/words/failure_explanation.h"
#include "core/words/words.h"
#include "page/html_report.h"
#include "page/serve/history.h"
#include "page/serve/server.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// Longer lines are refused, to bound the memory.
constexpr std::size_t longest_event = std::size_t{1} << 20;
/// More warnings about a stream would only hide other messages.
constexpr int most_warnings = 20;

std::string without_line_end(std::string line) {
  line.pop_back();
  return line;
}

/// The page of --serve, which shows a stream while it runs.
class LivePage {
 public:
  /// Serves the page at an address that serve::read_address() accepts, and prints where it is.
  /// `name` is that of the stream, `index` the number of the event before it. Null if it cannot be
  /// served, which is reported. The catalog must outlive it.
  [[nodiscard]] static std::unique_ptr<LivePage> open(const CompiledCatalog& catalog,
                                                      std::string_view address, std::string name,
                                                      std::uint64_t index,
                                                      const Coordinator& coordinator);

  explicit LivePage(const CompiledCatalog& catalog) : catalog_(catalog) {
    explanation_.begin_stream(catalog);
  }

  void add(const EventStream::Line& line);
  void add(const Failure& failure);
  /// The answer to a line that is no event.
  void add_refusal(const std::string& answer);
  /// After the stream: waits until all browsers have it, but not for long. `error`: why it ended
  /// early, or empty.
  void end(const RunResult& result, const std::string& error);

 private:
  void add(std::string_view type, std::string_view data);

  const CompiledCatalog& catalog_;
  FailureExplanation explanation_;
  serve::History history_{serve::History::Limits()};
  std::unique_ptr<serve::Server> server_;
};

std::unique_ptr<LivePage> LivePage::open(const CompiledCatalog& catalog, std::string_view address,
                                         std::string name, std::uint64_t index,
                                         const Coordinator& coordinator) {
  auto live = std::make_unique<LivePage>(catalog);
  const std::string begin = state_of_page(catalog, index, coordinator.now(), coordinator.state());
  live->history_.begin_part(begin);
  // Tells this run from those that another process serves at the same address.
  const std::string token = serve::make_token();
  serve::Server::Site site;
  site.page = [page = stream_page(catalog, {std::move(name), begin, "", 0, token})] {
    return page;
  };
  site.history = &live->history_;
  site.token = token;
  auto [server, error] = serve::Server::start(*serve::read_address(address), std::move(site));
  if (server == nullptr) {
    complain("--serve: cannot serve a page at {}: {}", quote(address), error);
    return nullptr;
  }
  live->server_ = std::move(server);
  complain("live page: {}", serve::to_url(live->server_->address()));
  return live;
}

void LivePage::add(std::string_view type, std::string_view data) {
  history_.add(type, data);
  server_->notify();
}

void LivePage::add(const EventStream::Line& line) {
  explanation_.add(line.record, line.step, line.state);
  std::string event = without_line_end(std::string(line.text));
  if (const std::string note = describe_note(catalog_, line.record, line.state); !note.empty()) {
    event.pop_back();
    event += R"(,"note":)";
    append_text(event, note);
    event += '}';
  }
  add("", event);
  if (history_.wants_state()) {
    history_.begin_part(state_of_page(catalog_, line.record.index, line.record.time, line.state));
  }
}

void LivePage::add(const Failure& failure) {
  std::string text;
  append_failure(text, catalog_, failure, explanation_);
  add("failure", text);
}

void LivePage::add_refusal(const std::string& answer) { add("refusal", without_line_end(answer)); }

void LivePage::end(const RunResult& result, const std::string& error) {
  add("end", without_line_end(json_line([&](JsonWriter& json) {
        json.write_members({{"passed", result.passed}, {"failed", result.failed}});
        if (!error.empty()) json.write("error", error);
      })));
  history_.end();
  server_->notify();
  server_->finish(std::chrono::seconds(2));
  if (!server_->was_visited()) {
    complain(
        "the stream ended before a browser opened its page; 'cbc solve CATALOG LOG --html "
        "FILE' makes one of a log");
  }
}

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
            [this](const EventStream::Line& line) {
              output_.write(line.text);
              if (live_ != nullptr) live_->add(line);
            },
            [this](const Failure& failure) {
              complain_of_line(failure.range.begin.line, failure.message);
              if (live_ != nullptr) live_->add(failure);
            }),
        runner_(catalog, stopping(of_coordinator), events_, questions(catalog)) {}

  /// False if --serve is not possible.
  [[nodiscard]] bool begin(const Situation& situation) {
    if (state_) {
      runner_.resume(*state_);
    } else {
      runner_.begin(situation);
    }
    if (options_.stream.serve) {
      live_ = LivePage::open(catalog_, *options_.stream.serve, "live stream",
                             state_ ? state_->events : 0, runner_.coordinator());
      if (live_ == nullptr) return false;
    }
    output_.write(stream_header(catalog_, catalog_.file, of_coordinator_, situation,
                                runner_.coordinator().state().variables(), options_.stream.clock));
    begin_ = std::chrono::steady_clock::now();
    first_ = runner_.coordinator().now();
    return true;
  }

  void run(const Script& script) {
    for (const Step& step : script.steps) {
      if (is_stopped() || !runner_.take(step)) return;
    }
  }

  void run_standard_input() {
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
    if (live_ != nullptr) {
      live_->end(runner_.result(), describe_end(runner_.result(), of_coordinator_));
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
    if (!has_real_clock()) return runner_.take(*reading.step);
    Step step = *reading.step;
    if (const Microseconds now = clock_time(); step.time && *step.time > now) {
      refuse(fmt::format("the time is {} s, but the real clock is at {} s",
                         format_decimal(*step.time, 6), format_decimal(now, 6)),
             number);
      lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
      return true;
    }
    step.time = std::max(
        {step.time ? *step.time : clock_time(), settled_ + 1, runner_.coordinator().now()});
    const bool goes_on = runner_.take(step);
    // Times of lines are relative to the real clock.
    lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    return goes_on;
  }

  [[nodiscard]] bool is_stopped() const { return signals_.have_come() || output_.has_failed(); }

  [[nodiscard]] Questions questions(const CompiledCatalog& catalog) const {
    Questions result = questions_of(options_, catalog);
    result.failures = options_.stream.serve.has_value();  // the page explains failed expectations
    return result;
  }

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
    const std::string line = stream_error(error, number);
    output_.write(line);
    if (live_ != nullptr) live_->add_refusal(line);
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
  std::unique_ptr<LivePage> live_;  ///< null: none is wanted
  std::chrono::steady_clock::time_point begin_;
  Microseconds first_ = 0;     ///< the time at begin_
  Microseconds settled_ = -1;  ///< all that was due until then is done
  int status_ = exit_ok;
  int warnings_ = 0;
};

std::optional<Script> load_script(const std::string& path, const CompiledCatalog& catalog,
                                  const std::optional<Snapshot>& state) {
  FileSet files;
  std::optional<Script> script;
  const auto file = files.read(path);
  if (file && file->is(FileKind::compiled)) {
    complain("{} is a catalog; expected a script here", quote(file->name));
  } else if (file) {
    script = files.read_script(*file, catalog, state ? &*state : nullptr);
  }
  files.print_findings();
  return script;
}

/// A script, on its own, from a state, or with its own situation.
int run_script_of(const Script& script, const CompiledCatalog& catalog, const SolveOptions& options,
                  const std::optional<Snapshot>& state) {
  if (!knows_names(catalog, options.explain)) return exit_unusable;
  CoordinatorOptions coordinator = coordinator_options(options);
  coordinator.reactive_delay = state ? state->reactive_delay : script.reactive_delay;
  coordinator.timeouts = state ? state->timeouts : script.timeouts;
  if (state && !script.situation.is_empty()) {
    return complain("script {} has a situation to begin with, but --state-in has one already",
                    quote(script.file));
  }
  if (!can_save_state(options.stream)) return exit_unusable;
  Stream stream(catalog, options, coordinator, state, script.file);
  if (!stream.begin(script.situation)) return exit_unusable;
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
    return complain("--format jsonl runs one script at a time, found {}", missions->size());
  }
  return run_script_of(missions->front().script, *missions->front().catalog, options, {});
}

int run_standard_input(const CompiledCatalog& catalog, const SolveOptions& options,
                       const std::optional<Snapshot>& state) {
  if (!knows_names(catalog, options.explain)) return exit_unusable;
  CoordinatorOptions coordinator = coordinator_options(options);
  if (state) {
    coordinator.reactive_delay = state->reactive_delay;
    coordinator.timeouts = state->timeouts;
  }
  if (!can_save_state(options.stream)) return exit_unusable;
  Stream stream(catalog, options, coordinator, state, display_name("-"));
  if (!stream.begin({})) return exit_unusable;
  stream.run_standard_input();
  return stream.end();
}

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
  if (!is_stream && options.stream.serve) {
    return complain(
        "--serve needs a stream of events: cbc solve CATALOG - --format jsonl --serve; --html FILE "
        "makes a page of a script");
  }
  if (paths.size() == 1) {
    if (!is_stream) return solve_mission(options);
    return complain("a stream of events needs a catalog: cbc solve CATALOG - --format jsonl");
  }
  if (is_folder(paths.back())) {
    return complain("--format jsonl runs one script at a time, and {} is a folder",
                    quote(display_name(paths.back())));
  }
  const auto catalog = load_catalog(paths.front());
  std::optional<Snapshot> state;
  if (catalog == nullptr || !load_state(options.stream, *catalog, state)) return exit_unusable;
  if (is_stream) return run_standard_input(*catalog, options, state);
  const auto script = load_script(paths.back(), *catalog, state);
  return script ? run_script_of(*script, *catalog, options, state) : exit_unusable;
}

}  // namespace cbc::cli
