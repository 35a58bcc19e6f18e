#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cbc {

/// What a program made of a text.
struct Filtered {
  bool is_found = false;     ///< the program could be started
  bool is_done = false;      ///< it ended with exit status 0
  std::string output;        ///< its standard output
  std::string error_output;  ///< its standard error, or why it could not be run
};

/// Runs a program, found by PATH, with a text as standard input. No shell is involved.
[[nodiscard]] Filtered run_filter(const std::vector<std::string>& command, std::string_view input);

}  // namespace cbc
