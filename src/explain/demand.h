#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// What a configuration is asked for beside the constraints.
struct Demand {
  enum class Kind : std::uint8_t {
    run,     ///< the task runs
    stop,    ///< the task does not run
    has,     ///< the task runs with this value
    has_not  ///< the task does not run with this value
  };
  Kind kind = Kind::run;
  TaskId task = 0;
  std::uint32_t place = none;  ///< of the value among those of the task
};

/// Demands that hold together.
using Demands = std::vector<Demand>;

}  // namespace cbc
