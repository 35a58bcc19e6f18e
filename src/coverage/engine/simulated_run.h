#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "core/script/script.h"
#include "coverage/engine/goals.h"
#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc {

/// What a mission does in a simulation, event by event.
struct SimulatedRun {
  /// After a step of the script, with all that came due before it.
  struct Moment {
    std::vector<std::uint32_t> goals;   ///< that it met first, ascending
    std::vector<BehaviorId> behaviors;  ///< by task of the group: what performs it, or none
    std::optional<Outcome> outcome;     ///< of a start, stop or finish of the script
  };

  GroupId group;
  Script script;                ///< its expectations are empty
  std::vector<Moment> moments;  ///< by step
  /// Timeouts of the group, and instants at which its reactive tasks tried to start.
  std::uint64_t clock_events = 0;
  std::string fault;  ///< of cbc, if an answer was refused
};

/// Runs missions of one group, monitored for goals, before they are written down.
class MissionSimulator {
 public:
  /// All must outlive this object. Once `is_over` is true, runs are cut short; it may be empty.
  MissionSimulator(const CompiledCatalog& catalog, std::span<const Goal> goals,
                   const Assumptions& assumptions, std::function<bool()> is_over = {})
      : catalog_(catalog), goals_(goals), assumptions_(assumptions), is_over_(std::move(is_over)) {}

  /// A mission of these moves, without timeouts.
  [[nodiscard]] SimulatedRun run(GroupId group, const std::vector<Move>& moves) const;
  /// A mission of these moves with timeouts: in place of some failures it waits. What comes of it
  /// may be another mission.
  [[nodiscard]] SimulatedRun run_by_clock(GroupId group, const std::vector<Move>& moves,
                                          const std::vector<std::uint8_t>& is_timeout) const;
  /// Makes the moves, one soon after the other, and then only waits: as long as timeouts meet some
  /// of the wanted goals, and for at most so many events of the clock.
  [[nodiscard]] SimulatedRun wait_after(GroupId group, const std::vector<Move>& moves,
                                        const std::vector<std::uint8_t>& wanted,
                                        std::uint32_t most_clock_events) const;

 private:
  class Simulation;

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  const Assumptions& assumptions_;
  const std::function<bool()> is_over_;
};

struct WrittenScript {
  Script script;
  std::string text;
};

/// A script that goes like the run, with comments that name the goals of each event that
/// count, and expectations of what it decides. `counts`: by goal. `title`: the first lines.
[[nodiscard]] WrittenScript write_down(const CompiledCatalog& catalog, std::span<const Goal> goals,
                                       const SimulatedRun& run,
                                       const std::vector<std::uint8_t>& counts,
                                       const std::string& title);

}  // namespace cbc
