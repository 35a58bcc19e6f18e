#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/report/search_stats.h"
#include "core/script/runner.h"
#include "core/support/json_description.h"

// The effort of searches as JSON.

namespace cbc::json {

/// Of `events` events.
struct Measure {
  const Spread& spread;
  std::uint64_t events = 0;
};

struct PutAnyNumber {
  void operator()(JsonWriter& json, const auto& value) const { json.put(value); }
};
inline constexpr Number<PutAnyNumber> any_number{};

/// A whole number if there is no event.
struct PutSum {
  void operator()(JsonWriter& json, const auto& value) const {
    if (value) {
      json.put(*value);
    } else {
      json.put(0);
    }
  }
};

/// Mean, minimum and maximum of no event are null.
inline constexpr auto spread = [](auto to_unit, double in_a_unit) {
  const auto one = [](auto measure) {
    return [measure](const Measure& of) {
      return of.events > 0 ? std::optional(measure(of)) : std::nullopt;
    };
  };
  return object(
      "spread",
      "Sum, mean, minimum and maximum over the events; the last three are null if there was no "
      "event.",
      member("sum", Number<PutSum>{}, "",
             one([to_unit](const Measure& of) { return to_unit(of.spread.sum); })),
      member("mean", nullable(any_number), "", one([in_a_unit](const Measure& of) {
               return static_cast<double>(of.spread.sum) / static_cast<double>(of.events) /
                      in_a_unit;
             })),
      member("min", nullable(any_number), "",
             one([to_unit](const Measure& of) { return to_unit(of.spread.least); })),
      member("max", nullable(any_number), "",
             one([to_unit](const Measure& of) { return to_unit(of.spread.greatest); })));
};
inline constexpr auto counts = spread([](std::uint64_t sum) { return sum; }, 1);
inline constexpr auto times = spread(to_microseconds, 1000);

inline constexpr auto effort = [](std::uint64_t least_events) {
  return group(member("events", integer(static_cast<std::int64_t>(least_events)),
                      "Number of events that needed a search.", &SearchEffort::events),
               member("solutions", counts, "",
                      [](const SearchEffort& of) {
                        return Measure{of.solutions, of.events};
                      }),
               member("nodes", counts, "",
                      [](const SearchEffort& of) {
                        return Measure{of.nodes, of.events};
                      }),
               member("propagations", counts, "",
                      [](const SearchEffort& of) {
                        return Measure{of.propagations, of.events};
                      }),
               member("elapsed_us", times, "Times of the searches in microseconds.",
                      [](const SearchEffort& of) {
                        return Measure{of.nanoseconds, of.events};
                      }));
};

struct EffortOfKind {
  SearchTotals::Kind kind;
  const SearchEffort& effort;
};

inline constexpr auto effort_of_kind =
    object("effort_of_kind", "",
           member("verb", words_among({Verb::start, Verb::stop, Verb::finish}), "",
                  [](const EffortOfKind& of) { return of.kind.verb; }),
           member("origin", words(Origin::situation), "",
                  [](const EffortOfKind& of) { return of.kind.origin; }),
           part(
               [](const EffortOfKind& of) -> const auto& { return of.effort; }, effort(1)));

inline constexpr auto totals = object(
    "totals", "With --stats: the effort of the searches.", part(&SearchTotals::all, effort(0)),
    member("kinds", list(effort_of_kind), "The same for each kind of event that occurred.",
           [](const SearchTotals& of) {
             return [&of](const auto& put) {
               for (std::size_t kind = 0; kind < SearchTotals::kinds.size(); ++kind) {
                 const SearchEffort& of_kind = of.of_kind(kind);
                 if (of_kind.events > 0) put(EffortOfKind{SearchTotals::kinds[kind], of_kind});
               }
             };
           }));

inline constexpr auto process = object(
    "process", "With --stats: the resources that the process has used so far.",
    member("peak_memory_bytes", count, "Peak main memory in bytes.", &ProcessUsage::peak_memory),
    member("cpu_us", count, "CPU time of all its threads, including system time, in microseconds.",
           &ProcessUsage::cpu_time));

/// What --stats adds at the end.
inline constexpr auto statistics =
    group(member(
              "totals", totals, "", [](const SearchTotals& of) -> const auto& { return of; }),
          member("process", process, "", [](const SearchTotals&) { return process_usage(); }));

}  // namespace cbc::json
