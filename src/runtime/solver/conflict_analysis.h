#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/solver/trail.h"

namespace cbc {

/// Derives a no-good from a conflict: resolves the conflict with the reasons of its literals, last
/// inference first, until one literal of the conflict level is left (the first unique implication
/// point), and drops literals that follow from the others.
class ConflictAnalysis {
 public:
  /// For problems of up to this number of variables.
  void resize(std::size_t variables);

  /// The highest level of the literals of a conflict.
  [[nodiscard]] static std::uint32_t level_of(std::span<const Literal> conflict,
                                              const Trail& trail);

  /// `conflict`: literals that hold and cannot all hold. One of them at least is of the highest
  /// level that there is, which is above 0.
  void analyze(std::span<const Literal> conflict, const Trail& trail);

  /// The no-good as a clause: first the literal that it implies after going back to back_level(),
  /// then one of that level, if there is any other.
  [[nodiscard]] std::span<const Literal> learned() const { return learned_; }
  [[nodiscard]] std::uint32_t back_level() const { return back_level_; }
  /// The number of levels of the literals of the no-good.
  [[nodiscard]] std::uint32_t level_count() const { return level_count_; }

  // The derivation.

  /// Variables above level 0 that the analysis met.
  [[nodiscard]] std::span<const std::uint32_t> variables() const { return variables_; }
  /// The literals whose reasons it resolved with.
  [[nodiscard]] std::span<const Literal> resolved() const { return resolved_; }
  /// The literals of level 0 that it rests on; some may be there several times.
  [[nodiscard]] std::span<const Literal> facts() const { return facts_; }

 private:
  void trace(std::span<const Literal> conflict, const Trail& trail);
  void note(Literal literal, const Trail& trail);
  void drop_implied_literals(const Trail& trail);
  void count_levels(const Trail& trail);

  std::uint32_t conflict_level_ = 0;
  std::uint32_t open_ = 0;  ///< noted literals of the conflict level, not yet resolved
  std::uint32_t back_level_ = 0;
  std::uint32_t level_count_ = 0;
  std::vector<Literal> learned_;
  std::vector<Literal> resolved_;
  std::vector<Literal> facts_;
  std::vector<std::uint32_t> variables_;
  std::vector<std::uint8_t> is_noted_;  ///< by variable
  std::vector<Literal> reason_;
  std::vector<std::uint64_t> counted_;  ///< by level
  std::uint64_t count_number_ = 0;
};

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
  void note(LocalTask task) {
    activities_[task] += increment_;
    if (activities_[task] < too_large) return;
    for (double& each : activities_) each /= too_large;
    increment_ /= too_large;
  }
  /// After each conflict.
  void age() { increment_ *= growth; }
  /// Notes the tasks of all variables that took part in a conflict.
  void note_conflict(std::span<const std::uint32_t> variables, const Trail& trail) {
    for (const std::uint32_t variable : variables) note(trail.task_of(variable));
    age();
  }
  [[nodiscard]] double operator[](LocalTask task) const { return activities_[task]; }

 private:
  static constexpr double growth = 1.05;
  static constexpr double too_large = 1e100;

  std::vector<double> activities_;
  double increment_ = 1;
};

}  // namespace cbc
