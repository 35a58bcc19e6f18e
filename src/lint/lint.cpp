#include "lint/lint.h"

#include <utility>
#include <vector>

#include "compiled/compile.h"
#include "diagnostic/reporter.h"
#include "lint/behavior_checks.h"
#include "lint/conflicting_requirements.h"
#include "lint/exclusivity_checks.h"
#include "lint/on_request_requirements.h"
#include "lint/semantic_checks.h"
#include "lint/task_checks.h"

namespace cbc {

LintResult lint_catalog(const yaml::Document& document, const LintOptions& options,
                        Diagnostics& diagnostics) {
  LintResult result;
  result.reading = understand_catalog(document, diagnostics);
  const Catalog& catalog = result.reading.catalog;
  Reporter reporter(document.file(), diagnostics);
  const CatalogReading& reading = result.reading;
  check_tasks(reading, reporter);
  check_behaviors(catalog, reading.is_complete, reporter);
  check_exclusivity(catalog, reporter);
  const std::vector<bool> conflicts = check_conflicting_requirements(catalog, reporter);
  if (!reading.has_all_names || !reading.is_acyclic) {
    // What is missing may be the reason of anything else that could be found.
    check_on_request_requirements(catalog, conflicts, reporter);
    return result;
  }
  CompiledCatalog compiled = compile(catalog);
  check_semantics(reading, compiled, conflicts, options, reporter);
  if (reading.is_complete) result.compiled = std::move(compiled);
  return result;
}

}  // namespace cbc
