#include "fuzz/lint.h"

#include <cstddef>
#include <utility>

#include "core/catalog/older_format.h"
#include "core/check/allow_comments.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "fuzz/target.h"
#include "lint/report/lint_report.h"

namespace cbc::fuzz {
namespace {

constexpr std::uint64_t most_lint_nodes = 1000;

}  // namespace

LintedCatalog lint(std::string text, const SeveritySettings& settings) {
  LintedCatalog linted;
  linted.file.file = "robot.yaml";
  linted.file.text = std::move(text);
  Diagnostics diagnostics;
  const auto document = yaml::parse(linted.file.text, linted.file.file, diagnostics);
  if (document == nullptr) {
    require(diagnostics.has_errors(), "a text is refused without a reason");
    linted.errors = diagnostics.count(Severity::error);
    linted.file.kind = LintedFile::Kind::unknown;
    linted.file.findings = control_findings(
        diagnostics.release(), {linted.file.file, linted.file.text, nullptr, false}, settings);
    return linted;
  }
  if (find_older_format(document->root())) {
    const Conversion conversion = convert_older_format(*document, linted.file.text);
    Diagnostics of_conversion;
    const auto converted = yaml::parse(conversion.text, {}, of_conversion);
    require(converted != nullptr, "what an older catalog is converted to is not valid YAML");
    require(!find_older_format(converted->root()), "an older catalog stays one");
  }
  CheckedCatalog checked = check_catalog(*document, linted.file.text, settings,
                                         LintOptions{most_lint_nodes}, std::move(diagnostics));
  if (checked.compiled) linted.file.summary = summarize(*checked.compiled);
  linted.catalog = std::move(checked.reading.catalog);
  linted.compiled = std::move(checked.compiled);
  linted.errors = checked.errors;
  linted.file.findings = std::move(checked.findings);
  return linted;
}

void report(const LintedFile& file) {
  const auto formats = lint_formats();
  const LintFormat& format = formats[file.text.size() % formats.size()];
  const std::string text = format.write({file}, {"/", true, plain_style()});
  require(!text.empty() || (format.name != "json" && format.name != "sarif"), "a report is empty");
}

void fix(const LintedCatalog& linted, const SeveritySettings& settings) {
  LintedCatalog fixed;
  fixed.file = linted.file;
  fixed.catalog = linted.catalog;
  fixed.errors = linted.errors;
  // Each round takes an entry or an older name out of the text.
  for (std::size_t rounds = 0;; ++rounds) {
    FixedText text = apply_fixes(fixed.file.text, fixed.file.findings);
    if (text.mended.empty()) break;
    require(rounds <= linted.file.text.size(), "fixing does not end");
    fixed = lint(std::move(text.text), settings);
  }
  require(same_meaning(linted.catalog, fixed.catalog), "a fix changes the meaning");
  require(fixed.errors <= linted.errors, "a fix adds errors");
}

}  // namespace cbc::fuzz
