#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/inputs.h"
#include "cbc/event.h"
#include "cbc/units.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"

namespace cbc::bench {

/// One event of a script, or all that the clock brings about at an instant.
struct Moment {
  Microseconds time = 0;
  std::optional<Event> event;          ///< empty: what falls due
  std::string name;                    ///< of the (first) event, as in 03_start_ROTATE
  std::uint32_t coordinations = 0;     ///< events that needed a search
  std::optional<SearchRecord> search;  ///< of the first of them
  Trigger trigger;                     ///< of the first of them
};

/// All that happens in a mission, cut into moments that can be timed one by one.
struct Scenario {
  std::shared_ptr<const Mission> mission;
  CoordinatorOptions options;
  std::vector<Moment> moments;

  [[nodiscard]] std::uint32_t coordinations() const;
};

/// Runs the mission once to see what happens; `m` is the paper's number of solutions to take the
/// best of, 0 for the proven optimum. Throws std::runtime_error if the coordinator fails.
[[nodiscard]] std::shared_ptr<const Scenario> plan(std::shared_ptr<const Mission> mission,
                                                   std::uint64_t m);

/// Coordinators that go through a scenario side by side. A handled event takes a few microseconds;
/// many of them are timed at once, each in a coordinator of its own, so nothing can be remembered.
class Batch {
 public:
  static constexpr std::uint32_t default_size = 16;

  explicit Batch(const Scenario& scenario, std::uint32_t size = default_size);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// Goes to the moment, the next one. Returns the seconds that all coordinators together took for
  /// what happens then.
  double take(const Moment& moment);

  /// The state of all of them.
  [[nodiscard]] const State& state() const { return coordinators_.front().state(); }

 private:
  class Listener final : public EventListener {
    void on_event(const EventRecord& /*record*/) override {}
  };

  Listener listener_;
  std::deque<Coordinator> coordinators_;
};

}  // namespace cbc::bench
