#pragma once

#include <optional>
#include <string>

#include "cbc/diagnostic.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/snapshot.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc {

/// The `catalog:` of a script (as written, relative to the script), if it names one.
[[nodiscard]] std::optional<std::string> catalog_of_script(const yaml::Document& document);

/// Understands an event script and checks it as a whole. A script has a meaning whatever the
/// parameters in it are: findings about them have the severity `of_parameters`. It goes on from
/// `state`, if there is one. The result is empty if there is an error.
[[nodiscard]] std::optional<Script> read_script(const yaml::Document& document,
                                                const CompiledCatalog& catalog,
                                                Severity of_parameters, Diagnostics& diagnostics,
                                                const Snapshot* state = nullptr);

}  // namespace cbc
