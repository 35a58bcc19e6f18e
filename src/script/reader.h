#pragma once

#include <optional>
#include <string>

#include "cbc/diagnostic.h"
#include "script/script.h"
#include "script/script_names.h"
#include "yaml/document.h"

namespace cbc {

/// The `catalog:` of a script (as written, relative to the script), if it names one.
[[nodiscard]] std::optional<std::string> catalog_of_script(const yaml::Document& document);

/// Understands an event script and checks it as a whole. A script has a meaning whatever the
/// parameters in it are: findings about them have the severity `of_parameters`. The result is empty
/// if there is an error.
[[nodiscard]] std::optional<Script> read_script(const yaml::Document& document,
                                                const ScriptNames& names, Severity of_parameters,
                                                Diagnostics& diagnostics);

}  // namespace cbc
