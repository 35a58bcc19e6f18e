#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "random.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::plain {

/// What to verify of a catalog.
struct Question {
  std::vector<GroupId> groups;       ///< ascending
  Assumptions assumptions;           ///< about all groups
  std::vector<Property> properties;  ///< about these groups
};

/// A random question about one group, or about several of them. Properties name tasks and
/// behaviors of these groups only, but sometimes other variables.
[[nodiscard]] Question generate_question(oracle::Random& random, const CompiledCatalog& catalog);

}  // namespace cbc::plain
