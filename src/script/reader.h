#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc {

/// The names a script may use, in catalog order.
struct ScriptNames {
  std::vector<std::string_view> tasks;
  std::vector<std::string_view> behaviors;
};

/// The `catalog:` of a script (as written, relative to the script), if it names one.
[[nodiscard]] std::optional<std::string> catalog_of_script(const yaml::Document& document);

/// Understands an event script and checks it as a whole. The result is empty if there is an error.
[[nodiscard]] std::optional<Script> read_script(const yaml::Document& document,
                                                const ScriptNames& names, Diagnostics& diagnostics);

}  // namespace cbc
