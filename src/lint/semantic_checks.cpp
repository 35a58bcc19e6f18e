#include "lint/semantic_checks.h"

#include "lint/conflicting_requirements.h"
#include "lint/dead_checks.h"
#include "lint/minimum_performances.h"
#include "lint/on_request_requirements.h"
#include "lint/redundant_requirements.h"
#include "lint/semantics.h"

namespace cbc {

void check_semantics(const Catalog& catalog, const CompiledCatalog& compiled,
                     const LintOptions& options, Reporter& reporter) {
  AssignmentSearch search(compiled, options.max_nodes);
  const Liveness liveness(search);
  Exclusions exclusions(catalog);
  Semantics semantics(catalog, search, liveness, exclusions, options.max_nodes, reporter);
  // The special cases first: what they explain is not explained again.
  check_conflicting_requirements(semantics);
  check_minimum_performances(semantics);
  check_dead(semantics);
  check_on_request_requirements(semantics);
  check_redundant_requirements(semantics);
}

}  // namespace cbc
