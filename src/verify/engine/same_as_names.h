#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/same_as.h"

namespace cbc {

// What is the same in two catalogs, and their assumptions and scripts in each other's numbers.

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

/// The script for the other catalog, which has all that it names.
[[nodiscard]] Script translate(const Script& script, const CompiledCatalog& from,
                               const CompiledCatalog& to, const Translation& translation);

/// Leaves out of an expectation what the other catalog does not have.
void leave_out_missing(const CompiledCatalog& catalog, const Translation& to_other,
                       Expectation& expectation);

}  // namespace cbc
