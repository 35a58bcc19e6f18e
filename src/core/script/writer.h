#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A name or a path in a script: in quotes, so that it is not taken for another type, and with
/// escapes for what does not show.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A script as text for `cbc solve`, below the lines of `comment`. `comments`: by step, lines to
/// write before it; it may be empty.
[[nodiscard]] std::string write_script(const CompiledCatalog& catalog, const Script& script,
                                       const std::string& comment,
                                       std::span<const std::string> comments = {});

}  // namespace cbc
