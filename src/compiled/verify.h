#pragma once

#include <optional>
#include <string>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// What is wrong with the arrays of a compiled catalog that came from outside, or nothing: then
/// everything that compile() ensures holds. All spans lie in readable memory and are aligned;
/// nothing else is taken for granted. Takes time linear in the size of the arrays.
[[nodiscard]] std::optional<std::string> find_fault(const CompiledCatalog& catalog);

}  // namespace cbc
