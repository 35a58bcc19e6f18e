#pragma once

#include <string>

namespace CLI {
class App;
}

namespace cbc::cli {

/// What --help shows of a command beside its options: the most common examples, right after the
/// usage, and the footer. `examples`: whole lines, indented.
void set_help(CLI::App& command, const std::string& examples, const std::string& footer);

}  // namespace cbc::cli
