#pragma once

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc completion` to the program. Where it is called, `status` receives the exit status.
void add_completion_command(CLI::App& program, int& status);

}  // namespace cbc::cli
