#include "core/files/check_file.h"

#include <algorithm>
#include <optional>

#include "core/check/allow_comments.h"
#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/reader.h"

namespace cbc::cli {
namespace {

/// Returns whether a property file can be used.
bool check_properties(const yaml::Document& document, const CompiledCatalog& catalog,
                      Diagnostics& diagnostics, std::vector<NamePlace>* names) {
  const std::optional<PropertyFile> file = read_properties(document, catalog, diagnostics, names);
  // Of a key without a value the reader has said so.
  if (file && lacks_properties(document, *file) && document.root().find("properties") != nullptr) {
    Reporter(document.file(), diagnostics)
        .report_as({Severity::warning, true}, rule::missing_key, document.root().range,
                   "the list of properties is empty, so there is nothing to prove");
  }
  return file.has_value();
}

}  // namespace

CheckedCatalog check_catalog_file(const InputFile& file, const SeveritySettings& settings,
                                  const LintOptions& options) {
  if (file.document != nullptr) {
    return check_catalog(*file.document, *file.text, settings, options, file.diagnostics);
  }
  CheckedCatalog checked;
  checked.errors = file.diagnostics.count(Severity::error);
  checked.findings =
      control_findings(file.diagnostics.all(), {file.name, *file.text, nullptr, false}, settings);
  return checked;
}

std::vector<Diagnostic> check_about_catalog(const InputFile& file, const CompiledCatalog& catalog,
                                            const SeveritySettings& settings,
                                            std::vector<NamePlace>* names) {
  Diagnostics diagnostics = file.diagnostics;
  const bool is_usable =
      file.is(FileKind::properties)
          ? check_properties(*file.document, catalog, diagnostics, names)
          : read_script(*file.document, catalog, Severity::error, diagnostics, nullptr, names)
                .has_value();
  // Findings that may be allowed do not make a file incomplete.
  const bool is_complete =
      is_usable || std::none_of(diagnostics.all().begin(), diagnostics.all().end(), is_fixed);
  return control_findings(diagnostics.release(),
                          {file.name, *file.text, file.document.get(), is_complete}, settings);
}

}  // namespace cbc::cli
