#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/check/controls.h"
#include "core/diagnostic/diagnostic.h"

namespace cbc::cli {

/// Finds the settings that apply to a file: those of its `.cbc.yaml`, overridden by those of the
/// command line.
class SettingsFinder {
 public:
  explicit SettingsFinder(SeveritySettings command_line = {});

  /// Empty if the settings file cannot be used; the reason is printed to standard error, once.
  [[nodiscard]] std::optional<SeveritySettings> find(const std::string& path);

 private:
  const SeveritySettings command_line_;
  std::map<std::string, std::optional<SeveritySettings>> known_;  ///< by settings file
};

}  // namespace cbc::cli
