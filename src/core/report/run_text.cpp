#include "core/report/run_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/search_stats.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/reason_words.h"
#include "core/words/suitability.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

constexpr const char* text_indent = "           ";

std::size_t column_width(const Texts& names, std::size_t least) {
  constexpr std::size_t widest = 48;
  std::size_t width = least;
  for (const std::string_view name : names) width = std::max(width, width_of(printable(name)));
  return std::min(width, widest);
}

/// The columns of the changes; their continuation stands below the behavior.
Table changes_table(const CompiledCatalog& catalog, const Style& style, std::size_t columns) {
  constexpr std::size_t column_of_behavior = 3;
  return Table(style,
               {number_column("priority", 8, 4),
                {{}, {}, 1, 1},  // the sign needs no name
                {"ok", {}, 2, 1},
                {"behavior", {}, column_width(catalog.behavior_names, 8), 1},
                {"task", {}, column_width(catalog.task_names, 4)},
                {"cause"}},
               {.columns = columns, .column = column_of_behavior});
}

}  // namespace

void TextReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  explanation_.begin_run(catalog, script);
  summary_.begin_run(catalog, script);
  script_file_ = printable(script.file);
  changes_.emplace(changes_table(catalog, style_, layout_.columns));
  if (runs_ > 0) text_.line("");
  text_.add(fmt::format("{} with {}\n\n", style_.paint(style_.strong, script_file_),
                        printable(catalog.file)));
  text_.painted(style_.faint, "  time [s]  event");
  if (!layout_.is_brief) text_.add(changes_->titles());
  if (!script.situation.is_empty()) {
    write_event("before", "situation" + describe_situation(catalog, script.situation), {});
  }
  flush();
}

void TextReport::on_event(const ExplainedRecord& record, const Step* step, const State& state) {
  explanation_.add(record, step, state);
  summary_.add(record, step);
  const std::string note = describe_note(*catalog_, record, state);
  std::string outcome = outcome_of(record, state);
  if (layout_.is_brief) {
    outcome += brief_details(record);
    if (!note.empty()) outcome += "; " + note;
  }
  write_event(format_time(record.time), describe_event(*catalog_, record, step), outcome);
  if (layout_.is_brief) {
    write_asked(record, state);
  } else {
    if (!note.empty()) write({note, {}});
    write_details(record, state);
  }
  flush();
}

void TextReport::write_between(Microseconds time, const std::string& what,
                               const std::vector<std::string>& reasons) {
  write_event(format_time(time), what, {});
  for (const std::string& reason : reasons) write({reason, {}});
}

void TextReport::write_event(const std::string& time, const std::string& event,
                             const std::string& outcome) {
  constexpr std::size_t indent = 14;
  const std::string line =
      fmt::format("{:>10}  {}{}", time, style_.paint(style_.strong, event), outcome);
  text_.add(wrap_line(line, layout_.columns, indent) + "\n");
}

/// What follows the event on its line: the reasons of a rejection, or the changes.
std::string TextReport::brief_details(const ExplainedRecord& record) const {
  std::string text;
  if (record.outcome == Outcome::rejected) {
    text = ": " + join(describe_rejection(*catalog_, record), "; ", without_indentation);
  }
  for (const Change& change : record.changes) {
    // Of a rejected event all changes are undone.
    if (record.outcome == Outcome::rejected && change.success) continue;
    const std::string_view color =
        change.is_activation && change.success ? style_.good : style_.bad;
    text += "  " + style_.paint(color, (change.is_activation ? "+" : "-") +
                                           printable(catalog_->name_of_behavior(change.behavior)) +
                                           (!change.success                       ? " failed"
                                            : change.cause == ChangeCause::undone ? " undone"
                                                                                  : ""));
  }
  return text;
}

void TextReport::write_details(const ExplainedRecord& record, const State& state) {
  if (record.outcome == Outcome::rejected) {
    for (const std::string& sentence : describe_rejection(*catalog_, record)) write({sentence, {}});
    if (record.origin == Origin::reactive && state.is_waiting(record.task)) {
      write({task_name(*catalog_, record.task) +
                 " waits, and tries again after each accepted event of its group",
             {}});
    }
  }
  for (const Change& change : record.changes) write_change(record, change);
  if (record.outcome == Outcome::accepted) write_failed(record);
  write_stopped(record);
  for (const Displacement& displaced : record.explanation.displaced) {
    write(describe_displacement(*catalog_, record, displaced, state));
  }
  write_asked(record, state);
  if (record.search != nullptr && record.search->elapsed) {
    text_.painted(style_.faint, text_indent + stats_line(*record.search));
  }
}

std::string TextReport::outcome_of(const ExplainedRecord& record, const State& state) const {
  if (!form_of(record.verb).is_decided) return {};
  std::string_view color = style_.faint;
  if (record.outcome == Outcome::accepted) color = style_.good;
  if (record.outcome == Outcome::rejected) color = style_.bad;
  std::string text = ": " + style_.paint(color, name_of(record.outcome));
  if (record.search && record.search->result.status == SearchStatus::feasible) {
    const std::string bound = describe_bound(*catalog_, record, state);
    text += fmt::format(" (not proven best: a search limit was reached{}{})",
                        bound.empty() ? "" : "; ", bound);
  }
  return text;
}

