#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/problem.h"

namespace cbc::test {

/// Solves the problem of one group by going through all assignments, one test for each sentence of
/// the rules. It shares nothing with the solver but the question. Products are exact for groups of
/// up to 6 tasks.
class BruteForce {
 public:
  /// `ranks`: by value, its place in the order of its task; empty: as the values stand.
  BruteForce(const CompiledCatalog& catalog, const Problem& problem,
             std::vector<std::uint32_t> ranks = {});

  /// All solutions, depth first: tasks in catalog order, values by rank.
  [[nodiscard]] const std::vector<Assignment>& solutions() const { return solutions_; }
  /// Of all solutions, or of the first `among`.
  [[nodiscard]] std::optional<Assignment> best(std::size_t among = SIZE_MAX) const;

  /// Whether all constraints hold; domains are another matter.
  [[nodiscard]] bool is_valid(const Assignment& answer) const;
  [[nodiscard]] bool is_in_domains(const Assignment& answer) const;

 private:
  [[nodiscard]] BehaviorId behavior(const Assignment& answer, std::uint32_t task) const;
  [[nodiscard]] bool performs(const Assignment& answer, std::uint32_t task,
                              Millionths minimum) const;
  [[nodiscard]] bool has(std::uint32_t task, std::uint32_t place) const;
  /// The values of a domain ("not running" too) in the order of rule 5.
  [[nodiscard]] std::vector<std::uint32_t> ordered_domain(std::uint32_t task) const;
  [[nodiscard]] bool is_better(const Assignment& a, const Assignment& b) const;
  [[nodiscard]] std::uint32_t count_changes(const Assignment& answer) const;
  void enumerate(std::uint32_t task);

  const CompiledCatalog& catalog_;
  const Problem& problem_;
  std::vector<std::uint32_t> ranks_;
  TaskId first_ = 0;
  std::uint32_t tasks_ = 0;
  std::vector<std::vector<std::uint32_t>> ordered_;
  Assignment present_;  ///< of the enumeration
  std::vector<Assignment> solutions_;
};

}  // namespace cbc::test
