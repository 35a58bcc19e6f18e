#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What `cbc verify` is asked: under which assumptions states are reached, and what is to hold in
// them (docs/verify.md). Situation variables are counted as the catalog does.

/// Values of situation variables, and answers of check_situation (own(b)); all of them hold.
struct SituationPart {
  struct Own {
    BehaviorId behavior;
    bool available = true;
  };
  std::vector<VariableValue> variables;
  std::vector<Own> behaviors;
};

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
  std::uint32_t faults = 0;  ///< the most behaviors that are faulty at a time
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

[[nodiscard]] bool can_become_faulty(const Assumptions& assumptions, BehaviorId behavior);

// Combinations of values of variables are counted in the order of values, those of the last
// variable first: 0 0, 0 1, 1 0, 1 1.

/// How many there are; more than `most_values_together` if there are more.
[[nodiscard]] std::uint32_t count_combinations(const CompiledCatalog& catalog,
                                               const std::vector<std::uint32_t>& variables);
[[nodiscard]] std::vector<VariableValue> combination_of(const CompiledCatalog& catalog,
                                                        const std::vector<std::uint32_t>& variables,
                                                        std::uint32_t number);

/// What a state satisfies: all parts together.
struct StateCondition {
  struct Running {
    TaskId task;
    BehaviorId behavior = none;  ///< none: any
  };
  struct Requested {
    TaskId task;
    std::int32_t priority = 1;  ///< the least priority of the request
  };
  std::vector<Running> running;
  std::vector<TaskId> stopped;
  std::vector<BehaviorId> active;
  bool only_active = false;  ///< no other behavior of the groups explored is active
  std::vector<BehaviorId> faulty;
  std::vector<BehaviorId> available;
  std::vector<Requested> requested;
  SituationPart situation;
};

/// One promise.
struct Property {
  enum class Kind : std::uint8_t {
    can_start,  ///< wherever the task does not run, its start with the priority is accepted
    always,     ///< `condition` holds in every state that satisfies `when`
    never,      ///< no state satisfies `condition`
    reachable   ///< some state satisfies `condition`
  };
  Kind kind = Kind::can_start;
  std::string name;      ///< empty: none
  std::size_t line = 0;  ///< in the file
  TaskId task = none;    ///< of can_start
  std::int32_t priority = 1;
  StateCondition condition;
  std::optional<StateCondition> when;
  bool settled = false;  ///< only states with nothing in the queue count
};

/// The situation variables that the conditions of a property name.
[[nodiscard]] std::set<std::uint32_t> variables_of(const Property& property);

/// The keys of the kinds of properties, in the order of the enumerators.
inline constexpr std::array<std::string_view, 4> property_kinds = {"can_start", "always", "never",
                                                                   "reachable"};
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
