#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/derive.h"

/// From the catalog that people write to the one that the solver uses, and how large a catalog is:
/// tasks, behaviors, groups, constraints, search space.
namespace cbc {

/// Works out everything that does not depend on the situation. `catalog` is one that read_catalog
/// accepted, so its requirements are not cyclic.
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog);
/// The same for one of many catalogs that have most of their numbers in common.
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog, KnownCosts& costs);

/// Number of constraints, counted as in the paper.
struct ConstraintCount {
  std::uint64_t exclusive_pairs = 0;  ///< distinct unordered pairs of different tasks
  std::uint64_t requirements = 0;     ///< distinct (behavior, task)
  std::uint64_t task_minimums = 0;
  std::uint64_t limits = 0;  ///< lists of which more than one task may run

  [[nodiscard]] std::uint64_t total() const {
    return exclusive_pairs + requirements + task_minimums + limits;
  }
};

/// The product of domain sizes, in decimal digits.
[[nodiscard]] std::string search_space(const std::vector<std::uint32_t>& domain_sizes);

/// A catalog, or a group of it, in numbers.
struct CatalogNumbers {
  std::size_t tasks = 0;
  std::size_t behaviors = 0;
  std::uint32_t levels = 0;  ///< 1 + highest level of a task; 0 if there is no task
  ConstraintCount constraints;
  std::string search_space;  ///< product over the tasks of 1 + number of behaviors, an integer
  std::vector<std::string> task_names;  ///< of a group, in catalog order
};

struct CatalogSummary {
  CatalogNumbers total;
  std::vector<CatalogNumbers> groups;  ///< in the order of their first task
};

[[nodiscard]] CatalogSummary summarize(const CompiledCatalog& catalog);

/// The limits of which a task is the first one.
[[nodiscard]] std::vector<std::uint32_t> limits_from(const CompiledCatalog& catalog, TaskId task);

/// The exclusivity lists of a group, as places in CompiledCatalog::cliques, by their first task.
[[nodiscard]] std::vector<std::uint32_t> cliques_of_group(const CompiledCatalog& catalog,
                                                          std::size_t group);

}  // namespace cbc
