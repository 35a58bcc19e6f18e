#pragma once

#include <string_view>

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc completion` to the program, which was called as the path or name `called_as`: its
/// scripts complete that name. Where the command is called, `status` receives the exit status.
void add_completion_command(CLI::App& program, std::string_view called_as, int& status);

}  // namespace cbc::cli
