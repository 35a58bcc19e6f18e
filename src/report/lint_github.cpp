#include "report/lint_github.h"

#include <string_view>

#include <fmt/format.h>

#include "report/github_command.h"

namespace cbc {
namespace {

std::string_view command_of(Severity severity) {
  return severity == Severity::note ? "notice" : name_of(severity);
}

std::string message_of(const Diagnostic& finding) {
  std::string message = finding.message;
  for (const Note& note : finding.notes) {
    message += fmt::format("\n{}:{}:{}: {}", note.file, note.range.begin.line,
                           note.range.begin.column, note.message);
  }
  return message;
}

}  // namespace

std::string github_command_of(const Diagnostic& finding) {
  return github_command(command_of(finding.severity), {finding.file, finding.range},
                        fmt::format("cbc {}", finding.rule), message_of(finding));
}

std::string lint_github(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) text += github_command_of(finding);
  }
  return text;
}

}  // namespace cbc
