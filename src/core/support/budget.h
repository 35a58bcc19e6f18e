#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace cbc {

/// What long work may use, when it has to stop, and to whom it tells how far it is. Commands make
/// one of their options and of signals; engines ask it whether they may go on, and say in their
/// results what ended them.
///
/// Its time begins with started(): all work with a copy of that has the same end, while
/// explorations with a copy of one that was not started have so much time each.
class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  /// What ended work before its end.
  enum class End : std::uint8_t {
    max_states,
    max_memory,
    time_limit,
    too_many,  ///< there are no numbers left for states
    stopped    ///< somebody asked for it
  };

  // 0: no limit.
  std::uint64_t max_states = 0;  ///< of one exploration
  std::uint64_t max_memory = 0;  ///< bytes, of all that it keeps
  double seconds = 0;

  /// Whether somebody asks to stop, such as a signal. Asked now and then, perhaps by several
  /// threads at once. May be empty.
  std::function<bool()> is_stopped = {};
  /// Is told now and then what is being done, "group 3", and may ask how far that is, " (4
  /// states)", perhaps by several threads at once. May be empty.
  std::function<void(const std::string& what, const std::function<std::string()>& how_far)> tell =
      {};

  /// The same, with a time that begins now, unless it has begun.
  [[nodiscard]] Budget started() const;
  /// The same, for a part of the work: it ends when this share of the time is over, if that has
  /// begun.
  [[nodiscard]] Budget until(double share) const;

  /// Whether work has to end that has used so much; if so, why.
  [[nodiscard]] std::optional<End> find_end(std::uint64_t states = 0,
                                            std::uint64_t bytes = 0) const;
  /// What ended work, in words: "ended by --max-states 1000".
  [[nodiscard]] std::string describe(End end) const;

 private:
  std::optional<Clock::time_point> deadline_;
};

}  // namespace cbc
