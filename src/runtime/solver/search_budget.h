#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace cbc {

/// Limits of decisions and time, of one search or of several in a row.
struct SearchBudget {
  std::uint64_t max_nodes = 0;     ///< 0: no limit
  std::uint64_t nodes_before = 0;  ///< of earlier searches
  std::optional<std::chrono::steady_clock::time_point> deadline;

  /// `nodes`: of the present search.
  [[nodiscard]] bool has_nodes_left(std::uint64_t nodes) const {
    return max_nodes == 0 || nodes_before + nodes < max_nodes;
  }
  [[nodiscard]] bool is_out_of_time() const {
    return deadline && std::chrono::steady_clock::now() >= *deadline;
  }
  [[nodiscard]] bool is_spent(std::uint64_t nodes) const {
    return !has_nodes_left(nodes) || is_out_of_time();
  }
};

}  // namespace cbc
