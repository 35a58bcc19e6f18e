#include "core/report/run_text.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <sys/resource.h>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/answer_bound.h"
#include "core/report/run_report.h"
#include "core/report/search_stats.h"
#include "core/report/sentences.h"
#include "core/report/table_parts.h"
#include "core/report/wrap.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::size_t widest_column = 48;
constexpr const char* change_indent = "          ";
constexpr const char* change_columns = "    priority   ok ";  ///< the sign needs no name
constexpr const char* text_indent = "           ";
constexpr std::size_t event_column = 12;
constexpr std::size_t text_column = 11;
constexpr std::size_t behavior_column = 18;

std::size_t column_width(const Texts& names, std::size_t least) {
  std::size_t width = least;
  for (const std::string_view name : names) width = std::max(width, width_of(printable(name)));
  return std::min(width, widest_column);
}

std::string join_tasks(const CompiledCatalog& catalog, std::span<const TaskId> tasks) {
  std::string text;
  for (const TaskId task : tasks) {
    if (!text.empty()) text += ", ";
    text += printable(catalog.name_of_task(task));
  }
  return text;
}

}  // namespace

void TextReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  explanation_.begin_run(catalog);
  summary_.begin_run(catalog, script);
  script_file_ = printable(script.file);
  behavior_width_ = column_width(catalog.behavior_names, 8);
  task_width_ = column_width(catalog.task_names, 4);
  if (runs_ > 0) fmt::print(out_, "\n");
  fmt::print(out_, "{}{}{} with {}\n\n", style_.strong, script_file_, style_.reset,
             printable(catalog.file));
  fmt::print(out_, "{}  time [s]  event{}\n", style_.faint, style_.reset);
  if (!layout_.is_brief) {
    write_line(fmt::format("{}{}{:<{}}  {:<{}}  cause{}", style_.faint, change_columns, "behavior",
                           behavior_width_, "task", task_width_, style_.reset),
               behavior_column);
  }
  if (!script.situation.is_empty()) {
    write_line(fmt::format("{:>10}  {}situation{}{}", "before", style_.strong,
                           describe_situation(catalog, script.situation), style_.reset),
               event_column + 2);
  }
}

void TextReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  explanation_.add(record, step, state);
  summary_.add(record, step);
  const std::string note = describe_note(*catalog_, record, state);
  std::string line = fmt::format("{:>10}  {}{}{}{}", format_time(record.time), style_.strong,
                                 describe_event(*catalog_, record, step), style_.reset,
                                 describe_outcome(record, state));
  if (layout_.is_brief) {
    line += describe_briefly(record);
    if (!note.empty()) line += "; " + note;
    write_line(line, event_column + 2);
    return;
  }
  write_line(line, event_column + 2);
  if (!note.empty()) write({note, {}});
  write_details(record, state);
}

/// What follows the event on its line: the reasons of a rejection, or the changes.
std::string TextReport::describe_briefly(const EventRecord& record) const {
  std::string text;
  if (record.outcome == Outcome::rejected) {
    for (const std::string& sentence : describe_rejection(*catalog_, record)) {
      text += text.empty() ? ": " : "; ";
      text += without_indentation(sentence);
    }
  }
  for (const Change& change : record.changes) {
    // Of a rejected event all changes are undone.
    const bool is_undone =
        change.cause == ChangeCause::undone || record.outcome == Outcome::rejected;
    if (is_undone && change.success) continue;
    const std::string_view color =
        change.is_activation && change.success ? style_.good : style_.bad;
    text += fmt::format("  {}{}{}{}{}", color, change.is_activation ? '+' : '-',
                        printable(catalog_->name_of_behavior(change.behavior)),
                        change.success ? "" : " failed",
                        color.empty() ? std::string_view() : style_.reset);
  }
  return text;
}

void TextReport::write_details(const EventRecord& record, const State& state) {
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
  write_explanation(record, state);
  if (record.search != nullptr && record.search->elapsed) {
    write_line(fmt::format("{}{}{}{}", text_indent, style_.faint, stats_line(*record.search),
                           style_.reset),
               text_column + 2);
  }
}

std::string TextReport::describe_outcome(const EventRecord& record, const State& state) const {
  if (!form_of(record.verb).is_decided) return {};
  std::string_view color = style_.faint;
  if (record.outcome == Outcome::accepted) color = style_.good;
  if (record.outcome == Outcome::rejected) color = style_.bad;
  std::string text = fmt::format(": {}{}{}", color, name_of(record.outcome), style_.reset);
  if (record.search && record.search->result.status == SearchStatus::feasible) {
    const std::string bound = describe_bound(*catalog_, record, state);
    text += fmt::format(" (not proven best: a search limit was reached{}{})",
                        bound.empty() ? "" : "; ", bound);
  }
  return text;
}

