#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"
#include "solver/problem.h"

namespace cbc {

/// An event that needs a new assignment.
struct Trigger {
  enum class Kind : std::uint8_t { start, stop, finish };
  Kind kind = Kind::start;
  std::uint32_t group = 0;
  TaskId task = none;          ///< of start and stop
  BehaviorId behavior = none;  ///< of finish
  FinishCause cause = FinishCause::goal_achieved;
  std::int32_t priority = 0;    ///< of start and stop
  bool is_reactive = false;     ///< a start that may stop no requested task
  std::string_view parameters;  ///< that the task will have
};

/// Whether a task may not stop: its request is stronger than the protection level, or, where the
/// trigger is a reactive start, there is one at all.
[[nodiscard]] bool is_protected(const State& state, const Trigger& trigger, TaskId task,
                                std::int32_t protection);

/// Whether the behavior that has finished performed the task.
[[nodiscard]] bool has_finished(const State& state, const Trigger& trigger, TaskId task);

/// Turns a trigger and the state into the constraint problem of its group (semantics: section 4).
class Question {
 public:
  Question(const CompiledCatalog& catalog, const State& state);

  /// Takes up a trigger. `event` is its number, the most recent of all.
  void load(const Trigger& trigger, std::uint64_t event);

  /// A behavior that may not be chosen any more in this event.
  void exclude(BehaviorId behavior) { excluded_.push_back(behavior); }
  [[nodiscard]] const std::vector<BehaviorId>& excluded() const { return excluded_; }

  /// The first protection level to try.
  [[nodiscard]] std::int32_t first_protection() const { return first_protection_; }
  /// The lowest level above `level` that protects fewer tasks; none if all levels protect alike.
  [[nodiscard]] std::optional<std::int32_t> next_protection(std::int32_t level) const;

  /// The problem at a protection level. Valid until the next call.
  [[nodiscard]] const Problem& ask(std::int32_t protection);

  /// The behaviors that were active just before the event, in BehaviorId order; one that has
  /// finished is none of them.
  [[nodiscard]] const std::vector<BehaviorId>& active_before() const { return problem_.active; }
  [[nodiscard]] bool has_finished(TaskId task) const {
    return cbc::has_finished(state_, trigger_, task);
  }

 private:
  void find_active();
  void rank_requests(std::uint64_t event);
  void open_domain(TaskId task);
  void limit_domain(TaskId task, std::int32_t protection);
  void clear_excluded();

  [[nodiscard]] std::uint64_t& word_of(TaskId task, std::uint32_t place);
  void empty_domain(TaskId task);

  const CompiledCatalog& catalog_;
  const State& state_;
  Trigger trigger_;
  TaskId first_task_ = 0;
  TaskId end_task_ = 0;
  std::int32_t first_protection_ = 0;
  std::vector<BehaviorId> excluded_;
  std::vector<std::uint8_t> is_listed_;  ///< by behavior of the group
  Problem problem_;
};

/// By value, its place in the order of its task if behaviors of equal suitability are put in an
/// order drawn from `seed`.
[[nodiscard]] std::vector<std::uint32_t> draw_ranks(const CompiledCatalog& catalog,
                                                    std::uint64_t seed);

}  // namespace cbc
