#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "explore/sets/bit_sets.h"

namespace cbc {

/// The bit strings of one length with at most so many ones, numbered from 0, the one without ones;
/// and sets of them as rows of words, with a bit for each string. Diagrams end in such rows, since
/// few behaviors are faulty at a time.
class SparseStrings {
 public:
  /// There must be less than 2^32 of them; see count().
  SparseStrings(std::uint32_t length, std::uint32_t most_ones);

  /// How many such strings there are; UINT64_MAX if there are at least as many.
  [[nodiscard]] static std::uint64_t count(std::uint32_t length, std::uint32_t most_ones);

  [[nodiscard]] std::uint32_t length() const { return length_; }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(firsts_.back()); }
  /// The length of a row.
  [[nodiscard]] std::size_t words() const { return words_for(count()); }

  /// The number of a string; count() if it has too many ones.
  [[nodiscard]] std::uint32_t find(const std::uint8_t* string) const;
  /// The places of the ones of a string, ascending.
  [[nodiscard]] std::span<const std::uint32_t> ones_of(std::uint32_t number) const;

  /// Adds to `result` the strings that come of those of `row` by setting (clearing) one of the
  /// places for which `is_listed` has true and that was not (was) set; those with too many ones are
  /// left out.
  void add_one_changed(const Word* row, const std::vector<bool>& is_listed, bool to,
                       Word* result) const;

 private:
  [[nodiscard]] std::uint32_t number_of(std::span<const std::uint32_t> ones) const;

  const std::uint32_t length_;
  /// By place, then by size: how many sets of that size there are of the places before it.
  std::vector<std::vector<std::uint64_t>> sets_before_;
  std::vector<std::uint64_t> firsts_;  ///< by number of ones: the first string; then their count
  std::vector<std::vector<std::uint32_t>> ones_;  ///< by number of ones, of all such strings
};

}  // namespace cbc
