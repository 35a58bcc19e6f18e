#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/command_line/command_line.h"

namespace cbc::cli {

/// The words of a command line, taken apart as the declarations say. What runs a command and what
/// completes a line that is being typed both look at this, so a line that is wrong or unfinished is
/// understood as far as that goes.
struct ParsedLine {
  const Command* command = nullptr;  ///< null: none is given, or an unknown one
  bool has_unknown_command = false;
  /// What was given has at least one value; of a flag, and of a value that is missing, an empty
  /// one.
  std::map<const Option*, std::vector<std::string>> given;
  std::vector<std::string> arguments;  ///< all that are no options, as they are typed
  const Option* pending = nullptr;     ///< the line ends where its value may be
  bool has_separator = false;          ///< "--" is there: no options follow
  std::string fault;                   ///< the first thing that could not be understood, or empty

  /// Whether an option is given, as `others` of an Option name it.
  [[nodiscard]] bool has(const Command& of, const std::string& other) const;
};

/// `words` follow the name of the program.
[[nodiscard]] ParsedLine parse(const Program& program, const std::vector<std::string>& words);

/// Whether a word is meant as an option.
[[nodiscard]] bool is_option(const std::string& word);
/// Whether a word after an option is its value.
[[nodiscard]] bool is_value_of(const Option* option, const std::string& word);
/// The argument that comes after `given` of them; null if all are there.
[[nodiscard]] const Option* next_argument(const Command& command, std::size_t given);

/// The complaint about a name of an option without a value.
[[nodiscard]] std::string needs_value(const Option& option, const std::string& name);

/// What is wrong with a line that could be understood: values, files that are read and written, and
/// what does not go together. Empty if nothing is.
[[nodiscard]] std::string find_misuse(const Command& command, const ParsedLine& line);

}  // namespace cbc::cli
