#include "core/files/findings.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/diagnostic/rules.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts) {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts) sources.add(file, *text);
  const Style style = style_for(stderr);
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.severity == Severity::error ||
        (++warnings[{finding.file, finding.rule}] <= most_warnings &&
         finding.rule != rule::deprecated_key.name)) {
      fmt::print(stderr, "{}", render(finding, sources, style));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (kind.second == rule::deprecated_key.name) {
      fmt::print(stderr, "{}: {}: {} {}; see 'cbc lint', or 'cbc lint --fix' [{}]\n",
                 printable(kind.first), style.paint(style.warning, "warning"),
                 quantity(count, "key"), count == 1 ? "has an older name" : "have older names",
                 kind.second);
      continue;
    }
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

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
