#pragma once

#include <span>
#include <string>

#include "compiled/compiled_catalog.h"
#include "script/script.h"

namespace cbc {

/// A script as text for `cbc solve`, below the lines of `comment`. `comments`: by step, lines to
/// write before it; it may be empty.
[[nodiscard]] std::string write_script(const CompiledCatalog& catalog, const Script& script,
                                       const std::string& comment,
                                       std::span<const std::string> comments = {});

}  // namespace cbc
