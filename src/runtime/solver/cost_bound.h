#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/components.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// Stands for the cost of a suitability of 0, which makes the whole product 0: more than any sum of
/// others.
inline constexpr std::int64_t prohibitive_cost = std::int64_t{1} << 61;

/// A lower bound on the cost of the needed tasks and all that they require, by dual ascent: what a
/// cut is, and what its arcs are, says cost_bound.cpp.
class CostBound {
 public:
  /// Costs in lexicographic order: -log of f2, then the number of idle tasks that run (f3).
  struct Cost {
    std::int64_t log = 0;
    std::int64_t idle = 0;
    auto operator<=>(const Cost&) const = default;
    Cost& operator+=(const Cost& other);
    Cost& operator-=(const Cost& other);
  };

  CostBound(const CompiledCatalog& catalog, const Domains& domains, const Components& components);

  /// Whose cost is bounded: the present component, or the rest of the component around it.
  enum class Roots : std::uint8_t { in_component, around_component };

  /// A lower bound on the cost of every solution of the present subtree. The ascent ends as soon as
  /// the bound exceeds `threshold`, and after millions of steps: in a group of n tasks it may take
  /// n^2.
  [[nodiscard]] Cost bound(const Cost& threshold, Roots roots);

  /// After a bound that did not exceed its threshold: an estimate of what a value of the domain
  /// costs beyond the bound. 0 for the values that the bound assumes.
  [[nodiscard]] Cost reduced_cost(LocalTask task, std::uint32_t index);

 private:
  /// A task on the path down from the root of a cut.
  struct Visit {
    LocalTask task;
    std::uint32_t index = 0;        ///< of its value under consideration
    std::uint32_t requirement = 0;  ///< of that value
  };
  enum class Step : std::uint8_t { descend, settled, cut };

  [[nodiscard]] bool is_root(LocalTask task, Roots roots) const;
  [[nodiscard]] Cost least_residual(LocalTask task);
  void open(LocalTask task);
  [[nodiscard]] bool is_settled(LocalTask task) const;
  [[nodiscard]] bool collect_cut(LocalTask root);
  [[nodiscard]] Step advance(Visit& visit, LocalTask& target);
  void begin_visit(LocalTask task);
  [[nodiscard]] bool requires_cut(const Value& value) const;
  [[nodiscard]] Cost subtract_cut_minimum();
  [[nodiscard]] Cost& residual(LocalTask task, std::uint32_t index);

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  const Components& components_;
  std::vector<Cost> residual_;         ///< by value of the group: cost not yet charged
  std::vector<std::uint64_t> opened_;  ///< by task: last bound that has set its residual_
  std::vector<std::uint64_t>
      settled_;                        ///< by task: last bound in which it runs at no residual cost
  std::vector<std::uint64_t> in_cut_;  ///< by task: last cut it was in
  std::vector<LocalTask> cut_;
  std::vector<Visit> visits_;
  std::uint64_t bound_number_ = 0;
  std::uint64_t cut_number_ = 0;
};

/// What the cost bound has to exceed to prove that nothing better than the incumbent is left where
/// it serves the same requests. `tasks`: of the group.
[[nodiscard]] CostBound::Cost pruning_threshold(const Incumbent& incumbent, std::uint32_t tasks);

}  // namespace cbc