void TextReport::write_change(const EventRecord& record, const Change& change) {
  const std::string priority = change.priority ? std::to_string(*change.priority) : ".";
  const std::string_view color = change.success ? std::string_view() : style_.bad;
  const std::string_view of_sign = change.is_activation ? style_.good : style_.bad;
  const std::string sign(1, change.is_activation ? '+' : '-');
  const bool paints_sign = change.success && !of_sign.empty();
  write_line(
      fmt::format("{}{}{:>2} {} {}  {:<{}}  {:<{}}  {}{}", change_indent, color, priority,
                  paints_sign ? style_.paint(of_sign, sign) : sign, change.success ? 'Y' : 'N',
                  printable(catalog_->name_of_behavior(change.behavior)), behavior_width_,
                  join_tasks(*catalog_, record.tasks_of(change)), task_width_,
                  name_of(change.cause), color.empty() ? std::string_view() : style_.reset),
      behavior_column);
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
                                 list_words(names, "and"), it);
  if (has_changed_before) {
    text += fmt::format(": the changes above {} are of an answer that was given up", it);
  }
  write({text, {}});
}

void TextReport::write_stopped(const EventRecord& record) {
  if (record.stopped_tasks.empty()) return;
  std::string text;
  for (const StoppedTask& stopped : record.stopped_tasks) {
    text +=
        fmt::format("{}{} ({})", text.empty() ? "" : ", ",
                    printable(catalog_->name_of_task(stopped.task)), stop_word(record, stopped));
  }
  write({"stopped: " + text, {}});
}

void TextReport::write_explanation(const EventRecord& record, const State& state) {
  for (const Displacement& displaced : record.explanation.displaced) {
    write(describe_displacement(*catalog_, record, displaced, state));
  }
  for (const Why& why : record.explanation.why) write(describe_why(*catalog_, record, why, state));
  write_alternatives(record, state);
}

void TextReport::write_alternatives(const EventRecord& record, const State& state) {
  const std::size_t count = record.explanation.alternatives.size();
  if (count == 0) return;
  write(Sentences{"best configurations:", {}});
  for (std::size_t place = 0; place < count; ++place) {
    write_line(fmt::format("{}{:>4}  {}", text_indent, place + 1,
                           describe_alternative(*catalog_, record, place, state)),
               text_column + 6);
  }
  if (record.explanation.is_list_cut) {
    write(Sentences{"a search limit was reached before the next one was found", {}});
  }
}

void TextReport::write(const Sentences& sentences) {
  const auto write_one = [&](const std::string& line) {
    write_line(text_indent + line, text_column + line.find_first_not_of(' ') + 2);
  };
  write_one(sentences.first);
  for (const std::string& sentence : sentences.more) write_one("  " + sentence);
}

void TextReport::write(const std::vector<SummaryLine>& lines) {
  for (const SummaryLine& line : lines) {
    const bool is_painted = line.is_bad && !style_.bad.empty();
    write_line(is_painted ? style_.paint(style_.bad, line.text) : line.text, line.indent);
  }
}

void TextReport::write_line(const std::string& line, std::size_t indent) {
  fmt::print(out_, "{}\n", wrap_line(line, layout_.columns, indent));
}

void TextReport::on_failure(const Failure& failure) {
  write_line(fmt::format("{}{}: {}{}", style_.bad, format_place(script_file_, failure.range.begin),
                         failure.message, style_.reset),
             text_column);
  for (const Sentences& sentences : explanation_.explain(failure)) write(sentences);
}

void TextReport::on_end(const State& state) {
  std::vector<std::string> lines(catalog_->behavior_names.size());
  for (const std::uint32_t index : state.running()) {
    std::string& tasks =
        lines[catalog_->behaviors[state.behavior(catalog_->task_ids[index])].catalog_index];
    tasks += fmt::format("{}{}", tasks.empty() ? "" : ", ", printable(catalog_->task_names[index]));
  }
  fmt::print(out_, "\n{}active behaviors{}\n", style_.strong, style_.reset);
  bool is_idle = true;
  for (std::size_t behavior = 0; behavior < lines.size(); ++behavior) {
    if (lines[behavior].empty()) continue;
    is_idle = false;
    fmt::print(out_, "  {:<{}}  {}\n", printable(catalog_->behavior_names[behavior]),
               behavior_width_, lines[behavior]);
  }
  if (is_idle) fmt::print(out_, "  none\n");
  if (state.waiting_count() == 0) return;
  fmt::print(out_, "{}waiting reactive tasks{}\n", style_.strong, style_.reset);
  for (const TaskId task : catalog_->task_ids) {
    if (state.is_waiting(task)) {
      fmt::print(out_, "  {}\n", printable(catalog_->name_of_task(task)));
    }
  }
}

void TextReport::end_run(const RunResult& result, const std::string& /*error*/) {
  count(result);
  fmt::print(out_, "\n{}summary{}\n", style_.strong, style_.reset);
  write(summary_.lines(result));
  if (result.passed + result.failed == 0) return;
  fmt::print(out_, "\n{}expectations: {} passed, {} failed{}\n",
             result.failed > 0 ? style_.bad : style_.good, result.passed, result.failed,
             style_.reset);
}

void TextReport::count(const RunResult& result) {
  ++runs_;
  scripts_.add(result);
  if (result.failed > 0) ++failed_runs_;
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
    fmt::print(out_, "\n{}all scripts{}\n", style_.strong, style_.reset);
    write(scripts_.lines());
    fmt::print(out_, "\n{}{} scripts, {} with failed expectations{}\n",
               failed_runs_ > 0 ? style_.bad : style_.good, runs_, failed_runs_, style_.reset);
  }
  if (totals_) fmt::print(out_, "\n{}", stats_table(*totals_, process_usage(), style_));
}

}  // namespace cbc
