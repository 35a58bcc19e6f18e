#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/explain/reasons.h"

namespace cbc {

// Random event sequences: how they are drawn and run, and what is counted in them.

/// Random numbers that are the same on every machine (SplitMix64). The standard distributions
/// differ between implementations of the library, so this class has its own.
class RandomSource {
 public:
  /// Each pair of numbers gives an independent source.
  RandomSource(std::uint64_t seed, std::uint64_t stream)
      : state_(mix(mix(seed + increment) + stream)) {}

  [[nodiscard]] std::uint64_t next() {
    state_ += increment;
    return mix(state_);
  }
  /// A number from 0 to bound - 1; `bound` is over 0.
  [[nodiscard]] std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32U) * bound) >> 32U);
  }
  /// Whether something happens whose probability is this many millionths.
  [[nodiscard]] bool happens(std::uint32_t millionths) { return below(1'000'000) < millionths; }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15U;

  [[nodiscard]] static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31U);
  }

  std::uint64_t state_;
};

/// What the random event sequences of a sweep look like.
struct SweepShape {
  std::uint32_t events = 100;     ///< scripted ones in each sequence; clock events are extra
  std::int32_t priorities = 3;    ///< requests have priorities from 1 to this number
  Millionths failures = 300'000;  ///< probability that a finish is a failure
  Millionths faults = 100'000;    ///< probability that an event is a situation, fault or repair

  bool operator==(const SweepShape&) const = default;
};

/// The search options of a sweep: those of the coordinator that do not depend on the clock of the
/// machine.
struct SweepSearch {
  std::uint64_t max_solutions = 0;
  std::uint64_t max_nodes = 0;
  std::optional<std::uint64_t> tie_seed;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;  ///< in each sequence

  bool operator==(const SweepSearch&) const = default;
};

/// The share of the sequences that is run: number `index` (from 1) of `count`.
struct SweepShard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;

  bool operator==(const SweepShard&) const = default;
};

/// Everything that the result of a sweep on a catalog depends on.
struct SweepSettings {
  std::uint64_t sequences = 1;
  std::uint64_t seed = 1;
  SweepShape shape;
  SweepSearch search;
  SweepShard shard;
};

/// Draws the events of one random sequence to suit the state of the coordinator that handled the
/// previous ones.
class EventGenerator {
 public:
  /// `catalog` must outlive this object.
  EventGenerator(const CompiledCatalog& catalog, const SweepShape& shape, std::uint64_t seed,
                 std::uint64_t sequence);

  /// The instant of the next event.
  [[nodiscard]] Microseconds draw_time(const Coordinator& coordinator);
  /// Draws the next event at this instant. The step already has its time.
  void draw_event(const State& state, Step& step);

 private:
  void draw_start(Step& step);
  void draw_stop(Step& step);
  void draw_finish(const State& state, Step& step);
  void draw_surroundings(const State& state, Step& step);
  void mend(Step& step);
  void break_something(const State& state, Step& step);
  void draw_parameters(Step& step);
  [[nodiscard]] VariableValue draw_variable(const State& state);
  [[nodiscard]] std::uint32_t any_active(const State& state);
  [[nodiscard]] std::int32_t draw_priority();
  [[nodiscard]] std::uint32_t below(std::size_t bound) {
    return random_.below(static_cast<std::uint32_t>(bound));
  }

  const CompiledCatalog& catalog_;
  const SweepShape shape_;
  RandomSource random_;
  std::uint32_t first_task_;                ///< the one started most often
  std::vector<std::uint32_t> faulty_;       ///< behaviors, by their places in the catalog
  std::vector<std::uint32_t> unavailable_;  ///< the same
  std::uint32_t lost_ = none;  ///< an active behavior that became unavailable and finishes next
  std::vector<std::uint32_t> running_;
};

/// Receives every event of a sequence, with the state after it.
class SequenceListener {
 public:
  virtual ~SequenceListener() = default;
  virtual void on_event(const EventRecord& record, const State& state) = 0;
};

struct SequenceEnd {
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
};

/// Runs one random sequence from the start, as its script would run.
[[nodiscard]] SequenceEnd run_sequence(const CompiledCatalog& catalog,
                                       const SweepSettings& settings, std::uint64_t sequence,
                                       SequenceListener& listener);

/// The steps of a sequence up to the one that completes event `index`; all of them if it never
/// happens.
[[nodiscard]] std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog,
                                                  const SweepSettings& settings,
                                                  std::uint64_t sequence, std::uint64_t index);

/// The options of `cbc solve` with which a script runs as in the sweep: " --max-nodes 5".
[[nodiscard]] std::string options_for_script(const SweepSearch& search);

/// Counts how often numbers occur. Numbers from 1024 on are rounded down to their first 10 binary
/// digits (less than 0.2 % off), which bounds the memory.
class Histogram {
 public:
  void add(std::uint64_t number) { add_rounded(round_down(number), 1); }
  void add(const Histogram& other) {
    for (const auto& [number, count] : other.counts_) add_rounded(number, count);
  }
  /// `number` is one that round_down returns.
  void add_rounded(std::uint64_t number, std::uint64_t count) {
    counts_[number] += count;
    total_ += count;
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
  lost       ///< a finish of a behavior that a rejected event could not activate again
};
inline constexpr std::size_t sweep_kinds = 11;

/// "start", "finish_success"
[[nodiscard]] std::string_view name_of(SweepKind kind);

struct OutcomeCounts {
  std::uint64_t accepted = 0;
  std::uint64_t escalated = 0;  ///< of the accepted: at a protection level above the first
  std::uint64_t rejected = 0;
  std::uint64_t unchanged = 0;

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
  void add(const CompiledCatalog& catalog, const EventRecord& record);
  /// `other` is of the same catalog.
  void add(const SweepCounts& other);
};

}  // namespace cbc
