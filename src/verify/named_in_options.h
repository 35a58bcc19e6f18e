#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

// What options of `cbc verify` name of a catalog.

namespace cbc::cli {

/// The tasks that are named in an option. Empty if the catalog lacks one, which is reported.
[[nodiscard]] std::optional<std::vector<TaskId>> find_tasks(const CompiledCatalog& catalog,
                                                            std::string_view option,
                                                            const std::vector<std::string>& names);

/// Adds KEY=VALUE to a situation. Returns what is wrong, or nothing.
[[nodiscard]] std::string add_to_situation(const CompiledCatalog& catalog, const std::string& entry,
                                           SituationPart& situation);

}  // namespace cbc::cli
