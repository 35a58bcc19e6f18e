#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "coordinator/search_totals.h"
#include "report/process_usage.h"
#include "text/style.h"

namespace cbc {

/// What searches took, as a table for a person: for each kind of event that there was, and for all,
/// the number of events, and mean, least and greatest of each measure. Below it what the process
/// took.
[[nodiscard]] std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage,
                                      const Style& style);

/// What one search took, in a line.
[[nodiscard]] std::string stats_line(const SearchRecord& search);

/// The same as the table, without the process: {"events", "solutions", "nodes", "propagations",
/// "elapsed_us", "kinds"}. Each measure is {"sum", "mean", "min", "max"}, the last three null where
/// there was no event; each of the kinds that there were has "verb", "origin", and the same
/// measures.
[[nodiscard]] nlohmann::ordered_json stats_to_json(const SearchTotals& totals);

/// {"peak_memory_bytes", "cpu_us"}
[[nodiscard]] nlohmann::ordered_json usage_to_json(const ProcessUsage& usage);

/// Microseconds, exact to the nanosecond.
[[nodiscard]] double to_microseconds(std::uint64_t nanoseconds);

}  // namespace cbc
