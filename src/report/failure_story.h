#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

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
