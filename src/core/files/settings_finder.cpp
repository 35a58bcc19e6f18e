#include "core/files/settings_finder.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "core/files/findings.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/files/read_files.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

std::string folder_of(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

}  // namespace

SettingsFinder::SettingsFinder(SeveritySettings command_line)
    : command_line_(std::move(command_line)) {}

std::optional<SeveritySettings> SettingsFinder::find(const std::string& path) {
  const std::optional<std::string> file = find_settings_file(path);
  // One above the folder of --confine belongs to others.
  if (!file || find_refusal(folder_of(*file))) return command_line_;
  const auto [entry, is_new] = known_.try_emplace(*file);
  if (!is_new) return entry->second;
  if (const std::optional<std::string> text = read_input(*file)) {
    Diagnostics diagnostics;
    entry->second = read_settings(*text, *file, diagnostics);
    diagnostics.sort();
    if (!entry->second && leads_out_of(folder_of(*file), *file)) {
      complain("{} is a link to a file elsewhere that has no valid settings", quote(*file));
    } else {
      print_findings(diagnostics.all(), {{*file, std::make_shared<const std::string>(*text)}});
    }
  }
  if (entry->second) entry->second->override_with(command_line_);
  return entry->second;
}

}  // namespace cbc::cli
