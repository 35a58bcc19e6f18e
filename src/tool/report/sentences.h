#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "script/runner.h"
#include "script/script.h"
#include "solver/problem.h"

namespace cbc {

/// f2 of a state: the product of the suitabilities of all running tasks, to the nearest double.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state);

/// The same with another configuration of one group.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state,
                                       std::uint32_t group, const Assignment& places);

/// The same exactly, as a decimal number. A suitability of 0 outside the group decides nothing, so
/// then that of the group alone.
[[nodiscard]] std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                                            std::uint32_t group, const Assignment& places);

/// f3: the share of the tasks that are not start_on_request which do not run.
[[nodiscard]] double idle_share(const ObjectiveValues& objective);

[[nodiscard]] double to_seconds(Microseconds time);

/// Seconds, to the millisecond, or to the microsecond where it takes that.
[[nodiscard]] std::string format_time(Microseconds time);

/// What happened: "start HOVER, priority 2". `step` is the scripted one, or null.
[[nodiscard]] std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                                         const Step* step);

/// " GPS unavailable, RADAR available"
[[nodiscard]] std::string describe_situation(const CompiledCatalog& catalog,
                                             const std::vector<Availability>& situation);

/// "outcome accepted, HOVER runs with HOVER_WITH_MPC, LAND does not run"
[[nodiscard]] std::string describe_expectation(const CompiledCatalog& catalog,
                                               const Expectation& expectation);

/// A reason why an event was rejected, or did not do otherwise, in a sentence, with the place in
/// the catalog if it has one.
[[nodiscard]] std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                                          const Reason& reason);

/// A set of reasons for a person: an exclusion and the protection that makes it hurt are one
/// sentence. `it`: a task that the sentences are about, or none.
[[nodiscard]] std::vector<std::string> describe_reasons(const CompiledCatalog& catalog,
                                                        const EventRecord& record,
                                                        std::span<const Reason> reasons,
                                                        TaskId it = none);

/// Why an event was rejected, in one sentence or more.
[[nodiscard]] std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                                          const EventRecord& record);

/// An explanation for a person: a sentence, and what it announces, if that is more than one.
struct Sentences {
  std::string first;
  std::vector<std::string> more;
};

/// Why a requested task does not run any more. The state is that after the event, here and below.
[[nodiscard]] Sentences describe_displacement(const CompiledCatalog& catalog,
                                              const EventRecord& record,
                                              const Displacement& displaced, const State& state);

/// Why a task has its value, or a behavior is active or not.
[[nodiscard]] Sentences describe_why(const CompiledCatalog& catalog, const EventRecord& record,
                                     const Why& why, const State& state);

/// A listed configuration: its objectives, then what runs in the first one of the list, or in what
/// another one differs from that.
[[nodiscard]] std::string describe_alternative(const CompiledCatalog& catalog,
                                               const EventRecord& record, std::size_t place,
                                               const State& state);

/// Knows what came before a failed expectation: the event it follows; why the last scripted start,
/// stop or finish was rejected, if it was; and when and why tasks stopped that are expected to run.
class FailureStory {
 public:
  /// At the begin of a run. The catalog outlives it.
  void begin_run(const CompiledCatalog& catalog);
  void add(const EventRecord& record, const Step* step, const State& state);

  /// In lines. To be asked before the next event is handled.
  [[nodiscard]] std::vector<std::string> tell(const Expectation& failed) const;

 private:
  /// The last stop of a task that does not run.
  struct Stop {
    std::uint64_t event = 0;
    std::vector<std::string> lines;  ///< why, if its request was displaced
    std::string what;                ///< the event
  };

  void note_stops(const EventRecord& record, const Step* step, const State& state);
  [[nodiscard]] std::string describe(const EventRecord& record, const Step* step) const;

  const CompiledCatalog* catalog_ = nullptr;
  const EventRecord* last_ = nullptr;  ///< null: none yet
  const Step* last_step_ = nullptr;
  std::string rejected_;  ///< the last scripted start, stop or finish, if it was rejected
  std::vector<std::string> reasons_;
  std::map<TaskId, Stop> stops_;
};

}  // namespace cbc
