#include "cli/settings_finder.h"

#include <utility>

#include "cli/findings.h"
#include "cli/input.h"
#include "lint/settings_file.h"

namespace cbc::cli {

SettingsFinder::SettingsFinder(SeveritySettings command_line)
    : command_line_(std::move(command_line)) {}

std::optional<SeveritySettings> SettingsFinder::find(const std::string& path) {
  const std::optional<std::string> file = find_settings_file(path);
  if (!file) return command_line_;
  const auto [entry, is_new] = known_.try_emplace(*file);
  if (!is_new) return entry->second;
  if (const std::optional<std::string> text = read_input(*file)) {
    Diagnostics diagnostics;
    entry->second = read_settings(*text, *file, diagnostics);
    diagnostics.sort();
    print_findings(diagnostics.all(), {{*file, *text}});
  }
  if (entry->second) entry->second->override_with(command_line_);
  return entry->second;
}

}  // namespace cbc::cli
