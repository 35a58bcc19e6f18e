#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cbc/diagnostic.h"

namespace cbc {

/// What an annotation is about.
struct GithubPlace {
  std::string file;
  std::optional<Range> range = {};  ///< empty: the file as a whole
};

/// A workflow command of GitHub Actions, a line, which becomes an annotation. `command` is error,
/// warning or notice. The title and the message may be any text; the message may have lines.
[[nodiscard]] std::string github_command(std::string_view command, const GithubPlace& place,
                                         std::string_view title, std::string_view message);

}  // namespace cbc
