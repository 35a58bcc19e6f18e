#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "core/report/blocks.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/names/renames.h"

namespace cbc {

// What is the same in two catalogs, and their assumptions and scripts in each other's numbers.
// Tasks, behaviors, variables and their values are the same if they have the same name, or if one
// was renamed to the other.

/// What is not the same in two catalogs by itself, each in words: "task LAND", "value dark of
/// LIGHT"; "task LAND: DESCEND" if it was renamed.
struct CatalogNames {
  std::vector<std::string> only_old;
  std::vector<std::string> only_new;
  std::vector<std::string> renamed;

  /// A line for each kind. `old_catalog`, `new_catalog`: their names.
  void add_to(Blocks& report, const std::string& old_catalog, const std::string& new_catalog) const;
};

/// The numbers that one catalog's tasks, behaviors and variables have in another; none: it does not
/// have them. From TaskId to TaskId, BehaviorId to BehaviorId, place to place.
struct Translation {
  std::vector<TaskId> tasks;
  std::vector<BehaviorId> behaviors;
  std::vector<std::uint32_t> variables;
  std::vector<std::vector<std::uint32_t>> values;  ///< by variable
};

struct TranslationPair {
  TranslationPair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                  const Renames& renames);

  Translation to_new;
  Translation to_old;
};

[[nodiscard]] CatalogNames names_of(const CompiledCatalog& old_catalog,
                                    const CompiledCatalog& new_catalog,
                                    const TranslationPair& translations, const Renames& renames);

/// The same assumptions about the other catalog, without what it does not have.
[[nodiscard]] Assumptions translate(const Assumptions& from, const Translation& to);

/// The step for the other catalog, which has all that it names.
[[nodiscard]] Step translate(const Step& step, const CompiledCatalog& from,
                             const CompiledCatalog& to, const Translation& translation);

/// The script for the other catalog, which has all that it names.
[[nodiscard]] Script translate(const Script& script, const CompiledCatalog& from,
                               const CompiledCatalog& to, const Translation& translation);

/// Leaves out of an expectation what the other catalog does not have.
void leave_out_missing(const CompiledCatalog& catalog, const Translation& to_other,
                       Expectation& expectation);

/// Groups of two catalogs that have to be looked at together.
struct GroupPair {
  std::vector<GroupId> old_groups;
  std::vector<GroupId> new_groups;
};

/// Joins groups that have the same task or behavior.
[[nodiscard]] std::vector<GroupPair> join_groups(const CompiledCatalog& old_catalog,
                                                 const CompiledCatalog& new_catalog,
                                                 const Translation& to_old);

/// The catalog with other tasks, some of which do not start by themselves.
[[nodiscard]] CompiledCatalog without_reactive_starts(
    const CompiledCatalog& catalog, const std::function<bool(TaskId)>& is_left_out);
/// The catalog without reactive starts of tasks that the other one does not have. It shares the
/// memory of the catalog.
[[nodiscard]] CompiledCatalog without_missing_starts(const CompiledCatalog& catalog,
                                                     const Translation& to_other);

}  // namespace cbc
