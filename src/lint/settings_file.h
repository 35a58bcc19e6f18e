#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cbc/diagnostic.h"
#include "lint/severity_settings.h"

namespace cbc {

/// The name of files with settings.
inline constexpr std::string_view settings_file_name = ".cbc.yaml";

/// Finds the settings file for a file: the one in its folder, or else in the nearest folder above
/// that has one. The file itself need not exist; of a link, its own folder counts, not the one it
/// leads to. Folders that cannot be searched are passed over. The result is relative to the current
/// folder if `file` is.
[[nodiscard]] std::optional<std::string> find_settings_file(const std::string& file);

/// Reads the text of a settings file, in which all keys may be absent:
///
///     error: [unknown-key, dead-behavior]
///     warn: [exclusive-requirement]
///     allow: [required-goal]
///     strict: true
///
/// All that is wrong with it is reported, as errors; there are no settings then.
[[nodiscard]] std::optional<SeveritySettings> read_settings(std::string_view text, std::string file,
                                                            Diagnostics& diagnostics);

}  // namespace cbc
