#include "solver/exact_product.h"

namespace cbc {

void ExactProduct::reserve(std::size_t factors) {
  constexpr std::size_t bits_of_factor = 20;
  limbs_.reserve(factors * bits_of_factor / 32 + 2);
}

void ExactProduct::clear() {
  limbs_.assign(1, 1);
  factors_ = 0;
}

void ExactProduct::multiply(Millionths degree) {
  scale(degree);
  ++factors_;
}

void ExactProduct::scale(std::uint32_t factor) {
  std::uint64_t carry = 0;
  for (std::uint32_t& limb : limbs_) {
    carry += std::uint64_t{limb} * factor;
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  if (carry != 0) limbs_.push_back(static_cast<std::uint32_t>(carry));
  while (limbs_.size() > 1 && limbs_.back() == 0) limbs_.pop_back();
}

std::strong_ordering ExactProduct::compare(ExactProduct& a, ExactProduct& b) {
  while (a.factors_ < b.factors_) a.multiply(one_million);
  while (b.factors_ < a.factors_) b.multiply(one_million);
  if (a.limbs_.size() != b.limbs_.size()) return a.limbs_.size() <=> b.limbs_.size();
  for (std::size_t limb = a.limbs_.size(); limb-- > 0;) {
    if (a.limbs_[limb] != b.limbs_[limb]) return a.limbs_[limb] <=> b.limbs_[limb];
  }
  return std::strong_ordering::equal;
}

}  // namespace cbc
