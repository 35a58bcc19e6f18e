#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostic/diagnostic.h"
#include "diagnostic/rules.h"
#include "lint/lint.h"

namespace cbc {

/// What an annotation is about.
struct GithubPlace {
  std::string file;
  std::optional<Range> range = {};  ///< empty: the file as a whole
};

/// A workflow command of GitHub Actions, a line, which becomes an annotation. `command` is error,
/// warning or notice. The title and the message may be any text; the message may have lines.
[[nodiscard]] std::string github_command(std::string_view command, const GithubPlace& place,
                                         std::string_view title, std::string_view message);

/// What lint found, for a person. Findings of a file that say the same are shown once, with the
/// lines of the others:
///
///     a.yaml:3:3: warning: 'efficacy' is an older name of 'suitability' [deprecated-key]
///       efficacy: 90
///       ^~~~~~~~
///       and 2 more like this, on lines 9, 15
///     3 warnings in 1 file
[[nodiscard]] std::string lint_text(const std::vector<LintedFile>& files, const Style& style);

/// What lint found, in the form of gcc, which editors understand, one place on a line:
///
///     a.yaml:3:9: error: task 'HOVER' is defined twice [duplicate-task]
///     a.yaml:1:9: note: first here
[[nodiscard]] std::string lint_gcc(const std::vector<LintedFile>& files);

/// A catalog in numbers, for a person: a table that begins with the name of the file. If the
/// catalog could not be understood, one line that says so.
[[nodiscard]] std::string lint_summary(const LintedFile& file, const Style& style);

/// What lint found, as JSON of the schema cbc.lint/1, one finding on a line. A name that is no
/// valid UTF-8 has replacement characters for what is wrong with it.
[[nodiscard]] std::string lint_json(const std::vector<LintedFile>& files);

/// What lint found, as a log of SARIF 2.1.0. `working_directory` is the absolute path that relative
/// names of files start from. Files below it have URIs relative to it, others absolute ones.
///
/// `is_complete`: whether all files could be read.
///
/// Each finding has a fingerprint that stays the same when it moves to another line.
[[nodiscard]] std::string lint_sarif(const std::vector<LintedFile>& files,
                                     std::string_view working_directory, bool is_complete);

/// A finding as a workflow command of GitHub Actions.
[[nodiscard]] std::string github_command_of(const Diagnostic& finding);

/// What lint found, as workflow commands of GitHub Actions: each becomes an annotation of the line
/// it is about. Places that belong to a finding are further lines of its message.
[[nodiscard]] std::string lint_github(const std::vector<LintedFile>& files);

/// All that is to be said about a rule, for a terminal of 80 columns.
[[nodiscard]] std::string rule_text(const Rule& rule, const Style& style);

/// All rules, one on a line: the most severe ones first, and by name.
[[nodiscard]] std::string rule_list(const Style& style);

/// Everything about a rule that is more than its summary, as Markdown: why it matters, an example,
/// and how it is mended.
[[nodiscard]] std::string rule_markdown(const Rule& rule);

}  // namespace cbc
