#include "core/report/test_report.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// The content of an element, with plain line ends, which are easier to read.
std::string xml_lines(std::string_view text) {
  std::string escaped;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    escaped += xml_text(text.substr(begin, end - begin));
    if (end < text.size()) escaped += '\n';
    begin = end + 1;
  }
  return escaped;
}

std::string junit_begin(std::string_view command) {
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\">\n",
                     command);
}

std::string junit_case(const TestCase& test, const std::string& file) {
  std::string text =
      fmt::format(R"(<testcase name="{}" classname="{}")", xml_text(test.name), xml_text(file));
  const std::string message = xml_text(test.message);
  switch (test.status) {
    case TestCase::Status::passed:
      return text + (message.empty()
                         ? "/>\n"
                         : fmt::format("><system-out>{}</system-out></testcase>\n", message));
    case TestCase::Status::skipped:
      return text + fmt::format("><skipped message=\"{}\"/></testcase>\n", message);
    case TestCase::Status::failed:
    case TestCase::Status::error:
      break;
  }
  return text + fmt::format(">\n<{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n</testcase>\n",
                            test.status == TestCase::Status::failed ? "failure" : "error",
                            test.type, message, xml_lines(test.details));
}

std::string junit_suite(const TestSuite& suite) {
  const auto count = [&](TestCase::Status status) {
    return std::count_if(suite.cases.begin(), suite.cases.end(),
                         [status](const TestCase& test) { return test.status == status; });
  };
  std::string text = fmt::format(
      "<testsuite name=\"{0}\" tests=\"{1}\" failures=\"{2}\" errors=\"{3}\" skipped=\"{4}\" "
      "file=\"{0}\">\n",
      xml_text(suite.file), suite.cases.size(), count(TestCase::Status::failed),
      count(TestCase::Status::error), count(TestCase::Status::skipped));
  if (!suite.catalog.empty()) {
    text += fmt::format("<properties><property name=\"catalog\" value=\"{}\"/></properties>\n",
                        xml_text(suite.catalog));
  }
  for (const TestCase& test : suite.cases) text += junit_case(test, suite.file);
  return text + "</testsuite>\n";
}

/// Escapes line ends and `separators` for GitHub's runner. Control characters that it has no escape
/// for become printable.
std::string escape_for_github(std::string_view text, std::string_view separators) {
  std::string escaped;
  for (const char byte : text) {
    if (byte == '%' || byte == '\r' || byte == '\n' ||
        separators.find(byte) != std::string_view::npos) {
      append_percent_encoded(escaped, byte);
    } else {
      escaped += byte;
    }
  }
  return printable(escaped);
}

/// One line, which becomes an annotation.
std::string github_command(const std::string& file, const Annotation& annotation) {
  const auto property = [](std::string_view text) { return escape_for_github(text, ":,"); };
  const std::string place =
      annotation.place ? fmt::format(",line={},endLine={},col={},endColumn={}",
                                     annotation.place->begin.line, annotation.place->end.line,
                                     annotation.place->begin.column, annotation.place->end.column)
                       : "";
  // GitHub does not attach annotations to "./a.yaml", which is how a search in "." names a file.
  const std::string path = std::filesystem::path(file).lexically_normal().string();
  return fmt::format(
      "::{} file={}{},title={}::{}\n",
      annotation.severity == Severity::note ? "notice" : name_of(annotation.severity),
      property(path), place, property(annotation.title), escape_for_github(annotation.message, ""));
}

std::string github_suite(const TestSuite& suite) {
  std::string text;
  for (const TestCase& test : suite.cases) {
    for (const Annotation& one : test.annotations) text += github_command(suite.file, one);
  }
  return text;
}

std::string place_and_message(const std::string& file, const Range& range,
                              const std::string& message) {
  return fmt::format("{}: {}", format_place(file, range.begin), message);
}

}  // namespace

const TestFormat junit_format = {junit_begin, junit_suite, "</testsuites>\n"};
const TestFormat github_format = {[](std::string_view) { return std::string(); }, github_suite, ""};

Range place_of_line(std::size_t line) {
  const Position begin{static_cast<std::uint32_t>(line), 1};
  return {begin, begin};
}

TestCase notice_of_line(std::size_t line, std::string title, std::string message) {
  TestCase test;
  test.annotations.push_back(
      {Severity::note, place_of_line(line), std::move(title), std::move(message)});
  return test;
}

std::string tests_to_text(const TestFormat& format, std::string_view command,
                          std::span<const TestSuite> suites) {
  std::string text = format.begin(command);
  for (const TestSuite& suite : suites) text += format.suite(suite);
  return text.append(format.end);
}

std::string unreadable_to_text(const TestFormat& format, std::string_view command,
                               std::span<const Diagnostic> findings) {
  const auto case_of = [](std::string message) {
    return TestCase{"can be read", TestCase::Status::error, "input", std::move(message)};
  };
  std::map<std::string, TestCase> by_file;
  for (const Diagnostic& finding : findings) {
    if (finding.severity != Severity::error) continue;
    TestCase& test = by_file.try_emplace(finding.file, case_of(finding.message)).first->second;
    test.details += place_and_message(finding.file, finding.range, finding.message) + "\n";
    test.annotations.push_back(annotation_of(finding));
  }
  if (by_file.empty()) {
    by_file["<input>"] = case_of("the input cannot be read; standard error has the reason");
  }
  std::vector<TestSuite> suites;
  suites.reserve(by_file.size());
  for (auto& [file, test] : by_file) suites.push_back({file, {}, {std::move(test)}});
  return tests_to_text(format, command, suites);
}

Annotation annotation_of(const Diagnostic& finding) {
  std::string message = finding.message;
  for (const Note& note : finding.notes) {
    message += "\n" + place_and_message(note.file, note.range, note.message);
  }
  return {finding.severity, finding.range, fmt::format("cbc {}", finding.rule), message};
}

}  // namespace cbc
