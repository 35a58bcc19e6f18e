#pragma once

#include <string_view>

#include "yaml/document.h"

/// What a file is, is told by its content.
namespace cbc::cli {

[[nodiscard]] bool is_catalog(const yaml::Document& document);
[[nodiscard]] bool is_script(const yaml::Document& document);

/// The same of a text that may be no YAML, as well as can be told.
[[nodiscard]] bool looks_like_catalog(std::string_view text);

}  // namespace cbc::cli
