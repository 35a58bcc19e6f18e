#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "coordinator/record.h"
#include "coordinator/state.h"
#include "explain/reason.h"

namespace cbc {

/// What kinds of events a sweep tells apart.
enum class SweepKind : std::uint8_t {
  start,
  stop,
  success,           ///< a finish, goal_achieved
  failure,           ///< a finish with a cause that is a failure
  situation_change,  ///< a finish
  situation,
  fault,
  repair,
  timeout,   ///< a finish by the clock
  reactive,  ///< a start by the clock
  lost       ///< a finish of a behavior that a rejected event could not activate again
};
inline constexpr std::size_t sweep_kinds = 11;

/// "start", "finish_success"
[[nodiscard]] std::string_view name_of(SweepKind kind);

struct OutcomeCounts {
  std::uint64_t accepted = 0;
  std::uint64_t escalated = 0;  ///< of the accepted: at a protection level above the first
  std::uint64_t rejected = 0;
  std::uint64_t unchanged = 0;
};

struct TaskCounts {
  std::uint64_t starts = 0;    ///< start events of scripts that were accepted
  std::uint64_t rejected = 0;  ///< that were rejected
  std::uint64_t runs = 0;      ///< how often it started to run, whatever for
};

struct BehaviorCounts {
  std::uint64_t activations = 0;  ///< that succeeded; restarts too, but none that is undone
  std::uint64_t failures = 0;     ///< activations that failed
};

/// A reason of rejections, whatever the priorities in it. Tasks and behaviors are places in the
/// catalog, or none.
struct RejectionReason {
  Reason::Kind kind = Reason::Kind::priority;
  std::uint32_t behavior = none;
  std::uint32_t task = none;
  std::uint32_t other_task = none;

  auto operator<=>(const RejectionReason&) const = default;
};

/// What happened in a sweep. Sums of parts are the same in any order.
struct SweepCounts {
  SweepCounts() = default;
  SweepCounts(std::size_t task_count, std::size_t behavior_count)
      : tasks(task_count), behaviors(behavior_count) {}

  std::array<OutcomeCounts, sweep_kinds> events;  ///< by SweepKind
  std::vector<TaskCounts> tasks;                  ///< in catalog order
  std::vector<BehaviorCounts> behaviors;          ///< in catalog order
  std::map<RejectionReason, std::uint64_t> reasons;

  /// Counts an event, but for the runs of tasks.
  void add(const CompiledCatalog& catalog, const EventRecord& record);
  /// `other` is of the same catalog.
  void add(const SweepCounts& other);
};

}  // namespace cbc
