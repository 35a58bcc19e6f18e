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

/// Related places are further lines.
std::string message_with_notes(const Diagnostic& finding) {
  std::string text = finding.message;
  for (const Note& note : finding.notes) {
    text += fmt::format("\n{}: {}", format_place(note.file, note.range.begin), note.message);
  }
  return text;
}

/// The same after the place, if there is one.
std::string with_place(const Diagnostic& finding) {
  const std::string message = message_with_notes(finding);
  if (finding.range == whole_file) return message;
  return fmt::format("{}: {}", format_place(finding.file, finding.range.begin), message);
}

std::string junit_case(const TestCase& test, const std::string& file) {
  const std::string text =
      fmt::format(R"(<testcase name="{}" classname="{}")", xml_text(test.name), xml_text(file));
  if (test.status == TestCase::Status::skipped) {
    return text + fmt::format("><skipped message=\"{}\"/></testcase>\n", xml_text(test.more));
  }
  std::string findings = join(test.findings, "\n", with_place);
  if (test.status == TestCase::Status::passed) {
    return text + (findings.empty() ? "/>\n"
                                    : fmt::format("><system-out>{}</system-out></testcase>\n",
                                                  xml_lines(findings)));
  }
  const Diagnostic& first = test.findings.front();
  std::string message = first.message.substr(0, first.message.find('\n'));
  if (test.findings.size() > 1) message += fmt::format(" (and {} more)", test.findings.size() - 1);
  if (!test.more.empty()) findings += "\n\n" + test.more;
  return text + fmt::format(">\n<{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n</testcase>\n",
                            test.status == TestCase::Status::failed ? "failure" : "error",
                            xml_text(first.rule), xml_text(message), xml_lines(findings));
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
std::string github_command(const Diagnostic& finding, const std::string& message) {
  const auto property = [](std::string_view text) { return escape_for_github(text, ":,"); };
  const auto& [begin, end] = finding.range;
  const std::string place = finding.range == whole_file
                                ? ""
                                : fmt::format(",line={},endLine={},col={},endColumn={}", begin.line,
                                              end.line, begin.column, end.column);
  // GitHub does not attach annotations to "./a.yaml", which is how a search in "." names a file.
  const std::string path = std::filesystem::path(finding.file).lexically_normal().string();
  return fmt::format("::{} file={}{},title=cbc {}::{}\n",
                     finding.severity == Severity::note ? "notice" : name_of(finding.severity),
                     property(path), place, property(finding.rule), escape_for_github(message, ""));
}

std::string github_suite(const TestSuite& suite) {
  std::string text;
  for (const TestCase& test : suite.cases) text += annotations_to_text(test.findings);
  return text;
}

}  // namespace

const TestFormat junit_format = {"junit", junit_begin, junit_suite, "</testsuites>\n"};
const TestFormat github_format = {"github", [](std::string_view) { return std::string(); },
                                  github_suite, ""};

Range place_of_line(std::size_t line) {
  const Position begin{static_cast<std::uint32_t>(line), 1};
  return {begin, begin};
}

Diagnostic notice_of_line(std::string_view file, std::size_t line, std::string_view rule,
                          std::string message) {
  return {rule, Severity::note, std::string(file), place_of_line(line), std::move(message), {}};
}

std::string annotations_to_text(std::span<const Diagnostic> findings) {
  std::string text;
  for (std::size_t first = 0, end = 0; first < findings.size(); first = end) {
    const Diagnostic& finding = findings[first];
    std::string message;
    for (; end < findings.size(); ++end) {
      const Diagnostic& next = findings[end];
      if (next.rule != finding.rule || next.file != finding.file || next.range != finding.range) {
        break;
      }
      message += (end > first ? "\n" : "") + message_with_notes(next);
    }
    text += github_command(finding, message);
  }
  return text;
}

void TestCase::fail(Diagnostic finding, Status its_status) {
  status = its_status;
  findings.push_back(std::move(finding));
}

std::string tests_to_text(const TestFormat& format, std::string_view command,
                          std::span<const TestSuite> suites) {
  std::string text = format.begin(command);
  for (const TestSuite& suite : suites) text += format.suite(suite);
  return text.append(format.end);
}

std::string unreadable_to_text(std::string_view format, std::string_view command,
                               std::span<const Diagnostic> findings) {
  std::map<std::string, TestCase> by_file;
  const auto add = [&](const Diagnostic& finding) {
    TestCase& test = by_file.try_emplace(finding.file, TestCase{"can be read"}).first->second;
    test.fail(finding, TestCase::Status::error);
  };
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::error) add(finding);
  }
  if (by_file.empty()) {
    add({"input",
         Severity::error,
         "<input>",
         whole_file,
         "the input cannot be read; standard error has the reason",
         {}});
  }
  std::vector<TestSuite> suites;
  suites.reserve(by_file.size());
  for (auto& [file, test] : by_file) suites.push_back({file, {}, {std::move(test)}});
  for (const TestFormat* const one : {&junit_format, &github_format}) {
    if (one->name == format) return tests_to_text(*one, command, suites);
  }
  return {};
}

}  // namespace cbc
