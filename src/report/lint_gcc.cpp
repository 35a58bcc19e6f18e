#include "report/lint_gcc.h"

#include <fmt/format.h>

#include "text/quote.h"

namespace cbc {
namespace {

std::string describe(const std::string& file, const Position& place, Severity severity,
                     const std::string& message) {
  return fmt::format("{}:{}:{}: {}: {}", printable(file), place.line, place.column,
                     name_of(severity), printable(message));
}

}  // namespace

std::string lint_gcc(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) {
      text += describe(finding.file, finding.range.begin, finding.severity, finding.message);
      text += fmt::format(" [{}]\n", finding.rule);
      for (const Note& note : finding.notes) {
        text += describe(note.file, note.range.begin, Severity::note, note.message) + "\n";
      }
    }
  }
  return text;
}

}  // namespace cbc
