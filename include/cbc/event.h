#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "cbc/units.h"

namespace cbc {

/// What an event asks for or reports.
enum class Verb : std::uint8_t { start, stop, finish, situation, fault, repair, wait };

/// Why a behavior finished. `goal_achieved` is success, `situation_change` a situation change, the
/// others are failures.
enum class FinishCause : std::uint8_t {
  goal_achieved,
  time_out,
  wrong_progress,
  situation_change,
  process_failure,
  interrupted
};

/// Where an event comes from: a script (or a program), the clock, or a failed rollback.
enum class Origin : std::uint8_t { script, timeout, reactive, fault };

enum class Outcome : std::uint8_t { accepted, rejected, unchanged };

/// Why a behavior was activated or deactivated.
enum class ChangeCause : std::uint8_t {
  requested,  ///< its task has a request of priority >= 1, or is the one of a stop event
  reactive,   ///< its task has a request of priority 0
  required,   ///< its task has no request
  replaced,   ///< its task goes on with another behavior
  displaced,  ///< its task had a request
  released,   ///< its task had none
  restarted,  ///< to take over changed parameters
  undone      ///< rolls back an earlier change of the same event
};

/// The names of the enumerators, as scripts and reports write them. The argument must be one.
[[nodiscard]] std::string_view name_of(Verb verb);
[[nodiscard]] std::string_view name_of(FinishCause cause);
[[nodiscard]] std::string_view name_of(Origin origin);
[[nodiscard]] std::string_view name_of(Outcome outcome);
[[nodiscard]] std::string_view name_of(ChangeCause cause);

/// Whether a behavior can be activated in the present situation: the answer of `check_situation`.
struct Availability {
  std::uint32_t behavior = 0;
  bool available = true;
};

/// One event for the coordinator. Tasks and behaviors are named by their place in the catalog.
struct Event {
  Verb verb = Verb::wait;
  std::uint32_t subject = 0;  ///< the task of start and stop, the behavior of finish, fault, repair
  std::optional<std::int32_t> priority;  ///< of start (default 1) and stop (default: its request's)
  /// Parameters of a start in canonical form: two are the same data iff the texts are equal; the
  /// empty text is "none". Absent: not given.
  std::optional<std::string_view> parameters;
  FinishCause cause = FinishCause::goal_achieved;  ///< of finish
  std::span<const Availability> situation;  ///< of situation; what is not in it stays as it was
};

}  // namespace cbc
