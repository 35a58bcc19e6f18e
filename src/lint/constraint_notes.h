#pragma once

#include <span>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "explain/reason.h"

namespace cbc {

/// The requirement of a task by a behavior that has one; of several the strongest, or the first.
[[nodiscard]] const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task);

/// Notes that say, for each of a set of constraints, what it is and where it stands.
[[nodiscard]] std::vector<Note> constraint_notes(std::span<const Reason> constraints,
                                                 const Catalog& catalog,
                                                 const CompiledCatalog& compiled,
                                                 const Reporter& reporter);

}  // namespace cbc
