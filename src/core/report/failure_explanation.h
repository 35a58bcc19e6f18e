#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/report/explanation_words.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

// Why expectations fail, for people.

namespace cbc {

/// Tells what led to a failed expectation: the event before it; why the last scripted start, stop
/// or finish was rejected, if it was; and when and why tasks stopped that are expected to run, or
/// why they wait.
class FailureExplanation {
 public:
  /// Starts a run. The catalog must outlive it.
  void begin_run(const CompiledCatalog& catalog);
  void add(const EventRecord& record, const Step* step, const State& state);

  // To be called before the next event is handled.

  /// The story, in lines.
  [[nodiscard]] std::vector<std::string> tell(const Expectation& failed) const;
  [[nodiscard]] std::vector<std::string> tell(const Failure& failure) const;
  /// The part of the story that the events alone do not tell: why tasks are not as expected.
  [[nodiscard]] std::vector<Sentences> explain(const Failure& failure) const;

 private:
  /// The last stop of a task that does not run.
  struct Stop {
    std::uint64_t event = 0;
    std::optional<Sentences> why;  ///< if its request was displaced
    std::string what;              ///< the event
  };

  void note_stops(const EventRecord& record, const Step* step, const State& state);
  void note_waits(const EventRecord& record, const State& state);
  /// Whether the last rejection may be why an expectation fails.
  [[nodiscard]] bool is_rejection_of_interest(const Failure& failure) const;
  [[nodiscard]] std::vector<std::string> tell_events(bool tells_rejection) const;
  void tell_wait(TaskId task, std::vector<Sentences>& lines) const;
  /// `told`: the event whose reasons are told elsewhere, or 0. False if there is no stop to tell.
  bool tell_stop(TaskId task, std::uint64_t told, std::vector<Sentences>& lines) const;
  [[nodiscard]] std::string time_and_event(const EventRecord& record, const Step* step) const;

  const CompiledCatalog* catalog_ = nullptr;
  const EventRecord* last_ = nullptr;  ///< null: none yet
  const Step* last_step_ = nullptr;
  std::string rejected_;  ///< the last scripted start, stop or finish, if it was rejected
  std::uint64_t rejected_index_ = 0;
  TaskId rejected_task_ = none;
  bool is_start_rejected_ = false;  ///< or a stop
  std::vector<std::string> reasons_;
  std::map<TaskId, Stop> stops_;
  struct Wait {
    std::uint64_t event = 0;
    Sentences why;
  };
  std::map<TaskId, Wait> waits_;  ///< of each waiting task: since when, and why
};

}  // namespace cbc
