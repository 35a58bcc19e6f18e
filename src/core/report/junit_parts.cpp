#include "core/report/junit_parts.h"

#include <cstddef>
#include <map>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// As a character reference: parsers turn a plain line end in an attribute into a blank.
constexpr std::string_view line_end = "&#10;";

std::string escape(std::string_view character, char32_t code) {
  switch (code) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\n':
      return std::string(line_end);
    case 0xFFFE:
      return "\\ufffe";
    case 0xFFFF:
      return "\\uffff";
    default:
      return printable(character);
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    escaped += escape(text.substr(offset, decoded.bytes), decoded.character);
    offset += decoded.bytes;
  }
  return escaped;
}

std::string open_junit(std::string_view command) {
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n",
                     command);
}

std::string close_junit() { return "</testsuites>\n"; }

std::string open_suite(const std::string& file, std::uint64_t tests, std::uint64_t failures,
                       std::uint64_t errors, std::uint64_t skipped) {
  const std::string name = xml_text(file);
  return fmt::format(
      "<testsuite name=\"{0}\" tests=\"{1}\" failures=\"{2}\" errors=\"{3}\" skipped=\"{4}\" "
      "file=\"{0}\">\n",
      name, tests, failures, errors, skipped);
}

std::string close_suite() { return "</testsuite>\n"; }

std::string junit_problem(std::string_view element, std::string_view type,
                          const std::string& message, const std::string& details) {
  return fmt::format(R"(<{0} type="{1}" message="{2}">{3}</{0}>)", element, type, xml_text(message),
                     details);
}

std::string broken_case(const std::string& name, const std::string& file,
                        const std::string& problem) {
  return fmt::format("<testcase name=\"{}\" classname=\"{}\">\n{}\n</testcase>\n", xml_text(name),
                     xml_text(file), problem);
}

namespace {

std::string describe_finding(const Diagnostic& finding) {
  return fmt::format("{}: {}", format_place(finding.file, finding.range.begin), finding.message);
}

std::string unreadable_suite(const std::string& file, const std::string& message,
                             const std::string& text) {
  return open_suite(file, 1, 0, 1, 0) +
         broken_case("can be read", file, junit_problem("error", "input", message, text)) +
         close_suite();
}

}  // namespace

std::string junit_of_unreadable(std::string_view command, const std::vector<Diagnostic>& findings) {
  std::map<std::string, std::vector<const Diagnostic*>> by_file;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::error) by_file[finding.file].push_back(&finding);
  }
  std::string text = open_junit(command);
  if (by_file.empty()) {
    text +=
        unreadable_suite("<input>", "the input cannot be read; standard error has the reason", "");
  }
  for (const auto& [file, errors] : by_file) {
    std::string details;
    for (const Diagnostic* error : errors) details += xml_text(describe_finding(*error)) + "\n";
    text += unreadable_suite(file, errors.front()->message, details);
  }
  return text + close_junit();
}

}  // namespace cbc
