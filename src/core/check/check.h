#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalog/reader.h"
#include "core/check/severity_settings.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"

/// Checks catalogs by all rules, and mends texts by the edits of findings.
namespace cbc {

/// How deep a catalog is checked: only as reading it does, by the rules that need no search, or by
/// all rules.
enum class CheckDepth : std::uint8_t { reading, rules, searches };

struct LintOptions {
  /// Decisions that the search for one answer may take; past them there is a finding `undecided`.
  std::uint64_t max_nodes = 100'000;
  /// What the rule `can-run-together` checks; must outlive the check.
  std::span<const NeverTogether> never_together = {};
  CheckDepth depth = CheckDepth::searches;
  /// Returns those of some findings that are reported; empty: all of them are. What is wrong behind
  /// a finding is looked for if it is not reported.
  std::function<std::vector<Diagnostic>(std::vector<Diagnostic>)> control = {};
  /// Asked now and then in searches; true ends them, and the findings are then not all there are.
  std::function<bool()> is_stopped = {};
};

/// What is known of a catalog. If it was read in compiled form, there is only that.
struct CheckedCatalog {
  std::shared_ptr<const std::string> text;  ///< that was read
  CatalogReading reading;
  std::shared_ptr<const CompiledCatalog> compiled;  ///< null if it was not fully understood
  std::vector<Diagnostic> findings;                 ///< what is to be reported
  std::size_t errors = 0;                           ///< whatever comments and settings say
};

/// Reports what is wrong with a catalog into `diagnostics`. It is compiled if it was searched.
[[nodiscard]] CheckedCatalog lint_catalog(const yaml::Document& document,
                                          const LintOptions& options, Diagnostics& diagnostics);

/// Reports names that are easily taken for one another. A task may have the name of a behavior, so
/// the two are not compared. Events of the situation name behaviors and variables alike.
void check_names(const Catalog& catalog, Reporter& reporter);

/// Reports what is odd about `improve`, `resume`, `reactive_priority` and `at_most`.
void check_keys(const Catalog& catalog, Reporter& reporter);

/// Checks a catalog under the control of its comments and of settings, which replace what `options`
/// says about settings. `text` is that of the document; `diagnostics` has what was found before.
[[nodiscard]] CheckedCatalog check_catalog(const yaml::Document& document, std::string_view text,
                                           const SeveritySettings& settings, LintOptions options,
                                           Diagnostics diagnostics);

/// What lint has to say about one file.
struct LintedFile {
  /// What the file is. `unknown`: it is not valid YAML.
  enum class Kind : std::uint8_t { catalog, script, properties, settings, unknown };
  std::string file;                       ///< name in messages
  std::string text;                       ///< as it was read
  std::vector<Diagnostic> findings;       ///< in the order of Diagnostics::sort
  std::optional<CatalogSummary> summary;  ///< of a catalog that was understood
  Kind kind = Kind::catalog;              ///< only a catalog has a summary
};

/// Number of findings of a severity in a file, in all files.
[[nodiscard]] std::size_t count(const LintedFile& file, Severity severity);
[[nodiscard]] std::size_t count(const std::vector<LintedFile>& files, Severity severity);

/// A text with the edits of some findings applied.
struct FixedText {
  std::string text;
  /// Indices of the findings that are mended, ascending. The others have no edits, or edits that
  /// are not safe to apply or conflict with others.
  std::vector<std::size_t> mended;
};

/// Applies the edits of findings about a text: for each finding all of them, or none. Nothing else
/// is changed: comments, order, layout, line breaks, a byte order mark, and whether the last line
/// has a line break stay as they are. Findings in a removed entry are mended with it. Removals
/// come first; of edits that overlap otherwise those of the first finding count.
///
/// Mended text may have new findings with edits: repeat until nothing is mended. This ends, since
/// the text loses entries or older names each time.
[[nodiscard]] FixedText apply_fixes(std::string_view text, std::span<const Diagnostic> findings);

}  // namespace cbc
