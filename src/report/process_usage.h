#pragma once

#include <cstdint>

#include "cbc/units.h"

namespace cbc {

/// What this process has taken so far.
struct ProcessUsage {
  std::uint64_t peak_memory = 0;  ///< bytes of main memory, at most at one time
  Microseconds cpu_time = 0;      ///< of all threads, and of the system for them
};

[[nodiscard]] ProcessUsage process_usage();

}  // namespace cbc
