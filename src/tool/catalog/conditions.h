#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "catalog/catalog.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"

/// The conditions of behaviors on situation variables by name, for pictures, lists and comparisons.
namespace cbc {

/// The values of a situation variable in which a behavior fits. The names are views of the catalog.
struct NamedCondition {
  std::string_view variable;
  bool is_boolean = false;               ///< the variable was declared without values
  std::vector<std::string_view> values;  ///< in catalog order; empty only in a bad catalog

  bool operator==(const NamedCondition&) const = default;
};

/// The conditions of a behavior, in the order of the variables.
[[nodiscard]] std::vector<NamedCondition> conditions_of(const CompiledCatalog& catalog,
                                                        BehaviorId behavior);
[[nodiscard]] std::vector<NamedCondition> conditions_of(const Catalog& catalog,
                                                        const Behavior& behavior);

/// "TARGET: near, far"; "GPS" or "not GPS" for a variable without values of its own.
[[nodiscard]] std::string describe(const NamedCondition& condition);

}  // namespace cbc
