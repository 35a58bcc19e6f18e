#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "coordinator/record.h"
#include "coordinator/search_totals.h"
#include "script/script.h"

namespace cbc {

/// An `expect` that does not hold.
struct Failure {
  std::uint64_t index = 0;  ///< of the event it follows; 0: none yet
  Range range;
  std::string message;
  const Step* step = nullptr;  ///< the entry of the script
};

/// Is told what happens in a run, in order.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// `step` is the scripted one, or null. The record and the state are those after the event.
  virtual void on_event(const EventRecord& record, const Step* step, const State& state) = 0;
  virtual void on_failure(const Failure& failure) = 0;
  /// After the last event, also of a run that ended early.
  virtual void on_end(const State& state) = 0;
};

struct RunResult {
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
  std::uint64_t passed = 0;    ///< expectations that hold
  std::uint64_t failed = 0;
  std::optional<SearchTotals> totals;  ///< if time was measured
};

/// The event of a step, which is no expectation. Refers to the step.
[[nodiscard]] Event event_of(const Step& step);

/// Runs steps one after the other through a coordinator.
class Runner final : private EventListener {
 public:
  /// `catalog` and `listener` must outlive this object.
  Runner(const CompiledCatalog& catalog, const CoordinatorOptions& options, RunListener& listener)
      : catalog_(catalog), listener_(listener), coordinator_(catalog, options, *this) {
    if (options.measure_time) result_.totals.emplace();
  }

  /// First of all, one of the two: see Coordinator.
  void begin(std::span<const Availability> situation) { coordinator_.begin(situation); }
  void resume(const Snapshot& snapshot);
  /// All that there is to go on from. The last call returned true.
  [[nodiscard]] Snapshot snapshot() const;

  /// Takes a step, and before it what falls due earlier. False if the run ends early: see result().
  [[nodiscard]] bool take(const Step& step);
  /// Processes what is due at the present instant; false as in take.
  [[nodiscard]] bool settle() { return note(coordinator_.settle()); }
  /// See Coordinator: the count of events that no script asked for.
  void restart_count() { coordinator_.restart_count(); }

  [[nodiscard]] const RunResult& result() const { return result_; }
  [[nodiscard]] const Coordinator& coordinator() const { return coordinator_; }

 private:
  void on_event(const EventRecord& record) override;
  [[nodiscard]] bool note(Coordinator::Status status);
  void check(const Step& step);

  const CompiledCatalog& catalog_;
  RunListener& listener_;
  Coordinator coordinator_;
  RunResult result_;
  const Step* step_ = nullptr;
  std::uint64_t index_ = 0;
  std::optional<Outcome> outcome_;
};

/// Runs a script, with its own reactive delay, through a coordinator.
[[nodiscard]] RunResult run_script(const CompiledCatalog& catalog, const Script& script,
                                   const CoordinatorOptions& options, RunListener& listener);

}  // namespace cbc
