#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/problem.h"

namespace cbc {

/// The order of the values of each task that decides where all objectives are equal (rule 5).
class CanonicalOrder {
 public:
  /// `ranks`: by value, place in the order of its task; empty: as the values stand.
  CanonicalOrder(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks);

  /// Takes up a problem. Allocates nothing.
  void load(const Problem& problem);

  /// Order of a value (or none) of a task: lower is better, and no two values have the same.
  [[nodiscard]] std::uint32_t key(std::uint32_t task, std::uint32_t place) const {
    if (place == none) return empty_first_[task] != 0 ? 0 : none;
    if (place == kept_first_[task]) return 0;
    if (ranks_.empty()) return place + 1;
    return ranks_[catalog_.values.begin[first_task_ + task] + place] + 1;
  }

 private:
  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t>& ranks_;
  TaskId first_task_ = 0;
  std::vector<std::uint8_t> empty_first_;  ///< by task: "not running" comes first
  std::vector<std::uint32_t> kept_first_;  ///< by task: the place that comes first, or none
};

}  // namespace cbc
