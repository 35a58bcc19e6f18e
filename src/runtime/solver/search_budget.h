#pragma once

#include <chrono>
#include <cstdint>

namespace cbc {

/// What the search may still spend: decisions and time.
struct SearchBudget {
  std::uint64_t max_nodes = 0;  ///< 0: no limit
  bool has_deadline = false;
  std::chrono::steady_clock::time_point deadline;

  [[nodiscard]] bool is_spent(std::uint64_t nodes) const {
    if (max_nodes > 0 && nodes >= max_nodes) return true;
    return has_deadline && std::chrono::steady_clock::now() >= deadline;
  }
};

}  // namespace cbc
