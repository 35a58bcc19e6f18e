#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cbc/units.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"
#include "versions/names/translation.h"

namespace cbc {

// How random events are drawn: by name, so that two versions of a catalog see the same events, as
// far as both have what they are about.

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

  /// A bijection whose result looks random.
  [[nodiscard]] static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31U);
  }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15U;

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

/// What random events may be about, with a number for each name.
class DrawnNames {
 public:
  /// By catalog index, or place.
  struct Name {
    std::uint32_t place = none;
    std::uint64_t number = 0;
  };

  /// Everything in the catalog.
  explicit DrawnNames(const CompiledCatalog& catalog);
  /// What the other catalog has, too.
  DrawnNames(const CompiledCatalog& catalog, const Translation& to_other);

  [[nodiscard]] const std::vector<Name>& tasks() const { return tasks_; }
  [[nodiscard]] const std::vector<Name>& behaviors() const { return behaviors_; }
  /// The variables with at least two values.
  [[nodiscard]] const std::vector<Name>& variables() const { return variables_; }
  [[nodiscard]] const std::vector<Name>& values(std::uint32_t variable) const {
    return values_[variable];
  }
  /// By catalog index; its place is none where no event may be about it.
  [[nodiscard]] const Name& task(std::uint32_t place) const { return all_tasks_[place]; }
  [[nodiscard]] const Name& behavior(std::uint32_t place) const { return all_behaviors_[place]; }

 private:
  DrawnNames(const CompiledCatalog& catalog, const Translation* to_other);

  std::vector<Name> tasks_;
  std::vector<Name> behaviors_;
  std::vector<Name> variables_;
  std::vector<std::vector<Name>> values_;  ///< by variable
  std::vector<Name> all_tasks_;
  std::vector<Name> all_behaviors_;
};

/// Draws the events of one random sequence to suit the state of the coordinator that handled the
/// previous ones. Each event has random numbers of its own, and each choice is the name whose
/// number comes first after mixing it with a random one (rendezvous hashing: D. G. Thaler and C. V.
/// Ravishankar, "Using name-based mappings to increase hit rates", 1998): a name that is added or
/// removed changes no other choices than those of itself.
class EventGenerator {
 public:
  /// `catalog` and `names` must outlive this object.
  EventGenerator(const CompiledCatalog& catalog, const DrawnNames& names, const SweepShape& shape,
                 std::uint64_t seed, std::uint64_t sequence);

  /// The instant of the next event.
  [[nodiscard]] Microseconds draw_time(const Coordinator& coordinator);
  /// Draws the next event at this instant. The step already has its time.
  void draw_event(const State& state, Step& step);

 private:
  using Name = DrawnNames::Name;

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
  void find_running(const State& state);
  [[nodiscard]] std::uint32_t below(std::size_t bound) {
    return random_.below(static_cast<std::uint32_t>(bound));
  }

  const CompiledCatalog& catalog_;
  const DrawnNames& names_;
  const SweepShape shape_;
  const std::uint64_t sequence_;  ///< a random number of its own
  std::uint64_t event_ = 0;
  RandomSource random_;
  std::vector<Name> faulty_;       ///< behaviors
  std::vector<Name> unavailable_;  ///< the same
  std::uint32_t lost_ = none;      ///< an active behavior that became unavailable and finishes next
  std::vector<Name> running_;      ///< tasks
};

}  // namespace cbc
