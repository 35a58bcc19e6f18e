#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Reads files and folders that command lines, or other files, name. If one cannot be read, prints
/// why to standard error.
namespace cbc::cli {

/// Prints why a file cannot be read.
std::nullopt_t cannot_read(const std::string& path, const std::string& reason);

/// The content of a file, or of standard input for "-".
[[nodiscard]] std::optional<std::string> read_input(const std::string& path);

/// The same for a JSON result that is to be merged with others.
[[nodiscard]] std::optional<std::string> read_result(const std::string& path);

/// The name of an input in messages and reports.
[[nodiscard]] std::string display_name(const std::string& path);

/// The files in a folder and its subfolders that have one of the suffixes (".yaml"), sorted by
/// path. Hidden files and links to folders are skipped. If a folder cannot be read, sets
/// `has_failed`.
[[nodiscard]] std::vector<std::string> list_folder(const std::string& path,
                                                   std::initializer_list<std::string_view> suffixes,
                                                   bool& has_failed);

[[nodiscard]] bool is_folder(const std::string& path);

/// Whether it is a pipe, a device or a socket, from which something may never come.
[[nodiscard]] bool is_special(const std::string& path);

/// Whether it is a regular file with a compiled catalog. Other files cannot be read twice.
[[nodiscard]] bool can_be_mapped(const std::string& path);

}  // namespace cbc::cli
