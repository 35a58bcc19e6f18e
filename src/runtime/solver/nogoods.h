#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/literal.h"

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

  /// The clauses that watch a literal.
  [[nodiscard]] std::vector<Watch>& watches(Literal literal) { return watches_[literal]; }

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

}  // namespace cbc
