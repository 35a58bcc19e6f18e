#pragma once

#include <cstdint>
#include <optional>

#include "cbc/units.h"
#include "coordinator/coordinator.h"

namespace cbc {

/// What the random event sequences of a sweep look like.
struct SweepShape {
  std::uint32_t events = 100;   ///< scripted ones in each sequence; those of the clock come on top
  std::int32_t priorities = 3;  ///< requests have priorities from 1 to this
  Millionths failures = 300'000;  ///< probability that a finish is a failure
  Millionths faults = 100'000;    ///< probability that an event is a situation, fault or repair

  bool operator==(const SweepShape&) const = default;
};

/// How the coordinator is to search in a sweep: those of its options by which nothing depends on
/// the clock of the machine.
struct SweepSearch {
  std::uint64_t max_solutions = 0;
  std::uint64_t max_nodes = 0;
  std::optional<std::uint64_t> tie_seed;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;  ///< in each sequence

  bool operator==(const SweepSearch&) const = default;
};

/// Which share of the sequences is run: share `index` (from 1) of `count`.
struct SweepShard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;

  bool operator==(const SweepShard&) const = default;
};

/// All that the result of a sweep on a catalog depends on.
struct SweepSettings {
  std::uint64_t sequences = 1;
  std::uint64_t seed = 1;
  SweepShape shape;
  SweepSearch search;
  SweepShard shard;
};

}  // namespace cbc
