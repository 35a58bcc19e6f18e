#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "core/files/file_set.h"
#include "core/files/line_input.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/report/event_json.h"
#include "core/script/event_lines.h"
#include "core/script/runner.h"
#include "core/support/wording.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// Event lines name all running tasks, so they may be long.
constexpr std::size_t longest_line = std::size_t{64} << 20;

/// Whether events have a member only if an option asks for it.
bool is_addition(std::string_view name) { return name == "why" || name == "alternatives"; }

using Json = nlohmann::ordered_json;

/// The stopped tasks as logs of 0.1.0 have them: "interrupted" for all that did not finish, and no
/// reasons.
Json without_causes(Json stopped_tasks) {
  for (Json& stopped : stopped_tasks) {
    const auto cause = find_word<ChangeCause>(stopped.value("cause", ""));
    if (cause) stopped["cause"] = name_of(FinishCause::interrupted);
    stopped.erase("conflict");
    stopped.erase("message");
  }
  return stopped_tasks;
}

/// Longer lists say what differs in them.
constexpr std::size_t most_items = 8;

/// The items of a list, or the entries of an object.
std::vector<std::string> items_of(const Json& container) {
  std::vector<std::string> items;
  for (const auto& [key, value] : container.items()) {
    const std::string item =
        container.is_object() ? fmt::format("{}: {}", key, value.dump()) : value.dump();
    items.push_back(printable(item));
  }
  return items;
}

/// "  running: missing: …; not expected: …": how a long list or object differs, or nothing.
std::string describe_difference(const std::string& name, const Json& logged, const Json& found) {
  if (!logged.is_structured() || !found.is_structured()) return {};
  if (logged.size() + found.size() <= most_items) return {};
  std::vector<std::string> missing = items_of(logged);
  std::vector<std::string> surplus = items_of(found);
  for (auto item = missing.begin(); item != missing.end();) {
    const auto same = std::find(surplus.begin(), surplus.end(), *item);
    if (same == surplus.end()) {
      ++item;
      continue;
    }
    surplus.erase(same);
    item = missing.erase(item);
  }
  if (missing.empty() && surplus.empty()) return fmt::format("\n  {}: in another order", name);
  std::string text = fmt::format("\n  {}:", name);
  if (!missing.empty()) text += " missing: " + join(missing, ", ");
  if (!surplus.empty()) {
    text += fmt::format("{} not expected: {}", missing.empty() ? "" : ";", join(surplus, ", "));
  }
  return text;
}

struct Differences {
  std::string names;    ///< of the members that differ: "'running', 'changes'"
  std::string details;  ///< lines about long ones
};

/// Empty if the lines differ only in what an option of one of the two runs adds, or this version.
Differences find_differences(std::string_view logged, std::string_view found) {
  const Json left = Json::parse(logged, nullptr, false);
  const Json right = Json::parse(found, nullptr, false);
  if (!left.is_object() || !right.is_object()) return {"the form of the line", {}};
  std::vector<std::string> names;
  std::string details;
  bool has_additions = false;
  const auto add_missing = [&](const std::string& name) {
    if (is_addition(name)) {
      has_additions = true;
    } else {
      names.push_back(quote(name));
    }
  };
  for (const auto& [name, value] : left.items()) {
    if (!right.contains(name)) {
      add_missing(name);
    } else if (name == "stopped_tasks" && value != right[name] &&
               value == without_causes(right[name])) {
      has_additions = true;
    } else if (right[name] != value) {
      names.push_back(quote(name));
      details += describe_difference(name, value, right[name]);
    }
  }
  for (const auto& [name, value] : right.items()) {
    if (!left.contains(name)) add_missing(name);
  }
  if (names.empty() && has_additions) return {};
  if (names.empty()) return {"the order or the spelling of the line", {}};
  return {join(names, ", "), details};
}

class StreamReplay {
 public:
  StreamReplay(int descriptor, std::string name, CompiledCatalog catalog,
               const SolveOptions& options)
      : name_(std::move(name)),
        catalog_(std::move(catalog)),
        options_(options),
        is_silent_(options.format != "jsonl"),
        input_(descriptor, -1, longest_line, [this] { output_.flush(); }),
        log_(catalog_) {}

