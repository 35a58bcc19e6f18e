#pragma once

#include <string_view>

/// The scripts that make a shell ask the program how a command line can go on.
namespace cbc::cli {

[[nodiscard]] std::string_view bash_completion();
[[nodiscard]] std::string_view zsh_completion();
[[nodiscard]] std::string_view fish_completion();

}  // namespace cbc::cli
