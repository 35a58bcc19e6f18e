#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/conflict_search.h"
#include "runtime/explain/reasons.h"

/// Questions about all situations: whether there is one in which something is possible, and if not,
/// why.
namespace cbc {

/// The situation variables, ascending, that behaviors name with which some tasks, and what these
/// require, run. No others matter to the tasks.
[[nodiscard]] std::vector<std::uint32_t> variables_of(const CompiledCatalog& catalog,
                                                      std::span<const TaskId> tasks);

/// Asks a question in the situations that differ in some variables, until the answer is not no. The
/// question gets the values of all variables. Past a limit of situations the answer is unknown.
using InSituation = std::function<Feasibility(std::span<const std::uint32_t>)>;
[[nodiscard]] Feasibility ask_in_situations(const CompiledCatalog& catalog,
                                            const std::vector<std::uint32_t>& variables,
                                            const InSituation& question);

/// Why there is no situation in which the demands hold together, with behaviors that fit: a minimal
/// set of requirements, minimum performances, exclusions, and conditions of behaviors. These are of
/// the kind `situation`, without a value. Empty if it takes too long to find. `effort_left` is
/// reduced by the work done.
[[nodiscard]] std::vector<Reason> conflict_in_all_situations(const CompiledCatalog& catalog,
                                                             const Demands& demands,
                                                             std::uint64_t& effort_left);

}  // namespace cbc
