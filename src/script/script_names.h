#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// What a script may refer to; tasks and behaviors in catalog order.
struct ScriptNames {
  std::vector<std::string_view> tasks;
  std::vector<std::string_view> behaviors;
  std::vector<std::vector<Parameter>> parameters;    ///< by task: those that it declares
  std::vector<std::vector<std::uint32_t>> performs;  ///< by behavior: its tasks, sorted
};

/// The names of a catalog, which must outlive the result.
[[nodiscard]] ScriptNames names_of(const CompiledCatalog& catalog);

}  // namespace cbc
