#include "report/lint_github.h"

#include <string_view>

#include <fmt/format.h>

#include "text/quote.h"

namespace cbc {
namespace {

/// A text in which GitHub's runner finds neither the end of the line nor any of `separators`.
/// Control characters that it has no escape for are made printable.
std::string escape(std::string_view text, std::string_view separators) {
  std::string escaped;
  for (const char byte : text) {
    if (byte == '%' || byte == '\r' || byte == '\n' ||
        separators.find(byte) != std::string_view::npos) {
      escaped += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
    } else {
      escaped += byte;
    }
  }
  return printable(escaped);
}

std::string escape_message(std::string_view text) { return escape(text, ""); }
std::string escape_property(std::string_view text) { return escape(text, ":,"); }

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

std::string lint_github(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) {
      text +=
          fmt::format("::{} file={},line={},endLine={},col={},endColumn={},title=cbc {}::{}\n",
                      command_of(finding.severity), escape_property(finding.file),
                      finding.range.begin.line, finding.range.end.line, finding.range.begin.column,
                      finding.range.end.column, finding.rule, escape_message(message_of(finding)));
    }
  }
  return text;
}

}  // namespace cbc
