#pragma once

#include <optional>
#include <string>

#include "yaml/document.h"

namespace cbc::cli {

/// The path of the catalog that a script at this path names (catalog: FILE). Empty if it names
/// none.
[[nodiscard]] std::optional<std::string> path_of_catalog(const std::string& script_path,
                                                         const yaml::Document& script);

}  // namespace cbc::cli
