#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "cbc/units.h"

namespace cbc {

/// What an event asks for or reports. `reconsider` is none of a script: after a situation or a
/// repair, a group is decided anew.
enum class Verb : std::uint8_t { start, stop, finish, situation, fault, repair, wait, reconsider };

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

/// Where an event comes from: a script (or a program), a timeout, the start of a reactive task, a
/// failed rollback, a situation that a behavior does not fit any more or that makes more possible,
/// or a repair.
enum class Origin : std::uint8_t { script, timeout, reactive, fault, situation, repair };

enum class Outcome : std::uint8_t { accepted, rejected, unchanged };

/// Why a behavior was activated or deactivated.
enum class ChangeCause : std::uint8_t {
  requested,  ///< its task has a request of priority >= 1, or is the task of a stop event
  resumed,    ///< its task had a suspended request
  reactive,   ///< its task has a request of priority 0, or starts by itself
  required,   ///< its task has no request
  replaced,   ///< its task continues with another behavior
  displaced,  ///< its task had a request
  released,   ///< its task had no request
  restarted,  ///< to take over changed parameters
  undone      ///< rolls back an earlier change of the same event
};

/// The word for a value in scripts and reports. The value must be one of the enumerators.
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

/// A value of a situation variable, both as the catalog counts them.
struct VariableValue {
  std::uint32_t variable = 0;
  std::uint32_t value = 0;

  bool operator==(const VariableValue&) const = default;
};

/// Stands for the subject of an event where there is none.
inline constexpr std::uint32_t no_subject = UINT32_MAX;

/// One event for the coordinator. Tasks, behaviors and situation variables are given as catalog
/// indices (see LoadedCatalog).
struct Event {
  Verb verb = Verb::wait;
  std::uint32_t subject = 0;  ///< the task of start and stop, the behavior of finish, fault, repair
  /// Of finish: the subject is a task, and whatever performs it at this moment finishes.
  bool is_by_task = false;
  std::optional<std::int32_t> priority;  ///< of start (default 1) and stop (default: its request's)
  /// Parameters of a start in canonical form: equal data have equal texts, and no other. The empty
  /// text means no parameters. Absent: the task keeps the ones it has.
  std::optional<std::string_view> parameters;
  FinishCause cause = FinishCause::goal_achieved;  ///< of finish
  // Of situation. What is not named stays as it was. All changes take effect at once.
  std::span<const Availability> situation;
  std::span<const VariableValue> variables;
};

}  // namespace cbc
