#pragma once

#include <string>
#include <string_view>

/// The scripts that make a shell ask the program how a command line can go on.
namespace cbc::cli {

/// The name whose command lines are to be completed by a program that was called as this path or
/// name: its file name, or "cbc" if a shell could take that for anything but a word.
[[nodiscard]] std::string name_to_complete(std::string_view called_as);

/// The script for "bash", "zsh" or "fish" that completes the command lines of `program`.
[[nodiscard]] std::string completion_script(std::string_view shell, std::string_view program);

}  // namespace cbc::cli
