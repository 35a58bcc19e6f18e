#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cbc/units.h"

namespace cbc {

/// At most one due time for each of a fixed number of items; the earliest comes first, of equal
/// ones the lowest item. A binary heap that knows where each item is, so that nothing is allocated
/// after construction.
class Timers {
 public:
  using Item = std::uint32_t;

  explicit Timers(std::size_t items);

  void set(Item item, Microseconds due);
  void remove(Item item);

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] bool has(Item item) const { return place_[item] != absent; }
  [[nodiscard]] Item first() const { return heap_.front().second; }
  [[nodiscard]] Microseconds first_due() const { return heap_.front().first; }
  /// Needs has(item).
  [[nodiscard]] Microseconds due(Item item) const { return heap_[place_[item]].first; }
  /// All entries, in no particular order.
  [[nodiscard]] const std::vector<std::pair<Microseconds, Item>>& entries() const { return heap_; }

 private:
  static constexpr std::uint32_t absent = UINT32_MAX;

  void put(std::uint32_t place, const std::pair<Microseconds, Item>& entry);
  void sift_up(std::uint32_t place);
  void sift_down(std::uint32_t place);

  std::vector<std::pair<Microseconds, Item>> heap_;
  std::vector<std::uint32_t> place_;  ///< by item
};

}  // namespace cbc
