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

// What the program may read, and what it has read, whatever for: catalogs, scripts, settings,
// states, property files, logs. Whoever reads asks and notes it here, and whoever writes asks
// here, so that no output replaces an input, under whatever name.

/// Notes that a file was read, or standard input ("-").
void note_read(const std::string& path);

/// Why a file must not be written, for people, or nothing: the same file was read, perhaps under
/// another name or through a link. Standard output ("-") replaces nothing.
[[nodiscard]] std::optional<std::string> find_read_file(const std::string& output);

/// Whether a file in a folder is a link to one outside of it. Then nothing of it must be shown that
/// is not meant for cbc: it may be a file that whoever made the link must not see.
[[nodiscard]] bool leads_out_of(const std::string& folder, const std::string& path);

/// Refuses from here on to read files outside of a folder, which must exist. For runs on files of
/// others, which may name files, or be links to them.
void confine_reading(const std::string& folder);
/// That folder; empty: there is none.
[[nodiscard]] std::string confinement();

/// Why a file must not be read, for people, or nothing: it is outside of that folder, or its name,
/// as only another file can give it, has a NUL character, which ends it for the system. Links and
/// ".." are followed. Standard input ("-") may be read.
[[nodiscard]] std::optional<std::string> find_refusal(const std::string& path);

}  // namespace cbc::cli
