#pragma once

#include <optional>
#include <string>

/// What the program may read, and what it has read, whatever for: catalogs, scripts, settings,
/// states, property files, logs. Whoever reads asks and notes it here, and whoever writes asks
/// here, so that no output replaces an input, under whatever name.
namespace cbc::cli {

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

/// Why a file must not be read, for people, or nothing: it is outside of that folder, or its name,
/// as only another file can give it, has a NUL character, which ends it for the system. Links and
/// ".." are followed. Standard input ("-") may be read.
[[nodiscard]] std::optional<std::string> find_refusal(const std::string& path);

}  // namespace cbc::cli
