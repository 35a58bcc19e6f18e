#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cbc::cli {

/// Files larger than this are refused, so that no input can eat the memory of the machine.
inline constexpr std::size_t largest_file = std::size_t{256} << 20;

/// Contents of a file, or of standard input for "-". Prints why not to standard error.
[[nodiscard]] std::optional<std::string> read_input(const std::string& path);

/// Name of an input in messages and reports.
[[nodiscard]] std::string display_name(const std::string& path);

/// The files with one of the suffixes (".yaml") of a folder and its folders, sorted by path; hidden
/// ones are passed over. Prints why not to standard error.
[[nodiscard]] std::optional<std::vector<std::string>> list_folder(
    const std::string& path, std::initializer_list<std::string_view> suffixes);

[[nodiscard]] bool is_folder(const std::string& path);

/// Prints a complaint to standard error.
void complain(const std::string& message);

}  // namespace cbc::cli
