#pragma once

#include <span>
#include <string>
#include <vector>

#include "ask/ask.h"
#include "ask/conflict/reasons.h"
#include "ask/liveness.h"
#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

/// What the constraints of a catalog make impossible or redundant: decided exactly, by search.
/// First the checks, then what they share.
namespace cbc {

/// All checks of a catalog whose names were all understood, and whose requirements have no cycle.
/// Their order is a rule: what one of them explains (ProofContext), those after it leave out, so
/// the most special check comes first. `conflicts`: by behavior, whether a finding already says
/// that it can never be active.
void check_by_proof(const CatalogReading& reading, const CompiledCatalog& compiled,
                    const std::vector<bool>& conflicts, const LintOptions& options,
                    Reporter& reporter);

/// The one check that is possible without a compiled catalog: reports requirements of tasks that
/// start on request only. Only the required task itself is known to be requested first.
void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter);

class ProofContext;

/// One of these checks: tasks and behaviors that the constraints allow, but that fit, with what
/// they require, in no situation.
void check_situations(ProofContext& proof);

/// The checks about tasks that run at the same time. `is_complete`: all of the catalog was
/// understood.
void check_together(ProofContext& proof, const LintOptions& options, bool is_complete);

/// What the proof checks of one catalog share, and what is explained so far.
class ProofContext {
 public:
  /// All references must outlive this object.
  ProofContext(const Catalog& catalog, AssignmentSearch& search, const Liveness& liveness,
               const LintOptions& options, Reporter& reporter);

  [[nodiscard]] const Catalog& catalog() const { return catalog_; }
  [[nodiscard]] const CompiledCatalog& compiled() const { return search_.catalog(); }
  [[nodiscard]] const Behavior& behavior(BehaviorId id) const {
    return catalog_.behaviors[compiled().behaviors[id].catalog_index];
  }
  [[nodiscard]] const Task& task(TaskId id) const {
    return catalog_.tasks[compiled().tasks[id].catalog_index];
  }
  [[nodiscard]] AssignmentSearch& search() { return search_; }
  /// All situations.
  [[nodiscard]] const SituationSpace& space() const { return space_; }
  /// What proofs with some of the constraints may cost.
  [[nodiscard]] Effort& effort() { return effort_; }
  [[nodiscard]] const Liveness& liveness() const { return liveness_; }
  [[nodiscard]] Reporter& reporter() { return reporter_; }

  /// Whether a finding says why a behavior is never active, a task never runs.
  [[nodiscard]] bool is_explained_behavior(BehaviorId id) const { return behaviors_[id]; }
  [[nodiscard]] bool is_explained_task(TaskId id) const { return tasks_[id]; }
  void explain_behavior(BehaviorId id) { behaviors_[id] = true; }
  void explain_task(TaskId id) { tasks_[id] = true; }

  /// Whether a task runs with a value of it.
  [[nodiscard]] Demand has(ValueId value) const {
    const TaskId task = compiled().task_of(value);
    return {Demand::Kind::has, task, value - compiled().values.begin[task]};
  }
  /// Questions with only some of the constraints in force, one for each of some demands.
  [[nodiscard]] RelaxedQuestions relaxed(std::span<const Demand> demands);

  /// Notes that say, for each of a set of constraints, what it is and where it stands.
  [[nodiscard]] std::vector<Note> notes_of(std::span<const Reason> constraints) const;

  /// Reports that a question could not be decided within the limits.
  void report_undecided(const Range& range, const std::string& question);

 private:
  [[nodiscard]] Note note_of(const Reason& reason) const;
  [[nodiscard]] Note note_of_condition(const Reason& reason) const;

  const Catalog& catalog_;
  AssignmentSearch& search_;
  const Liveness& liveness_;
  const SituationSpace space_;
  const std::uint64_t max_nodes_;
  Reporter& reporter_;
  std::vector<bool> behaviors_;
  std::vector<bool> tasks_;
  Effort effort_;
  bool has_told_exhaustion_ = false;
};

}  // namespace cbc
