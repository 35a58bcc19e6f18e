#pragma once

#include <compare>
#include <cstdint>
#include <string_view>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// One of the reasons why an event is rejected, or why an accepted one did not do otherwise.
struct Reason {
  enum class Kind : std::uint8_t {
    priority,       ///< the task's own request is stronger than the event; comes alone
    no_behavior,    ///< no behavior performs the task at all; comes alone
    is_protected,   ///< the task may not stop, as its request is stronger than the event
    exclusive,      ///< at most one of the two tasks runs
    on_request,     ///< the task is not running, and starts on request only
    requires_task,  ///< where the behavior is assigned, the task runs
    performance,    ///< where it is (or, without a behavior, always), the task performs well enough
    unavailable,    ///< the behavior cannot be activated in the present situation
    faulty,         ///< the activation of the behavior failed in this event
    finished        ///< the behavior of a finish event, where it failed; never of a rejected one
  };
  Kind kind = Kind::priority;
  TaskId task = none;
  TaskId other_task = none;  ///< of exclusive
  BehaviorId behavior = none;
  std::int32_t priority = 0;           ///< of priority and is_protected
  Millionths minimum_performance = 0;  ///< of performance
  std::uint32_t line = 0;              ///< of the catalog, where a line says so; else 0
};

[[nodiscard]] std::string_view name_of(Reason::Kind kind);

}  // namespace cbc
