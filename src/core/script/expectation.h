#pragma once

#include <vector>

#include "ask/conflict/reasons.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/condition.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

// What is expected of a state: the reader of an `expect`, and the parts that conditions of property
// files share with it.

/// Reads the value of an `expect`, and warns of what can never hold together. Mistakes are
/// reported; the result may be used only if there was no error.
[[nodiscard]] Expectation read_expectation(const yaml::Node& node, NameIndex& names,
                                           Reporter& reporter);

/// Reads a mapping of tasks to behaviors, lists of behaviors or 'any', and appends a condition for
/// each. Entries with mistakes are left out.
void read_running(const yaml::Node& node, NameIndex& names, Reporter& reporter,
                  std::vector<StateCondition>& conditions);

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
