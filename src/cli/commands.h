#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace cbc::cli {

/// All commands of the program, in the order of --help.
[[nodiscard]] std::vector<CLI::App*> commands_of(CLI::App& program);

/// Null if there is none of this name.
[[nodiscard]] CLI::App* find_command(CLI::App& program, const std::string& name);

}  // namespace cbc::cli
