#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// What searches that learn have in common beside the analysis of conflicts: when they restart, and
// which tasks they look at first.

namespace cbc {

/// Restarts by the sequence 1, 1, 2, 1, 1, 2, 4, ... (M. Luby, A. Sinclair and D. Zuckerman,
/// "Optimal speedup of Las Vegas algorithms", Information Processing Letters 47 (1993)).
class Restarts {
 public:
  void clear() { *this = {}; }
  void note_conflict() { ++conflicts_; }
  [[nodiscard]] bool is_due() const { return conflicts_ >= next_; }
  /// Notes that the search restarts.
  void restart() {
    ++restarts_;
    next_ = conflicts_ + conflicts_of_a_restart * luby(restarts_);
  }

 private:
  static constexpr std::uint64_t conflicts_of_a_restart = 64;

  /// `place` counts from 0.
  [[nodiscard]] static constexpr std::uint64_t luby(std::uint64_t place) {
    std::uint64_t size = 1;
    std::uint64_t value = 1;
    while (size < place + 1) {
      size = 2 * size + 1;
      value *= 2;
    }
    while (size - 1 > place) {
      size = (size - 1) / 2;
      value /= 2;
      place %= size;
    }
    return value;
  }

  std::uint64_t conflicts_ = 0;
  std::uint64_t restarts_ = 0;
  std::uint64_t next_ = conflicts_of_a_restart;
};

/// How much each task has taken part in conflicts; later conflicts count more (M. W. Moskewicz et
/// al., "Chaff: engineering an efficient SAT solver", DAC 2001).
class Activities {
 public:
  void clear(std::size_t tasks) {
    activities_.assign(tasks, 0);
    increment_ = 1;
  }
  void note(std::uint32_t task) {
    activities_[task] += increment_;
    if (activities_[task] < too_large) return;
    for (double& each : activities_) each /= too_large;
    increment_ /= too_large;
  }
  /// After each conflict.
  void age() { increment_ *= growth; }
  [[nodiscard]] double operator[](std::uint32_t task) const { return activities_[task]; }

 private:
  static constexpr double growth = 1.05;
  static constexpr double too_large = 1e100;

  std::vector<double> activities_;
  double increment_ = 1;
};

}  // namespace cbc
