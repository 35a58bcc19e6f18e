#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/reasons.h"
#include "runtime/explain/relaxed_trail.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/restarts.h"

namespace cbc {

/// Whether a problem has a solution; unknown at a limit of effort.
enum class Feasibility : std::uint8_t { no, yes, unknown };

/// Searches for a solution with only some of the reasons in force: the demands hold; otherwise
/// every task of the group may have any of its behaviors or none, and the reasons are all
/// constraints.
///
/// It learns a no-good from each failure, as LearningSearch does, together with the reasons that
/// the no-good was derived from, so that a proof of no solution yields the reasons that it used.
class ConflictSearch {
 public:
  /// `present`: by task of the group, its value index, or none.
  ConflictSearch(const CompiledCatalog& catalog, std::uint32_t group,
                 const std::vector<std::uint32_t>& present, Demands demands);

  /// Admits only solutions in which `task` runs and its performance is below `minimum`.
  void keep_below(TaskId task, Millionths minimum) {
    low_task_ = task;
    low_minimum_ = minimum;
  }

  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  /// The answer is unknown where it would take more than `most_effort`, or longer than to the
  /// deadline.
  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons, std::uint64_t most_effort,
                                  const Deadline& deadline = std::nullopt);

  /// After the answer yes: the values of a task and of all that it requires; empty if nothing needs
  /// the task.
  [[nodiscard]] std::vector<ValueId> values_of(TaskId task);

  /// After the answer no: by reason, whether the proof used it. The reasons that it used leave no
  /// solution by themselves.
  [[nodiscard]] const std::vector<std::uint8_t>& is_used() const { return is_used_; }

  /// Literals, reasons and values visited so far: a measure of time that does not depend on the
  /// machine.
  [[nodiscard]] std::uint64_t effort() const { return effort_ + trail_.effort(); }

 private:
  [[nodiscard]] bool begin(std::span<const Reason> reasons);
  [[nodiscard]] bool demand(const Demand& demand);
  void sort(std::span<const Reason> reasons);
  [[nodiscard]] bool apply(const Reason& reason, std::uint32_t index);

  [[nodiscard]] bool propagate(std::span<const Reason> reasons);
  [[nodiscard]] bool may_perform(const Reason& reason, std::uint32_t index);
  [[nodiscard]] bool may_reach(TaskId reached, Millionths minimum);
  void explain_performance(const RelaxedTrail::Cause& cause);

  [[nodiscard]] bool learn();
  [[nodiscard]] bool leave_dead_end();
  void note_activity();
  void restart();
  void begin_derivation();
  void add_cause(const RelaxedTrail::Cause& cause);
  void add_reason(std::uint32_t reason);
  void trace_facts(std::span<const Literal> facts);

  [[nodiscard]] TaskId choose_task() const;
  [[nodiscard]] std::uint32_t choose_value(TaskId task);
  [[nodiscard]] TaskId optional_factor() const;

  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t>& present_;
  const Demands demands_;
  TaskId low_task_ = none;
  Millionths low_minimum_ = 0;
  const TaskId first_task_;
  const TaskId end_task_;
  RelaxedTrail trail_;
  ConflictAnalysis analysis_;
  std::vector<std::uint32_t> performances_;  ///< the reasons of that kind
  std::vector<std::uint32_t> state_;         ///< the reasons that apply once
  std::uint64_t effort_ = 0;                 ///< apart from that of the trail

  std::vector<std::uint32_t> saved_;  ///< by task of the group: the value chosen last, or none
  Activities activities_;             ///< by task of the group
  Restarts restarts_;

  // The derivation of a no-good.
  std::vector<std::uint8_t> is_used_;  ///< by reason
  std::vector<std::uint32_t> used_;
  std::vector<Literal> facts_;
  std::vector<std::uint8_t> is_known_fact_;  ///< by variable
  std::vector<std::uint32_t> known_facts_;

  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<TaskId> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task of the group
  std::vector<Literal> literals_;
};

}  // namespace cbc
