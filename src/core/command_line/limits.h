#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/command_line/command_line.h"
#include "core/support/budget.h"
#include "runtime/coordinator/coordinator.h"

// Options that several commands have: how answers are searched for, and when to give up.
namespace cbc::cli {

/// Of the search for the answer of an event.
struct SearchLimits {
  std::uint64_t max_solutions = 0;
  std::uint64_t max_nodes = 0;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;
};

/// Declares these options, and returns them.
std::vector<Option*> add_search_limits(Command& command, SearchLimits& limits);

[[nodiscard]] CoordinatorOptions coordinator_options(const SearchLimits& limits);

/// Of explorations of states.
struct StateLimits {
  std::uint64_t max_states = 0;
  std::string max_memory;
  std::string time_limit;

  [[nodiscard]] Budget budget() const;
  /// Bytes; without --max-memory three quarters of the memory of the machine, or 0 if that is
  /// unknown.
  [[nodiscard]] std::uint64_t memory() const;
  /// 0: no limit.
  [[nodiscard]] double seconds() const;
};

/// Declares these options, and returns them.
std::vector<Option*> add_state_limits(Command& command, StateLimits& limits);

}  // namespace cbc::cli
