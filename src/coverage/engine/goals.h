#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalog/catalog.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Something that a mission can show of a catalog (docs/coverage.md, "Goals"). What it is about
/// depends on the kind; everything else is `none`.
struct Goal {
  enum class Kind : std::uint8_t {
    task_ran,                ///< task
    behavior_active,         ///< behavior
    behavior_succeeded,      ///< behavior
    behavior_failed,         ///< behavior
    behavior_replaced,       ///< behavior
    failure_remembered,      ///< behavior
    requirement_used,        ///< behavior and the task that it requires
    requirement_decided,     ///< the same
    minimum_decided,         ///< task; of a requirement, also the behavior
    exclusion_decided,       ///< task and other_task, of which it is the first in the catalog
    timeout_fired,           ///< task, or behavior with a timeout of its own
    reactive_started,        ///< task
    reactive_gave_way,       ///< task
    reactive_returned,       ///< task
    variable_value,          ///< variable and value
    behavior_began_to_fit,   ///< behavior
    behavior_ceased_to_fit,  ///< behavior
    improved_at_once,        ///< task
    higher_displaced,        ///< task, which was started
    lower_rejected,          ///< task, which was to start
    equal_displaced,         ///< task, which was started
    request_suspended,       ///< task
    request_resumed          ///< task
  };
  static constexpr std::size_t kinds = 23;

  Kind kind = Kind::task_ran;
  TaskId task = none;
  TaskId other_task = none;
  BehaviorId behavior = none;
  std::uint32_t variable = none;
  std::uint32_t value = none;
  std::vector<std::uint32_t> lines;  ///< of the catalog, ascending; see add_lines
};

/// The word of a kind in JSON.
[[nodiscard]] std::string_view name_of(Goal::Kind kind);

/// What reports put together.
enum class GoalSection : std::uint8_t {
  tasks,
  behaviors,
  requirements,
  minimums,
  exclusions,
  timeouts,
  reactive,
  situation,
  priorities
};
inline constexpr std::size_t goal_sections = 9;
[[nodiscard]] std::string_view name_of(GoalSection section);
[[nodiscard]] GoalSection section_of(Goal::Kind kind);

/// Whether the goal asks for an answer that would be another one without a constraint.
[[nodiscard]] constexpr bool is_about_deciding(Goal::Kind kind) {
  return kind == Goal::Kind::requirement_decided || kind == Goal::Kind::minimum_decided ||
         kind == Goal::Kind::exclusion_decided;
}

/// Why the goals and the mutants of a catalog cannot be listed, if so: each pair of tasks of an
/// exclusivity list is one, so a list of thousands of tasks has millions.
[[nodiscard]] std::optional<std::string> find_too_many_pairs(const CompiledCatalog& catalog);

/// All goals of a catalog: by section, and in it in catalog order. They have no lines yet.
[[nodiscard]] std::vector<Goal> find_goals(const CompiledCatalog& catalog);

/// Adds the lines of the catalog that the goals are about. `source` is what was compiled.
void add_lines(const Catalog& source, const CompiledCatalog& catalog, std::vector<Goal>& goals);

/// What the goal asks for, in a sentence: "behavior HOVER_STILL failed".
[[nodiscard]] std::string describe(const CompiledCatalog& catalog, const Goal& goal);

/// A name for a script about a goal: words of lower-case letters and digits, with hyphens.
[[nodiscard]] std::string name_after(const CompiledCatalog& catalog, const Goal& goal);

}  // namespace cbc
