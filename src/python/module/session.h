#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/script/repetition.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "python/module/catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// A coordinator with what Python asks of it beyond events. Nothing here knows Python.

namespace cbc::python {

/// The options of a coordinator, as far as Python has them.
struct SessionOptions {
  Microseconds reactive_delay = 80'000;
  bool timeouts = true;
  std::uint64_t max_nodes = 0;
  Microseconds time_limit = 0;
};

/// Asked again and again in a call; true ends it.
using IsStopped = std::function<bool()>;

[[nodiscard]] CoordinatorOptions to_internal(const SessionOptions& options,
                                             const IsStopped& is_stopped = {});

/// A call with the state before it, so that it can be repeated.
struct PastCall {
  std::shared_ptr<const Catalog> catalog;
  SessionOptions options;
  Snapshot before;
  Call call;

  /// What asked for an event of the call; null: the clock did.
  [[nodiscard]] const Step* step_of(const EventRecord& record) const {
    return record.origin == Origin::script && !call.is_clock ? &call.step : nullptr;
  }
};

/// What can be said of an event that cannot be repeated.
struct Told {
  std::string words;
  std::string json;
};

/// What one event did.
struct HandledEvent {
  std::shared_ptr<const PastCall> past;  ///< that it is a part of
  EventRecord record;                    ///< without its search
  bool is_proven = true;
  /// Not null: a limit of time ended a search of the call, so to repeat it may give another answer.
  std::shared_ptr<const Told> told = nullptr;
};

/// Which event decided about a group.
struct Decision {
  std::shared_ptr<const PastCall> past;  ///< null: none
  std::uint64_t index = 0;
  Microseconds time = 0;
  std::shared_ptr<const Told> told;
};

/// Why a call was not done. The state is that before it.
struct CallFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Session final : private RunListener {
 public:
  Session(std::shared_ptr<const Catalog> catalog, const SessionOptions& options);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Another one in the same state.
  [[nodiscard]] std::unique_ptr<Session> clone() const;

  void begin(const Situation& situation);
  /// Continues from a state that find_inconsistency accepts; `options` of what goes on are kept.
  void resume(const Snapshot& snapshot);
  [[nodiscard]] Snapshot snapshot() const { return runner_->snapshot(); }

  /// What the call did, in order; nothing if `is_stopped` ended it. Throws a CallFault.
  [[nodiscard]] std::optional<std::vector<HandledEvent>> run(Call call,
                                                             const IsStopped& is_stopped);

  /// The last accepted event of the group.
  [[nodiscard]] const Decision& decision_of(GroupId group) const { return decisions_[group]; }
  /// The last rejected event of the group since then.
  [[nodiscard]] const std::optional<HandledEvent>& rejection_of(GroupId group) const {
    return rejections_[group];
  }

  [[nodiscard]] const std::shared_ptr<const Catalog>& catalog() const { return catalog_; }
  [[nodiscard]] const SessionOptions& options() const { return options_; }
  [[nodiscard]] const Coordinator& coordinator() const { return runner_->coordinator(); }
  [[nodiscard]] const State& state() const { return coordinator().state(); }

 private:
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  void make_runner();
  void go_back(const Snapshot& before);

  const std::shared_ptr<const Catalog> catalog_;
  SessionOptions options_;
  std::optional<Runner> runner_;
  const IsStopped* is_stopped_ = nullptr;  ///< of the present call
  bool was_stopped_ = false;
  std::vector<Decision> decisions_;                      ///< by group
  std::vector<std::optional<HandledEvent>> rejections_;  ///< by group

  // Of the present call.
  std::shared_ptr<const PastCall> past_;
  std::vector<HandledEvent> events_;
  bool is_repeatable_ = true;
  /// What the call has replaced, in order.
  struct Replaced {
    GroupId group;
    Decision decision;
    std::optional<HandledEvent> rejection;
  };
  std::vector<Replaced> replaced_;
};

}  // namespace cbc::python
