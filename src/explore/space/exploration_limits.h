#pragma once

#include <cstdint>
#include <string>

namespace cbc {

/// Where an exploration ends although states are left. 0: no limit.
struct ExplorationLimits {
  std::uint64_t max_states = 0;
  std::uint64_t max_memory = 0;  ///< bytes, of controls, sets, moves and remembered decisions
  double seconds = 0;
};

/// What ended an exploration before its end.
enum class ExplorationEnd : std::uint8_t {
  max_states,
  max_memory,
  time_limit,
  too_many,  ///< there are no numbers left for states
  stopped    ///< by who was told the progress
};

/// What ended an exploration, in words: "ended by --max-states 1000".
[[nodiscard]] std::string describe_exploration_end(ExplorationEnd end,
                                                   const ExplorationLimits& limits);

struct ExplorationProgress {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::uint32_t depth = 0;
  std::uint64_t controls = 0;
};

}  // namespace cbc
