#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "core/script/script.h"
#include "coverage/engine/goal_search.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Scripts that together meet the goals that can be met, and that no mission meets yet
/// (docs/coverage.md, "The missing missions").
struct MissingMissions {
  struct Mission {
    std::string name;  ///< of a file, without its ending: after the goal with which it ends
    GroupId group;
    Script script;
    std::string text;                  ///< of the script
    std::vector<std::uint32_t> goals;  ///< that no mission before it meets
    std::uint64_t events = 0;          ///< of the script, without its expectations
  };
  struct Unmet {
    std::uint32_t goal = 0;
    std::string reason;
  };
  enum class Phase : std::uint8_t { exploration, planning, simulation, done };

  /// Whether nothing ended the work, so that what is not met is known to be hard to meet.
  [[nodiscard]] bool is_complete() const { return reached == Phase::done && is_explored(); }
  /// Whether no limit and no stop ended the exploration.
  [[nodiscard]] bool is_explored() const { return partial.empty() && partial_variables.empty(); }

  std::vector<Mission> missions;
  std::uint64_t wanted = 0;  ///< goals that the missions so far do not meet
  /// Of these: proven, no mission can meet them; by goal. Of groups that were explored completely.
  std::vector<Unmet> unreachable;
  std::vector<Unmet> unmet;  ///< the others that no script was found for; by goal
  /// The least number of such scripts, each about one group, with at most so many events as its
  /// group allows. Empty if a limit ended the exploration.
  std::optional<std::uint64_t> lower_bound;
  std::uint32_t most_events = 0;  ///< of a script, with those of the clock
  /// Groups that were not explored completely: those whose exploration a limit ended, then, after a
  /// stop, the others, of which the first is `unexplored`.
  std::vector<GroupId> partial;
  GroupId unexplored;  ///< the number of groups if there are none
  /// Variables that no behavior names and that `never` binds, and were not explored completely.
  std::vector<std::uint32_t> partial_variables;
  std::uint64_t states = 0;
  Phase reached = Phase::done;       ///< what the budget ended; then the missions are those so far
  std::optional<std::string> error;  ///< see Model::find_obstacle()
  std::string fault;                 ///< of cbc: a script does not do what was proven
};

struct MissingMissionOptions {
  /// Once its budget asks for an end, the search ends soon, with simple missions for what is known
  /// by then.
  GoalSearchOptions exploration;
  std::string catalog;       ///< see Script
  std::uint32_t events = 8;  ///< of a script, if no goal takes more
  /// Called now and then after the exploration, with the number of scripts so far. May be empty.
  std::function<void(std::size_t number)> on_mission;
  /// Asked now and then, later: once it is true, no more missions are tried. May be empty.
  std::function<bool()> is_over;
};

/// `met`: by goal, whether the present missions meet it. The same input gives the same scripts.
[[nodiscard]] MissingMissions find_missing_missions(const CompiledCatalog& catalog,
                                                    std::span<const Goal> goals,
                                                    const std::vector<std::uint8_t>& met,
                                                    const Assumptions& assumptions,
                                                    const MissingMissionOptions& options);

}  // namespace cbc
