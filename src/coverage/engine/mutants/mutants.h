#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/catalog.h"

namespace cbc {

/// A catalog with one thing changed (docs/coverage.md, "Mutants"). What was changed depends on the
/// kind; everything else is `none`. Numbers are places in the Catalog.
struct Mutant {
  enum class Kind : std::uint8_t {
    behavior_removed,         ///< behavior, which can never be active
    suitability_lowered,      ///< behavior and its task, to `suitability`, below that of `other`
    requirement_removed,      ///< behavior and the task that it requires
    minimum_removed,          ///< task; of a requirement, also the behavior
    condition_removed,        ///< behavior and variable
    exclusion_removed,        ///< task and other, of which it is the first in the catalog
    exclusion_narrowed,       ///< task, in `list`
    timeout_removed,          ///< task, or behavior with a timeout of its own
    start_on_request_turned,  ///< task
    reactive_start_turned,    ///< task
    execution_goal_turned     ///< task, to achieve_goal, so that it may time out
  };
  static constexpr std::size_t kinds = 11;
  static constexpr std::uint32_t none = UINT32_MAX;

  Kind kind = Kind::behavior_removed;
  std::uint32_t task = none;
  std::uint32_t other = none;  ///< a task; of suitability_lowered the behavior that comes next
  std::uint32_t behavior = none;
  std::uint32_t variable = none;
  std::uint32_t list = none;  ///< place in Catalog::exclusivity
  Millionths suitability = 0;
  std::vector<std::uint32_t> lines;  ///< of the catalog, ascending, at least one
};

/// The word of a kind in JSON.
[[nodiscard]] std::string_view name_of(Mutant::Kind kind);

/// All mutants of a catalog, by their first line.
[[nodiscard]] std::vector<Mutant> find_mutants(const Catalog& catalog);

/// The catalog with the change: a valid one with the same tasks, behaviors and variables in the
/// same places, so that a script for the one is a script for the other. A behavior that is removed
/// stays in it, but fits in no situation; a variable is added for this.
[[nodiscard]] Catalog mutate(const Catalog& catalog, const Mutant& mutant);

/// What was changed, in words: "HOVER_STILL no longer requires LOCALIZE".
[[nodiscard]] std::string describe(const Catalog& catalog, const Mutant& mutant);

}  // namespace cbc
