#include "runtime/solver/conflict_analysis.h"

#include <algorithm>
#include <iterator>

namespace cbc {

void ConflictAnalysis::resize(std::size_t variables) {
  if (is_noted_.size() >= variables) return;
  is_noted_.resize(variables, 0);
  counted_.resize(variables + 1, 0);
}

std::uint32_t ConflictAnalysis::level_of(std::span<const Literal> conflict, const Trail& trail) {
  std::uint32_t level = 0;
  for (const Literal literal : conflict) level = std::max(level, trail.level_of(literal));
  return level;
}

void ConflictAnalysis::analyze(std::span<const Literal> conflict, const Trail& trail) {
  conflict_level_ = level_of(conflict, trail);
  resolved_.clear();
  facts_.clear();
  variables_.clear();
  trace(conflict, trail);
  drop_implied_literals(trail);
  for (const std::uint32_t variable : variables_) is_noted_[variable] = 0;
  count_levels(trail);
  back_level_ = 0;
  if (learned_.size() == 1) return;
  const auto next_highest = std::max_element(
      learned_.begin() + 1, learned_.end(),
      [&trail](Literal a, Literal b) { return trail.level_of(a) < trail.level_of(b); });
  std::swap(learned_[1], *next_highest);
  back_level_ = trail.level_of(learned_[1]);
}

void ConflictAnalysis::trace(std::span<const Literal> conflict, const Trail& trail) {
  const std::span<const Literal> literals = trail.literals();
  learned_.assign(1, 0);
  open_ = 0;
  for (const Literal literal : conflict) note(literal, trail);
  std::size_t place = literals.size();
  for (;;) {
    do --place;
    while (is_noted_[variable_of(literals[place])] == 0);
    const Literal literal = literals[place];
    if (--open_ == 0) {
      learned_.front() = negate(literal);
      return;
    }
    resolved_.push_back(literal);
    reason_.clear();
    trail.append_reason(literal, reason_);
    for (const Literal other : reason_) note(other, trail);
  }
}

void ConflictAnalysis::note(Literal literal, const Trail& trail) {
  const std::uint32_t variable = variable_of(literal);
  const std::uint32_t level = trail.level_of(literal);
  if (level == 0) facts_.push_back(literal);
  if (level == 0 || is_noted_[variable] != 0) return;
  is_noted_[variable] = 1;
  variables_.push_back(variable);
  if (level == conflict_level_) {
    ++open_;
  } else {
    learned_.push_back(negate(literal));
  }
}

void ConflictAnalysis::drop_implied_literals(const Trail& trail) {
  const auto is_implied = [&](Literal literal) {
    if (trail.is_given(negate(literal))) return false;
    reason_.clear();
    trail.append_reason(negate(literal), reason_);
    const bool follows = std::all_of(reason_.begin(), reason_.end(), [&](Literal other) {
      return trail.level_of(other) == 0 || is_noted_[variable_of(other)] != 0;
    });
    if (!follows) return false;
    resolved_.push_back(negate(literal));
    std::copy_if(reason_.begin(), reason_.end(), std::back_inserter(facts_),
                 [&](Literal other) { return trail.level_of(other) == 0; });
    return true;
  };
  learned_.erase(std::remove_if(learned_.begin() + 1, learned_.end(), is_implied), learned_.end());
}

void ConflictAnalysis::count_levels(const Trail& trail) {
  ++count_number_;
  level_count_ = 0;
  for (const Literal literal : learned_) {
    std::uint64_t& counted = counted_[trail.level_of(literal)];
    if (counted == count_number_) continue;
    counted = count_number_;
    ++level_count_;
  }
}

}  // namespace cbc
