#include "report/lint_text.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>

#include "diagnostic/text.h"
#include "report/quantity.h"

namespace cbc {
namespace {

// Of findings that say the same as one that is shown in full.
constexpr std::size_t most_lines = 10;

/// Findings that say the same, in the order of the file.
using Alike = std::vector<const Diagnostic*>;

/// "  and 2 more like this, on lines 9, 15"
std::string describe_others(const Alike& alike) {
  std::string lines;
  std::size_t count = 0;
  std::uint32_t last = 0;
  for (std::size_t i = 1; i < alike.size(); ++i) {
    const std::uint32_t line = alike[i]->range.begin.line;
    if (line == last) continue;
    last = line;
    if (++count > most_lines) {
      lines += ", ...";
      break;
    }
    lines += (count > 1 ? ", " : "") + std::to_string(line);
  }
  return "  and " + std::to_string(alike.size() - 1) + " more like this, on " +
         (count == 1 ? "line " : "lines ") + lines;
}

std::string file_to_text(const LintedFile& file, const SourceTexts& sources, const Style& style) {
  std::map<std::tuple<Severity, std::string_view, std::string_view>, Alike> by_message;
  for (const Diagnostic& finding : file.findings) {
    by_message[{finding.severity, finding.rule, finding.message}].push_back(&finding);
  }
  std::string text;
  for (const Diagnostic& finding : file.findings) {
    const Alike& alike = by_message[{finding.severity, finding.rule, finding.message}];
    if (alike.front() != &finding) continue;
    text += render(finding, sources, style);
    if (alike.size() > 1) text += style.paint(style.faint, describe_others(alike)) + "\n";
  }
  return text;
}

/// "2 errors, 1 warning in 4 files"
std::string describe_total(const std::vector<LintedFile>& files, const Style& style) {
  std::string text;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    const std::size_t findings = count(files, severity);
    if (findings == 0) continue;
    if (!text.empty()) text += ", ";
    text += style.paint(style.of(severity), quantity(findings, name_of(severity)));
  }
  if (text.empty()) text = style.paint(style.good, "no findings");
  return text + " in " + quantity(files.size(), "file") + "\n";
}

}  // namespace

std::string lint_text(const std::vector<LintedFile>& files, const Style& style) {
  SourceTexts sources;
  for (const LintedFile& file : files) sources.add(file.file, file.text);
  std::string text;
  for (const LintedFile& file : files) text += file_to_text(file, sources, style);
  return text + describe_total(files, style);
}

}  // namespace cbc
