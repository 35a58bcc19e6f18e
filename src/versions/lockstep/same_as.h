#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/witness.h"
#include "explore/properties/explore.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/names/translation.h"

namespace cbc {

// Whether two catalogs decide every reachable event alike (docs/verify.md, "Two catalogs"). Tasks,
// behaviors, variables and their values are the same if they have the same name, or if one was
// renamed to the other.

/// A difference that no event of an exploration shows.
struct DirectDifference {
  enum class Kind : std::uint8_t {
    task,      ///< only one catalog has it, and it can be requested there
    behavior,  ///< only one has it, and it can be active there
    variable,  ///< only one has it, and behaviors of both depend on it
    value,     ///< the same, of a variable
    timeout,
    execution_goal,
    requestable,
    parameter
  };
  Kind kind = Kind::task;
  std::string line;  ///< "DOCK1: timeout 5 s in old.yaml, none in new.yaml"
};
[[nodiscard]] constexpr std::string_view name_of(DirectDifference::Kind kind) {
  constexpr std::array<std::string_view, 8> names = {"task",        "behavior", "variable",
                                                     "value",       "timeout",  "execution_goal",
                                                     "requestable", "parameter"};
  return names.at(static_cast<std::size_t>(kind));
}

/// How an event is decided differently about one task.
struct TaskDifference {
  /// What differs, the most important first.
  enum class Aspect : std::uint8_t { outcome, running, event, change, stop, queue, suspended };
  Aspect aspect = Aspect::outcome;
  std::string task;  ///< its name, in the new catalog if that has it
  std::string line;  ///< "LOCALIZE: FLOAT_GNSS in place of LIDAR_SLAM"
};
[[nodiscard]] constexpr std::string_view name_of(TaskDifference::Aspect aspect) {
  constexpr std::array<std::string_view, 7> names = {"outcome", "running", "event",    "change",
                                                     "stop",    "queue",   "suspended"};
  return names.at(static_cast<std::size_t>(aspect));
}

/// A shortest path whose last move is decided differently.
struct EventDifference {
  std::vector<Move> moves;            ///< as the new catalog counts
  std::vector<TaskDifference> tasks;  ///< those that nothing before it shows, in catalog order
  /// Expects at its end what the new catalog does, as far as the old one has names for it, too.
  Witness witness;
  Script old_script;  ///< the same events for the old catalog, not expecting
  std::optional<std::string>
      old_text;  ///< of the witness in the old catalog's names, if they differ
};

/// Groups of both catalogs that were explored together.
struct GroupComparison {
  std::vector<GroupId> old_groups;
  std::vector<GroupId> new_groups;
  std::vector<std::string> tasks;  ///< names, in the order of the new catalog, then of the old one
  Verdict::Result result = Verdict::Result::undecided;
  bool is_compared = false;                  ///< a start, stop or finish was made in both
  std::uint64_t states = 0;                  ///< pairs of states
  std::uint64_t transitions = 0;             ///< pairs of transitions
  std::uint32_t depth = 0;                   ///< see Exploration
  std::optional<Budget::End> end;            ///< what ended the search before its end
  std::vector<EventDifference> differences;  ///< the first of all, then further ones of other tasks
};

struct CatalogComparison {
  CatalogNames names;
  /// Violated if an event is decided differently, or there is a direct difference; undecided also
  /// if nothing was compared.
  Verdict::Result result = Verdict::Result::undecided;
  Verdict::Result explored = Verdict::Result::undecided;  ///< of the events alone
  bool is_compared = false;                               ///< see GroupComparison, of any of them
  std::uint64_t states = 0;                               ///< of all groups
  std::uint64_t transitions = 0;
  std::uint32_t depth = 0;         ///< of the deepest one
  std::optional<Budget::End> end;  ///< what ended the first search that was ended
  std::vector<DirectDifference> direct;
  std::vector<GroupComparison> groups;
  std::optional<std::string> error;  ///< see Exploration

  /// The shortest one, of several the first in the order of moves; null: none.
  [[nodiscard]] const EventDifference* first_difference() const;
};

/// What a comparison is about.
struct ComparisonScope {
  /// What counts as a difference after a move.
  enum class Differences : std::uint8_t {
    all,  ///< see CatalogComparison
    /// What an expectation can see: the outcome of a start, stop or finish of a script, and the
    /// tasks that run with their behaviors.
    expectable
  };
  Differences differences = Differences::all;
  /// The first one ends the comparison of its groups, and direct ones do not count.
  bool only_first = false;
  /// Only the groups that are explored together with this one of the new catalog.
  std::optional<std::uint32_t> group;
  Renames renames = {};
  /// What only one of them has does not count.
  bool allow_missing = false;
  /// The assumptions are common_assumptions(): what only one of them has may do all that its
  /// catalog lets happen.
  bool is_by_default = false;
};

/// Assumptions about the new catalog for a comparison without a property file: what either catalog
/// lets happen by default, as far as both have it.
[[nodiscard]] Assumptions common_assumptions(const CompiledCatalog& old_catalog,
                                             const CompiledCatalog& new_catalog,
                                             const Renames& renames = {});

/// Visits the pairs of states that the same moves lead to in both catalogs, as long as they are
/// decided alike. `assumptions` are about the new one; what only one has takes part in no move.
[[nodiscard]] CatalogComparison compare_catalogs(const CompiledCatalog& old_catalog,
                                                 const CompiledCatalog& new_catalog,
                                                 const Assumptions& assumptions,
                                                 const ExplorationOptions& options,
                                                 const ComparisonScope& scope = {});

}  // namespace cbc
