#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/trail.h"

namespace cbc {

/// Bounds the performance of a task in the present subtree from above: by the product of the best
/// suitabilities of the task and of all that it requires with every behavior it has left (its
/// closure). By these bounds minimum performances are propagated.
class PerformanceBound {
 public:
  struct Bound {
    bool reachable = true;  ///< false: a task of the closure cannot run
    bool zero = false;
    std::int64_t cost = 0;
    std::uint32_t factors = 0;
  };
  /// What asks for a minimum: a task that runs, or the value that it has; or nothing that holds.
  struct Demand {
    LocalTask task = none;
    std::uint32_t index = none;
  };

  PerformanceBound(const CompiledCatalog& catalog, const Domains& domains);

  /// Applies all minimums that hold if the task runs: its own, and those of its behaviors.
  /// `Changes` refuses demands that cannot be met, and removes values that are too low for a
  /// demand, or that themselves demand too much. False if it returns that.
  template <typename Changes>
  [[nodiscard]] bool revise(LocalTask task, Changes& changes);

  /// The tasks of the closures of all bounds so far: what they took.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }
  /// The tasks of the last bound; the last of them is the one that cannot run, if any.
  [[nodiscard]] const std::vector<LocalTask>& closure() const { return closure_; }

 private:
  [[nodiscard]] Bound bound(LocalTask task);
  [[nodiscard]] bool is_below(const Bound& bound, Millionths minimum, std::int64_t minimum_cost);
  template <typename Changes>
  [[nodiscard]] bool enforce(LocalTask task, Millionths minimum, std::int64_t minimum_cost,
                             Demand demand, Changes& changes);
  [[nodiscard]] bool is_too_low(const Bound& bound, LocalTask task, std::uint32_t index,
                                std::int64_t minimum_cost) const;

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  std::vector<LocalTask> closure_;
  std::vector<std::uint64_t> in_closure_;  ///< by task: number of the last closure it was in
  std::uint64_t closure_number_ = 0;
  std::uint64_t effort_ = 0;
  ExactProduct product_;
  ExactProduct minimum_;
};

/// Removes values that no solution has, to a fixed point. Each exclusivity list, which is a clique,
/// and each requirement, which is an arc between domains, becomes arc consistent (GAC); a minimum
/// performance is propagated by bounds.
class Propagator {
 public:
  Propagator(const CompiledCatalog& catalog, Domains& domains);

  void load(const Problem& problem);

  /// False: there is no solution in this subtree. True where every needed task has one behavior
  /// left: these behaviors, with all other tasks not running, are a solution.
  [[nodiscard]] bool propagate();

  /// Revisions of tasks since the last load.
  [[nodiscard]] std::uint64_t propagations() const { return propagations_; }
  [[nodiscard]] std::uint64_t performance_effort() const {
    return performance_.effort() - effort_before_;
  }

 private:
  [[nodiscard]] bool revise(LocalTask task);
  [[nodiscard]] bool close_limited(std::uint32_t limit);
  [[nodiscard]] bool revise_performance();

  const CompiledCatalog& catalog_;
  Domains& domains_;
  bool has_performance_rules_ = false;
  std::uint64_t propagations_ = 0;
  std::uint64_t effort_before_ = 0;      ///< of performance_, in earlier problems
  std::vector<std::uint8_t> has_rules_;  ///< by group
  PerformanceBound performance_;
};

/// The trail of a search for the best solution: all constraints of the catalog but the minimum
/// performances apply, and infer what the propagator does.
class CatalogTrail final : public Trail {
 public:
  CatalogTrail(const CompiledCatalog& catalog, Domains& domains) : Trail(catalog, domains) {}

  /// Begins with the facts of the problem; the domains must be loaded. Forgets all no-goods. False:
  /// see conflict().
  [[nodiscard]] bool load(const Problem& problem);
  /// The tasks with a request, most important first.
  [[nodiscard]] std::span<const LocalTask> requests() const { return requests_; }

 private:
  [[nodiscard]] bool follow_running(LocalTask task) override;
  [[nodiscard]] bool follow_not_running(LocalTask task) override;
  [[nodiscard]] bool follow_value(LocalTask task, ValueId value) override;
  [[nodiscard]] bool follow_choice(LocalTask task) override;

  std::span<const LocalTask> requests_;
};

/// Propagates minimum performances as the propagator does, on a trail: the reasons are the removals
/// that lowered the best suitabilities, and those that left only values that require a task.
class PerformanceReasons {
 public:
  PerformanceReasons(const CompiledCatalog& catalog, const Domains& domains, Trail& trail);

  void load();
  /// To be called at a fixpoint of the trail; there may be more to propagate afterwards, or if no
  /// time is left. False: see the trail's conflict.
  [[nodiscard]] bool propagate(const SearchBudget& budget = {});

 private:
  friend PerformanceBound;
  using Demand = PerformanceBound::Demand;

  [[nodiscard]] bool is_chosen(LocalTask task, std::uint32_t index) const {
    return trail_.is_true(trail_.has_value(task, index));
  }
  [[nodiscard]] bool refuse(const Demand& demand);
  [[nodiscard]] bool remove(LocalTask task, std::uint32_t index, const Demand& demand);
  void explain_bound(const Demand& demand);
  [[nodiscard]] bool is_in_reason(LocalTask task, std::uint32_t index) const;

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  Trail& trail_;
  PerformanceBound performance_;
  std::vector<LocalTask> ruled_;  ///< tasks with a minimum, or a behavior that requires one
  std::vector<Literal> reason_;
};

}  // namespace cbc
