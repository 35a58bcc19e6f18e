#include "core/report/search_stats.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <sys/resource.h>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/answer_bound.h"
#include "core/report/sentences.h"
#include "core/report/table_parts.h"
#include "core/report/wrap.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

Microseconds microseconds_of(const timeval& time) { return time.tv_sec * second + time.tv_usec; }

}  // namespace

ProcessUsage process_usage() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return {};
  constexpr std::uint64_t kibibyte = 1024;  // the unit of Linux
  return {static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte,
          microseconds_of(usage.ru_utime) + microseconds_of(usage.ru_stime)};
}

namespace {

double mean(const Spread& spread, std::uint64_t count) {
  return static_cast<double>(spread.sum) / static_cast<double>(count);
}

std::string name_of_kind(const SearchTotals::Kind& kind) {
  std::string name(name_of(kind.verb));
  if (kind.origin != Origin::script) name += fmt::format(" ({})", name_of(kind.origin));
  return name;
}

/// One measure of a kind of events: its name, mean, minimum and maximum.
std::string columns(const char* measure, const Spread& spread, std::uint64_t events) {
  return fmt::format("{:<12}  {:>11.2f} {:>11} {:>11}\n", measure, mean(spread, events),
                     spread.least, spread.greatest);
}

std::string columns_of_time(const Spread& spread, std::uint64_t events) {
  return fmt::format("{:<12}  {:>11.2f} {:>11.2f} {:>11.2f}\n", "time [us]",
                     mean(spread, events) / 1000, to_microseconds(spread.least),
                     to_microseconds(spread.greatest));
}

std::string rows(const std::string& name, const SearchEffort& effort) {
  if (effort.events == 0) return {};
  const std::string indent(31, ' ');
  return fmt::format("  {:<18} {:>8}  ", name, effort.events) +
         columns("solutions", effort.solutions, effort.events) + indent +
         columns("nodes", effort.nodes, effort.events) + indent +
         columns("propagations", effort.propagations, effort.events) + indent +
         columns_of_time(effort.nanoseconds, effort.events);
}

}  // namespace

double to_microseconds(std::uint64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1000;
}

std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage, const Style& style) {
  std::string text =
      fmt::format("{}searches{}\n{}  {:<18} {:>8}  {:<12}  {:>11} {:>11} {:>11}{}\n", style.strong,
                  style.reset, style.faint, "event", "n", "", "mean", "min", "max", style.reset);
  for (std::size_t kind = 0; kind < SearchTotals::kinds.size(); ++kind) {
    text += rows(name_of_kind(SearchTotals::kinds[kind]), totals.of_kind(kind));
  }
  text += totals.all().events > 0 ? rows("all", totals.all()) : "  none\n";
  text +=
      fmt::format("  process: {:.1f} MiB of memory at most, {:.3f} s of CPU time\n",
                  static_cast<double>(usage.peak_memory) / (1 << 20), to_seconds(usage.cpu_time));
  return text;
}

std::string stats_line(const SearchRecord& search) {
  std::string text = quantity(search.result.solutions, "solution") + ", " +
                     quantity(search.result.nodes, "node") + ", " +
                     quantity(search.result.propagations, "propagation");
  if (search.elapsed) {
    text += fmt::format(", {:.2f} us",
                        to_microseconds(static_cast<std::uint64_t>(search.elapsed->count())));
  }
  return text;
}

}  // namespace cbc
