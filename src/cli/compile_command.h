#pragma once

#include <CLI/CLI.hpp>

namespace cbc::cli {

/// Adds `cbc compile` to the program. Where it is called, `status` receives the exit status.
void add_compile_command(CLI::App& program, int& status);

}  // namespace cbc::cli
