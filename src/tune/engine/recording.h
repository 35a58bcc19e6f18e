#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "explore/controls/witness.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "tune/engine/solved_problems.h"

namespace cbc {

/// A task has another behavior than before, or than in another run; none: it does not run.
struct ValueChange {
  TaskId task;
  BehaviorId before;
  BehaviorId now;
  friend bool operator==(const ValueChange&, const ValueChange&) = default;
};

/// What an event did.
struct RecordedEvent {
  EventRecord record;
  std::uint32_t line = 0;  ///< of the last event of the script by then; 0: none yet
  std::vector<ValueChange> moves;
};

/// Missions that were run on a catalog, with all that the solver was asked: what runs with other
/// numbers are compared with.
struct Recording {
  struct Failure {
    std::size_t mission = 0;
    FailedExpectation expectation;
  };

  CompiledCatalog catalog;
  std::vector<SolvedProblem> decisions;            ///< each once, in the order of the runs
  std::vector<std::vector<RecordedEvent>> events;  ///< by mission
  std::uint64_t passed = 0;                        ///< expectations
  std::vector<Failure> failures;
  Coordinator::Status status = Coordinator::Status::ok;  ///< of the last mission
  std::string internal_error;                            ///< if an answer was refused

  [[nodiscard]] bool holds() const { return failures.empty() && status == Coordinator::Status::ok; }
};

using Missions = std::vector<const Script*>;

/// Timeouts and reactive starts of a mission; one with more cannot be recorded.
inline constexpr std::uint64_t most_clock_events = 100'000;

enum class Until : std::uint8_t { end, failure };
/// Runs missions, one after the other, to the end or to the first expectation that fails. A mission
/// that cannot be run to its end is the last one.
[[nodiscard]] Recording record(CompiledCatalog catalog, const Missions& missions, Until until);

/// Where a run begins to differ from another one: an event that only one of them has, or that has
/// another outcome, other changes or other behaviors.
struct RunDifference {
  std::size_t mission = 0;
  std::uint32_t line = 0;   ///< of the script; 0: before its first event
  std::uint64_t event = 0;  ///< its number
  std::optional<EventRecord> before;
  std::optional<EventRecord> now;
  std::vector<ValueChange> moves;             ///< how the behaviors after it differ
  std::optional<Recording::Failure> failure;  ///< the first one that is new
  /// The difference in a state that no mission need come to.
  struct InState {
    Witness path;  ///< to the first of these events, which is the last one of it
    std::optional<std::size_t> broken_property;  ///< place of the first one that holds no more
  };
  std::optional<InState> in_state;
};
/// Where two recordings of the same missions, to the end, begin to differ.
[[nodiscard]] std::optional<RunDifference> find_difference(const Recording& before,
                                                           const Recording& now);

/// The events of the script whose decisions differ, or those of the clock after them: lines.
[[nodiscard]] std::vector<std::uint32_t> differing_lines(const Recording& before,
                                                         const Recording& now, std::size_t mission);

}  // namespace cbc
