#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"
#include "unit/random_problems.h"

namespace cbc::test {

/// A random catalog in which the clock has a lot to do: tasks have timeouts, and start reactively.
[[nodiscard]] CompiledCatalog restless_catalog(Random& random, std::uint32_t tasks);

/// Random events of all kinds. They end in the state in which they begin: nothing runs, is asked
/// for or faulty, and every behavior is available. So they may be gone through again and again.
class RandomMission {
 public:
  struct Step {
    Microseconds time = 0;  ///< since the mission began
    Event event;            ///< refers to the mission
  };

  RandomMission(Random& random, const CompiledCatalog& catalog, std::size_t events);
  RandomMission(const RandomMission&) = delete;
  RandomMission& operator=(const RandomMission&) = delete;

  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  [[nodiscard]] Microseconds duration() const { return steps_.back().time; }

 private:
  void add_random_event();
  void add_reset();
  void add(const Event& event) { steps_.push_back({time_, event}); }
  [[nodiscard]] std::uint32_t any_task() { return below(catalog_.tasks.size()); }
  [[nodiscard]] std::uint32_t any_behavior() { return below(catalog_.behaviors.size()); }
  [[nodiscard]] std::uint32_t below(std::size_t bound) {
    return static_cast<std::uint32_t>(random_.below(bound));
  }

  Random& random_;
  const CompiledCatalog& catalog_;
  Microseconds time_ = 0;
  std::vector<Step> steps_;
  std::deque<std::vector<Availability>> situations_;
};

/// A number that depends on all that it was given, in order.
class Fingerprint {
 public:
  void add(std::uint64_t value) { value_ = (value_ ^ value) * 0x100000001b3U + (value_ >> 29U); }
  bool operator==(const Fingerprint&) const = default;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace cbc::test
