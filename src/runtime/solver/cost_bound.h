#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/components.h"
#include "solver/domains.h"
#include "solver/problem.h"

namespace cbc {

/// A lower bound on what the needed tasks cost together with all that they will come to require, by
/// dual ascent.
///
/// Let a cut be any set of tasks with a needed one in it. Every solution runs some task of the cut
/// with a behavior that requires no task of the cut: follow the requirements inside the cut, from
/// the needed task down; they end, as the catalog is acyclic. So the cheapest of these behaviors,
/// the ways out of the cut, is a lower bound. Its cost is taken off all ways out, which cannot be
/// charged for it again, and the next cut is one whose ways out still cost something, until each
/// needed task has a way down that costs nothing any more.
class Lookahead {
 public:
  /// Cost in lexicographic order: -log of f2, then a of f3.
  struct Cost {
    std::int64_t log = 0;
    std::int64_t idle = 0;
    auto operator<=>(const Cost&) const = default;
    Cost& operator+=(const Cost& other);
    Cost& operator-=(const Cost& other);
  };

  Lookahead(const CompiledCatalog& catalog, const Domains& domains, const Parts& parts);

  /// Whose cost is bounded: that of the present part, or that of the rest of the part around it.
  enum class Roots : std::uint8_t { in_part, around_part };

  /// A bound on the cost in every solution of the present subtree. The ascent ends as soon as the
  /// bound exceeds `enough`.
  [[nodiscard]] Cost bound(const Cost& enough, Roots roots);

  /// After a bound that did not exceed `enough`: what a value of the domain costs beyond it, at a
  /// guess. 0 for the values on the cheapest ways that the bound knows of.
  [[nodiscard]] Cost reduced_cost(std::uint32_t task, std::uint32_t place);

 private:
  /// A task on the way down from the root of a cut.
  struct Visit {
    std::uint32_t task = 0;
    std::uint32_t place = 0;        ///< of the value looked at
    std::uint32_t requirement = 0;  ///< of that value, the one looked at
  };
  enum class Step : std::uint8_t { descend, settled, cut };

  [[nodiscard]] bool is_root(std::uint32_t task, Roots roots) const;
  [[nodiscard]] Cost cheapest_left(std::uint32_t task);
  void open(std::uint32_t task);
  [[nodiscard]] bool is_settled(std::uint32_t task) const;
  [[nodiscard]] bool collect_cut(std::uint32_t root);
  [[nodiscard]] Step go_on(Visit& visit, std::uint32_t& target);
  void begin_visit(std::uint32_t task);
  [[nodiscard]] bool requires_cut(const Value& value) const;
  [[nodiscard]] Cost lower_cut();
  [[nodiscard]] Cost& left(std::uint32_t task, std::uint32_t place);

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  const Parts& parts_;
  std::vector<Cost> left_;              ///< by value of the group: cost not yet taken off
  std::vector<std::uint64_t> opened_;   ///< by task: last bound for which left_ was set
  std::vector<std::uint64_t> settled_;  ///< by task: last bound in which it ran at no cost
  std::vector<std::uint64_t> in_cut_;   ///< by task: last cut it was in
  std::vector<std::uint32_t> cut_;
  std::vector<Visit> visits_;
  std::uint64_t bound_number_ = 0;
  std::uint64_t cut_number_ = 0;
};

}  // namespace cbc
