#pragma once

#include <array>
#include <cstddef>

#include "compiled/log_cost.h"

namespace cbc {

/// log_cost with a small memory: catalogs have few different degrees.
class KnownCosts {
 public:
  std::int64_t of(Millionths degree) {
    Entry& entry = entries_[(degree * 2654435769U) >> 24U];
    if (entry.degree != degree) entry = {degree, log_cost(degree)};
    return entry.cost;
  }

 private:
  struct Entry {
    Millionths degree = 0;  ///< what is not known yet says what is true of 0
    std::int64_t cost = 0;
  };
  std::array<Entry, 256> entries_{};
};

}  // namespace cbc
