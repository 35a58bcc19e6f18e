#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/catalog_loader.h"
#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/line_input.h"
#include "cli/line_output.h"
#include "cli/solve_stream.h"
#include "cli/stream_start.h"
#include "report/event_stream.h"
#include "script/event_log.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// An event line names all that runs.
constexpr std::size_t longest_line = std::size_t{64} << 20;

/// The names of the members that differ, "'running', 'changes'".
std::string find_differences(std::string_view logged, std::string_view found) {
  using Json = nlohmann::ordered_json;
  const Json left = Json::parse(logged, nullptr, false);
  const Json right = Json::parse(found, nullptr, false);
  std::string names;
  const auto add = [&names](const std::string& name) {
    names += (names.empty() ? "" : ", ") + quote(name);
  };
  if (!left.is_object() || !right.is_object()) return "the form of the line";
  for (const auto& [name, value] : left.items()) {
    const auto other = right.find(name);
    if (other == right.end() || *other != value) add(name);
  }
  for (const auto& [name, value] : right.items()) {
    if (!left.contains(name)) add(name);
  }
  return names.empty() ? "the order or the spelling of the line" : names;
}

class Replay {
 public:
  Replay(int descriptor, std::string name, CompiledCatalog catalog, const SolveOptions& options)
      : name_(std::move(name)),
        catalog_(std::move(catalog)),
        options_(options),
        input_(descriptor, -1, longest_line),
        log_(catalog_) {}

  int run(const std::optional<Snapshot>& state) {
    CoordinatorOptions of_coordinator = coordinator_options(options_, catalog_);
    const auto header = read_header();
    if (!header) return exit_unusable;
    of_coordinator.reactive_delay = header->reactive_delay;
    catalog_.file = header->catalog;  // some messages name it
    if (state && state->reactive_delay != header->reactive_delay) {
      return refuse("its reactive delay is not that of the state");
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
    if (!is_over()) status_ = report_end(runner, of_coordinator);
    if (!is_over()) look_for_rest();
    if (!is_over() && !save_state(options_.stream, catalog_, runner)) status_ = exit_unusable;
    return output_.has_failed() ? std::max<int>(status_, exit_unusable) : status_;
  }

 private:
  struct Line {
    std::string text;
    std::uint64_t number = 0;
    EventLog::Entry entry;
  };

  [[nodiscard]] std::optional<EventLog::Header> read_header() {
    if (input_.next() != LineInput::Status::line) {
      refuse("it has no header");
      return std::nullopt;
    }
    auto header = log_.read_header(input_.line());
    if (!header) {
      refuse(log_.error());
      return std::nullopt;
    }
    std::string text =
        stream_header(catalog_, header->catalog, header->reactive_delay, header->situation);
    output_.write(text);
    text.pop_back();
    if (text != input_.line()) {
      tell_difference(1, std::string(input_.line()), text, "the header differs");
    }
    return header;
  }

  /// Each scripted event, when the lines up to it are read.
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

  /// What came by the clock after the last scripted event: up to an expectation, which is in no
  /// log, or to the last instant.
  void run_to_end(Runner& runner) {
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

  /// Adds the next line of the log to what is expected.
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

  /// Takes a line that the run has made.
  void compare(std::string_view line) {
    if (is_over()) return;
    pass_answers();
    // Events that follow a scripted one at once are not read yet.
    while (expected_.empty() && read_line()) pass_answers();
    if (is_over()) return;
    output_.write(line);
    line.remove_suffix(1);
    if (expected_.empty()) {
      tell_difference(input_.number() + 1, "", std::string(line),
                      is_at_end_ ? "the log ends here, before what is due at its last instant; "
                                   "a log made with --state-out is replayed with it"
                                 : "the log ends here");
    } else if (expected_.front().text != line) {
      std::string names = find_differences(expected_.front().text, line);
      if (!options_.stream.state_in && names.starts_with("'index'")) {
        names += "; a log that goes on from a state is replayed with --state-in";
      }
      tell_difference(expected_.front().number, expected_.front().text, std::string(line),
                      "they differ in " + names);
    } else {
      expected_.pop_front();
    }
  }

  /// All of the log must have come again.
  void look_for_rest() {
    pass_answers();
    if (expected_.empty()) return;
    tell_difference(expected_.front().number, expected_.front().text, "", "the replay ends here");
  }

  /// Answers to lines that were no events cannot be made again.
  void pass_answers() {
    while (!expected_.empty() && !expected_.front().entry.is_event) {
      output_.write(expected_.front().text + "\n");
      expected_.pop_front();
    }
  }

  [[nodiscard]] bool is_over() const { return status_ != exit_ok || output_.has_failed(); }

  int refuse(const std::string& reason) {
    complain(fmt::format("cannot replay {}: {}", quote(name_), reason));
    return status_ = exit_unusable;
  }

  void tell_difference(std::uint64_t number, const std::string& logged, const std::string& found,
                       const std::string& what) {
    std::string message =
        fmt::format("{}:{}: the first difference: {}", printable(name_), number, what);
    if (!logged.empty()) message += "\n  log:    " + printable(logged);
    if (!found.empty()) message += "\n  replay: " + printable(found);
    complain(message);
    status_ = exit_no;
  }

  const std::string name_;
  CompiledCatalog catalog_;
  const SolveOptions& options_;
  LineInput input_;
  LineOutput output_;
  EventLog log_;
  std::deque<Line> expected_;  ///< lines of the log that no event was compared with yet
  bool is_at_end_ = false;     ///< of the log
  int status_ = exit_ok;
};

}  // namespace

int replay_stream(const SolveOptions& options) {
  if (options.paths.size() != 1) {
    complain("--replay needs a log and its catalog: cbc solve --replay LOG CATALOG");
    return exit_unusable;
  }
  if (!can_use_files(options)) return exit_unusable;
  const std::string& path = *options.stream.replay;
  const auto catalog = load_catalog(options.paths.front());
  std::optional<Snapshot> state;
  if (catalog == nullptr || !load_state(options.stream, *catalog, state) ||
      !knows_names(*catalog, options.explain)) {
    return exit_unusable;
  }
  const int file = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    complain(fmt::format("cannot read {}: {}", quote(path), std::strerror(errno)));
    return exit_unusable;
  }
  const int status = Replay(file, display_name(path), *catalog, options).run(state);
  if (file != STDIN_FILENO) ::close(file);
  return status;
}

}  // namespace cbc::cli
