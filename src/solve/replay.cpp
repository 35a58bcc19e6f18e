// A log on a catalog, its own or another one: would the robot do in the field what it did? The
// events from outside are run again, and after each event outcomes and running tasks are compared
// with those of the log. A difference stays until it ends, and is told when it begins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "core/files/file_set.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/report/table.h"
#include "core/script/event_lines.h"
#include "core/script/log_script.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/support/wording.h"
#include "core/words/layout.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/state.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

using LogLine = nlohmann::json;

/// Running tasks with their behaviors, by name.
using Running = std::map<std::string, std::string>;

/// What one event led to.
struct Answer {
  Microseconds time = 0;
  std::uint64_t index = 0;  ///< of the event; in the log or in the run
  std::string what;         ///< "start LAND"
  std::string outcome;      ///< of a start, stop or finish from outside
  Running running;
};

/// An event of the log, and what came of it.
struct LoggedEvent {
  Answer answer;
  bool is_from_outside = false;
  std::optional<Step> step;  ///< empty if it is left out
};

/// The text of a member; empty if there is none.
std::string text_in(const LogLine& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Reads a log that was made with any catalog, as events for another one.
class ForeignLog {
 public:
  /// The catalog must outlive it.
  explicit ForeignLog(const CompiledCatalog& catalog) : catalog_(catalog), log_(catalog) {}

  [[nodiscard]] std::optional<EventLog::Header> read_header(std::string_view line) {
    LogLine json = parse(line);
    if (json.contains("digest")) json["digest"] = to_hex(identity_of(catalog_));
    leave_out_unknown(json, 1);
    return log_.read_header(json.dump());
  }
  /// Empty if the line cannot be read: see error(). No event: it answers a line that was none.
  [[nodiscard]] bool read(std::string_view line, std::uint32_t number,
                          std::optional<LoggedEvent>& event) {
    event.reset();
    LogLine json = parse(line);
    const std::string unknown = find_unknown(json);
    LoggedEvent found;
    LogLine known = json;
    if (!unknown.empty()) {
      left_out_.push_back(fmt::format("line {}: {}", number, unknown));
      known["origin"] = "situation";  // nothing from outside
    } else if (text_in(json, "verb") == "situation") {
      leave_out_unknown(known, number);
    }
    auto entry = log_.read_entry(known.dump(), number);
    if (!entry) return false;
    if (!entry->is_event) return true;
    found.is_from_outside = text_in(json, "origin") == "script";
    found.step = std::move(entry->step);
    found.answer = answer_in(json, *entry);
    event = std::move(found);
    return true;
  }
  [[nodiscard]] const std::string& error() const { return log_.error(); }
  /// What the catalog lacks, each in words.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  /// What is no JSON becomes a text, which the log refuses.
  static LogLine parse(std::string_view line) {
    LogLine json = LogLine::parse(line, nullptr, false);
    return json.is_discarded() ? LogLine(std::string(line)) : json;
  }
  [[nodiscard]] static Answer answer_in(const LogLine& json, const EventLog::Entry& entry) {
    Answer answer{entry.time, entry.index, {}, {}, {}};
    const auto verb = find_word<Verb>(text_in(json, "verb"));
    const std::string name = text_in(json, "name");
    answer.what = text_in(json, "verb") + (name.empty() ? "" : " " + printable(name));
    const bool is_decided = verb && form_of(*verb).is_decided;
    if (is_decided && text_in(json, "origin") == "script")
      answer.outcome = text_in(json, "outcome");
    if (const auto running = json.find("running"); running != json.end() && running->is_object()) {
      for (const auto& [task, behavior] : running->items()) {
        if (behavior.is_string()) answer.running[task] = behavior.get<std::string>();
      }
    }
    return answer;
  }
  /// Why the catalog cannot have this event; empty if it can.
  [[nodiscard]] std::string find_unknown(const LogLine& json) const {
    const auto verb = find_word<Verb>(text_in(json, "verb"));
    if (!verb || text_in(json, "origin") != "script") return {};
    const auto lacks = [&](std::string_view kind, const std::string& name) {
      return fmt::format("{} has no {} {}", quote(catalog_.file), kind, quote(name));
    };
    const VerbForm& form = form_of(*verb);
    const std::string task =
        form.subject == VerbForm::SubjectKind::task ? text_in(json, "name") : text_in(json, "task");
    if (!task.empty() && !catalog_.find_task(task)) return lacks("task", task);
    const std::string behavior =
        form.subject == VerbForm::SubjectKind::behavior ? text_in(json, "name") : std::string();
    if (!behavior.empty() && !catalog_.find_behavior(behavior)) return lacks("behavior", behavior);
    return {};
  }
  /// Takes what the catalog lacks out of a situation.
  void leave_out_unknown(LogLine& json, std::uint32_t number) {
    const auto situation = json.find("situation");
    if (situation == json.end() || !situation->is_object()) return;
    LogLine known = LogLine::object();
    for (const auto& [key, value] : situation->items()) {
      if (is_known(key, value)) {
        known[key] = value;
      } else {
        left_out_.push_back(fmt::format("line {}: {} has no situation {}: {}", number,
                                        quote(catalog_.file), printable(key), value.dump()));
      }
    }
    *situation = std::move(known);
  }
  [[nodiscard]] bool is_known(const std::string& key, const LogLine& value) const {
    const auto variable = catalog_.find_variable(key);
    if (!variable) return catalog_.find_behavior(key).has_value();
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    return catalog_.find_value(*variable, text).has_value();
  }

  const CompiledCatalog& catalog_;
  EventLog log_;
  std::vector<std::string> left_out_;
};

/// The answers of the new catalog, until they are taken.
class Answers final : public RunListener {
 public:
  explicit Answers(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    Answer& answer = answers_.emplace_back();
    answer.time = record.time;
    answer.index = record.index;
    answer.what = name_of(record.verb);
    if (record.task != none) {
      answer.what += " " + printable(catalog_.name_of_task(record.task));
    } else if (record.behavior != none) {
      answer.what += " " + printable(catalog_.name_of_behavior(record.behavior));
    }
    if (step != nullptr && form_of(record.verb).is_decided)
      answer.outcome = name_of(record.outcome);
    for (const std::uint32_t task : state.running()) {
      answer.running[std::string(catalog_.task_names[task])] =
          catalog_.name_of_behavior(state.behavior(catalog_.task_ids[task]));
    }
  }
  [[nodiscard]] std::vector<Answer> take() { return std::exchange(answers_, {}); }

 private:
  const CompiledCatalog& catalog_;
  std::vector<Answer> answers_;
};

/// Compares what both did between two events from outside, and tells where a difference begins.
class LogComparison {
 public:
  struct Line {
    Microseconds time = 0;
    std::string event;
    std::string what;
    bool is_end = false;  ///< of differences
  };

  void compare(const std::vector<Answer>& logged, const std::vector<Answer>& found) {
    compare_outcomes(logged, found);
    std::vector<Microseconds> times;
    for (const auto* const answers : {&logged, &found}) {
      for (const Answer& answer : *answers) times.push_back(answer.time);
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    for (const Microseconds time : times) {
      const Answer* const left = move_to(time, logged, logged_);
      const Answer* const right = move_to(time, found, found_);
      compare_running(time, right != nullptr ? right : left);
    }
  }
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  /// How many events begin a difference.
  [[nodiscard]] std::size_t events() const {
    std::size_t count = 0;
    const Line* before = nullptr;
    for (const Line& line : lines_) {
      if (line.is_end) continue;
      if (before == nullptr || before->time != line.time || before->event != line.event) ++count;
      before = &line;
    }
    return count;
  }

 private:
  /// Takes over what runs after the last answer up to this time. The answer at this time, or null.
  static const Answer* move_to(Microseconds time, const std::vector<Answer>& answers,
                               Running& running) {
    const Answer* last = nullptr;
    for (const Answer& answer : answers) {
      if (answer.time <= time) last = &answer;
    }
    if (last != nullptr) running = last->running;
    return last != nullptr && last->time == time ? last : nullptr;
  }
  void compare_outcomes(const std::vector<Answer>& logged, const std::vector<Answer>& found) {
    if (logged.empty() || found.empty()) return;
    const Answer& left = logged.front();
    const Answer& right = found.front();
    if (left.outcome.empty() || right.outcome.empty() || left.outcome == right.outcome) return;
    lines_.push_back({left.time, left.what, in_place_of(right.outcome, left.outcome)});
  }
  void compare_running(Microseconds time, const Answer* event) {
    std::map<std::string, std::string> differences;  // by task
    for (const auto& [task, behavior] : logged_) {
      const auto other = found_.find(task);
      const std::string now = other == found_.end() ? "" : other->second;
      if (now != behavior) differences[task] = in_place_of(now, behavior);
    }
    for (const auto& [task, behavior] : found_) {
      if (!logged_.contains(task)) differences[task] = in_place_of(behavior, "");
    }
    const std::string what = event != nullptr ? event->what : "";
    for (const auto& [task, words] : differences) {
      const auto known = differences_.find(task);
      if (known != differences_.end() && known->second == words) continue;
      lines_.push_back({time, what, fmt::format("{}: {}", printable(task), words)});
    }
    std::vector<std::string> alike;
    for (const auto& [task, words] : differences_) {
      if (!differences.contains(task)) alike.push_back(printable(task));
    }
    if (!alike.empty())
      lines_.push_back({time, what, "as in the log again: " + join(alike, ", "), true});
    differences_ = std::move(differences);
  }

  Running logged_;
  Running found_;
  std::map<std::string, std::string> differences_;
  std::vector<Line> lines_;
};

class Replay {
 public:
  Replay(const SolveOptions& options, const CompiledCatalog& catalog)
      : options_(options),
        catalog_(catalog),
        name_(display_name(*options.stream.replay)),
        log_(catalog),
        answers_(catalog) {}

  /// `state`: which the log continues from.
  int run(std::string_view text, const std::optional<Snapshot>& state) {
    text = utf8::without_byte_order_mark(text);
    const auto header = log_.read_header(take_line(text));
    if (!header) return complain("cannot read {}: {}", quote(name_), log_.error());
    CoordinatorOptions of_coordinator = coordinator_options(options_, catalog_);
    of_coordinator.reactive_delay = header->reactive_delay;
    of_coordinator.timeouts = header->timeouts;
    Runner runner(catalog_, of_coordinator, answers_);
    if (state) {
      runner.resume(*state);
      events_before_ = state->events;
    } else {
      runner.begin(header->situation);
    }
    if (const int status = run_steps(text, runner); status != exit_ok) return status;
    if (const int status = report_end(runner, of_coordinator); status != exit_ok) return status;
    fmt::print("{}", report(header->catalog));
    return comparison_.lines().empty() && log_.left_out().empty() ? exit_ok : exit_no;
  }

 private:
  /// Runs each event from outside after comparing what came before it.
  int run_steps(std::string_view text, Runner& runner) {
    for (std::uint32_t number = 2; !text.empty(); ++number) {
      std::optional<LoggedEvent> event;
      if (!log_.read(take_line(text), number, event)) {
        return complain("cannot read {}: line {}: {}", quote(name_), number, log_.error());
      }
      if (!event) continue;
      if (event->answer.time < last_) {
        return complain("cannot read {}: line {}: time goes back", quote(name_), number);
      }
      last_ = event->answer.time;
      if (++events_ == 1 && event->answer.index != events_before_ + 1) {
        return complain("cannot read {}: line {}: it continues from another state; see --state-in",
                        quote(name_), number);
      }
      if (event->is_from_outside && !wait_for_last(runner)) return exit_ok;
      if (event->is_from_outside) compare();
      is_last_from_outside_ = event->is_from_outside;
      logged_.push_back(std::move(event->answer));
      if (event->step && !runner.take(*event->step)) return exit_ok;
    }
    if (wait_for_last(runner) && !is_last_from_outside_) static_cast<void>(runner.settle());
    compare();
    return exit_ok;
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
      for (std::size_t place = 0; place < std::min(left_out.size(), most_left_out); ++place) {
        text.line("    {}", left_out[place]);
      }
      if (left_out.size() > most_left_out) {
        text.line("    and {} more", left_out.size() - most_left_out);
      }
    }
    const std::vector<LogComparison::Line>& lines = comparison_.lines();
    if (lines.empty()) {
      text.line("  {}", style.paint(style.good, "all was decided alike"));
      return text.take();
    }
    text.line("");
    Table table(style, {number_column("time [s]", 10, 0), {"event", {}, 26}, {"in the replay"}});
    const LogComparison::Line* before = nullptr;
    for (const LogComparison::Line& line : lines) {
      const bool is_same =
          before != nullptr && before->time == line.time && before->event == line.event;
      table.add({is_same ? "" : format_time(line.time), is_same ? "" : line.event, line.what});
      before = &line;
    }
    text.add(table.text());
    text.line("");
    text.painted(style.bad, "{} of {} decided differently", comparison_.events(),
                 quantity(events_, "event"));
    return text.take();
  }

  const SolveOptions& options_;
  const CompiledCatalog& catalog_;
  const std::string name_;
  ForeignLog log_;
  Answers answers_;
  LogComparison comparison_;
  std::vector<Answer> logged_;  ///< since the last event from outside, and of that
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
