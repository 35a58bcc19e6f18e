#include "cli/solve_stream.h"

#include <algorithm>
#include <memory>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "cli/catalog_loader.h"
#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/input_files.h"
#include "cli/line_input.h"
#include "cli/line_output.h"
#include "cli/mission.h"
#include "cli/stop_signals.h"
#include "cli/stream_start.h"
#include "report/event_stream.h"
#include "script/event_lines.h"
#include "script/reader.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// Longer lines are refused, so that no input can eat the memory of the machine.
constexpr std::size_t longest_event = std::size_t{1} << 20;
/// More warnings about a stream would only hide what else is said.
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
        runner_(catalog, of_coordinator, events_) {}

  void begin(std::span<const Availability> situation) {
    output_.write(
        stream_header(catalog_, catalog_.file, of_coordinator_.reactive_delay, situation));
    if (state_) {
      runner_.resume(*state_);
    } else {
      runner_.begin(situation);
    }
  }

  void run(const Script& script) {
    begin(script.situation);
    for (const Step& step : script.steps) {
      if (signals_.have_come() || output_.has_failed() || !runner_.take(step)) return;
    }
  }

  void run_standard_input() {
    begin({});
    LineInput input(STDIN_FILENO, signals_.descriptor(), longest_event);
    EventLines lines(catalog_);
    lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    while (!signals_.have_come() && !output_.has_failed()) {
      switch (input.next()) {
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

  /// What is due at the last instant still comes with a continued mission, if there is one.
  int end() {
    const bool goes_on = runner_.result().status == Coordinator::Status::ok;
    if (goes_on && !options_.stream.state_out && !output_.has_failed()) {
      static_cast<void>(runner_.settle());
    }
    status_ = std::max(status_, report_end(runner_, of_coordinator_));
    if (const auto& totals = runner_.result().totals) output_.write(stream_totals(*totals));
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
      if (warnings_ == most_warnings) complain("further warnings are not shown");
    }
    if (!reading.error.empty()) {
      refuse(reading.error, number);
      lines.resume(runner_.coordinator().now(), runner_.coordinator().state());
    }
    if (!reading.step) return true;
    // A stream has no length that its clock events could be compared with; a line has.
    runner_.restart_count();
    return runner_.take(*reading.step);
  }

  void refuse(const std::string& error, std::uint64_t number) {
    output_.write(stream_error(error, number));
    status_ = exit_unusable;
  }

  void complain_of_line(std::uint64_t number, const std::string& message) const {
    complain(fmt::format("{}:{}: {}", printable(script_), number, message));
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
  int status_ = exit_ok;
  int warnings_ = 0;
};

std::optional<Script> load_script(const std::string& path, const CompiledCatalog& catalog,
                                  const std::optional<Snapshot>& state) {
  InputFiles files;
  std::optional<Script> script;
  const std::optional<InputFile> file = files.read(path);
  if (file && file->document == nullptr) {
    complain(fmt::format("{} is a catalog; expected a script here", quote(display_name(path))));
  } else if (file) {
    Diagnostics diagnostics;
    script = read_script(*file->document, catalog, Severity::warning, diagnostics,
                         state ? &*state : nullptr);
    if (!files.take_findings(path, *file->document, std::move(diagnostics))) script.reset();
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
  if (state && !script.situation.empty()) {
    complain(fmt::format("script {} has a situation to begin with, but --state-in has one already",
                         quote(script.file)));
    return exit_unusable;
  }
  Stream stream(catalog, options, coordinator, state, script.file);
  stream.run(script);
  return stream.end();
}

/// A script that names its catalog.
int solve_mission(const SolveOptions& options) {
  if (options.stream.state_in) {
    complain("--state-in needs a catalog and a script: cbc solve CATALOG SCRIPT");
    return exit_unusable;
  }
  const auto missions = MissionLoader().load(options.paths);
  if (!missions) return exit_unusable;
  if (missions->size() != 1) {
    complain("--format jsonl runs one script at a time");
    return exit_unusable;
  }
  return run_script_of(missions->front().script, *missions->front().catalog, options, {});
}

int run_standard_input(const CompiledCatalog& catalog, const SolveOptions& options,
                       const std::optional<Snapshot>& state) {
  if (!knows_names(catalog, options.explain)) return exit_unusable;
  CoordinatorOptions coordinator = coordinator_options(options, catalog);
  if (state) coordinator.reactive_delay = state->reactive_delay;
  Stream stream(catalog, options, coordinator, state, display_name("-"));
  stream.run_standard_input();
  return stream.end();
}

}  // namespace

int solve_stream(const SolveOptions& options) {
  const std::vector<std::string>& paths = options.paths;
  if (!can_use_files(options)) return exit_unusable;
  if (paths.size() > 2) {
    complain("--format jsonl runs one script at a time: cbc solve CATALOG SCRIPT");
    return exit_unusable;
  }
  const bool is_stream = paths.back() == "-";
  if (paths.size() == 1) {
    if (!is_stream) return solve_mission(options);
    complain("a stream of events needs a catalog: cbc solve CATALOG - --format jsonl");
    return exit_unusable;
  }
  const auto catalog = load_catalog(paths.front());
  std::optional<Snapshot> state;
  if (catalog == nullptr || !load_state(options.stream, *catalog, state)) return exit_unusable;
  if (is_stream) return run_standard_input(*catalog, options, state);
  const auto script = load_script(paths.back(), *catalog, state);
  return script ? run_script_of(*script, *catalog, options, state) : exit_unusable;
}

}  // namespace cbc::cli
