#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// What reports in JUnit XML consist of (the schema that Jenkins validates with).

namespace cbc {

/// Escapes a text as content of an XML element or as a quoted attribute value. Line ends are kept;
/// other control characters, invalid UTF-8 and characters that XML 1.0 does not allow become
/// printable.
[[nodiscard]] std::string xml_text(std::string_view text);

/// The begin of a report; `command`: "cbc solve".
[[nodiscard]] std::string open_junit(std::string_view command);
[[nodiscard]] std::string close_junit();

/// The begin of a test suite, which is about a file.
[[nodiscard]] std::string open_suite(const std::string& file, std::uint64_t tests,
                                     std::uint64_t failures, std::uint64_t errors,
                                     std::uint64_t skipped);
[[nodiscard]] std::string close_suite();

/// A problem of a test case: failure or error. `details` are XML.
[[nodiscard]] std::string junit_problem(std::string_view element, std::string_view type,
                                        const std::string& message, const std::string& details);

/// A test case with a problem.
[[nodiscard]] std::string broken_case(const std::string& name, const std::string& file,
                                      const std::string& problem);

/// A report of a command that could not read its input. Each file with errors is a suite; if there
/// is none, one suite says that something else is wrong.
[[nodiscard]] std::string junit_of_unreadable(std::string_view command,
                                              const std::vector<Diagnostic>& findings);

}  // namespace cbc
