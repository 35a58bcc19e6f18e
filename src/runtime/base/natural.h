// Natural numbers of any size, for products that must be exact.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cbc {

/// A product of small factors. It is 1 at first.
class Natural {
 public:
  /// Numbers of up to `bits` bits allocate nothing from here on.
  void reserve(std::size_t bits) { limbs_.reserve(bits / 32 + 2); }
  void set_to_one() { limbs_.assign(1, 1); }

  void multiply(std::uint32_t factor) {
    std::uint64_t carry = 0;
    for (std::uint32_t& limb : limbs_) {
      carry += std::uint64_t{limb} * factor;
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) limbs_.push_back(static_cast<std::uint32_t>(carry));
    while (limbs_.size() > 1 && limbs_.back() == 0) limbs_.pop_back();
  }

  [[nodiscard]] std::strong_ordering operator<=>(const Natural& other) const {
    if (limbs_.size() != other.limbs_.size()) return limbs_.size() <=> other.limbs_.size();
    for (std::size_t limb = limbs_.size(); limb-- > 0;) {
      if (limbs_[limb] != other.limbs_[limb]) return limbs_[limb] <=> other.limbs_[limb];
    }
    return std::strong_ordering::equal;
  }
  [[nodiscard]] bool operator==(const Natural& other) const = default;

  /// In decimal digits.
  [[nodiscard]] std::string digits() const {
    if (limbs_.size() == 1) return std::to_string(limbs_[0]);
    if (limbs_.size() == 2) return std::to_string(std::uint64_t{limbs_[1]} << 32 | limbs_[0]);
    constexpr std::uint32_t chunk = 1'000'000'000;
    std::string reversed;
    for (std::vector<std::uint32_t> rest = limbs_; !rest.empty();) {
      std::uint64_t remainder = 0;
      for (std::size_t limb = rest.size(); limb-- > 0;) {
        remainder = (remainder << 32) | rest[limb];
        rest[limb] = static_cast<std::uint32_t>(remainder / chunk);
        remainder %= chunk;
      }
      while (!rest.empty() && rest.back() == 0) rest.pop_back();
      for (int digit = 0; digit < 9 && (!rest.empty() || remainder != 0); ++digit) {
        reversed += static_cast<char>('0' + remainder % 10);
        remainder /= 10;
      }
    }
    return {reversed.rbegin(), reversed.rend()};
  }

 private:
  std::vector<std::uint32_t> limbs_{
      1};  ///< lowest first; none of the highest is 0, but for 0 itself
};

}  // namespace cbc
