#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ask/ask.h"
#include "ask/situation_space.h"
#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

// What each fault, and each change of the situation, does to each task: its failure modes and
// effects (docs/verify.md, "Effects of faults").

namespace cbc {

struct EffectOptions {
  std::uint32_t order = 1;  ///< the most faults together
  /// Called before each search for an assignment, and now and then during a long one; false ends
  /// the whole search. May be empty.
  std::function<bool()> on_progress;
};

/// The best assignment in which a task runs alone, from idle: the value of each task of its group.
/// Empty: there is none.
using BestAssignment = std::optional<Assignment>;

/// What faults, or a change of the situation, do to a task.
struct Effect {
  enum class Kind : std::uint8_t {
    lost,      ///< it cannot run
    degraded,  ///< it runs with other behaviors, or what it requires does
    unchanged  ///< everything is as before
  };
  Kind kind = Kind::lost;
  BehaviorSet faults;                   ///< in catalog order; empty: see `change`
  std::optional<VariableValue> change;  ///< the new value of a variable
  BestAssignment best;                  ///< with these faults, in this situation
};

/// "lost", "degraded", "none".
[[nodiscard]] std::string_view name_of(Effect::Kind kind);

/// The effects on a task, those that change nothing left out.
struct TaskEffects {
  TaskId task;
  BestAssignment best;  ///< without faults
  /// First of sets of faults, by size, then in catalog order; an effect that a part of the set has
  /// is left out. Then of the changes, in catalog order. If the task cannot run even without a
  /// fault: only that it is lost, without faults.
  std::vector<Effect> effects;
  bool complete = false;  ///< false: the search was stopped
};

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
