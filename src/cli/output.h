#pragma once

#include <string>
#include <string_view>

namespace cbc::cli {

/// Writes a file, as a whole or not at all, or to standard output for "-". Prints why it could not.
/// Returns the exit status.
[[nodiscard]] int write_output(const std::string& path, std::string_view content);

/// Whether an input ("-": standard input) is the file that an output ("-": standard output, which
/// is none) would replace.
[[nodiscard]] bool is_same_file(const std::string& input, const std::string& output);

}  // namespace cbc::cli
