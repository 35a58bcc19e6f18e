#include "report/solve_stats.h"

#include <cstddef>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/exact_values.h"
#include "report/quantity.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

double mean(const Spread& spread, std::uint64_t count) {
  return static_cast<double>(spread.sum) / static_cast<double>(count);
}

std::string name_of_kind(const SearchTotals::Kind& kind) {
  std::string name(name_of(kind.verb));
  if (kind.origin != Origin::script) name += fmt::format(" ({})", name_of(kind.origin));
  return name;
}

/// One measure of a kind of events: its name, mean, least and greatest.
std::string columns(const char* measure, const Spread& spread, std::uint64_t events) {
  return fmt::format("{:<12}  {:>12.2f} {:>12} {:>12}\n", measure, mean(spread, events),
                     spread.least, spread.greatest);
}

std::string columns_of_time(const Spread& spread, std::uint64_t events) {
  return fmt::format("{:<12}  {:>12.2f} {:>12.2f} {:>12.2f}\n", "time [us]",
                     mean(spread, events) / 1000, to_microseconds(spread.least),
                     to_microseconds(spread.greatest));
}

std::string rows(const std::string& name, const SearchEffort& effort) {
  if (effort.events == 0) return {};
  const std::string indent(29, ' ');
  return fmt::format("  {:<16} {:>8}  ", name, effort.events) +
         columns("solutions", effort.solutions, effort.events) + indent +
         columns("nodes", effort.nodes, effort.events) + indent +
         columns("propagations", effort.propagations, effort.events) + indent +
         columns_of_time(effort.nanoseconds, effort.events);
}

Json spread_to_json(const Spread& spread, std::uint64_t count) {
  if (count == 0) return {{"sum", 0}, {"mean", nullptr}, {"min", nullptr}, {"max", nullptr}};
  return {{"sum", spread.sum},
          {"mean", mean(spread, count)},
          {"min", spread.least},
          {"max", spread.greatest}};
}

Json time_to_json(const Spread& spread, std::uint64_t count) {
  if (count == 0) return spread_to_json(spread, count);
  return {{"sum", to_microseconds(spread.sum)},
          {"mean", mean(spread, count) / 1000},
          {"min", to_microseconds(spread.least)},
          {"max", to_microseconds(spread.greatest)}};
}

void add_effort(Json& json, const SearchEffort& effort) {
  json["events"] = effort.events;
  json["solutions"] = spread_to_json(effort.solutions, effort.events);
  json["nodes"] = spread_to_json(effort.nodes, effort.events);
  json["propagations"] = spread_to_json(effort.propagations, effort.events);
  json["elapsed_us"] = time_to_json(effort.nanoseconds, effort.events);
}

}  // namespace

double to_microseconds(std::uint64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1000;
}

std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage, const Style& style) {
  std::string text =
      fmt::format("{}searches{}\n{}  {:<16} {:>8}  {:<12}  {:>12} {:>12} {:>12}{}\n", style.strong,
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

Json stats_to_json(const SearchTotals& totals) {
  Json json;
  add_effort(json, totals.all());
  Json& kinds = json["kinds"] = Json::array();
  for (std::size_t kind = 0; kind < SearchTotals::kinds.size(); ++kind) {
    if (totals.of_kind(kind).events == 0) continue;
    Json& entry = kinds.emplace_back(Json::object());
    entry["verb"] = name_of(SearchTotals::kinds[kind].verb);
    entry["origin"] = name_of(SearchTotals::kinds[kind].origin);
    add_effort(entry, totals.of_kind(kind));
  }
  return json;
}

Json usage_to_json(const ProcessUsage& usage) {
  return {{"peak_memory_bytes", usage.peak_memory}, {"cpu_us", usage.cpu_time}};
}

}  // namespace cbc
