#pragma once

#include <cstdint>

#include "solver/problem.h"

namespace cbc {

/// The objectives of a solution, over the whole catalog. f2 is a property of the values.
struct ObjectiveValues {
  std::uint32_t satisfied = 0;     ///< r of f1
  std::uint32_t requests = 0;      ///< n of f1
  std::uint32_t idle_total = 0;    ///< t of f3
  std::uint32_t idle_running = 0;  ///< a of f3
  std::uint32_t changes = 0;       ///< c of f4
};

/// A solution of the problem of a group, with its objectives.
struct Configuration {
  Assignment places;
  ObjectiveValues objective;
};

}  // namespace cbc
