#include "report/github_command.h"

#include <filesystem>

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

std::string describe_range(const Range& range) {
  return fmt::format(",line={},endLine={},col={},endColumn={}", range.begin.line, range.end.line,
                     range.begin.column, range.end.column);
}

/// GitHub attaches nothing to "./a.yaml", which is how a search in "." names a file.
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

}  // namespace cbc
