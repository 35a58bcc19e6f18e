#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ask/conflict/reasons.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "sweep/engine/draw.h"
#include "why/explanation.h"

namespace cbc {

// Random event sequences: how they are run, and what is counted in them.

/// The search options of a sweep: those of the coordinator that do not depend on the clock of the
/// machine.
struct SweepSearch {
  std::uint64_t max_solutions = 0;
  std::uint64_t max_nodes = 0;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;  ///< in each sequence
};

/// Everything that the result of a sweep on a catalog depends on.
struct SweepSettings {
  std::uint64_t first = 0;  ///< sequence, from 0: parts of a sweep may run on several machines
  std::uint64_t sequences = 1;
  std::uint64_t seed = 1;
  SweepShape shape;
  SweepSearch search;
};

/// Receives every event of a sequence, with the state after it.
class SequenceListener {
 public:
  virtual ~SequenceListener() = default;
  virtual void on_event(const ExplainedRecord& record, const State& state) = 0;
  /// Before the next step, after all that was due before this time.
  virtual void on_time(Microseconds /*time*/, const State& /*state*/) {}
  /// After the step was handled.
  virtual void on_step(const Step& /*step*/, const State& /*state*/) {}
};

struct SequenceEnd {
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
};

/// Runs one random sequence from the start, as its script would run.
[[nodiscard]] SequenceEnd run_sequence(const CompiledCatalog& catalog, const DrawnNames& names,
                                       const SweepSettings& settings, std::uint64_t sequence,
                                       SequenceListener& listener);

/// The steps of a sequence up to the one that completes event `index`; all of them if it never
/// happens.
[[nodiscard]] std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog,
                                                  const DrawnNames& names,
                                                  const SweepSettings& settings,
                                                  std::uint64_t sequence, std::uint64_t index);

[[nodiscard]] CoordinatorOptions coordinator_options(const SweepSearch& search);

/// The options of `cbc solve` with which a script runs as in the sweep: " --max-nodes 5".
[[nodiscard]] std::string options_for_script(const SweepSearch& search);

/// Counts how often numbers occur. Numbers from 1024 on are rounded down to their first 10 binary
/// digits (less than 0.2 % off), which bounds the memory.
class Histogram {
 public:
  void add(std::uint64_t number) {
    ++counts_[round_down(number)];
    ++total_;
  }
  void add(const Histogram& other) {
    for (const auto& [number, count] : other.counts_) counts_[number] += count;
    total_ += other.total_;
  }

  [[nodiscard]] static std::uint64_t round_down(std::uint64_t number);

  [[nodiscard]] std::uint64_t total() const { return total_; }
  [[nodiscard]] const std::map<std::uint64_t, std::uint64_t>& counts() const { return counts_; }
  /// The smallest number that is not less than half of the counted ones, than 99 % of them, and the
  /// largest number; 0 if there are none.
  [[nodiscard]] std::uint64_t median() const { return at_rank(total_ - total_ / 2); }
  [[nodiscard]] std::uint64_t percentile_99() const { return at_rank(total_ - total_ / 100); }
  [[nodiscard]] std::uint64_t maximum() const {
    return counts_.empty() ? 0 : counts_.rbegin()->first;
  }

 private:
  [[nodiscard]] std::uint64_t at_rank(std::uint64_t rank) const;

  std::map<std::uint64_t, std::uint64_t> counts_;
  std::uint64_t total_ = 0;
};

/// The kinds of events that a sweep distinguishes.
enum class SweepKind : std::uint8_t {
  start,
  stop,
  success,           ///< a finish, goal_achieved
  failure,           ///< a finish with a cause that is a failure
  situation_change,  ///< a finish
  situation,
  fault,
  repair,
  timeout,   ///< a finish by the clock
  reactive,  ///< a start by the clock
  lost,      ///< a finish of a behavior that a rejected event could not activate again
  reconsider
};
inline constexpr std::size_t sweep_kinds = 12;

/// "start", "finish_success"
[[nodiscard]] std::string_view name_of(SweepKind kind);

struct OutcomeCounts {
  std::uint64_t accepted = 0;
  std::uint64_t escalated = 0;  ///< of the accepted: at a protection level above the first
  std::uint64_t rejected = 0;
  std::uint64_t unchanged = 0;

  [[nodiscard]] bool is_zero() const { return accepted + rejected + unchanged == 0; }
  void add(const OutcomeCounts& other) {
    accepted += other.accepted;
    escalated += other.escalated;
    rejected += other.rejected;
    unchanged += other.unchanged;
  }
};

struct TaskCounts {
  std::uint64_t starts = 0;    ///< start events of scripts that were accepted
  std::uint64_t rejected = 0;  ///< that were rejected
  std::uint64_t runs = 0;      ///< how often it started to run, whatever for
};

struct BehaviorCounts {
  std::uint64_t activations = 0;  ///< that succeeded; restarts too, but none that is undone
  std::uint64_t failures = 0;     ///< activations that failed
};

/// A reason of rejections, whatever the priorities in it. Tasks and behaviors are places in the
/// catalog, or none.
struct RejectionReason {
  Reason::Kind kind = Reason::Kind::priority;
  std::uint32_t behavior = none;
  std::uint32_t task = none;
  std::uint32_t other_task = none;
  std::uint32_t line = 0;  ///< of a list that lets only some tasks run

  auto operator<=>(const RejectionReason&) const = default;
};

/// What happened in a sweep. Sums of parts are the same in any order.
struct SweepCounts {
  SweepCounts() = default;
  SweepCounts(std::size_t task_count, std::size_t behavior_count)
      : tasks(task_count), behaviors(behavior_count) {}

  std::array<OutcomeCounts, sweep_kinds> events;  ///< by SweepKind
  std::vector<TaskCounts> tasks;                  ///< in catalog order
  std::vector<BehaviorCounts> behaviors;          ///< in catalog order
  std::map<RejectionReason, std::uint64_t> reasons;

  /// Counts an event, except for the runs of tasks.
  void add(const CompiledCatalog& catalog, const ExplainedRecord& record);
  /// `other` is of the same catalog.
  void add(const SweepCounts& other);
};

}  // namespace cbc
