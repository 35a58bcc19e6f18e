#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

namespace cbc {

/// The catalog without the constraint of a goal about deciding. Tasks, behaviors, values and groups
/// have the numbers that they had, so that problems of the one are problems of the other.
[[nodiscard]] CompiledCatalog without_constraint(const CompiledCatalog& catalog, const Goal& goal);

/// So many catalogs without a constraint are kept at a time, at most, of one of this size.
[[nodiscard]] std::size_t most_variants_of(const CompiledCatalog& catalog);

/// Asks what the answer to an event of a coordinator would have been without some constraint, as
/// RelaxedDecisions does of a move of an exploration. Keeps the catalogs that it compiles for this,
/// as long as they do not become too large together. Not for use by several threads.
class ConstraintRelaxation {
 public:
  /// The limits and the order of ties are those of the coordinator. The catalog must outlive this.
  ConstraintRelaxation(const CompiledCatalog& catalog, const CoordinatorOptions& options);

  /// Takes up an event. `solution`: its answer, null if it was rejected. False: the answer is not
  /// proven, so that nothing can be asked.
  [[nodiscard]] bool load(const EventRecord& record, const Circumstances& circumstances,
                          const Assignment* solution);

  /// Whether the event could have another answer without the constraint of the goal, as far as one
  /// sees without a search.
  [[nodiscard]] bool may_matter(const Goal& goal) const;
  /// Whether the constraint of the goal, which is about the group of the event, decided it: without
  /// it the answer is another one. `number` tells goals apart.
  [[nodiscard]] bool decided(const Goal& goal, std::size_t number);
  /// Whether the start was rejected for the sake of requests of higher priority alone.
  [[nodiscard]] bool was_protection_alone();

 private:
  struct Variant {
    Variant(CompiledCatalog without, const SearchOptions& options)
        : catalog(std::move(without)), solver(catalog, options), asked(catalog) {}

    CompiledCatalog catalog;
    Solver solver;
    AskedProduct asked;
  };

  [[nodiscard]] bool may_run(TaskId task) const;
  [[nodiscard]] bool may_be_active(BehaviorId behavior) const;
  [[nodiscard]] Variant& variant_of(const Goal& goal, std::size_t number);

  const CompiledCatalog& catalog_;
  const SearchOptions options_;
  std::size_t most_variants_;
  std::unordered_map<std::size_t, std::unique_ptr<Variant>> variants_;
  Solver solver_;  ///< with all constraints

  // The event.
  std::vector<Problem> problems_;  ///< by protection level, up to that of the answer
  std::optional<Problem> unprotected_;
  const Assignment* solution_ = nullptr;
  bool is_unasked_ = false;  ///< a start that nobody asked for
  Assignment relaxed_;
};

}  // namespace cbc
