#include "rename/engine/proof.h"

namespace cbc {
namespace {

/// Of what was renamed alone: another thing may have either name, too.
Renames renames_of(const CompiledCatalog& before, const CompiledCatalog& after,
                   const Renaming& renaming) {
  Renames renames;
  const std::string& from = renaming.old_name;
  const std::string& to = renaming.new_name;
  switch (renaming.kind) {
    case NameKind::task:
      renames.tasks.emplace_back(before.task_ids[*before.find_task(from)],
                                 after.task_ids[*after.find_task(to)]);
      break;
    case NameKind::behavior:
      renames.behaviors.emplace_back(before.behavior_ids[*before.find_behavior(from)],
                                     after.behavior_ids[*after.find_behavior(to)]);
      break;
    case NameKind::variable:
      renames.variables.emplace_back(*before.find_variable(from), *after.find_variable(to));
      break;
  }
  return renames;
}

}  // namespace

CatalogComparison compare_renamed(const CompiledCatalog& before, const CompiledCatalog& after,
                                  const Renaming& renaming, const Budget& budget, unsigned jobs) {
  ComparisonScope scope;
  scope.renames = renames_of(before, after, renaming);
  scope.is_by_default = true;
  ExplorationOptions options;
  options.budget = budget;
  options.jobs = jobs;
  return compare_catalogs(before, after, common_assumptions(before, after, scope.renames), options,
                          scope);
}

}  // namespace cbc
