#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// What was seen, beside the goals that were met: from this follows why others were not.
struct GoalFacts {
  GoalFacts() = default;
  GoalFacts(const CompiledCatalog& catalog, std::size_t goals);

  std::vector<std::uint8_t> performed;       ///< by value: its task ran with its behavior
  std::vector<std::uint8_t> fitted;          ///< by behavior: it fit some situation
  std::vector<std::uint8_t> misfitted;       ///< by behavior: it did not fit some situation
  std::vector<std::uint8_t> start_accepted;  ///< by task: a start of a script was
  std::vector<std::uint8_t> start_rejected;  ///< the same
  std::vector<std::uint8_t> started_itself;  ///< by task
  std::vector<std::uint8_t> gave_way;        ///< by task
  /// By goal about deciding: some event could have had another answer without the constraint, as
  /// far as one sees without a search.
  std::vector<std::uint8_t> was_asked;
  /// By value: another one that always times out before it, or none.
  std::vector<ValueId> forestalled_by;

  /// Adds what was seen elsewhere, but for timeouts.
  void add(const GoalFacts& other);
};

/// What an event has decided.
struct DecidedEvent {
  const Trigger& trigger;
  std::span<const BehaviorId> behaviors;  ///< before it, by task of its group; none: does not run
  /// The same: the priority, of a suspended request, too.
  std::span<const std::optional<std::int32_t>> requests;
  const Assignment& solution;
};

/// Notes which goals the answers to events meet. A mission on a coordinator and the moves of an
/// exploration note them here alike, so that a goal counts for the one exactly if it does for the
/// other. What depends on the environment, its owner notes.
class GoalNotes {
 public:
  using Kind = Goal::Kind;

  /// `goals` are those of find_goals. Catalog and goals must outlive this object.
  GoalNotes(const CompiledCatalog& catalog, std::span<const Goal> goals);

  /// Begins a mission, or a move that is looked at alone.
  void begin();
  void note(const DecidedEvent& event);
  /// A value has run into its timeout.
  void note_timeout(ValueId value);
  /// The behavior has failed, or an activation of it.
  void note_failure(BehaviorId behavior);
  void meet(Kind kind, std::uint32_t subject);
  void meet(std::uint32_t goal);
  /// The goal of a kind about a task, a behavior, or the place of a requirement or of a value among
  /// all; none if the catalog has no such goal. Not of those about deciding.
  [[nodiscard]] std::uint32_t find(Kind kind, std::uint32_t subject) const;
  /// Whether the reactive task has given way since begin().
  [[nodiscard]] bool has_given_way(TaskId task) const { return has_given_way_[task] != 0; }

  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return met_; }  ///< by goal
  /// The goals that were met, in the order in which they were.
  [[nodiscard]] const std::vector<std::uint32_t>& found() const { return found_; }
  /// Begins with goals anew.
  void forget();

  [[nodiscard]] const GoalFacts& facts() const { return facts_; }
  [[nodiscard]] GoalFacts& facts() { return facts_; }

 private:
  void note_values(const DecidedEvent& event);
  void note_stop(const DecidedEvent& event, TaskId task);
  void note_start(const DecidedEvent& event);
  void note_request(const DecidedEvent& event, LocalTask place);
  void note_improvement(const DecidedEvent& event, LocalTask place);

  const CompiledCatalog& catalog_;
  /// By kind and its subject: the goal, or none. See subject_of.
  std::array<std::vector<std::uint32_t>, Goal::kinds> places_;
  GoalFacts facts_;
  std::vector<std::uint8_t> met_;
  std::vector<std::uint32_t> found_;
  std::vector<std::uint8_t> has_given_way_;  ///< by task
  std::vector<std::uint8_t> was_active_;     ///< by behavior; kept for its memory
};

}  // namespace cbc
