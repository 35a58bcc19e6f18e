#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ask/conflict/reasons.h"
#include "cbc/units.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/words/explanation_words.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

// Why expectations fail, for people.

namespace cbc {

/// Tells what led to a failed expectation: the event before it; why the last scripted start, stop
/// or finish was rejected, if it was; when and why tasks stopped that are expected to run, and
/// whether their requests ended with that, or why they wait; what has changed since the decision;
/// and which timeouts are still to come.
class FailureExplanation {
 public:
  /// Why tasks of one group are not as expected.
  struct Story {
    std::vector<Sentences> sentences;
    std::vector<std::string> notes;  ///< what else one has to know
  };

  /// Starts a run. Both must outlive it.
  void begin_run(const CompiledCatalog& catalog, const Script& script);
  /// The same of a stream, which may expect something in any line.
  void begin_stream(const CompiledCatalog& catalog);
  void add(const ExplainedRecord& record, const Step* step, const State& state);

  // To be called before the next event is handled.

  /// The story, in lines.
  [[nodiscard]] std::vector<std::string> tell(const Expectation& failed) const;
  [[nodiscard]] std::vector<std::string> tell(const Failure& failure) const;
  /// The part of the story that the events alone do not tell: why tasks are not as expected.
  [[nodiscard]] std::vector<Sentences> explain(const Failure& failure) const;
  /// The same of one group.
  [[nodiscard]] Story explain(const Failure& failure, const UnexpectedTasks& unexpected) const;

 private:
  /// The last stop of a task that does not run.
  struct Stop {
    std::uint64_t event = 0;
    std::optional<Sentences> why;  ///< if its request was displaced
    std::string what;              ///< the event
    std::int32_t priority = 0;     ///< of the request that ended; 0: none, or it started by itself
    bool is_suspended = false;     ///< the request waits
    std::string ended;             ///< the event that ended a request that waited
    bool is_own_end = false;       ///< it was stopped, or its behavior has achieved its goal
    std::string timeout;           ///< how its timeout ended it, if one did
  };
  struct Wait {
    std::uint64_t event = 0;
    Sentences why;
  };
  /// The last event that changed what a behavior depends on.
  struct Change {
    std::uint64_t event = 0;
    Microseconds time = 0;
    std::string what;
  };
  /// The timeout of a running task.
  struct Timeout {
    Microseconds begin = 0;
    Microseconds length = 0;
    std::uint64_t event = 0;
    BehaviorId behavior = none;
    std::string_view how;  ///< the behavior began to perform the task
    bool is_anew = false;  ///< the task ran before
  };

  void note_stops(const ExplainedRecord& record, const State& state);
  void note_waits(const ExplainedRecord& record, const State& state);
  void note_changes(const EventRecord& record, const Step* step, const State& state);
  void note_timeouts(const EventRecord& record, const State& state);
  /// Whether the last rejection may be why an expectation fails.
  [[nodiscard]] bool is_rejection_of_interest(const Failure& failure) const;
  [[nodiscard]] std::vector<std::string> tell_events(bool tells_rejection) const;
  void tell_wait(TaskId task, std::vector<Sentences>& lines) const;
  /// `told`: the event whose reasons are told elsewhere, or 0. False if there is no stop to tell.
  bool tell_stop(TaskId task, std::uint64_t told, std::vector<Sentences>& lines) const;
  [[nodiscard]] std::vector<std::string> notes_on(const Failure& failure,
                                                  const UnexpectedTasks& unexpected) const;
  [[nodiscard]] std::string note_of_change(const UnexpectedTasks& unexpected) const;
  [[nodiscard]] std::string describe_timeout(TaskId task, const Timeout& timeout) const;
  [[nodiscard]] std::string time_and_event(const EventRecord& record, const Step* step) const;

  const CompiledCatalog* catalog_ = nullptr;
  bool is_needed_ = false;             ///< the script expects something
  const EventRecord* last_ = nullptr;  ///< null: none yet
  const Step* last_step_ = nullptr;
  std::string rejected_;  ///< the last scripted start, stop or finish, if it was rejected
  std::uint64_t rejected_index_ = 0;
  TaskId rejected_task_ = none;
  bool is_start_rejected_ = false;  ///< or a stop
  std::vector<Reason> conflict_;    ///< of the rejection
  std::vector<std::string> reasons_;
  std::map<TaskId, Stop> stops_;
  std::map<TaskId, Wait> waits_;  ///< of each waiting task: since when, and why
  std::map<BehaviorId, Change> changes_;
  std::map<TaskId, Timeout> timeouts_;
};

}  // namespace cbc
