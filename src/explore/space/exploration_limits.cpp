#include "explore/space/exploration_limits.h"

#include <fmt/format.h>

namespace cbc {
namespace {

/// As --max-memory takes it: "512M".
std::string memory_with_unit(std::uint64_t bytes) {
  constexpr std::string_view units = " KMGT";
  std::size_t unit = 0;
  while (bytes % 1024 == 0 && unit + 1 < units.size()) {
    bytes /= 1024;
    ++unit;
  }
  return std::to_string(bytes) + std::string(unit > 0 ? units.substr(unit, 1) : "");
}

}  // namespace

std::string describe_exploration_end(ExplorationEnd end, const ExplorationLimits& limits) {
  switch (end) {
    case ExplorationEnd::max_states:
      return fmt::format("ended by --max-states {}", limits.max_states);
    case ExplorationEnd::max_memory:
      return fmt::format("ended by --max-memory {}", memory_with_unit(limits.max_memory));
    case ExplorationEnd::time_limit:
      return fmt::format("ended by --time-limit {}", limits.seconds);
    case ExplorationEnd::too_many:
      return "ended, as there are more states than can be counted";
    case ExplorationEnd::stopped:
      break;
  }
  return "interrupted";
}

}  // namespace cbc
