#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "core/check/proofs.h"
#include "core/check/together.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/conflict_search.h"
#include "runtime/explain/reasons.h"
#include "runtime/solver/problem.h"

/// The search behind the table of pairs, and behind the rules about tasks that run together.
namespace cbc {

/// The situation variables, ascending, that behaviors name with which some tasks, and what these
/// require, run. No others matter to the tasks.
[[nodiscard]] std::vector<std::uint32_t> variables_of(const CompiledCatalog& catalog,
                                                      std::span<const TaskId> tasks);

/// Asks a question in the situations that differ in some variables, until the answer is not no. The
/// question gets the values of all variables. Past a limit of situations the answer is unknown.
using InSituation = std::function<Feasibility(std::span<const std::uint32_t>)>;
[[nodiscard]] Feasibility ask_in_situations(const CompiledCatalog& catalog,
                                            const std::vector<std::uint32_t>& variables,
                                            const InSituation& question);

/// Why there is no situation in which the demands hold together, with behaviors that fit: a minimal
/// set of requirements, minimum performances, exclusions, and conditions of behaviors. These are of
/// the kind `situation`, without a value. Empty if it takes too long to find. `effort_left` is
/// reduced by the work done.
[[nodiscard]] std::vector<Reason> conflict_in_all_situations(const CompiledCatalog& catalog,
                                                             const Demands& demands,
                                                             std::uint64_t& effort_left);

/// Answers questions about pairs of tasks, with every behavior available that fits in the
/// situation, which may be any.
///
/// The effort of one object is bounded: past it, answers are unknown and reasons are missing.
class TogetherSearch {
 public:
  /// Both must outlive this object.
  TogetherSearch(AssignmentSearch& search, const Liveness& liveness);

  /// `a` and `b` differ.
  [[nodiscard]] Together decide(TaskId a, TaskId b);

  /// Whether the constraints allow both, the situation aside. No list has both, and neither is
  /// dead.
  [[nodiscard]] Feasibility decide_by_constraints(TaskId a, TaskId b);

  /// Whether a task can run at all, in some situation.
  [[nodiscard]] Feasibility can_run(TaskId task);

  /// Place in CompiledCatalog::cliques of the first exclusivity list that has both tasks.
  [[nodiscard]] std::optional<std::uint32_t> find_list(TaskId a, TaskId b) const;

  /// Why two tasks never run together: a minimal set of constraints, in the order of the chain that
  /// they form. It begins with what `a` requires, then come exclusions and minimum performances,
  /// and last what `b` requires. Empty if it takes too long to find, or if the constraints allow
  /// both.
  [[nodiscard]] std::vector<Reason> find_reasons(TaskId a, TaskId b);
  /// The same where the constraints allow both, but not with behaviors that fit in one situation:
  /// with the conditions of behaviors.
  [[nodiscard]] std::vector<Reason> find_reasons_in_situations(TaskId a, TaskId b);

  /// Behaviors with which both tasks run. They can run together.
  struct Witness {
    BehaviorId a = none;
    BehaviorId b = none;
  };
  [[nodiscard]] Witness find_witness(TaskId a, TaskId b);

 private:
  [[nodiscard]] bool is_dead(TaskId task) const {
    return liveness_.of_task(task) == Liveness::State::dead;
  }
  [[nodiscard]] Feasibility decide_by_situations(TaskId a, TaskId b,
                                                 const std::vector<std::uint32_t>& variables);
  [[nodiscard]] Together why_not_in_situations(TaskId a, TaskId b,
                                               const std::vector<std::uint32_t>& variables);
  [[nodiscard]] Feasibility find(TaskId a, TaskId b, std::span<const std::uint32_t> situation);
  [[nodiscard]] Feasibility find_alone(TaskId task, std::span<const std::uint32_t> situation);
  [[nodiscard]] Feasibility solve(ConflictSearch& problem, std::span<const Reason> reasons);
  void note_running(TaskId first_of_group);

  AssignmentSearch& search_;
  const Liveness& liveness_;
  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t> nothing_present_;
  Assignment solution_;
  Witness witness_;                               ///< of the last search that found one
  std::unordered_set<std::uint64_t> compatible_;  ///< pairs that the constraints allow
  std::uint64_t effort_left_;
};

}  // namespace cbc
