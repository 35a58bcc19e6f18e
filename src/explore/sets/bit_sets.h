#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace cbc {

// Sets of small numbers as arrays of words, whose lengths the user knows: parts of larger arrays
// can be sets, too.

using Word = std::uint64_t;

[[nodiscard]] constexpr std::size_t words_for(std::size_t bits) { return (bits + 63) / 64; }
[[nodiscard]] inline bool has_bit(const Word* words, std::size_t bit) {
  return ((words[bit / 64] >> (bit % 64)) & 1) != 0;
}
inline void set_bit(Word* words, std::size_t bit) { words[bit / 64] |= Word{1} << (bit % 64); }
inline void clear_bit(Word* words, std::size_t bit) { words[bit / 64] &= ~(Word{1} << (bit % 64)); }
template <typename Function>
void for_each_bit(const Word* words, std::size_t count, Function&& function) {
  for (std::size_t word = 0; word < count; ++word) {
    for (Word bits = words[word]; bits != 0; bits &= bits - 1) {
      function(
          static_cast<std::uint32_t>(word * 64 + static_cast<unsigned>(std::countr_zero(bits))));
    }
  }
}

}  // namespace cbc