void TextReport::write_change(const EventRecord& record, const Change& change) {
  const std::string_view of_sign = change.is_activation ? style_.good : style_.bad;
  text_.add(changes_->line(
      {change.priority ? std::to_string(*change.priority) : ".",
       {change.is_activation ? "+" : "-", change.success ? of_sign : std::string_view()},
       change.success ? "Y" : "N",
       printable(catalog_->name_of_behavior(change.behavior)),
       join(names_of_tasks(*catalog_, record.tasks_of(change)), ", "),
       name_of(change.cause)},
      change.success ? std::string_view() : style_.bad));
}

/// What the changes around a failed activation are.
void TextReport::write_failed(const EventRecord& record) {
  std::vector<std::string> names;
  bool has_changed = false;
  bool has_changed_before = false;
  for (const Change& change : record.changes) {
    if (change.success) {
      has_changed = true;
      continue;
    }
    names.push_back(behavior_name(*catalog_, change.behavior));
    has_changed_before = has_changed;
  }
  if (names.empty()) return;
  const char* const it = names.size() == 1 ? "it" : "them";
  std::string text = fmt::format("{} failed (N), and the event was decided anew without {}",
                                 list_with_and(names), it);
  if (has_changed_before) {
    text += fmt::format(": the changes above {} are of an answer that was given up", it);
  }
  write({text, {}});
}

void TextReport::write_stopped(const EventRecord& record) {
  if (record.stopped_tasks.empty()) return;
  const auto name_and_cause = [&](const StoppedTask& stopped) {
    return fmt::format("{} ({})", printable(catalog_->name_of_task(stopped.task)),
                       stop_word(record, stopped));
  };
  write({"stopped: " + join(record.stopped_tasks, ", ", name_and_cause), {}});
}

/// The answers to --why and --alternatives.
void TextReport::write_asked(const ExplainedRecord& record, const State& state) {
  for (const Why& why : record.explanation.why) write(describe_why(*catalog_, record, why, state));
  write_alternatives(record, state);
}

void TextReport::write_alternatives(const ExplainedRecord& record, const State& state) {
  const std::size_t count = record.explanation.alternatives.size();
  if (count == 0) return;
  write(Sentences{"best configurations:", {}});
  const Table table(style_, {number_column({}, 4, 11), {}}, {.columns = layout_.columns});
  for (std::size_t place = 0; place < count; ++place) {
    text_.add(table.line({place + 1, describe_alternative(*catalog_, record, place, state)}));
  }
  if (record.explanation.is_list_cut) {
    write(Sentences{"a search limit was reached before the next one was found", {}});
  }
}

void TextReport::write(const Sentences& sentences) {
  text_.line(text_indent + sentences.first);
  for (const std::string& sentence : sentences.more) {
    text_.line(std::string(text_indent) + "  " + sentence);
  }
}

void TextReport::flush() { fmt::print(out_, "{}", text_.take()); }

void TextReport::on_failure(const Failure& failure) {
  text_.painted(style_.bad,
                format_place(script_file_, failure.range.begin) + ": " + failure.message);
  for (const Sentences& sentences : explanation_.explain(failure)) write(sentences);
  flush();
}

void TextReport::on_end(const State& state) {
  std::map<std::uint32_t, std::vector<std::string>> tasks;  // by behavior, in catalog order
  for (const std::uint32_t index : state.running()) {
    const BehaviorId behavior = state.behavior(catalog_->task_ids[index]);
    tasks[catalog_->behaviors[behavior].catalog_index].push_back(
        printable(catalog_->task_names[index]));
  }
  text_.title("active behaviors");
  const Table table(style_, {{{}, {}, column_width(catalog_->behavior_names, 8)}, {}});
  for (const auto& [behavior, names] : tasks) {
    text_.add(table.line({printable(catalog_->behavior_names[behavior]), join(names, ", ")}));
  }
  if (tasks.empty()) text_.line("  none");
  if (state.waiting_count() > 0) {
    text_.painted(style_.strong, "waiting reactive tasks");
    for (const TaskId task : catalog_->task_ids) {
      if (state.is_waiting(task)) text_.line("  {}", printable(catalog_->name_of_task(task)));
    }
  }
  flush();
}

void TextReport::end_run(const RunResult& result, const std::string& error) {
  count(result);
  if (!result.was_run) {
    text_.line("");
    text_.painted(style_.bad, printable(error));
    return flush();
  }
  text_.title("summary");
  summary_.write(result, text_);
  if (result.passed + result.failed > 0) {
    text_.line("");
    text_.painted(result.failed > 0 ? style_.bad : style_.good,
                  "expectations: {} passed, {} failed", result.passed, result.failed);
  }
  flush();
}

