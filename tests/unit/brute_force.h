#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "property/enumeration.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

namespace cbc::test {

/// Solves the problem of one group with the enumeration of the oracle, which knows neither compiled
/// catalogs nor value indices.
class BruteForce {
 public:
  BruteForce(const CompiledCatalog& catalog, const Problem& problem);

  /// All solutions, depth first: tasks in catalog order, values by rank.
  [[nodiscard]] const std::vector<Assignment>& solutions() const { return solutions_; }
  /// Of all solutions, or of the first `among`.
  [[nodiscard]] std::optional<Assignment> best(std::size_t among = SIZE_MAX) const;

  /// Whether the answer is in the domains and all constraints hold.
  [[nodiscard]] bool is_solution(const Assignment& answer) const;

 private:
  const TaskId first_task_;
  const oracle::CatalogFacts facts_;
  const oracle::Problem problem_;
  const std::vector<oracle::Solution> evaluated_;
  std::vector<Assignment> solutions_;
};

}  // namespace cbc::test
