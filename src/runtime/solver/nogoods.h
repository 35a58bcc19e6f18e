#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "runtime/solver/literal.h"

namespace cbc {

/// The no-goods that a search has learned, each as a clause: one of its literals holds in every
/// solution that is still of interest. Two literals of each clause are watched: only when one of
/// them becomes false can the clause imply something (M. W. Moskewicz et al., "Chaff: engineering
/// an efficient SAT solver", DAC 2001).
class Nogoods {
 public:
  struct Watch {
    std::uint32_t nogood = 0;
    Literal other = 0;  ///< if it holds, the clause does
  };

  /// Forgets everything. `variables` are to come.
  void clear(std::size_t variables);

  /// Adds a clause of two literals or more, and watches the first two. `levels`: the number of
  /// decision levels of its literals; the fewer, the more useful the clause is.
  std::uint32_t add(std::span<const Literal> literals, std::uint32_t levels);

  [[nodiscard]] std::span<Literal> literals(std::uint32_t nogood) {
    return {literals_.data() + nogoods_[nogood].begin, nogoods_[nogood].size};
  }
  [[nodiscard]] std::span<const Literal> literals(std::uint32_t nogood) const {
    return {literals_.data() + nogoods_[nogood].begin, nogoods_[nogood].size};
  }

  /// Propagates that a literal holds: every clause that watches its negation needs another literal
  /// to watch; where none is left, the other watched literal follows. `truth` of a literal: 1 true,
  /// -1 false, 0 undecided. `imply` of a literal and a clause: infers it; false ends the
  /// propagation. False if it did.
  template <typename Truth, typename Imply>
  [[nodiscard]] bool follow(Literal literal, const Truth& truth, const Imply& imply);

  /// Notes that a clause has taken part in a conflict.
  void note_use(std::uint32_t nogood);
  void age() { increment_ *= growth; }

  [[nodiscard]] std::size_t size() const { return nogoods_.size(); }
  /// Forgets about half of the clauses, those used least. To be called where no clause is a
  /// reason.
  void forget_half();

 private:
  struct Nogood {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t levels = 0;
    double activity = 0;
  };
  static constexpr double growth = 1.001;

  void watch(std::uint32_t nogood);

  std::vector<Nogood> nogoods_;
  std::vector<Literal> literals_;
  std::vector<std::vector<Watch>> watches_;  ///< by literal
  std::vector<double> activities_;
  double increment_ = 1;
};

template <typename Truth, typename Imply>
bool Nogoods::follow(Literal literal, const Truth& truth, const Imply& imply) {
  const Literal lost = negate(literal);
  std::vector<Watch>& watches = watches_[lost];
  std::size_t kept = 0;
  std::size_t next = 0;
  bool is_consistent = true;
  while (is_consistent && next < watches.size()) {
    const Watch watch = watches[next++];
    if (truth(watch.other) > 0) {
      watches[kept++] = watch;
      continue;
    }
    const std::span<Literal> clause = literals(watch.nogood);
    if (clause[0] == lost) std::swap(clause[0], clause[1]);
    const Watch again{watch.nogood, clause[0]};
    const auto other = truth(clause[0]) > 0
                           ? clause.end()
                           : std::find_if(clause.begin() + 2, clause.end(),
                                          [&](Literal some) { return truth(some) >= 0; });
    if (other != clause.end()) {
      std::swap(clause[1], *other);
      watches_[clause[1]].push_back(again);
      continue;
    }
    watches[kept++] = again;
    is_consistent = imply(clause[0], watch.nogood);
  }
  watches.erase(watches.begin() + static_cast<std::ptrdiff_t>(kept),
                watches.begin() + static_cast<std::ptrdiff_t>(next));
  return is_consistent;
}

}  // namespace cbc
