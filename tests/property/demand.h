#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace cbc::oracle {

/// Throws std::runtime_error with `otherwise` if what must hold does not.
inline void demand(bool holds, const std::string& otherwise) {
  if (!holds) throw std::runtime_error(otherwise);
}

template <typename Items, typename Item>
[[nodiscard]] bool contains(const Items& items, const Item& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

}  // namespace cbc::oracle
