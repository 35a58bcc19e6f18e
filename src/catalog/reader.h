#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "catalog/catalog.h"
#include "cbc/diagnostic.h"
#include "yaml/document.h"

namespace cbc {

/// Understands a catalog. All problems of the text are reported into `diagnostics` at once; the
/// result is empty if one of them is an error.
[[nodiscard]] std::optional<Catalog> read_catalog(const yaml::Document& document,
                                                  Diagnostics& diagnostics);

/// The same from YAML text. `file` is the name used in messages.
[[nodiscard]] std::optional<Catalog> read_catalog(std::string_view text, std::string file,
                                                  Diagnostics& diagnostics);

}  // namespace cbc
