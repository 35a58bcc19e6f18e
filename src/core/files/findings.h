#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/check/controls.h"
#include "core/diagnostic/diagnostic.h"

namespace cbc::cli {

/// The texts of files, by their names in messages.
using Texts = std::map<std::string, std::shared_ptr<const std::string>>;

/// Prints findings to standard error: all errors, and the first few warnings of each rule in each
/// file, but no notes. Older names of keys, of which a file usually has many, are only counted.
/// `texts` has the files they are about.
void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts);

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
