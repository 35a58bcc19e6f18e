#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// What was tested, for continuous integration: as JUnit XML (the schema that Jenkins validates
// with), and as workflow commands of GitHub Actions.

namespace cbc {

/// What GitHub shows at a line. The title and the message may be any text; the message may have
/// several lines.
struct Annotation {
  Severity severity = Severity::error;
  std::optional<Range> place = {};  ///< empty: the file as a whole
  std::string title = {};
  std::string message = {};
};

/// At the beginning of a line.
[[nodiscard]] Range place_of_line(std::size_t line);

struct TestCase {
  enum class Status : std::uint8_t { passed, failed, error, skipped };
  std::string name = {};
  Status status = Status::passed;
  std::string type = {};     ///< of what is wrong: "expectation"
  std::string message = {};  ///< what is wrong or to be noticed, or why the case was skipped
  std::string details = {};  ///< further lines about that
  std::vector<Annotation> annotations = {};
};

/// What is only to be noticed, as no rule says that it is wrong.
[[nodiscard]] TestCase notice_of_line(std::size_t line, std::string title, std::string message);

/// The cases of a file.
struct TestSuite {
  std::string file;
  std::string catalog = {};  ///< the file of the catalog that they are about; may be empty
  std::vector<TestCase> cases = {};
};

/// A way to write suites, one after the other, between a begin and an end.
struct TestFormat {
  std::string (*begin)(std::string_view command);  ///< "cbc solve"
  std::string (*suite)(const TestSuite& suite);
  std::string_view end;
};

/// There are no times: those of a mission are not durations of tests.
extern const TestFormat junit_format;
/// Each annotation is a line. Nothing is written about successes.
extern const TestFormat github_format;

[[nodiscard]] std::string tests_to_text(const TestFormat& format, std::string_view command,
                                        std::span<const TestSuite> suites);

/// A report of a command that could not read its input. Each file with errors is a suite; if there
/// is none, one suite says that something else is wrong.
[[nodiscard]] std::string unreadable_to_text(const TestFormat& format, std::string_view command,
                                             std::span<const Diagnostic> findings);

/// A finding as an annotation of its file. Related places are further lines.
[[nodiscard]] Annotation annotation_of(const Diagnostic& finding);

}  // namespace cbc
