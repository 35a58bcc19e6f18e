#pragma once

#include <map>
#include <optional>
#include <string>

#include "lint/severity_settings.h"

namespace cbc::cli {

/// Finds the settings that hold for a file: those of the command line, over those of its
/// `.cbc.yaml`.
class SettingsFinder {
 public:
  explicit SettingsFinder(SeveritySettings command_line = {});

  /// Empty if there is a settings file that cannot be used; why is printed to standard error, once.
  [[nodiscard]] std::optional<SeveritySettings> find(const std::string& path);

 private:
  const SeveritySettings command_line_;
  std::map<std::string, std::optional<SeveritySettings>> known_;  ///< by settings file
};

}  // namespace cbc::cli
