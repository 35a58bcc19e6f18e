#include "core/report/run_summary.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/sentences.h"
#include "core/report/table_parts.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Longer lists would hide what comes before them.
constexpr std::size_t most_places = 20;
constexpr std::size_t place_indent = 8;

std::string row(std::string_view what, std::uint64_t count) {
  return fmt::format("  {:<19} {:>7}", what, count);
}

void add_rest(std::size_t total, std::vector<SummaryLine>& lines) {
  if (total <= most_places) return;
  lines.push_back({fmt::format("    and {} more", total - most_places), place_indent});
}

void add_failures(const std::string& file, std::span<const FailedExpectation> failures,
                  std::vector<SummaryLine>& lines) {
  for (const FailedExpectation& failed : failures.first(std::min(failures.size(), most_places))) {
    lines.push_back(
        {fmt::format("    {}: {}", format_place(file, failed.range.begin), failed.message),
         place_indent, true});
  }
  add_rest(failures.size(), lines);
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
  rejected_.push_back(fmt::format("    {}: at {} s, {}", place, format_time(record.time),
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
  std::string behaviors;
  for (const auto& [behavior, count] : timeouts_.counts) {
    if (count < 2) continue;
    behaviors += fmt::format("{}{} ({} times)", behaviors.empty() ? "" : ", ",
                             behavior_name(*catalog_, behavior), count);
  }
  if (!behaviors.empty()) {
    cycles_.push_back(fmt::format("    from {} s to {} s, while the script does nothing: {}",
                                  format_time(timeouts_.first), format_time(timeouts_.last),
                                  behaviors));
  }
  timeouts_ = {};
}

std::vector<SummaryLine> RunSummary::lines(const RunResult& result) {
  end_timeouts();
  std::vector<SummaryLine> lines;
  lines.push_back({row("events", result.events)});
  lines.push_back({row("accepted", result.accepted)});
  lines.push_back({row("rejected", result.rejected)});
  for (const std::string& rejected : rejected_) lines.push_back({rejected, place_indent});
  add_rest(result.rejected, lines);
  if (!cycles_.empty()) {
    lines.push_back({"  timeouts again and again"});
    for (std::size_t place = 0; place < std::min(cycles_.size(), most_places); ++place) {
      lines.push_back({cycles_[place], place_indent});
    }
    add_rest(cycles_.size(), lines);
  }
  if (result.failed == 0) return lines;
  lines.push_back({row("failed expectations", result.failed), 0, true});
  add_failures(file_, result.failures, lines);
  return lines;
}

void ScriptTable::add(const RunResult& result) {
  rows_.push_back({result.script == nullptr ? "" : printable(result.script->file), result});
}

std::vector<SummaryLine> ScriptTable::lines() const {
  std::size_t width = 6;
  for (const Row& row : rows_) width = std::max(width, width_of(row.file));
  const auto line = [width](const std::string& file, const auto& events, const auto& accepted,
                            const auto& rejected, const auto& failed) {
    return fmt::format("  {}{}  {:>8}  {:>8}  {:>8}  {:>8}", file,
                       std::string(width - width_of(file), ' '), events, accepted, rejected,
                       failed);
  };
  std::vector<SummaryLine> lines;
  lines.push_back({line("script", "events", "accepted", "rejected", "failed")});
  for (const Row& row : rows_) {
    lines.push_back({line(row.file, row.result.events, row.result.accepted, row.result.rejected,
                          row.result.failed),
                     place_indent, row.result.failed > 0});
  }
  for (const Row& row : rows_) add_failures(row.file, row.result.failures, lines);
  return lines;
}

}  // namespace cbc
