#pragma once

#include <cstdint>
#include <string>

#include "cbc/units.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/runner.h"
#include "runtime/coordinator/record.h"

// The effort of searches, for --stats.

namespace cbc {

/// The resources that this process has used so far.
struct ProcessUsage {
  std::uint64_t peak_memory = 0;  ///< bytes of main memory, at its peak
  Microseconds cpu_time = 0;      ///< of all threads, user and system
};

[[nodiscard]] ProcessUsage process_usage();

/// The effort of searches as a table for people: for each kind of event that occurred, and for all,
/// the number of events and the mean, minimum and maximum of each measure; below it the resources
/// of the process.
[[nodiscard]] std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage,
                                      const Style& style);

/// The effort of one search, in one line.
[[nodiscard]] std::string stats_line(const SearchRecord& search);

/// Microseconds, exact to the nanosecond.
[[nodiscard]] double to_microseconds(std::uint64_t nanoseconds);

}  // namespace cbc
