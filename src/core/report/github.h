#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// Workflow commands of GitHub Actions.

namespace cbc {

/// The place that an annotation belongs to.
struct GithubPlace {
  std::string file;
  std::optional<Range> range = {};  ///< empty: the file as a whole
};

/// A workflow command of GitHub Actions: one line, which becomes an annotation. `command` is error,
/// warning or notice. The title and the message may be any text; the message may have several
/// lines.
[[nodiscard]] std::string github_command(std::string_view command, const GithubPlace& place,
                                         std::string_view title, std::string_view message);

/// A finding as a workflow command of GitHub Actions.
[[nodiscard]] std::string github_command_of(const Diagnostic& finding);
/// The errors among findings, in place of a report of what could not be read.
[[nodiscard]] std::string github_commands_of_errors(const std::vector<Diagnostic>& findings);

}  // namespace cbc
