#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// What was found for continuous integration: findings as workflow commands of GitHub Actions, and
// tests with their findings as JUnit XML (the schema that Jenkins validates with), too.

namespace cbc {

/// The place of a finding about a file as a whole.
inline constexpr Range whole_file = {{0, 0}, {0, 0}};

/// At the beginning of a line.
[[nodiscard]] Range place_of_line(std::size_t line);

/// What is only to be noticed. `rule`: what it is, must outlive it.
[[nodiscard]] Diagnostic notice_of_line(std::string_view file, std::size_t line,
                                        std::string_view rule, std::string message);

/// Each finding becomes an annotation of its lines. Those of one rule at one place become one, as
/// GitHub shows ten at most. The message may have several lines; related places are further ones.
[[nodiscard]] std::string annotations_to_text(std::span<const Diagnostic> findings);

/// A format of a report (see ReportFormat) that has annotations alone.
template <auto find>
constexpr auto as_annotations =
    [](const auto& result, const Style& /*style*/, std::size_t /*columns*/) {
      return annotations_to_text(find(result));
    };

struct TestCase {
  enum class Status : std::uint8_t { passed, failed, error, skipped };
  std::string name = {};
  Status status = Status::passed;
  std::vector<Diagnostic> findings = {};  ///< what is wrong or to be noticed
  std::string more = {};                  ///< why it was skipped, or what shows the findings

  /// Adds a finding, which makes the case a failure, or an error.
  void fail(Diagnostic finding, Status its_status = Status::failed);
};

/// The cases of a file.
struct TestSuite {
  std::string file;
  std::string catalog = {};  ///< the file of the catalog that they are about; may be empty
  std::vector<TestCase> cases = {};
};

/// A way to write suites, one after the other, between a begin and an end.
struct TestFormat {
  std::string_view name;
  std::string (*begin)(std::string_view command);  ///< "cbc solve"
  std::string (*suite)(const TestSuite& suite);
  std::string_view end;
};

/// There are no times: those of a mission are not durations of tests.
extern const TestFormat junit_format;
/// The findings as annotations. Nothing is written about successes.
extern const TestFormat github_format;

[[nodiscard]] std::string tests_to_text(const TestFormat& format, std::string_view command,
                                        std::span<const TestSuite> suites);

/// A report of a command that could not read its input, in a format for CI. Each file with errors
/// is a suite; if there is none, one suite says that something else is wrong. Empty in any other
/// format.
[[nodiscard]] std::string unreadable_to_text(std::string_view format, std::string_view command,
                                             std::span<const Diagnostic> findings);

}  // namespace cbc
