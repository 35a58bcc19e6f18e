#pragma once

#include <string>
#include <string_view>

namespace cbc::cli {

/// Writes a file, as a whole or not at all, or to standard output for "-". Prints why it could not.
/// Returns the exit status.
[[nodiscard]] int write_output(const std::string& path, std::string_view content);

/// Whether both lead to the same file; "-" and what is not there lead to none.
[[nodiscard]] bool is_same_file(const std::string& path, const std::string& other);

}  // namespace cbc::cli
