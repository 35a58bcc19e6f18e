#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ask/conflict/reasons.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

// What is said of one state, by an expectation of a script or a condition of a property file, and
// which parts of it cannot hold together.

/// What is said of the values of tasks. Numbers are those of the compiled catalog.
struct StateClaims {
  /// A task or a behavior, and where it is named.
  template <typename Number>
  struct Named {
    Number id;
    Range range;
  };
  using Task = Named<TaskId>;
  using Behavior = Named<BehaviorId>;
  struct Running {
    Task task;
    std::vector<Behavior> behaviors;  ///< one of these; empty: any
  };
  /// No behavior but these is active.
  struct Only {
    Range range;  ///< of what says so
    std::vector<BehaviorId> behaviors;
  };

  std::vector<Running> running;
  std::vector<Task> stopped;
  std::vector<Behavior> active;
  std::vector<Only> only_active;  ///< whose behaviors are among `active`
};

/// Takes why something can never hold, the place that says it, and places that say otherwise.
using OnContradiction =
    std::function<void(const Range& range, const std::string& why, std::vector<Note> notes)>;

/// Finds claims that contradict each other in any catalog with these behaviors: an active behavior
/// performs a task, a task has one behavior at most, and none if it is stopped.
void find_contradictions(const StateClaims& claims, const CompiledCatalog& catalog,
                         const Reporter& reporter, const OnContradiction& on_contradiction);

/// Finds claims that exclusions of the catalog do not allow together, and behaviors that do not
/// perform the task that they are listed for, though others do. It knows nothing of performances.
void find_excluded(const StateClaims& claims, const CompiledCatalog& catalog,
                   const Reporter& reporter, const OnContradiction& on_contradiction);

/// The same with all that requirements make run, too.
void find_ruled_out(const StateClaims& claims, const CompiledCatalog& catalog,
                    const Reporter& reporter, const OnContradiction& on_contradiction);

// What is expected of a state: the reader of an `expect`, and the parts that conditions of property
// files share with it.

/// Reads the value of an `expect`, and warns of what can never hold together. Mistakes are
/// reported; the result may be used only if there was no error.
[[nodiscard]] Expectation read_expectation(const yaml::Node& node, NameIndex& names,
                                           Reporter& reporter);

/// Reads a mapping of tasks to behaviors, lists of behaviors or 'any'. Entries with mistakes are
/// left out.
[[nodiscard]] std::vector<StateClaims::Running> read_running(const yaml::Node& node,
                                                             NameIndex& names, Reporter& reporter);

/// Reports a list of all active behaviors beside a list of some of them.
void check_active_keys(const yaml::Fields& fields, Reporter& reporter);

/// What an expectation that does not hold demands of one group of tasks.
struct ExpectedValues {
  GroupId group;
  std::vector<TaskId> tasks;  ///< those that are not as expected, in catalog order
  /// The expectation holds in the group if all demands of one of these hold. More than one where
  /// an active behavior may perform several tasks.
  std::vector<Demands> ways;
};

/// The groups in which the expectation does not hold, in catalog order. Left out are those in which
/// it can never hold, and those with more ways than anybody would list.
[[nodiscard]] std::vector<ExpectedValues> find_expected_values(const Expectation& expectation,
                                                               const CompiledCatalog& catalog,
                                                               const State& state);

}  // namespace cbc
