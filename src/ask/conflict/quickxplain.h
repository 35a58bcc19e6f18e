#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

// Which few of many constraints leave no solution.

namespace cbc {

/// U. Junker, "QuickXplain: preferred explanations and relaxations for over-constrained problems",
/// AAAI 2004. `HasSolution` is asked with lists of constraints, whether there is a solution with
/// them in force and no others.
template <typename Constraint, typename HasSolution>
class QuickXplain {
 public:
  explicit QuickXplain(HasSolution has_solution) : has_solution_(std::move(has_solution)) {}

  /// A minimal conflict set out of `candidates`, which together leave no solution: with any
  /// constraint of the set left out there is one. Earlier ones are preferred, and come last. Where
  /// it is not known whether there is a solution, `HasSolution` should say so: then the set has no
  /// solution either, but may not be minimal.
  [[nodiscard]] std::vector<Constraint> find(std::span<const Constraint> candidates) {
    background_.clear();
    conflict_set_.clear();
    if (!candidates.empty()) divide(false, candidates);
    return std::move(conflict_set_);
  }

 private:
  /// Appends the part of a minimal conflict set that lies in `candidates`, with all of the
  /// background in force. `has_delta`: the background has new constraints since it was last found
  /// to leave a solution.
  void divide(bool has_delta, std::span<const Constraint> candidates) {
    if (has_delta && !has_solution_(background_)) return;
    if (candidates.size() == 1) {
      conflict_set_.push_back(candidates.front());
      return;
    }
    const std::span<const Constraint> earlier = candidates.first(candidates.size() / 2);
    const std::span<const Constraint> later = candidates.subspan(earlier.size());
    const std::size_t background_before = background_.size();
    const std::size_t set_before = conflict_set_.size();

    background_.insert(background_.end(), earlier.begin(), earlier.end());
    divide(true, later);
    background_.resize(background_before);

    background_.insert(background_.end(),
                       conflict_set_.begin() + static_cast<std::ptrdiff_t>(set_before),
                       conflict_set_.end());
    divide(background_.size() > background_before, earlier);
    background_.resize(background_before);
  }

  HasSolution has_solution_;
  std::vector<Constraint> background_;
  std::vector<Constraint> conflict_set_;
};

}  // namespace cbc
