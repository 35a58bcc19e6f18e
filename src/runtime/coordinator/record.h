#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

// The vocabulary of events, and the records of what they did, but not why (src/why). The words of
// scripts, streams, logs, saved states and reports are in `verb_forms` and in the tables of
// record.cpp, and nowhere else.

namespace cbc {

/// What an event with a verb consists of, beside its time.
struct VerbForm {
  /// What the verb is about; a situation is a mapping of behaviors to booleans, and of situation
  /// variables to their values. A behavior of a finish may be given by a task that it performs.
  enum class SubjectKind : std::uint8_t { nothing, task, behavior, situation };

  std::string_view name;
  SubjectKind subject = SubjectKind::nothing;
  bool has_priority = false;
  std::int32_t lowest_priority = 0;
  bool has_parameters = false;
  bool has_cause = false;
  bool is_decided = false;  ///< the event is accepted, rejected, or changes nothing
};

/// In the order of the enumerators.
inline constexpr std::array<VerbForm, 8> verb_forms{
    {{.name = "start",
      .subject = VerbForm::SubjectKind::task,
      .has_priority = true,
      .lowest_priority = 1,
      .has_parameters = true,
      .is_decided = true},
     {.name = "stop",
      .subject = VerbForm::SubjectKind::task,
      .has_priority = true,
      .is_decided = true},
     {.name = "finish",
      .subject = VerbForm::SubjectKind::behavior,
      .has_cause = true,
      .is_decided = true},
     {.name = "situation", .subject = VerbForm::SubjectKind::situation},
     {.name = "fault", .subject = VerbForm::SubjectKind::behavior},
     {.name = "repair", .subject = VerbForm::SubjectKind::behavior},
     {.name = "wait"},
     {.name = "reconsider", .is_decided = true}}};
static_assert(verb_forms.size() == static_cast<std::size_t>(Verb::reconsider) + 1);
/// The verbs of scripts and streams.
inline constexpr std::span<const VerbForm> scripted_verbs(verb_forms.data(), verb_forms.size() - 1);

[[nodiscard]] constexpr const VerbForm& form_of(Verb verb) {
  return verb_forms[static_cast<std::size_t>(verb)];
}

[[nodiscard]] constexpr bool is_scripted_verb(std::string_view word) {
  return std::any_of(scripted_verbs.begin(), scripted_verbs.end(),
                     [word](const VerbForm& form) { return form.name == word; });
}

using Words = std::span<const std::string_view>;

/// The words for the values of Verb, FinishCause, Origin, Outcome, ChangeCause or SearchStatus, in
/// the order of the enumerators.
template <typename Enum>
[[nodiscard]] Words words_of() = delete;
template <>
Words words_of<Verb>();
/// Those of scripts.
[[nodiscard]] inline Words scripted_verb_words() {
  return words_of<Verb>().first(scripted_verbs.size());
}
template <>
Words words_of<FinishCause>();
template <>
Words words_of<Origin>();
template <>
Words words_of<Outcome>();
template <>
Words words_of<ChangeCause>();
template <>
Words words_of<SearchStatus>();

template <typename Enum>
[[nodiscard]] std::string_view word_of(Enum value) {
  return words_of<Enum>()[static_cast<std::size_t>(value)];
}

/// The value that a word stands for, if there is one.
template <typename Enum>
[[nodiscard]] std::optional<Enum> find_word(std::string_view word) {
  const Words words = words_of<Enum>();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Enum>(found - words.begin());
}

/// The objectives of a solution but for f2, over the whole catalog (docs/semantics.md,
/// "Objectives"). Idle tasks are those that can start without a request.
struct ObjectiveValues {
  std::uint32_t satisfied = 0;     ///< requests, for f1
  std::uint32_t requests = 0;      ///< active requests, for f1
  std::uint32_t idle_total = 0;    ///< idle tasks, for f3
  std::uint32_t idle_running = 0;  ///< idle tasks that run, for f3
  std::uint32_t changes = 0;       ///< for f4
};

[[nodiscard]] std::string_view name_of(SearchStatus status);

/// One activation or deactivation, in the order applied.
struct Change {
  bool is_activation = false;
  BehaviorId behavior;
  std::uint32_t first_task = 0;  ///< its first one in EventRecord::tasks_of_changes
  std::uint32_t task_count = 0;
  ChangeCause cause = ChangeCause::requested;
  std::optional<std::int32_t> priority;
  bool success = true;

  friend bool operator==(const Change&, const Change&) = default;
};

struct StoppedTask {
  TaskId task;
  FinishCause cause = FinishCause::interrupted;
  bool has_finished = false;             ///< by the finish of its behavior
  bool is_suspended = false;             ///< its request waits
  std::optional<std::int32_t> priority;  ///< of its request before the event, if it had one
};

struct SearchRecord {
  SearchResult result;  ///< status of the last search; counts over all searches of the event
  GroupId group;
  std::int32_t protection = 0;
  bool is_escalated = false;  ///< the first protection level had no solution
  bool makes_worse = false;   ///< the only solutions make what was asked for worse, and are none
  std::vector<std::uint32_t> domain_sizes;  ///< their product is the search space
  /// The time of all searches of the event and of building their problems; empty unless measured.
  std::optional<std::chrono::nanoseconds> elapsed;
};

/// What one event did. Valid until the coordinator handles the next one, which reuses the memory.
struct EventRecord {
  std::uint64_t index = 0;  ///< counts all events from 1
  Microseconds time = 0;
  Origin origin = Origin::script;
  Verb verb = Verb::wait;
  TaskId task = none;          ///< of start, stop, and a finish that names a task
  BehaviorId behavior = none;  ///< of finish (none: nothing performs its task), fault and repair
  std::int32_t priority = 0;   ///< of start and stop
  FinishCause cause = FinishCause::goal_achieved;

  Outcome outcome = Outcome::unchanged;
  std::vector<Change> changes;
  std::vector<TaskId> tasks_of_changes;
  std::vector<StoppedTask> stopped_tasks;
  std::vector<TaskId> resumed_tasks;  ///< those that run, and whose request was suspended
  /// Tasks with another behavior than before, which was active already: no change tells of them.
  std::vector<TaskId> tasks_taken_over;
  std::optional<ObjectiveValues> objective;
  const SearchRecord* search = nullptr;  ///< null: there was none

  /// The tasks that one of the changes is about.
  [[nodiscard]] std::span<const TaskId> tasks_of(const Change& change) const {
    return std::span(tasks_of_changes).subspan(change.first_task, change.task_count);
  }
};

}  // namespace cbc
