#pragma once

#include <string_view>

#include "yaml/document.h"

/// What a file is, is told by its content.
namespace cbc::cli {

[[nodiscard]] bool is_catalog(const yaml::Document& document);
[[nodiscard]] bool is_script(const yaml::Document& document);

/// The same, or with its events under a misspelt key.
[[nodiscard]] bool looks_like_script(const yaml::Document& document);

/// Whether a text that may be no YAML is meant as a catalog: misspelt keys count, too.
[[nodiscard]] bool looks_like_catalog(std::string_view text);

}  // namespace cbc::cli
