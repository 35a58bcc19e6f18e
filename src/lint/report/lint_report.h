#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"

namespace cbc {

/// The findings for people. Findings with the same message in a file are shown once, with the line
/// numbers of the others:
///
///     a.yaml:3:3: warning: 'efficacy' is an older name of 'suitability' [deprecated-key]
///       efficacy: 90
///       ^~~~~~~~
///       and 2 more like this, on lines 9, 15
///     3 warnings in 1 catalog; 1 file was not understood: b.yaml
///
/// `not_understood`: files without findings, which may be those of other programs.
[[nodiscard]] std::string lint_text(const std::vector<LintedFile>& files, const Style& style,
                                    const std::vector<std::string>& not_understood = {});

/// The findings in the format of gcc, which editors understand, one place per line:
///
///     a.yaml:3:9: error: task 'HOVER' is defined twice [duplicate-task]
///     a.yaml:1:9: note: first here
[[nodiscard]] std::string lint_gcc(const std::vector<LintedFile>& files);

/// The numbers of a catalog for people: a table that begins with the name of the file, or one line
/// that says that the catalog could not be understood.
[[nodiscard]] std::string lint_summary(const LintedFile& file, const Style& style);

/// The findings as JSON, one per line. Invalid UTF-8 in names is replaced by U+FFFD.
[[nodiscard]] std::string lint_json(const std::vector<LintedFile>& files);
[[nodiscard]] std::string lint_schema();

/// The findings as a SARIF 2.1.0 log. `working_directory` is the absolute path that relative file
/// names start from. Files below it get URIs relative to it, others get absolute ones.
///
/// `is_complete`: whether all files could be read.
///
/// Each finding has a fingerprint that does not change when the finding moves to another line.
[[nodiscard]] std::string lint_sarif(const std::vector<LintedFile>& files,
                                     std::string_view working_directory, bool is_complete);

/// What a report depends on besides the findings.
struct LintRun {
  std::string working_directory;                 ///< absolute
  bool is_complete = true;                       ///< all files could be read
  Style style = plain_style();                   ///< of a text for people
  std::vector<std::string> not_understood = {};  ///< see lint_text
};

/// A format of `cbc lint`.
struct LintFormat {
  std::string_view name;
  std::string (*write)(const std::vector<LintedFile>& files, const LintRun& run);
};

/// The first one is the default.
[[nodiscard]] std::span<const LintFormat> lint_formats();

/// The findings as workflow commands of GitHub Actions: each becomes an annotation of its line.
/// Related places are further lines of the message.
[[nodiscard]] std::string lint_github(const std::vector<LintedFile>& files);

/// The full description of a rule, for a terminal of 80 columns.
[[nodiscard]] std::string rule_text(const Rule& rule, const Style& style);

/// All rules, one per line, by severity (errors first) and by name.
[[nodiscard]] std::string rule_list(const Style& style);

/// The description of a rule without its summary, as Markdown: why it matters, an example, and how
/// to mend it.
[[nodiscard]] std::string rule_markdown(const Rule& rule);

}  // namespace cbc
