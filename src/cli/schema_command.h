#pragma once

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `schema` to the program. When it is parsed, it runs and sets `status`.
void add_schema_command(CLI::App& program, int& status);

}  // namespace cbc::cli
