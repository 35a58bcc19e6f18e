#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/value_kind.h"

namespace cbc::cli {

/// The words around the one that is being typed, understood as far as they can be.
struct TypedLine {
  CLI::App* command = nullptr;        ///< null: it comes next
  bool is_unknown = false;            ///< there is no such command
  CLI::Option* pending = nullptr;     ///< what is being typed is its value
  bool has_separator = false;         ///< "--" is before it: no options come any more
  std::size_t positionals = 0;        ///< of the command, before it
  std::vector<std::string> files;     ///< the positionals before and behind it
  std::vector<std::string> scripts;   ///< that options before and behind it name
  std::optional<ValueKind> argument;  ///< what a flag makes of the positionals
};

/// `words`: those after the name of the program; the last one is being typed. `behind`: those
/// behind it.
[[nodiscard]] TypedLine understand_line(CLI::App& program, const std::vector<std::string>& words,
                                        const std::vector<std::string>& behind);

}  // namespace cbc::cli
