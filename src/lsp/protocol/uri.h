#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cbc::lsp {

/// The path of a file of this machine. A text that was never saved ("untitled:") has its URI as its
/// path. Empty for anything else (vscode-vfs:, git:, ...).
[[nodiscard]] std::optional<std::string> path_of_uri(std::string_view uri);

/// "file:///home/user/robot.yaml". `path` is absolute.
[[nodiscard]] std::string uri_of_path(std::string_view path);

}  // namespace cbc::lsp
