#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/script/contradictions.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/yaml/document.h"

namespace cbc {

// What is expected of a state: the reader of an `expect`, and the parts that conditions of property
// files share with it.

/// Reads the value of an `expect`, and warns of what can never hold together. Mistakes are
/// reported; the result may be used only if there was no error.
[[nodiscard]] Expectation read_expectation(const yaml::Node& node, NameIndex& names,
                                           Reporter& reporter);

/// A task that is expected to run, as it is written. Numbers are places in the catalog.
struct RunningEntry {
  std::uint32_t task = 0;
  std::optional<std::uint32_t> behavior;  ///< empty: any
  Range task_range;
  Range behavior_range;  ///< of `task_range`, if a list names the task alone
};

/// The same for checks of what is claimed together.
[[nodiscard]] StateClaims::Running claim_of(const RunningEntry& entry,
                                            const CompiledCatalog& catalog);

/// Reads a mapping of tasks to behaviors or 'any'. Entries with mistakes are left out. `of_misfit`:
/// how a behavior counts that does not perform its task.
[[nodiscard]] std::vector<RunningEntry> read_running(const yaml::Node& node, NameIndex& names,
                                                     const Standing& of_misfit, Reporter& reporter);

/// Reports a task that is expected to be stopped, and is one of those that are expected to run.
void check_stopped(std::uint32_t task, const Range& range, const std::vector<RunningEntry>& running,
                   const CompiledCatalog& catalog, const Standing& standing, Reporter& reporter);

}  // namespace cbc
