#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "explain/reason.h"
#include "explain/relaxed_problem.h"
#include "lint/assignment_search.h"
#include "lint/liveness.h"

namespace cbc {

/// What the semantic checks of one catalog share.
class Semantics {
 public:
  /// All references must outlive this object.
  Semantics(const Catalog& catalog, AssignmentSearch& search, const Liveness& liveness,
            std::uint64_t max_nodes, Reporter& reporter);

  [[nodiscard]] const Catalog& catalog() const { return catalog_; }
  [[nodiscard]] const CompiledCatalog& compiled() const { return search_.catalog(); }
  [[nodiscard]] const Behavior& behavior(BehaviorId id) const {
    return catalog_.behaviors[compiled().behaviors[id].catalog_index];
  }
  [[nodiscard]] const Task& task(TaskId id) const {
    return catalog_.tasks[compiled().tasks[id].catalog_index];
  }
  [[nodiscard]] AssignmentSearch& search() { return search_; }
  [[nodiscard]] const Liveness& liveness() const { return liveness_; }
  [[nodiscard]] Reporter& reporter() { return reporter_; }

  /// Whether a finding says why a behavior is never active, a task never runs.
  [[nodiscard]] bool is_explained_behavior(BehaviorId id) const { return behaviors_[id]; }
  [[nodiscard]] bool is_explained_task(TaskId id) const { return tasks_[id]; }
  void explain_behavior(BehaviorId id) { behaviors_[id] = true; }
  void explain_task(TaskId id) { tasks_[id] = true; }

  /// A question about reasons: tasks of one group, of which at least one runs (with the value).
  struct Goal {
    TaskId task = none;
    std::uint32_t place = none;  ///< none: with any behavior
  };
  /// Whether one of the goals can be had with only some constraints in force.
  [[nodiscard]] Feasibility solve(std::span<const Goal> goals, std::span<const Reason> reasons);
  /// The same for a problem that was set up.
  [[nodiscard]] Feasibility solve(RelaxedProblem& problem, std::span<const Reason> reasons);

  /// A relaxed problem in which a task runs.
  [[nodiscard]] RelaxedProblem relaxed(const Goal& goal) const;

  /// Reports that a question took too many decisions.
  void report_undecided(const Range& range, const std::string& question);

 private:
  const Catalog& catalog_;
  AssignmentSearch& search_;
  const Liveness& liveness_;
  const std::uint64_t max_nodes_;
  Reporter& reporter_;
  std::vector<bool> behaviors_;
  std::vector<bool> tasks_;
  const std::vector<std::uint32_t> nothing_present_;
  std::uint64_t effort_left_;
  bool has_told_exhaustion_ = false;
};

}  // namespace cbc
