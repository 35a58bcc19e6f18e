#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cbc/units.h"

/// What the value of an option, or an argument, stands for: so that completion knows what to offer,
/// and messages what was expected.
namespace cbc::cli {

enum class ValueKind {
  catalog,            ///< a file with a catalog or a script, or a folder of them
  script,             ///< a file with a script
  catalog_or_script,  ///< either, or a folder of scripts
  shard,   ///< a file with the result of a shard; of a flag: it makes the arguments such files
  file,    ///< any file
  rule,    ///< the name of a rule
  schema,  ///< the name of a schema
  task,    ///< the name of a task of the catalog
  task_or_behavior,
};

/// "a rule"
[[nodiscard]] std::string describe(ValueKind kind);

/// Accepts everything; `kind_of` finds the kind again.
[[nodiscard]] CLI::Validator stands_for(ValueKind kind);

/// Empty if the option has none.
[[nodiscard]] std::optional<ValueKind> kind_of(CLI::Option& option);

/// Accepts one of a few words; `choices_of` finds them again.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& choices);

/// Empty if the option has any value.
[[nodiscard]] std::vector<std::string> choices_of(CLI::Option& option);

/// "text, json or gcc"
[[nodiscard]] std::string list_choices(const std::vector<std::string>& choices);

/// Whether the option needs a value, unlike a flag.
[[nodiscard]] bool takes_value(const CLI::Option& option);

/// Checks of option values that CLI11 lacks, with messages that say what was expected.

/// Accepts a whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(
    std::int64_t least, std::int64_t most = std::numeric_limits<std::int64_t>::max());

/// Accepts a time in seconds, of so many microseconds at least.
[[nodiscard]] CLI::Validator seconds(Microseconds least = 1);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// What --help shows of a command beside its options.
struct HelpText {
  std::vector<std::string> usages;  ///< what follows the name of the command, a line each
  std::string examples;             ///< the most common ones: whole lines, indented
  std::string
      footer;  ///< paragraphs, which are wrapped; lines that begin with a blank are left alone
};

void set_help(CLI::App& command, HelpText text);

}  // namespace cbc::cli

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
