#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "why/explanation.h"
#include "why/inquiry.h"
#include "why/unmet.h"

namespace cbc {

/// Sum, minimum and maximum of some numbers.
struct Spread {
  std::uint64_t sum = 0;
  std::uint64_t least = UINT64_MAX;
  std::uint64_t greatest = 0;

  void add(std::uint64_t number) { merge({number, number, number}); }
  void merge(const Spread& other) {
    sum += other.sum;
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

/// The effort of the searches of some events.
struct SearchEffort {
  std::uint64_t events = 0;
  Spread solutions;
  Spread nodes;
  Spread propagations;
  Spread nanoseconds;

  void merge(const SearchEffort& other);
};

/// The effort of all searches of one run or of several, by kind of event and in all. Events without
/// a search do not count.
class SearchTotals {
 public:
  struct Kind {
    Verb verb = Verb::wait;
    Origin origin = Origin::script;
  };
  /// The kinds of events that may take a search.
  static constexpr std::array<Kind, 9> kinds{{{Verb::start, Origin::script},
                                              {Verb::stop, Origin::script},
                                              {Verb::finish, Origin::script},
                                              {Verb::finish, Origin::timeout},
                                              {Verb::finish, Origin::fault},
                                              {Verb::finish, Origin::situation},
                                              {Verb::start, Origin::reactive},
                                              {Verb::reconsider, Origin::situation},
                                              {Verb::reconsider, Origin::repair}}};

  /// Counts an event if it took a search whose time was measured.
  void add(const EventRecord& record);
  void merge(const SearchTotals& other);

  [[nodiscard]] const SearchEffort& all() const { return all_; }
  /// The effort of one kind, by its place in `kinds`.
  [[nodiscard]] const SearchEffort& of_kind(std::size_t kind) const { return by_kind_[kind]; }

 private:
  SearchEffort all_;
  std::array<SearchEffort, kinds.size()> by_kind_;
};

/// Says which parts of the expectation do not hold; empty if all hold. `outcome` is that of the
/// last scripted start, stop or finish.
[[nodiscard]] std::string find_mismatch(const Expectation& expectation,
                                        const CompiledCatalog& catalog, const State& state,
                                        std::optional<Outcome> outcome);

/// Why tasks of one group are not as expected.
struct UnexpectedTasks {
  GroupId group;
  std::vector<TaskId> tasks;  ///< those that are not as expected, in catalog order
  WhyUnmet why_unmet;
};

/// Of how many failed expectations of a run the reasons are searched: where more fail, they are
/// alike, or one looks at the first ones anyway.
inline constexpr std::uint64_t most_explained = 100;

/// An `expect` that does not hold. Valid until the listener returns.
struct Failure {
  std::uint64_t number = 0;  ///< among those of the run, from 1
  std::uint64_t index = 0;   ///< of the event it follows; 0: none yet
  Range range;
  std::string message;
  const Step* step = nullptr;    ///< the entry of the script
  const State* state = nullptr;  ///< in which it does not hold
  /// By group, in catalog order; only with Questions::failures. Empty where the
  /// outcome alone is wrong, and after the first `most_explained` failures.
  std::vector<UnexpectedTasks> unexpected;
};

/// An `expect` that holds.
struct Success {
  std::uint64_t index = 0;  ///< of the event it follows; 0: none yet
  const Step& step;         ///< the entry of the script
};

/// Receives what happens in a run, in order.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// `step` is the scripted one, or null. The record and the state are those after the event.
  virtual void on_event(const ExplainedRecord& record, const Step* step, const State& state) = 0;
  /// Of each search: see EventListener.
  virtual void on_search(const Problem& /*problem*/, const Assignment* /*solution*/) {}
  /// Before the record of an event that took a search: see EventListener.
  virtual void on_decision(const EventRecord& /*record*/, const Circumstances& /*circumstances*/,
                           const Assignment* /*solution*/) {}
  virtual void on_success(const Success& /*success*/) {}
  virtual void on_failure(const Failure& /*failure*/) {}
  /// After the last event, also of a run that ended early.
  virtual void on_end(const State& /*state*/) {}
};

/// For runs of which only the result matters.
class SilentRun final : public RunListener {
 public:
  void on_event(const ExplainedRecord& /*record*/, const Step* /*step*/,
                const State& /*state*/) override {}
};

/// The place and the message of a failure.
struct FailedExpectation {
  Range range;
  std::string message;
};

struct RunResult {
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;      ///< if an answer was refused
  const Script* script = nullptr;  ///< null: a stream
  bool was_run = true;             ///< false: the script names what its catalog does not have
  std::uint64_t events = 0;        ///< scripted or not; some are neither accepted nor rejected
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t passed = 0;  ///< expectations that hold
  std::uint64_t failed = 0;
  std::vector<FailedExpectation> failures;
  std::optional<SearchTotals> totals;  ///< if time was measured
};

/// The event of a step that is not an expectation. It refers to the step.
[[nodiscard]] Event event_of(const Step& step);

/// The options with what the script itself says.
[[nodiscard]] CoordinatorOptions options_of(const Script& script, CoordinatorOptions options = {});

/// Runs steps through a coordinator, one after the other.
class Runner final : private EventListener {
 public:
  /// `catalog` and `listener` must outlive this object.
  Runner(const CompiledCatalog& catalog, const CoordinatorOptions& options, RunListener& listener,
         Questions questions = {})
      : catalog_(catalog),
        listener_(listener),
        inquiry_(catalog, std::move(questions)),
        coordinator_(catalog, options, *this) {
    if (options.measure_time) result_.totals.emplace();
  }

  /// Call begin() or resume() before anything else: see Coordinator.
  void begin(const Situation& situation) {
    coordinator_.begin(situation.availability, situation.variables);
  }
  void resume(const Snapshot& snapshot);
  /// The state to continue from, if no answer was refused.
  [[nodiscard]] Snapshot snapshot() const;

  /// Handles what is due before a step, then the step. False if the run ends early: see result().
  [[nodiscard]] bool take(const Step& step);
  /// Handles what is due at the present instant; false as in take().
  [[nodiscard]] bool settle() { return note(coordinator_.settle()); }
  /// Allows the full number of clock events from here on: see CoordinatorOptions.
  void restart_count() { coordinator_.restart_count(); }

  [[nodiscard]] const RunResult& result() const { return result_; }
  [[nodiscard]] const Coordinator& coordinator() const { return coordinator_; }

 private:
  void on_event(const EventRecord& record) override;
  void on_search(const Problem& problem, const Assignment* solution) override {
    listener_.on_search(problem, solution);
  }
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    inquiry_.on_decision(record, circumstances, solution);
    listener_.on_decision(record, circumstances, solution);
  }
  [[nodiscard]] bool note(Coordinator::Status status);
  void check(const Step& step);
  [[nodiscard]] std::vector<UnexpectedTasks> find_unexpected(const Expectation& expectation);

  const CompiledCatalog& catalog_;
  RunListener& listener_;
  Inquiry inquiry_;
  Coordinator coordinator_;
  RunResult result_;
  const Step* step_ = nullptr;
  std::uint64_t index_ = 0;
  std::optional<Outcome> outcome_;
};

/// Runs a script, with its own reactive delay, through a coordinator.
[[nodiscard]] RunResult run_script(const CompiledCatalog& catalog, const Script& script,
                                   const CoordinatorOptions& options, RunListener& listener,
                                   Questions questions = {});

}  // namespace cbc
