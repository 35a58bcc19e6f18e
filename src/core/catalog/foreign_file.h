#pragma once

#include <string>
#include <string_view>

#include "core/yaml/document.h"

/// Files of other programs that robots have, which are easily given in place of one for cbc.
namespace cbc {

/// What a text seems to be, by its beginning: "a PDDL domain"; empty if it is none of these files.
[[nodiscard]] std::string_view find_foreign_file(std::string_view text);

/// The same of a document, which may be one of another language that was taken for YAML.
[[nodiscard]] std::string_view find_foreign_file(const yaml::Node& root);

/// Says that a file is none of those that are expected here. `expected`: "behavior catalog";
/// `found`: one of the above.
[[nodiscard]] std::string describe_foreign_file(std::string_view expected, std::string_view found);

}  // namespace cbc
