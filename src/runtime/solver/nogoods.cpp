#include "runtime/solver/nogoods.h"

#include <algorithm>

namespace cbc {

void Nogoods::clear(std::size_t variables) {
  if (!nogoods_.empty()) {
    for (std::vector<Watch>& watches : watches_) watches.clear();
  }
  nogoods_.clear();
  literals_.clear();
  if (watches_.size() < 2 * variables) watches_.resize(2 * variables);
  increment_ = 1;
}

std::uint32_t Nogoods::add(std::span<const Literal> literals, std::uint32_t levels) {
  const auto number = static_cast<std::uint32_t>(nogoods_.size());
  nogoods_.push_back({static_cast<std::uint32_t>(literals_.size()),
                      static_cast<std::uint32_t>(literals.size()), levels, increment_});
  literals_.insert(literals_.end(), literals.begin(), literals.end());
  watch(number);
  return number;
}

void Nogoods::watch(std::uint32_t nogood) {
  const std::span<const Literal> clause = literals(nogood);
  watches_[clause[0]].push_back({nogood, clause[1]});
  watches_[clause[1]].push_back({nogood, clause[0]});
}

void Nogoods::note_use(std::uint32_t nogood) {
  constexpr double too_large = 1e100;
  nogoods_[nogood].activity += increment_;
  if (nogoods_[nogood].activity < too_large) return;
  for (Nogood& each : nogoods_) each.activity /= too_large;
  increment_ /= too_large;
}

void Nogoods::forget_half() {
  constexpr std::uint32_t levels_to_keep = 2;
  std::size_t to_forget = nogoods_.size() / 2;
  if (to_forget == 0) return;
  activities_.clear();
  for (const Nogood& nogood : nogoods_) activities_.push_back(nogood.activity);
  const auto last = activities_.begin() + static_cast<std::ptrdiff_t>(to_forget - 1);
  std::nth_element(activities_.begin(), last, activities_.end());
  const double limit = *last;

  for (std::vector<Watch>& watches : watches_) watches.clear();
  std::uint32_t kept = 0;
  std::uint32_t end = 0;
  for (const Nogood nogood : std::span<const Nogood>(nogoods_)) {
    if (to_forget > 0 && nogood.activity <= limit && nogood.levels > levels_to_keep) {
      --to_forget;
      continue;
    }
    const auto first = literals_.begin() + nogood.begin;
    std::copy(first, first + nogood.size, literals_.begin() + end);
    nogoods_[kept] = nogood;
    nogoods_[kept].begin = end;
    end += nogood.size;
    ++kept;
  }
  nogoods_.resize(kept);
  literals_.resize(end);
  for (std::uint32_t nogood = 0; nogood < kept; ++nogood) watch(nogood);
}

}  // namespace cbc
