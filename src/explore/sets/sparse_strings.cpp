// Strings with the same number of ones stand one after the other, in colexicographic order, so that
// the number of a string is a sum of binomial coefficients: the combinatorial number system (D. E.
// Knuth, "The Art of Computer Programming", volume 4A, 7.2.1.3).

#include "explore/sets/sparse_strings.h"

#include <algorithm>
#include <cstddef>

namespace cbc {

namespace {

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/// By size, how many sets of that size there are of one place more.
void add_place(std::vector<std::uint64_t>& sets) {
  for (std::size_t size = sets.size(); --size > 0;) {
    sets[size] = sum(sets[size], sets[size - 1]);
  }
}

}  // namespace

std::uint64_t SparseStrings::count(std::uint32_t length, std::uint32_t most_ones) {
  std::vector<std::uint64_t> sets(std::size_t{std::min(length, most_ones)} + 1, 0);
  sets[0] = 1;
  for (std::uint32_t place = 0; place < length; ++place) add_place(sets);
  std::uint64_t all = 0;
  for (const std::uint64_t one : sets) all = sum(all, one);
  return all;
}

SparseStrings::SparseStrings(std::uint32_t length, std::uint32_t most_ones)
    : length_(length), ones_(std::size_t{std::min(length, most_ones)} + 1) {
  std::vector<std::uint64_t> sets(ones_.size(), 0);
  sets[0] = 1;
  sets_before_.push_back(sets);
  for (std::uint32_t place = 0; place < length; ++place) {
    add_place(sets);
    sets_before_.push_back(sets);
  }
  firsts_.push_back(0);
  for (const std::uint64_t of_size : sets) firsts_.push_back(firsts_.back() + of_size);
  for (std::size_t size = 1; size < ones_.size(); ++size) {
    std::vector<std::uint32_t> ones(size);
    for (std::size_t one = 0; one < size; ++one) ones[one] = static_cast<std::uint32_t>(one);
    for (std::uint64_t number = 0; number < sets[size]; ++number) {
      ones_[size].insert(ones_[size].end(), ones.begin(), ones.end());
      // The next set: the first one that can moves on, and those before it go back.
      std::size_t next = 0;
      while (next + 1 < size && ones[next] + 1 == ones[next + 1]) ++next;
      ++ones[next];
      for (std::size_t one = 0; one < next; ++one) ones[one] = static_cast<std::uint32_t>(one);
    }
  }
}

std::uint32_t SparseStrings::number_of(std::span<const std::uint32_t> ones) const {
  std::uint64_t number = firsts_[ones.size()];
  for (std::size_t one = 0; one < ones.size(); ++one) number += sets_before_[ones[one]][one + 1];
  return static_cast<std::uint32_t>(number);
}

std::uint32_t SparseStrings::find(const std::uint8_t* string) const {
  std::size_t size = 0;
  std::uint64_t number = 0;
  for (std::uint32_t place = 0; place < length_; ++place) {
    if (string[place] == 0) continue;
    if (++size == ones_.size()) return count();
    number += sets_before_[place][size];
  }
  return static_cast<std::uint32_t>(firsts_[size] + number);
}

std::span<const std::uint32_t> SparseStrings::ones_of(std::uint32_t number) const {
  const auto next = std::upper_bound(firsts_.begin(), firsts_.end(), std::uint64_t{number});
  const auto size = static_cast<std::size_t>(next - firsts_.begin() - 1);
  if (size == 0) return {};
  return {&ones_[size][static_cast<std::size_t>(number - firsts_[size]) * size], size};
}

void SparseStrings::add_one_changed(const Word* row, const std::vector<bool>& is_listed, bool to,
                                    Word* result) const {
  std::vector<std::uint32_t> changed;
  for_each_bit(row, words(), [&](std::uint32_t number) {
    const std::span<const std::uint32_t> ones = ones_of(number);
    if (!to) {
      for (std::size_t left_out = 0; left_out < ones.size(); ++left_out) {
        if (!is_listed[ones[left_out]]) continue;
        changed.assign(ones.begin(), ones.end());
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(left_out));
        set_bit(result, number_of(changed));
      }
      return;
    }
    if (ones.size() + 1 == ones_.size()) return;
    for (std::uint32_t place = 0; place < length_; ++place) {
      const auto after = std::lower_bound(ones.begin(), ones.end(), place);
      if (!is_listed[place] || (after != ones.end() && *after == place)) continue;
      changed.assign(ones.begin(), after);
      changed.push_back(place);
      changed.insert(changed.end(), after, ones.end());
      set_bit(result, number_of(changed));
    }
  });
}

}  // namespace cbc
