#pragma once

#include <optional>
#include <string>

/// What the program has read, whatever for: catalogs, scripts, settings, states, property files,
/// logs. Whoever reads notes it here, and whoever writes asks here, so that no output replaces an
/// input, under whatever name.
namespace cbc::cli {

/// Notes that a file was read, or standard input ("-").
void note_read(const std::string& path);

/// Why a file must not be written, for people, or nothing: the same file was read, perhaps under
/// another name or through a link. Standard output ("-") replaces nothing.
[[nodiscard]] std::optional<std::string> find_read_file(const std::string& output);

}  // namespace cbc::cli
