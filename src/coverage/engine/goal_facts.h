#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What an exploration has seen, beside the goals that were met: from this follows why others were
/// not.
struct GoalFacts {
  GoalFacts() = default;
  GoalFacts(const CompiledCatalog& catalog, std::size_t goals);

  std::vector<std::uint8_t> performed;       ///< by value: its task ran with its behavior
  std::vector<std::uint8_t> fitted;          ///< by behavior: it fit some situation
  std::vector<std::uint8_t> misfitted;       ///< by behavior: it did not fit some situation
  std::vector<std::uint8_t> start_accepted;  ///< by task: a start of a script was
  std::vector<std::uint8_t> start_rejected;  ///< the same
  std::vector<std::uint8_t> started_itself;  ///< by task
  std::vector<std::uint8_t> gave_way;        ///< by task
  /// By goal about deciding: some event could have had another answer without the constraint, as
  /// far as one sees without a search.
  std::vector<std::uint8_t> was_asked;
  /// By value: another one that always times out before it, or none.
  std::vector<ValueId> forestalled_by;
};

/// Whether the goal is that of a timeout before which another one always comes.
[[nodiscard]] bool is_forestalled(const CompiledCatalog& catalog, const Goal& goal,
                                  const GoalFacts& facts);

/// Why no move meets goal `number` of those of a catalog: "no event requests task LAND". `facts`
/// are those of a complete exploration under the assumptions, which did not meet it.
[[nodiscard]] std::string why_unreachable(const CompiledCatalog& catalog,
                                          std::span<const Goal> goals, std::size_t number,
                                          const Assumptions& assumptions, const GoalFacts& facts);

}  // namespace cbc
