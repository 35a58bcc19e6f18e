// What the constraints of a catalog make impossible, found by looking at every assignment of each
// of its groups: every behavior is available, every task free to run or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "enumeration.h"
#include "model.h"

namespace cbc::oracle {

struct Constraint {
  // That a task runs, and that it performs well enough if it does, are two constraints.
  enum class Kind { exclusive, requires_task, performance };

  Kind kind = Kind::exclusive;
  std::size_t task = 0;
  std::size_t other_task = none;  // of exclusive
  std::size_t behavior = none;    // whose requirement it is; none: the minimum of the task itself
  Millionths minimum = 0;         // of performance

  bool operator==(const Constraint&) const = default;
};

// Constraints of one group, by their place in LintOracle::constraints().
using ConstraintSet = std::uint64_t;

// An assignment of one group.
struct Row {
  std::vector<std::size_t> values;  // of all tasks of the catalog; none in other groups
  ConstraintSet violated = 0;
};

class LintOracle {
 public:
  // A group has at most 64 constraints and 10 tasks. Of several requirements of one task by one
  // behavior the strongest counts.
  explicit LintOracle(const CatalogFacts& facts);

  const CatalogFacts& facts() const { return facts_; }
  std::size_t group_of_behavior(std::size_t behavior) const {
    return facts_.group_of_behavior(behavior);
  }
  const std::vector<Constraint>& constraints(std::size_t group) const {
    return groups_[group].constraints;
  }
  ConstraintSet all(std::size_t group) const;
  // Those of the group for which a predicate holds.
  ConstraintSet those(std::size_t group, const std::function<bool(const Constraint&)>& holds) const;

  // The assignments of the group that satisfy all constraints of a set.
  bool any(std::size_t group, ConstraintSet in_force,
           const std::function<bool(const Row&)>& holds) const;
  bool can_run(std::size_t task, ConstraintSet in_force) const;
  bool can_have(std::size_t task, std::size_t behavior, ConstraintSet in_force) const;

  // The best performance of a task of all assignments in which it runs and that satisfy the
  // constraints of a set, as a fraction of 10^(6 * tasks of the group); nothing if there is none.
  std::optional<Integer> best_performance(std::size_t task, ConstraintSet in_force) const;
  Integer scale(std::size_t task) const;

 private:
  // Holds products of ten suitabilities.
  using Product = boost::multiprecision::uint256_t;

  struct Group {
    std::vector<std::size_t> tasks;
    std::vector<Constraint> constraints;
    std::vector<Row> rows;
  };

  void collect_constraints(Group& group) const;
  void enumerate(Group& group) const;
  bool holds(const Group& group, const Constraint& constraint, const Row& row) const;
  Product performance(const Group& group, const Row& row, std::size_t task) const;

  const CatalogFacts& facts_;
  std::vector<Group> groups_;
  std::vector<Product> powers_;  // of a million
};

}  // namespace cbc::oracle
