#include "lint/semantic_checks.h"

#include "lint/dead_checks.h"
#include "lint/minimum_performances.h"
#include "lint/on_request_requirements.h"
#include "lint/redundant_requirements.h"
#include "lint/semantics.h"

namespace cbc {

void check_semantics(const CatalogReading& reading, const CompiledCatalog& compiled,
                     const std::vector<bool>& conflicts, const LintOptions& options,
                     Reporter& reporter) {
  AssignmentSearch search(compiled, options.max_nodes);
  const Liveness liveness(search);
  Semantics semantics(reading.catalog, search, liveness, options.max_nodes, reporter);
  // The special cases first: what they explain is not explained again.
  for (std::size_t behavior = 0; behavior < conflicts.size(); ++behavior) {
    if (conflicts[behavior]) semantics.explain_behavior(compiled.behavior_ids[behavior]);
  }
  check_minimum_performances(semantics);
  check_dead(semantics);
  check_on_request_requirements(semantics);
  // A value that could not be read excludes nothing, so that more may seem to hold anyway.
  if (reading.is_complete) check_redundant_requirements(semantics);
}

}  // namespace cbc
