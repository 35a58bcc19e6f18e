#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

/// What is wrong with a command line, in plain sentences.
namespace cbc::cli {

/// The complaint about a command line, of these arguments, that CLI11 refused.
[[nodiscard]] std::string describe_usage_error(CLI::App& program, const CLI::ParseError& error,
                                               const std::vector<std::string>& arguments);

/// The complaint about a first argument that is no command; empty if it is one, or an option.
[[nodiscard]] std::string find_unknown_command(CLI::App& program, const std::string& argument);

/// The complaint about an equals sign: behind a short option, whose value it would begin, or with
/// no value behind it, where the next argument would be taken; empty if there is none.
[[nodiscard]] std::string find_bad_equals(CLI::App& program,
                                          const std::vector<std::string>& arguments);

/// The command that was called, as "cbc lint", or "cbc".
[[nodiscard]] std::string full_name(const CLI::App& program);

}  // namespace cbc::cli