void TextReport::count(const RunResult& result) {
  ++runs_;
  results_.push_back(result);
  if (result.failed > 0) ++failed_runs_;
  if (!result.was_run) ++missing_runs_;
  if (!result.totals) return;
  if (!totals_) totals_.emplace();
  totals_->merge(*result.totals);
}

std::unique_ptr<SolveReport> TextReport::make_part(std::FILE* out) const {
  return std::make_unique<TextReport>(style_, out, layout_);
}

void TextReport::add_part(std::string_view text, const RunResult& result) {
  if (runs_ > 0) fmt::print(out_, "\n");
  fmt::print(out_, "{}", text);
  count(result);
}

void TextReport::end() {
  if (runs_ > 1) {
    text_.title("all scripts");
    write_scripts(results_, text_);
    text_.line("");
    const std::string not_run =
        missing_runs_ > 0 ? fmt::format(", {} not run", missing_runs_) : std::string();
    text_.painted(failed_runs_ + missing_runs_ > 0 ? style_.bad : style_.good,
                  "{} scripts, {} with failed expectations{}", runs_, failed_runs_, not_run);
  }
  if (totals_) text_.add("\n" + stats_table(*totals_, process_usage(), style_));
  flush();
}

namespace {

/// Longer lists would hide what comes before them.
constexpr std::size_t most_places = 20;

void write_failures(const std::string& file, const std::vector<FailedExpectation>& failures,
                    Text& text) {
  std::vector<std::string> lines;
  lines.reserve(failures.size());
  for (const FailedExpectation& failed : failures) {
    lines.push_back(fmt::format("{}: {}", format_place(file, failed.range.begin), failed.message));
  }
  text.list(lines, most_places, "    ", text.style().bad);
}

std::string file_of(const RunResult& result) {
  return result.script == nullptr ? "" : printable(result.script->file);
}

}  // namespace

void RunSummary::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  file_ = printable(script.file);
  rejected_.clear();
  timeouts_ = {};
  cycles_.clear();
}

void RunSummary::add(const EventRecord& record, const Step* step) {
  if (record.origin == Origin::timeout) note_timeout(record);
  if (record.origin == Origin::script && record.verb != Verb::wait) end_timeouts();
  if (record.outcome != Outcome::rejected || rejected_.size() == most_places) return;
  const std::string place = step == nullptr ? file_ : format_place(file_, step->range.begin);
  rejected_.push_back(fmt::format("{}: at {} s, {}", place, format_time(record.time),
                                  describe_event(*catalog_, record, nullptr)));
}

void RunSummary::note_timeout(const EventRecord& record) {
  if (timeouts_.counts.empty()) timeouts_.first = record.time;
  timeouts_.last = record.time;
  ++timeouts_.counts[record.behavior];
}

/// A behavior that times out twice has been activated again, though the script did nothing: that
/// goes on for ever.
void RunSummary::end_timeouts() {
  std::vector<std::string> behaviors;
  for (const auto& [behavior, count] : timeouts_.counts) {
    if (count < 2) continue;
    behaviors.push_back(fmt::format("{} ({} times)", behavior_name(*catalog_, behavior), count));
  }
  if (!behaviors.empty()) {
    cycles_.push_back(fmt::format("from {} s to {} s, while the script does nothing: {}",
                                  format_time(timeouts_.first), format_time(timeouts_.last),
                                  join(behaviors, ", ")));
  }
  timeouts_ = {};
}

void RunSummary::write(const RunResult& result, Text& text) {
  end_timeouts();
  const Table table(text.style(), {{{}, {}, 19}, number_column({}, 7, 1)});
  text.add(table.line({"events", result.events}));
  text.add(table.line({"accepted", result.accepted}));
  text.add(table.line({"rejected", result.rejected}));
  text.list(rejected_, most_places, "    ");
  if (const std::uint64_t more = result.rejected - rejected_.size(); more > 0) {
    text.line("    and {} more", more);
  }
  if (!cycles_.empty()) {
    text.line("  timeouts again and again");
    text.list(cycles_, most_places, "    ");
  }
  if (result.failed == 0) return;
  text.add(table.line({"failed expectations", result.failed}, text.style().bad));
  write_failures(file_, result.failures, text);
}

void write_scripts(const std::vector<RunResult>& results, Text& text) {
  Table table(text.style(),
              {{"script"},
               number_column("events", 8),
               number_column("accepted", 8),
               number_column("rejected", 8),
               number_column("failed", 8)},
              {.columns = text.columns(), .column = 0});
  for (const RunResult& result : results) {
    if (!result.was_run) {
      table.add({file_of(result), "not run"}, text.style().bad);
      continue;
    }
    table.add({file_of(result), result.events, result.accepted, result.rejected, result.failed},
              result.failed > 0 ? text.style().bad : std::string_view());
  }
  text.table(table);
  for (const RunResult& result : results) write_failures(file_of(result), result.failures, text);
}

}  // namespace cbc
