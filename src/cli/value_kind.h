#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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

}  // namespace cbc::cli
