#pragma once

#include <string>

#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/fault_tree.h"

// Fault trees for other programs.

namespace cbc {

/// A fault tree in the Model Exchange Format of Open-PSA (XML), which SCRAM and others read: a
/// basic event for each behavior, without a probability. Names that are no identifiers there are in
/// the labels.
[[nodiscard]] std::string open_psa_text(const CompiledCatalog& catalog, const FaultTree& tree);

}  // namespace cbc
