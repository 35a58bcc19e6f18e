#pragma once

#include <string>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A condition of a property file in words: "DRIVE runs with CREEP or WALK and not (PEOPLE is near
/// and HORN is active)". Alternatives stand in parentheses beside other parts.
[[nodiscard]] std::string describe_condition(const CompiledCatalog& catalog,
                                             const StateCondition& condition);

}  // namespace cbc
