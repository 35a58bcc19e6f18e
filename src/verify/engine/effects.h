#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ask/ask.h"
#include "ask/situation_space.h"
#include "cbc/event.h"
#include "core/support/budget.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

// What faults, and changes of the situation, do to a task: its failure modes and effects
// (docs/verify.md, "Effects of faults"). Those that make it impossible are its minimal cut sets
// ("Cut sets"). Both come from one search, so that they cannot contradict each other.

namespace cbc {

struct EffectOptions {
  std::uint32_t order = 1;  ///< the most faults together
  /// Of cut sets: also those that suffice in some of the situations.
  bool in_some_situation = false;
  /// Asked before each search for an assignment, and now and then during a long one. It is told the
  /// name of the task.
  Budget budget = {};
};

/// The best assignment in which a task runs alone, from idle: the value of each task of its group.
/// Empty: there is none, or none was sought.
using BestAssignment = std::optional<Assignment>;

/// What faults, or a change of the situation, do to a task.
struct Effect {
  enum class Kind : std::uint8_t {
    lost,      ///< it cannot run
    degraded,  ///< it runs with other behaviors, or what it requires does
    unchanged  ///< everything is as before
  };
  Kind kind = Kind::lost;
  BehaviorSet faults;  ///< in catalog order
  /// Of a cut set: the values under which it suffices, in catalog order, one of a variable; none:
  /// in every situation. Otherwise of a change the new value.
  std::vector<VariableValue> situation = {};
  BestAssignment best = {};  ///< with these faults, in this situation

  [[nodiscard]] bool operator==(const Effect&) const = default;
};

/// "lost", "degraded", "none".
[[nodiscard]] std::string_view name_of(Effect::Kind kind);

/// The effects on a task, those that change nothing left out.
struct TaskEffects {
  TaskId task;
  BestAssignment best = {};  ///< without faults
  /// First of sets of faults, by size, then in catalog order, then by the values; an effect that a
  /// part of the set has, under the same values or fewer, is left out. Then of the changes, in
  /// catalog order. Lost without faults: the task cannot run anyway.
  std::vector<Effect> effects = {};
  bool complete = false;  ///< false: the search was stopped
  /// If not complete: all effects of fewer faults and values than this are there.
  std::uint32_t incomplete_size = 0;
  std::uint64_t searches = 0;  ///< for assignments
};

/// The minimal cut sets of a task: the effects `lost` of sets of faults in all of the situations,
/// or in some of them. In none of these there is an assignment that satisfies all constraints and
/// runs the task with behaviors that are available there, none of which is in the set.
[[nodiscard]] TaskEffects find_cut_sets(const SituationSpace& situations, TaskId task,
                                        const EffectOptions& options);

/// The situation from which the changes are: of every variable a value, be it the first one.
[[nodiscard]] SituationPart complete_situation(const CompiledCatalog& catalog, SituationPart given);

/// The single changes of a complete situation that do not lead into one that never occurs, in
/// catalog order.
[[nodiscard]] std::vector<VariableValue> changes_of(const CompiledCatalog& catalog,
                                                    const SituationPart& situation,
                                                    std::span<const SituationPart> never);

/// The effects of faults, and of some changes of the situation. `situation`: a complete one.
[[nodiscard]] TaskEffects find_effects(const CompiledCatalog& catalog, TaskId task,
                                       const SituationPart& situation,
                                       std::span<const VariableValue> changes,
                                       const EffectOptions& options);

/// The suitabilities of which the objective f2 of an assignment is the product; those of 100 % left
/// out.
[[nodiscard]] std::vector<Millionths> suitabilities_of(const CompiledCatalog& catalog, TaskId task,
                                                       const Assignment& assignment);

/// Compares two products of suitabilities exactly: whether the first is below so many thousandths
/// of the second.
[[nodiscard]] bool is_below(std::span<const Millionths> product, std::span<const Millionths> whole,
                            std::uint32_t thousandths);

}  // namespace cbc
