// A small deterministic generator (SplitMix64): the same seed gives the same cases everywhere, as
// long as no two draws are operands whose order is left to the compiler. A fuzzer gives the bytes
// that it draws from instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace cbc::oracle {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Draws from the bytes, which must outlive it, as long as there are any; then it goes on as with
  // a seed, so that a loop that waits for some draw ends.
  explicit Random(std::string_view bytes) : state_(0), bytes_(bytes) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  // 0 to bound - 1; bound is not 0. The slight bias for bounds that are no power of two does not
  // matter here.
  std::size_t below(std::size_t bound) {
    if (bound == 0) throw std::invalid_argument("no number is below 0");
    if (bytes_.empty()) return static_cast<std::size_t>(next() % bound);
    std::size_t value = 0;
    for (std::size_t rest = bound - 1; rest > 0 && !bytes_.empty(); rest >>= 8U) {
      value = value << 8U | static_cast<unsigned char>(bytes_.front());
      bytes_.remove_prefix(1);
    }
    return value % bound;
  }

  std::int64_t between(std::int64_t first, std::int64_t last) {
    return first + static_cast<std::int64_t>(below(static_cast<std::size_t>(last - first + 1)));
  }

  bool percent(std::size_t chance) { return below(100) < chance; }

  template <typename T>
  const T& pick(const std::vector<T>& items) {
    return items[below(items.size())];
  }

  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      using std::swap;
      swap(items[i - 1], items[below(i)]);
    }
  }

 private:
  std::uint64_t state_;
  std::string_view bytes_;
};

}  // namespace cbc::oracle
