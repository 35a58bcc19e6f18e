#include "core/report/search_stats.h"

#include <cstddef>
#include <sys/resource.h>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"

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

void add_rows(const std::string& name, const SearchEffort& effort, Table& table) {
  const auto number = [](double value) { return fmt::format("{:.2f}", value); };
  bool is_first = true;
  const auto add = [&](const char* measure, const Spread& spread) {
    table.add({is_first ? name : "", is_first ? std::to_string(effort.events) : "", measure,
               number(mean(spread, effort.events)), spread.least, spread.greatest});
    is_first = false;
  };
  add("solutions", effort.solutions);
  add("nodes", effort.nodes);
  add("propagations", effort.propagations);
  const Spread& time = effort.nanoseconds;
  table.add({"", "", "time [us]", number(mean(time, effort.events) / 1000),
             number(to_microseconds(time.least)), number(to_microseconds(time.greatest))});
}

}  // namespace

double to_microseconds(std::uint64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1000;
}

std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage, const Style& style) {
  Table table(style, {{"event", {}, 18},
                      number_column("n", 8, 1),
                      {{}, {}, 12},
                      number_column("mean", 11),
                      number_column("min", 11, 1),
                      number_column("max", 11, 1)});
  for (std::size_t kind = 0; kind < SearchTotals::kinds.size(); ++kind) {
    const SearchEffort& effort = totals.of_kind(kind);
    if (effort.events > 0) add_rows(name_of_kind(SearchTotals::kinds[kind]), effort, table);
  }
  if (totals.all().events > 0) add_rows("all", totals.all(), table);
  return style.paint(style.strong, "searches") + "\n" + table.text() +
         (totals.all().events > 0 ? "" : "  none\n") +
         fmt::format("  process: {:.1f} MiB of memory at most, {:.3f} s of CPU time\n",
                     static_cast<double>(usage.peak_memory) / (1 << 20),
                     to_seconds(usage.cpu_time));
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
