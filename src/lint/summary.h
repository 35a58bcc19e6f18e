#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "compiled/count_constraints.h"

namespace cbc {

/// A catalog in numbers.
struct Summary {
  struct Group {
    std::vector<std::string> tasks;  ///< in catalog order
    std::uint64_t constraints = 0;
  };
  std::size_t tasks = 0;
  std::size_t behaviors = 0;
  ConstraintCount constraints;
  std::vector<Group> groups;  ///< in the order of their first task
  std::string search_space;   ///< product over all tasks of 1 + number of behaviors, an integer
};

[[nodiscard]] Summary summarize(const CompiledCatalog& catalog);

}  // namespace cbc
