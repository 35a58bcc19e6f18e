#include "report/solve_text.h"

#include <algorithm>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "report/describe_event.h"
#include "report/process_usage.h"
#include "report/reasons.h"
#include "report/solve_stats.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc {
namespace {

constexpr std::size_t widest_column = 48;
constexpr const char* change_indent = "          ";
constexpr const char* text_indent = "           ";

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    width += utf8::display_width(decoded.character);
    offset += decoded.bytes;
  }
  return width;
}

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
  script_file_ = printable(script.file);
  behavior_width_ = column_width(catalog.behavior_names, 8);
  task_width_ = column_width(catalog.task_names, 4);
  if (runs_ > 0) fmt::print(out_, "\n");
  fmt::print(out_, "{}{}{} with {}\n\n", style_.strong, script_file_, style_.reset,
             printable(catalog.file));
  fmt::print(out_, "{}  time [s]  event{}\n", style_.faint, style_.reset);
  fmt::print(out_, "{}{} P T S  {:<{}}  {:<{}}  cause{}\n", style_.faint, change_indent, "behavior",
             behavior_width_, "task", task_width_, style_.reset);
  if (!script.situation.empty()) {
    fmt::print(out_, "{:>10}  {}situation{}{}\n", "before", style_.strong,
               describe_situation(catalog, script.situation), style_.reset);
  }
}

void TextReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  fmt::print(out_, "{:>10}  {}{}{}{}\n", format_time(record.time), style_.strong,
             describe_event(*catalog_, record, step), style_.reset, describe_outcome(record));
  if (record.outcome == Outcome::rejected) {
    for (const std::string& sentence : describe_rejection(*catalog_, record)) {
      fmt::print(out_, "{}{}\n", text_indent, sentence);
    }
  }
  for (const Change& change : record.changes) write_change(record, change);
  write_stopped(record);
  write_explanation(record, state);
  if (record.search != nullptr && record.search->elapsed) {
    fmt::print(out_, "{}{}{}{}\n", text_indent, style_.faint, stats_line(*record.search),
               style_.reset);
  }
}

std::string TextReport::describe_outcome(const EventRecord& record) const {
  std::string_view color = style_.faint;
  switch (record.verb) {
    case Verb::start:
    case Verb::stop:
    case Verb::finish:
      break;
    default:
      return {};  // there is nothing to accept or reject
  }
  if (record.outcome == Outcome::accepted) color = style_.good;
  if (record.outcome == Outcome::rejected) color = style_.bad;
  const bool is_cut = record.search && record.search->result.status == SearchStatus::feasible;
  return fmt::format(": {}{}{}{}", color, name_of(record.outcome), style_.reset,
                     is_cut ? " (not proven best: a search limit came first)" : "");
}

void TextReport::write_change(const EventRecord& record, const Change& change) {
  const std::string priority = change.priority ? std::to_string(*change.priority) : ".";
  const std::string_view color = change.success ? std::string_view() : style_.bad;
  fmt::print(out_, "{}{}{:>2} {} {}  {:<{}}  {:<{}}  {}{}\n", change_indent, color, priority,
             change.is_activation ? '+' : '-', change.success ? 'Y' : 'N',
             printable(catalog_->name_of_behavior(change.behavior)), behavior_width_,
             join_tasks(*catalog_, record.tasks_of(change)), task_width_, name_of(change.cause),
             color.empty() ? std::string_view() : style_.reset);
}

void TextReport::write_stopped(const EventRecord& record) {
  if (record.stopped_tasks.empty()) return;
  std::string text;
  for (const StoppedTask& stopped : record.stopped_tasks) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ",
                        printable(catalog_->name_of_task(stopped.task)), name_of(stopped.cause));
  }
  fmt::print(out_, "{}stopped: {}\n", text_indent, text);
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
  fmt::print(out_, "{}best configurations:\n", text_indent);
  for (std::size_t place = 0; place < count; ++place) {
    fmt::print(out_, "{}{:>4}  {}\n", text_indent, place + 1,
               describe_alternative(*catalog_, record, place, state));
  }
  if (record.explanation.is_list_cut) {
    fmt::print(out_, "{}a limit of effort came before the next one\n", text_indent);
  }
}

void TextReport::write(const Sentences& sentences) {
  fmt::print(out_, "{}{}\n", text_indent, sentences.first);
  for (const std::string& sentence : sentences.more) {
    fmt::print(out_, "{}  {}\n", text_indent, sentence);
  }
}

void TextReport::on_failure(const Failure& failure) {
  fmt::print(out_, "{}{}:{}:{}: {}{}\n", style_.bad, script_file_, failure.range.begin.line,
             failure.range.begin.column, failure.message, style_.reset);
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
}

void TextReport::end_run(const RunResult& result, const std::string& /*error*/) {
  count(result);
  if (result.passed + result.failed == 0) return;
  fmt::print(out_, "\n{}expectations: {} passed, {} failed{}\n",
             result.failed > 0 ? style_.bad : style_.good, result.passed, result.failed,
             style_.reset);
}

void TextReport::count(const RunResult& result) {
  ++runs_;
  if (result.failed > 0) ++failed_runs_;
  if (!result.totals) return;
  if (!totals_) totals_.emplace();
  totals_->merge(*result.totals);
}

std::unique_ptr<SolveReport> TextReport::make_part(std::FILE* out) const {
  return std::make_unique<TextReport>(style_, out);
}

void TextReport::add_part(std::string_view text, const RunResult& result) {
  if (runs_ > 0) fmt::print(out_, "\n");
  fmt::print(out_, "{}", text);
  count(result);
}

void TextReport::end() {
  if (runs_ > 1) {
    fmt::print(out_, "\n{}{} scripts, {} with failed expectations{}\n",
               failed_runs_ > 0 ? style_.bad : style_.good, runs_, failed_runs_, style_.reset);
  }
  if (totals_) fmt::print(out_, "\n{}", stats_table(*totals_, process_usage(), style_));
}

}  // namespace cbc
