#include "sweep/report/sweep_report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/blocks.h"
#include "core/report/search_stats.h"
#include "core/support/wording.h"
#include "core/words/reason_words.h"
#include "runtime/base/text.h"
#include "sweep/engine/sweep.h"

namespace cbc {
namespace {

constexpr std::string_view label(SweepKind kind) {
  constexpr std::array<std::string_view, sweep_kinds> labels = {"start",
                                                                "stop",
                                                                "finish, goal achieved",
                                                                "finish, failure",
                                                                "finish, situation change",
                                                                "situation",
                                                                "fault",
                                                                "repair",
                                                                "timeout",
                                                                "reactive start",
                                                                "finish after a failed undo",
                                                                "reconsidered"};
  return labels[static_cast<std::size_t>(kind)];
}

std::string rejected_because(const SweepResult& result, const RejectionReason& reason) {
  const auto name_in = [](const std::vector<std::string>& names, std::uint32_t place) {
    return place == none ? std::string() : printable(names[place]);
  };
  return describe_kind(reason.kind, name_in(result.behavior_names, reason.behavior),
                       name_in(result.task_names, reason.task),
                       name_in(result.task_names, reason.other_task));
}

/// Whether a reason is a requirement of the catalog. These take part in most rejections, whatever
/// has come about.
bool is_requirement(const RejectionReason& reason) {
  return reason.kind == Reason::Kind::requires_task || reason.kind == Reason::Kind::performance;
}

/// "2.50" for 2500 nanoseconds, with at least three digits.
std::string three_digits(std::uint64_t nanoseconds) {
  const double time = to_microseconds(nanoseconds);
  return fmt::format("{:.{}f}", time, time < 10 ? 2 : time < 100 ? 1 : 0);
}

void add_events(const SweepResult& result, Text& text) {
  Table table(text.style(), {{"events", {}, 28, 0},
                             number_column("accepted", 12, 0),
                             number_column("escalated", 12, 0),
                             number_column("rejected", 12, 0),
                             number_column("unchanged", 12, 0)});
  OutcomeCounts all;
  const auto add = [&](std::string_view name, const OutcomeCounts& counts) {
    table.add({fmt::format("  {}", name), counts.accepted, counts.escalated, counts.rejected,
               counts.unchanged});
  };
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& counts = result.counts.events[kind];
    if (static_cast<SweepKind>(kind) == SweepKind::reconsider && counts.is_zero()) continue;
    add(label(static_cast<SweepKind>(kind)), counts);
    all.add(counts);
  }
  add("all", all);
  text.table(table);
  text.line("");
}

/// The names whose count is 0.
template <typename Count>
void add_unused(std::string_view what, const std::vector<std::string>& names, Count count,
                Text& text) {
  constexpr std::size_t most_named = 20;
  std::vector<std::string> unused;
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (count(place) == 0) unused.push_back(printable(names[place]));
  }
  text.line("{}: {} of {}", text.style().paint(text.style().strong, what), unused.size(),
            names.size());
  text.list(unused, most_named);
}

void add_reasons(const SweepResult& result, Text& text) {
  constexpr std::size_t most_shown = 10;
  std::vector<std::pair<RejectionReason, std::uint64_t>> reasons(result.counts.reasons.begin(),
                                                                 result.counts.reasons.end());
  if (reasons.empty()) return;
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    const bool is_last = is_requirement(a.first);
    return is_last != is_requirement(b.first) ? !is_last : a.second > b.second;
  });
  text.line("{}, the most frequent of {}, requirements last",
            text.style().paint(text.style().strong, "reasons for rejections"), reasons.size());
  reasons.resize(std::min(reasons.size(), most_shown));
  Table table(text.style(), {number_column({}, 9, 0), {}});
  for (const auto& [reason, count] : reasons) table.add({count, rejected_because(result, reason)});
  text.table(table);
}

void add_slowest(const SlowestEvent& slowest, std::string_view measure, std::string_view option,
                 Text& text) {
  text.line("  slowest by {}: event {} of sequence {}, {} ({} FILE writes it as a script)", measure,
            slowest.event, slowest.sequence, printable(slowest.what), option);
}

void add_nodes(const SweepResult& result, Text& text) {
  if (!result.slowest) return text.line("no event needed a search");
  text.line("{} of {}: median {}, 99th percentile {}, largest {}",
            text.style().paint(text.style().strong, "nodes"),
            quantity(result.nodes.total(), "solved event"), result.nodes.median(),
            result.nodes.percentile_99(), result.slowest->cost);
  add_slowest(*result.slowest, "nodes", "--slowest", text);
}

void add_times(const SweepTimes& times, Text& text) {
  if (!times.slowest) return;
  text.line("{} of an event in µs: median {}, 99th percentile {}, largest {}",
            text.style().paint(text.style().strong, "time"), three_digits(times.events.median()),
            three_digits(times.events.percentile_99()), three_digits(times.slowest->cost));
  add_slowest(*times.slowest, "time", "--slowest-by-time", text);
  text.line("elapsed: {} s", format_decimal(static_cast<std::int64_t>(times.elapsed / 1000), 3));
}

}  // namespace

std::string describe(const SweepSettings& settings) {
  return fmt::format("{}{} of {}, seed {}", quantity(settings.sequences, "sequence"),
                     settings.first > 0 ? fmt::format(" from number {}", settings.first + 1) : "",
                     quantity(settings.shape.events, "event"), settings.seed);
}

namespace {

/// Of a sweep against an older version only the comparison.
void add_sweep(const SweepResult& result, Text& text) {
  if (result.against) return add_against(result, text);
  text.line("{}: {}",
            text.style().paint(text.style().strong, "sweep of " + printable(result.catalog)),
            describe(result.settings));
  text.line("");
  add_events(result, text);
  add_unused(
      "behaviors that never became active", result.behavior_names,
      [&](std::size_t place) { return result.counts.behaviors[place].activations; }, text);
  add_unused(
      "tasks that never ran", result.task_names,
      [&](std::size_t place) { return result.counts.tasks[place].runs; }, text);
  add_reasons(result, text);
  add_nodes(result, text);
  if (result.times) add_times(*result.times, text);
}

}  // namespace

std::span<const ReportFormat<SweepResult>> sweep_formats() {
  static constexpr ReportFormat<SweepResult> formats[] = {
      {"text", as_text<add_sweep>},
      {"json", for_programs<sweep_to_json>},
  };
  return formats;
}

}  // namespace cbc
