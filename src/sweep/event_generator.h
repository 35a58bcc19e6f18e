#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "script/script.h"
#include "sweep/random_source.h"
#include "sweep/settings.h"

namespace cbc {

/// Draws the events of one random sequence, as they suit the state of the coordinator that has
/// handled those before.
class EventGenerator {
 public:
  /// `catalog` must outlive this object.
  EventGenerator(const CompiledCatalog& catalog, const SweepShape& shape, std::uint64_t seed,
                 std::uint64_t sequence);

  /// The instant of the next event.
  [[nodiscard]] Microseconds draw_time(const Coordinator& coordinator);
  /// What the next event is, at this instant. The step has its time already.
  void draw_event(const State& state, Step& step);

 private:
  void draw_start(Step& step);
  void draw_stop(Step& step);
  void draw_finish(const State& state, Step& step);
  void draw_surroundings(const State& state, Step& step);
  void mend(Step& step);
  void break_something(const State& state, Step& step);
  void draw_parameters(Step& step);
  [[nodiscard]] std::uint32_t any_active(const State& state);
  [[nodiscard]] std::int32_t draw_priority();
  [[nodiscard]] std::uint32_t below(std::size_t bound) {
    return random_.below(static_cast<std::uint32_t>(bound));
  }

  const CompiledCatalog& catalog_;
  const SweepShape shape_;
  RandomSource random_;
  std::uint32_t first_task_;                ///< the one that is started most often
  std::vector<std::uint32_t> faulty_;       ///< behaviors, by their places in the catalog
  std::vector<std::uint32_t> unavailable_;  ///< the same
  std::uint32_t lost_ = none;  ///< an active behavior that became unavailable, and finishes next
  std::vector<std::uint32_t> running_;
};

}  // namespace cbc
