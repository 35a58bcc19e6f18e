#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "compiled/count_constraints.h"

namespace cbc {

/// A catalog, or a group of it, in numbers.
struct CatalogNumbers {
  std::size_t tasks = 0;
  std::size_t behaviors = 0;
  std::uint32_t levels = 0;  ///< 1 + highest level of a task; 0 if there is no task
  ConstraintCount constraints;
  std::string search_space;  ///< product over the tasks of 1 + number of behaviors, an integer
};

struct CatalogSummary {
  CatalogNumbers total;
  std::vector<CatalogNumbers> groups;
};

[[nodiscard]] CatalogSummary summarize_groups(const CompiledCatalog& catalog);

/// The exclusivity lists of a group, as places in CompiledCatalog::cliques, by their first task.
[[nodiscard]] std::vector<std::uint32_t> cliques_of_group(const CompiledCatalog& catalog,
                                                          std::size_t group);

}  // namespace cbc