  int run(const std::optional<Snapshot>& state) {
    CoordinatorOptions of_coordinator = coordinator_options(options_);
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
        catalog_, is_silent_ ? EventAdditions() : event_additions(options_),
        [this](const EventStream::Line& line) { compare(line.text); }, [](const Failure&) {});
    Runner runner(catalog_, of_coordinator, events, questions_of(options_, catalog_));
    if (state) {
      runner.resume(*state);
    } else {
      runner.begin(header->situation);
    }
    const Coordinator& coordinator = runner.coordinator();
    const std::string begin =
        state_of_page(catalog_, state ? state->events : 0, coordinator.now(), coordinator.state());
    run_steps(runner);
    if (!is_over() && runner.result().status == Coordinator::Status::ok) run_to_end(runner);
    output_.flush();
    if (!is_over()) look_for_rest();
    output_.flush();
    if (!is_over()) {
      status_ = report_end(runner, of_coordinator);
      if (!save_state(options_.stream, catalog_, runner)) status_ = exit_unusable;
    }
    if (options_.html && !is_silent_) draw(begin);
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
    if (const auto status = input_.next(); status != LineInput::Status::line) {
      refuse(status == LineInput::Status::failed ? input_.error() : "it has no header");
      return std::nullopt;
    }
    const std::string_view line = utf8::without_byte_order_mark(input_.line());
    auto header = log_.read_header(line);
    if (!header) {
      refuse(log_.error());
      return std::nullopt;
    }
    of_coordinator.reactive_delay = header->reactive_delay;
    of_coordinator.timeouts = header->timeouts;
    State first(catalog_);
    first.change_situation(header->situation.availability, header->situation.variables);
    std::string text = stream_header(catalog_, header->catalog, of_coordinator, header->situation,
                                     state ? state->variables : first.variables(), header->clock);
    write(text);
    text.pop_back();
    if (text != line) {
      tell_difference(1, std::string(line), text, "the header differs");
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
    write(line);
    line.remove_suffix(1);
    if (options_.html && !is_silent_) add_to_page(line);
    if (expected_.empty()) {
      tell_difference(input_.number() + 1, "", std::string(line),
                      is_at_end_ ? "the log ends here, before the events due at its last "
                                   "instant; replay a log made with --state-out with the same "
                                   "option"
                                 : "the log ends here");
    } else if (expected_.front().text != line) {
      auto [names, details] = find_differences(expected_.front().text, line);
      if (names.empty()) {
        expected_.pop_front();
        return;
      }
      if (!options_.stream.state_in && names.starts_with("'index'")) {
        names += "; replay a log that continues from a saved state with --state-in";
      }
      tell_difference(expected_.front().number, expected_.front().text, std::string(line),
                      "they differ in " + names, details);
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
      write(expected_.front().text + "\n");
      expected_.pop_front();
    }
  }

  void write(std::string_view line) {
    if (!is_silent_) output_.write(line);
  }

  void add_to_page(std::string_view event) {
    if (events_.size() >= HtmlReport::most_data) {
      ++left_out_;
      return;
    }
    events_.append(events_.empty() ? "" : ",").append(event);
  }

  /// The page of what was run, which is the log, or its beginning.
  void draw(const std::string& begin) {
    const std::string page = stream_page(catalog_, {name_, begin, events_, left_out_, end_, ""});
    status_ = std::max(status_, write_output(*options_.html, page));
    tell_left_out(*options_.html, left_out_);
  }

  [[nodiscard]] bool is_over() const { return status_ != exit_ok || output_.has_failed(); }

  int refuse(const std::string& reason) {
    output_.flush();
    complain("cannot replay {}: {}", quote(name_), reason);
    end_ = reason;
    return status_ = exit_unusable;
  }

  void tell_difference(std::uint64_t number, const std::string& logged, const std::string& found,
                       const std::string& what, const std::string& details = {}) {
    end_ = fmt::format("the replay differs from line {} of the log: {}", number, what);
    std::string message =
        fmt::format("{}:{}: the first difference: {}", printable(name_), number, what) + details;
    if (!logged.empty()) message += "\n  log:    " + printable(logged);
    if (!found.empty()) message += "\n  replay: " + printable(found);
    output_.flush();
    complain(message);
    status_ = exit_no;
  }

  const std::string name_;
  CompiledCatalog catalog_;
  const SolveOptions& options_;
  const bool is_silent_;  ///< nothing but a difference is written
  LineInput input_;
  LineOutput output_;
  EventLog log_;
  std::deque<Line> expected_;   ///< lines of the log that are not compared yet
  bool is_at_end_ = false;      ///< of the log
  std::string events_;          ///< for the page of --html
  std::uint64_t left_out_ = 0;  ///< events that are not on the page
  std::string end_;             ///< why the replay ended early, or empty
  int status_ = exit_ok;
};

}  // namespace

int replay_stream(const SolveOptions& options, const CompiledCatalog& catalog) {
  const std::string& path = *options.stream.replay;
  std::optional<Snapshot> state;
  if (!load_state(options.stream, catalog, state) || !knows_names(catalog, options.explain)) {
    return exit_unusable;
  }
  if (const auto refusal = find_refusal(path)) {
    return complain("cannot read {}: {}", quote(path), *refusal);
  }
  const int file = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return complain("cannot read {}: {}", quote(path), std::strerror(errno));
  }
  note_read(path);
  if (!can_save_state(options.stream)) return exit_unusable;
  const int status = StreamReplay(file, display_name(path), catalog, options).run(state);
  if (file != STDIN_FILENO) ::close(file);
  return status;
}

}  // namespace cbc::cli
