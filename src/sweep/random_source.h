#pragma once

#include <cstdint>

namespace cbc {

/// Random numbers that are the same on every machine (SplitMix64). The distributions of the
/// standard library differ between its implementations, so there are some here.
class RandomSource {
 public:
  /// A source of its own for each pair of numbers.
  RandomSource(std::uint64_t seed, std::uint64_t stream)
      : state_(mix(mix(seed + increment) + stream)) {}

  [[nodiscard]] std::uint64_t next() {
    state_ += increment;
    return mix(state_);
  }
  /// A number from 0 to bound - 1; `bound` is over 0.
  [[nodiscard]] std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32U) * bound) >> 32U);
  }
  /// Whether something happens whose probability is this many millionths.
  [[nodiscard]] bool happens(std::uint32_t millionths) { return below(1'000'000) < millionths; }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15U;

  [[nodiscard]] static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace cbc
