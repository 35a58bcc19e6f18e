#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "coordinator/record.h"
#include "script/script.h"

namespace cbc {

/// An `expect` that does not hold.
struct Failure {
  std::uint64_t index = 0;  ///< of the event it follows; 0: none yet
  Range range;
  std::string message;
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
};

/// The event of a step, which is no expectation. Refers to the step.
[[nodiscard]] Event event_of(const Step& step);

/// Runs a script, with its own reactive delay, through a coordinator.
[[nodiscard]] RunResult run_script(const CompiledCatalog& catalog, const Script& script,
                                   const CoordinatorOptions& options, RunListener& listener);

}  // namespace cbc
