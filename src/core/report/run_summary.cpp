#include "core/report/run_summary.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/event_words.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Longer lists would hide what comes before them.
constexpr std::size_t most_places = 20;

/// Writes the first ones.
void write_list(const std::vector<std::string>& lines, std::size_t total, std::string_view color,
                Text& text) {
  for (std::size_t place = 0; place < std::min(lines.size(), most_places); ++place) {
    text.painted(color, "    " + lines[place]);
  }
  if (total > most_places) text.line("    and {} more", total - most_places);
}

void write_failures(const std::string& file, const std::vector<FailedExpectation>& failures,
                    Text& text) {
  std::vector<std::string> lines;
  for (const FailedExpectation& failed : failures) {
    lines.push_back(fmt::format("{}: {}", format_place(file, failed.range.begin), failed.message));
  }
  write_list(lines, lines.size(), text.style().bad, text);
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
  write_list(rejected_, result.rejected, {}, text);
  if (!cycles_.empty()) {
    text.line("  timeouts again and again");
    write_list(cycles_, cycles_.size(), {}, text);
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
    table.add({file_of(result), result.events, result.accepted, result.rejected, result.failed},
              result.failed > 0 ? text.style().bad : std::string_view());
  }
  text.add(table.text());
  for (const RunResult& result : results) write_failures(file_of(result), result.failures, text);
}

}  // namespace cbc
