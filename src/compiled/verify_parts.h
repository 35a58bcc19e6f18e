#pragma once

#include <optional>
#include <string>

#include "compiled/compiled_catalog.h"

/// The parts of find_fault(), in their order: each takes for granted what those before it ensure.
namespace cbc::verify {

/// What is wrong, for people; or nothing.
using Fault = std::optional<std::string>;

/// That all arrays fit each other and that rows lie in their arrays.
[[nodiscard]] Fault find_size_fault(const CompiledCatalog& catalog);

/// Texts, names and their order, packages, parameters.
[[nodiscard]] Fault find_text_fault(const CompiledCatalog& catalog);

/// Groups and the order of all that is in them, and what tasks and behaviors say of themselves but
/// for levels and has_performance_rules.
[[nodiscard]] Fault find_group_fault(const CompiledCatalog& catalog);

/// Values, domain words, `performs`.
[[nodiscard]] Fault find_value_fault(const CompiledCatalog& catalog);

/// Requirements and the levels of behaviors.
[[nodiscard]] Fault find_requirement_fault(const CompiledCatalog& catalog);

/// Arcs, masks, has_performance_rules, the levels and the order of tasks.
[[nodiscard]] Fault find_graph_fault(const CompiledCatalog& catalog);

/// Cliques, `task_cliques`.
[[nodiscard]] Fault find_clique_fault(const CompiledCatalog& catalog);

/// That each group is connected: a suitability of 0 in what should be another group would decide.
[[nodiscard]] Fault find_connection_fault(const CompiledCatalog& catalog);

}  // namespace cbc::verify
