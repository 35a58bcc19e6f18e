#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cbc::cli {

/// Texts larger than this are refused (compiled catalogs have a limit of their own), so that no
/// input can eat the memory of the machine.
inline constexpr std::size_t largest_file = std::size_t{256} << 20;

/// Contents of a file, or of standard input for "-". Prints why not to standard error.
[[nodiscard]] std::optional<std::string> read_input(const std::string& path);

/// The complaint about a command line that gives "-" more than once.
inline constexpr const char* stdin_only_once =
    "standard input can be read only once, but is given several times";

/// Name of an input in messages and reports.
[[nodiscard]] std::string display_name(const std::string& path);

/// The files with one of the suffixes (".yaml") of a folder and its folders, sorted by path; hidden
/// ones are passed over, and links to folders. Sets `has_failed`, and prints why to standard error,
/// if a folder cannot be read.
[[nodiscard]] std::vector<std::string> list_folder(const std::string& path,
                                                   std::initializer_list<std::string_view> suffixes,
                                                   bool& has_failed);

[[nodiscard]] bool is_folder(const std::string& path);

/// Prints a complaint to standard error.
void complain(const std::string& message);

/// The same about the command line of a command, whose help it points to. Returns the exit status.
int usage_error(std::string_view command, const std::string& message);

}  // namespace cbc::cli
