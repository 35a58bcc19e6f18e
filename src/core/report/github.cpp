#include "core/report/github.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Escapes line ends and `separators` for GitHub's runner. Control characters that it has no escape
/// for become printable.
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

std::string describe_range(const Range& range) {
  return fmt::format(",line={},endLine={},col={},endColumn={}", range.begin.line, range.end.line,
                     range.begin.column, range.end.column);
}

/// GitHub does not attach annotations to "./a.yaml", which is how a search in "." names a file.
std::string plain_path(const std::string& file) {
  return std::filesystem::path(file).lexically_normal().string();
}

}  // namespace

std::string github_command(std::string_view command, const GithubPlace& place,
                           std::string_view title, std::string_view message) {
  return fmt::format("::{} file={}{},title={}::{}\n", command,
                     escape_property(plain_path(place.file)),
                     place.range ? describe_range(*place.range) : "", escape_property(title),
                     escape_message(message));
}

namespace {

std::string_view command_of(Severity severity) {
  return severity == Severity::note ? "notice" : name_of(severity);
}

std::string message_of(const Diagnostic& finding) {
  std::string message = finding.message;
  for (const Note& note : finding.notes) {
    message += fmt::format("\n{}: {}", format_place(note.file, note.range.begin), note.message);
  }
  return message;
}

}  // namespace

std::string github_command_of(const Diagnostic& finding) {
  return github_command(command_of(finding.severity), {finding.file, finding.range},
                        fmt::format("cbc {}", finding.rule), message_of(finding));
}

std::string github_commands_of_errors(const std::vector<Diagnostic>& findings) {
  std::string text;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::error) text += github_command_of(finding);
  }
  return text;
}

}  // namespace cbc
