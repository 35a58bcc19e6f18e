// A log on a catalog, its own or another one: would the robot do in the field what it did? The
// events from outside are run again, and after each event outcomes and running tasks are compared
// with those of the log. A difference stays until it ends, and is told when it begins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/files/file_set.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/report/blocks.h"
#include "core/report/event_json.h"
#include "core/script/event_lines.h"
#include "core/script/log_script.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/state.h"
#include "solve/solve.h"
#include "versions/runs/run_comparison.h"

namespace cbc::cli {
namespace {

class Replay {
 public:
  Replay(const SolveOptions& options, const CompiledCatalog& catalog)
      : options_(options),
        catalog_(catalog),
        name_(display_name(*options.stream.replay)),
        log_(catalog, EventLog::Origin::any),
        answers_(catalog) {
    page_.name = name_;
  }

  /// `state`: which the log continues from.
  int run(std::string_view text, const std::optional<Snapshot>& state) {
    text = utf8::without_byte_order_mark(text);
    const auto header = log_.read_header(take_line(text));
    if (!header) return complain("cannot read {}: {}", quote(name_), log_.error());
    CoordinatorOptions of_coordinator = coordinator_options(options_);
    of_coordinator.reactive_delay = header->reactive_delay;
    of_coordinator.timeouts = header->timeouts;
    EventStream stream(
        catalog_, {}, [this](const EventStream::Line& line) { take(line); }, [](const Failure&) {});
    RunListener* listener = &answers_;
    if (options_.html) listener = &stream;
    Runner runner(catalog_, of_coordinator, *listener,
                  options_.html ? questions_of(options_, catalog_) : Questions());
    if (state) {
      runner.resume(*state);
      events_before_ = state->events;
    } else {
      runner.begin(header->situation);
    }
    const Coordinator& coordinator = runner.coordinator();
    page_.begin = state_of_page(catalog_, events_before_, coordinator.now(), coordinator.state());
    if (const int status = run_steps(text, runner); status != exit_ok) return status;
    if (const int status = report_end(runner, of_coordinator); status != exit_ok) return status;
    fmt::print("{}", report(header->catalog));
    const int status = comparison_.lines().empty() && log_.left_out().empty() ? exit_ok : exit_no;
    return options_.html ? std::max(status, draw()) : status;
  }

 private:
  void take(const EventStream::Line& line) {
    answers_.on_event(line.record, line.step, line.state);
    if (page_.events.size() >= HtmlReport::most_data) {
      ++page_.left_out;
    } else {
      page_.events.append(page_.events.empty() ? "" : ",").append(line.text);
    }
  }
  int draw() const {
    tell_left_out(*options_.html, page_.left_out);
    return write_output(*options_.html, stream_page(catalog_, page_));
  }
  /// Runs each event from outside after comparing what came before it.
  int run_steps(std::string_view text, Runner& runner) {
    for (std::uint32_t number = 2; !text.empty(); ++number) {
      auto entry = log_.read_entry(take_line(text), number);
      if (!entry) return refuse(number, log_.error());
      if (!entry->is_event) continue;
      if (entry->time < last_) return refuse(number, "time goes back");
      last_ = entry->time;
      if (++events_ == 1 && entry->index != events_before_ + 1) {
        return refuse(number, "it continues from another state; see --state-in");
      }
      if (entry->is_from_outside && !wait_for_last(runner)) return exit_ok;
      if (entry->is_from_outside) compare();
      is_last_from_outside_ = entry->is_from_outside;
      logged_.push_back({entry->time, entry->what, entry->outcome,
                         Running(entry->running.begin(), entry->running.end())});
      if (entry->step && !runner.take(*entry->step)) return exit_ok;
    }
    if (wait_for_last(runner) && !is_last_from_outside_) static_cast<void>(runner.settle());
    compare();
    return exit_ok;
  }
  int refuse(std::uint32_t line, const std::string& reason) const {
    return complain("cannot read {}: line {}: {}", quote(name_), line, reason);
  }
  /// Runs what is due before the last event of the log that was read. False: see Runner.
  bool wait_for_last(Runner& runner) const {
    Step wait;
    wait.time = last_;
    wait.expect.emplace();  // no event
    runner.restart_count();
    return runner.take(wait);
  }
  void compare() { comparison_.compare(std::exchange(logged_, {}), answers_.take()); }

  [[nodiscard]] std::string report(const std::string& old_catalog) const {
    constexpr std::size_t most_left_out = 10;
    const Style style = style_for(stdout);
    Text text(style);
    text.line("{}: {} of {}",
              style.paint(style.strong,
                          fmt::format("{} against {}", printable(catalog_.file), printable(name_))),
              quantity(events_, "event"), printable(old_catalog));
    const std::vector<std::string>& left_out = log_.left_out();
    if (!left_out.empty()) {
      text.line("  {}", style.paint(style.warning, "left out"));
      text.list(left_out, most_left_out, "    ");
    }
    const std::vector<RunComparison::Line>& lines = comparison_.lines();
    if (lines.empty()) {
      text.line("  {}", style.paint(style.good, "all was decided alike"));
      return text.take();
    }
    text.line("");
    Table table(style, {number_column("time [s]", 10, 0), {"event", {}, 26}, {"in the replay"}});
    const RunComparison::Line* before = nullptr;
    for (const RunComparison::Line& line : lines) {
      const bool is_same =
          before != nullptr && before->time == line.time && before->event == line.event;
      table.add({is_same ? "" : format_time(line.time), is_same ? "" : line.event, line.what});
      before = &line;
    }
    text.table(table);
    text.line("");
    text.painted(style.bad, "{} of {} decided differently", comparison_.events(),
                 quantity(events_, "event"));
    return text.take();
  }

  const SolveOptions& options_;
  const CompiledCatalog& catalog_;
  const std::string name_;
  EventLog log_;
  AnswerCollector answers_;
  StreamOfPage page_;  ///< of the replay, if there is to be one
  RunComparison comparison_;
  std::vector<RunAnswer> logged_;  ///< since the last event from outside, and of that
  Microseconds last_ = 0;
  bool is_last_from_outside_ = true;
  std::uint64_t events_before_ = 0;  ///< in the state
  std::uint64_t events_ = 0;
};

/// Writes the events of the log as a script.
int write_as_script(const SolveOptions& options, const CompiledCatalog& catalog,
                    std::string_view log) {
  std::string error;
  auto script = read_log(log, catalog, error);
  if (!script) {
    return complain("cannot read {}: {}", quote(display_name(*options.stream.replay)), error);
  }
  const std::filesystem::path file = *options.stream.to_script;
  script->catalog = path_in_script(options.paths.front(), (file.parent_path() / ".").string());
  return write_output(file.string(), write_script(catalog, *script, {}));
}

}  // namespace

int replay(const SolveOptions& options) {
  if (options.paths.size() != 1) {
    return complain("--replay needs a log and its catalog: cbc solve --replay LOG CATALOG");
  }
  FileSet files;
  const auto catalog = files.load(options.paths.front());
  files.print_findings();
  if (catalog == nullptr) return exit_unusable;
  std::optional<Snapshot> state;
  if (!load_state(options.stream, *catalog->compiled, state)) return exit_unusable;
  const auto log = read_input(*options.stream.replay);
  if (!log) return exit_unusable;
  const int status = Replay(options, *catalog->compiled).run(*log, state);
  if (status == exit_unusable || !options.stream.to_script) return status;
  return std::max(status, write_as_script(options, *catalog->compiled, *log));
}

}  // namespace cbc::cli
