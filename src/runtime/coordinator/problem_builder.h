#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/may_need.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// An event that needs a new assignment.
struct Trigger {
  enum class Kind : std::uint8_t { start, stop, finish, reconsider };
  Kind kind = Kind::start;
  GroupId group;
  TaskId task = none;          ///< of start and stop
  BehaviorId behavior = none;  ///< of finish
  FinishCause cause = FinishCause::goal_achieved;
  std::int32_t priority = 0;    ///< of start and stop
  Microseconds time = 0;        ///< of start: that of the request
  bool is_reactive = false;     ///< a start that may not stop a task with a request as high
  std::string_view parameters;  ///< that the task will have

  /// A reactive start that nobody asked for: suspended requests stay so.
  [[nodiscard]] bool is_unasked() const { return is_reactive && priority == 0; }
};

/// What was decided, while the state is still the one before the answer, but for what is active.
struct Circumstances {
  const State& state;
  const Trigger& trigger;
  std::int32_t protection = 0;         ///< the last level that was tried
  std::span<const BehaviorId> failed;  ///< behaviors that failed in this event
  /// The one that has the answer; null: there is no answer.
  const Problem* problem = nullptr;
  /// When the event is to be done.
  std::optional<std::chrono::steady_clock::time_point> deadline = std::nullopt;
};

/// Whether a running task may not stop: its request has a higher priority than the protection level
/// or, where the trigger is a reactive start, as high a priority; where a group is reconsidered,
/// one that counts (docs/semantics.md, "Protection").
[[nodiscard]] bool is_protected(const State& state, const Trigger& trigger, TaskId task,
                                std::int32_t protection);

/// Whether the behavior that has finished performed the task.
[[nodiscard]] bool has_finished(const State& state, const Trigger& trigger, TaskId task);

/// Builds the constraint problem of a group from a trigger and the state (docs/semantics.md,
/// "Domains").
class ProblemBuilder {
 public:
  ProblemBuilder(const CompiledCatalog& catalog, const State& state);

  /// Begins an event. `event` is its number, higher than that of any request.
  void load(const Trigger& trigger, std::uint64_t event);

  /// Removes a behavior from all domains of this event.
  void exclude(BehaviorId behavior) { excluded_.push_back(behavior); }
  [[nodiscard]] const std::vector<BehaviorId>& excluded() const { return excluded_; }

  /// The first protection level to try.
  [[nodiscard]] std::int32_t first_protection() const { return first_protection_; }
  /// The lowest level above `level` that protects fewer tasks; none if all levels protect alike.
  /// `level` is the first one or above, so above the requests of what has finished.
  [[nodiscard]] std::optional<std::int32_t> next_protection(std::int32_t level) const;

  /// The problem at a protection level. Valid until the next call.
  [[nodiscard]] const Problem& build(std::int32_t protection);

  /// The behaviors that were active just before the event, without one that has finished, in
  /// BehaviorId order.
  [[nodiscard]] const std::vector<BehaviorId>& active_before() const { return problem_.active; }
  [[nodiscard]] bool has_finished(TaskId task) const {
    return cbc::has_finished(state_, trigger_, task);
  }

 private:
  void find_active();
  void rank_requests(std::uint64_t event);
  void add_present_value(TaskId task);
  void restrict_domain(TaskId task, std::int32_t protection);
  void remove_excluded();
  void keep_from_improving(TaskId task);
  void keep_what_was_not_asked_for();
  void remove_better(TaskId task);

  [[nodiscard]] std::uint64_t& word_of(TaskId task, std::uint32_t index);
  void empty_domain(TaskId task);

  const CompiledCatalog& catalog_;
  const State& state_;
  Trigger trigger_;
  TaskId first_task_;
  TaskId end_task_;
  std::int32_t first_protection_ = 0;
  std::vector<BehaviorId> excluded_;
  MayNeed may_need_;
  std::vector<std::uint8_t> is_listed_;  ///< by behavior of the group
  Problem problem_;
};

}  // namespace cbc
