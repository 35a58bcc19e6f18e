#include "lint/lint.h"

#include <utility>

#include "compiled/compile.h"
#include "diagnostic/reporter.h"
#include "lint/behavior_checks.h"
#include "lint/exclusivity_checks.h"
#include "lint/semantic_checks.h"
#include "lint/task_checks.h"

namespace cbc {

LintResult lint_catalog(const yaml::Document& document, const LintOptions& options,
                        Diagnostics& diagnostics) {
  LintResult result;
  result.reading = understand_catalog(document, diagnostics);
  const Catalog& catalog = result.reading.catalog;
  Reporter reporter(document.file(), diagnostics);
  check_tasks(catalog, result.reading.is_complete, reporter);
  check_behaviors(catalog, result.reading.is_complete, reporter);
  check_exclusivity(catalog, reporter);
  if (!result.reading.is_complete || !result.reading.is_acyclic) return result;

  const CompiledCatalog compiled = compile(catalog);
  result.summary = summarize(compiled);
  check_semantics(catalog, compiled, options, reporter);
  return result;
}

}  // namespace cbc
