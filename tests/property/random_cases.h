// Random cases, each run by one of several workers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics.h"

namespace cbc::oracle {

struct Fault {
  std::uint64_t seed = 0;
  std::string report;
};

struct Results {
  Statistics statistics;
  std::vector<Fault> faults;
};

// Adds what happened in the case of a seed, and its faults.
using RunCase = void (*)(std::uint64_t seed, Results& results);

// How often something has to happen in 1000 cases for the comparison to mean anything.
struct LowerBound {
  const char* what;
  std::int64_t per_thousand;
};

// Runs the cases from the seed CBC_SEED on, CBC_PROPERTY_CASES of them. None may have a fault, and
// in enough of them what has to happen must happen often enough.
void run_random_cases(std::uint64_t default_cases, RunCase run_case,
                      std::span<const LowerBound> lower_bounds);

}  // namespace cbc::oracle
