#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ask/situation_space.h"
#include "cbc/event.h"
#include "core/script/condition.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What `cbc verify` is asked: under which assumptions states are reached, and what is to hold in
// them (docs/verify.md). Situation variables are counted as the catalog does.

inline constexpr std::uint32_t most_values_together = 10'000;

/// The events that may happen, and the first state (docs/verify.md, "Moves"). Lists are in catalog
/// order.
struct Assumptions {
  struct Start {
    TaskId task;
    std::vector<std::int32_t> priorities;  ///< each at least 1, distinct, in the order of the file
  };
  std::vector<Start> start;  ///< distinct tasks
  std::vector<TaskId> stop;  ///< distinct tasks
  bool successes = true;
  bool failures = true;
  /// The most behaviors in X with which a finish may put one more there; nothing: any number.
  std::optional<std::uint32_t> most_failed;
  std::optional<std::uint32_t> most_suspended;  ///< the most suspended requests
  std::uint32_t faults = 0;                     ///< the most behaviors that are faulty at a time
  /// Only these can become faulty, or all but these; see can_become_faulty().
  bool only_listed_fail = false;
  std::vector<BehaviorId> listed_for_faults;
  std::vector<std::uint32_t> variables;  ///< those that may change
  std::vector<BehaviorId> behaviors;     ///< those whose own(b) may change
  std::vector<SituationPart> never;      ///< situations that do not occur
  /// Variables that may also change at once, in any way but for what `never` excludes; each list
  /// has at least two, which may change, and at most `most_values_together` combinations of values.
  std::vector<std::vector<std::uint32_t>> together;
  /// Of those that may change: `never` keeps them as they are (find_frozen_variables()).
  std::vector<std::uint32_t> frozen;
  SituationPart initially;  ///< what differs from initial values and own(b) true
};

/// Assumptions, and who states them.
struct StatedAssumptions {
  Assumptions assumptions;
  std::string file;  ///< the property file; empty: none
};

/// What holds without a property file: every task with start_on_request may be requested with
/// priority 1 and stopped, all variables may change, nothing is faulty.
[[nodiscard]] Assumptions default_assumptions(const CompiledCatalog& catalog);

/// Of the first state: the value of a situation variable, and own(b) of a behavior.
[[nodiscard]] std::uint32_t initial_value(const Assumptions& assumptions, std::uint32_t variable);
[[nodiscard]] bool is_available_at_first(const Assumptions& assumptions, BehaviorId behavior);
/// Whether all of the part holds in the first state.
[[nodiscard]] bool holds_at_first(const Assumptions& assumptions, const SituationPart& part);

/// Whether events may change the value of a variable, and own(b) of a behavior.
[[nodiscard]] bool may_change(const Assumptions& assumptions, std::uint32_t variable);
[[nodiscard]] bool may_change(const Assumptions& assumptions, BehaviorId behavior);
[[nodiscard]] bool can_become_faulty(const Assumptions& assumptions, BehaviorId behavior);

// Combinations of values of variables are counted in the order of values, those of the last
// variable first: 0 0, 0 1, 1 0, 1 1.

/// How many there are; more than `most_values_together` if there are more.
[[nodiscard]] std::uint32_t count_combinations(const CompiledCatalog& catalog,
                                               const std::vector<std::uint32_t>& variables);
[[nodiscard]] std::vector<VariableValue> combination_of(const CompiledCatalog& catalog,
                                                        const std::vector<std::uint32_t>& variables,
                                                        std::uint32_t number);

/// The most `not`, `any` and `all` that stand in one another.
inline constexpr std::size_t most_nested_conditions = 16;

/// Some of the moves of the assumptions, by their kinds (docs/verify.md, "Moves").
struct MoveKinds {
  bool start = false;
  bool stop = false;
  bool successes = false;
  bool failures = false;
  bool fault = false;
  bool repair = false;
  bool situation = false;          ///< with the finishes of behaviors that are unavailable
  bool queue = false;              ///< its first set comes due
  std::vector<TaskId> start_only;  ///< the tasks of `start`; empty: all
  std::vector<TaskId> stop_only;   ///< the tasks of `stop`; empty: all
};

/// The words for the kinds, in their order.
struct MoveKindWord {
  std::string_view word;
  bool MoveKinds::*kind;
};
inline constexpr std::array<MoveKindWord, 8> move_kind_words = {
    {{"start", &MoveKinds::start},
     {"stop", &MoveKinds::stop},
     {"successes", &MoveKinds::successes},
     {"failures", &MoveKinds::failures},
     {"fault", &MoveKinds::fault},
     {"repair", &MoveKinds::repair},
     {"situation", &MoveKinds::situation},
     {"queue", &MoveKinds::queue}}};

/// One promise.
struct Property {
  enum class Kind : std::uint8_t {
    can_start,       ///< wherever the task does not run, its start with the priority is accepted
    always,          ///< `condition` holds in every state
    never,           ///< no state satisfies `condition`
    reachable,       ///< some state satisfies `condition`
    keeps_running,   ///< no move ends the task while it runs with a request of priority 1 or more
    always_possible  ///< from every state one that satisfies `condition` can be reached
  };
  Kind kind = Kind::can_start;
  std::string name;      ///< empty: none
  std::size_t line = 0;  ///< in the file
  TaskId task = none;    ///< of can_start and keeps_running
  std::int32_t priority = 1;
  StateCondition condition;
  std::optional<StateCondition> when;  ///< only states that satisfy it count
  bool settled = false;                ///< only states with nothing in the queue count
  /// Of always and never: only states that are marked count. A state that satisfies `until` loses
  /// the mark when it is entered; otherwise one that satisfies `after` gets it; otherwise it has
  /// the mark of the state before.
  std::optional<StateCondition> after;
  std::optional<StateCondition> until;
  std::optional<MoveKinds> by;          ///< the moves that count; nothing: all
  std::optional<std::uint32_t> within;  ///< of always_possible: the most moves
};

/// The conditions of a property, and all that stand in them.
[[nodiscard]] std::vector<const StateCondition*> conditions_of(const Property& property);
/// The situation variables that they name.
[[nodiscard]] std::set<std::uint32_t> variables_of(const Property& property);

/// The keys of the kinds of properties, in the order of the enumerators.
inline constexpr std::array<std::string_view, 6> property_kinds = {
    "can_start", "always", "never", "reachable", "keeps_running", "always_possible"};
[[nodiscard]] constexpr std::string_view name_of(Property::Kind kind) {
  return property_kinds[static_cast<std::size_t>(kind)];
}

/// A property file.
struct PropertyFile {
  std::string path;                    ///< as named; for messages and reports
  std::optional<std::string> catalog;  ///< as written in the file, relative to it
  Assumptions assumptions;
  std::vector<Property> properties;
};

}  // namespace cbc
