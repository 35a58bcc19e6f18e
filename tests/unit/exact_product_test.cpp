#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "property/random.h"
#include "runtime/solver/objective.h"

namespace cbc::exact_product_test {
namespace {

ExactProduct product_of(const std::vector<Millionths>& degrees) {
  ExactProduct product;
  for (const Millionths degree : degrees) product.multiply(degree);
  return product;
}

std::strong_ordering compare(const std::vector<Millionths>& a, const std::vector<Millionths>& b) {
  ExactProduct product_a = product_of(a);
  ExactProduct product_b = product_of(b);
  return ExactProduct::compare(product_a, product_b);
}

TEST(ExactProduct, ZeroIsLessThanTheSmallest) {
  EXPECT_EQ(compare({0}, {1, 1, 1, 1}), std::strong_ordering::less);
  EXPECT_EQ(compare({0, 5}, {7, 0, 9}), std::strong_ordering::equal);
}

TEST(ExactProduct, ClearBeginsAnew) {
  ExactProduct a;
  a.reserve(4);
  a.multiply(3);
  a.clear();
  a.multiply(500'000);
  ExactProduct b = product_of({500'000});
  EXPECT_EQ(ExactProduct::compare(a, b), std::strong_ordering::equal);
}

TEST(ExactProduct, AgreesWithBigIntegers) {
  using boost::multiprecision::cpp_int;
  oracle::Random random(3);
  int equal = 0;
  for (int round = 0; round < 3'000; ++round) {
    std::vector<Millionths> sides[2];
    cpp_int products[2] = {1, 1};
    for (int side = 0; side < 2; ++side) {
      const std::size_t count = random.below(12);
      for (std::size_t i = 0; i < count; ++i) {
        static const std::vector<Millionths> near_one{999'999, 999'998, 1'000'000, 500'000,
                                                      250'000};
        const Millionths degree = random.percent(70)
                                      ? random.pick(near_one)
                                      : static_cast<Millionths>(random.between(1, one_million));
        sides[side].push_back(degree);
        products[side] *= degree;
      }
      for (std::size_t i = count; i < 12; ++i) products[side] *= one_million;
    }
    const auto expected = products[0] < products[1]    ? std::strong_ordering::less
                          : products[0] == products[1] ? std::strong_ordering::equal
                                                       : std::strong_ordering::greater;
    ASSERT_EQ(compare(sides[0], sides[1]), expected);
    if (expected == 0) ++equal;
  }
  EXPECT_GT(equal, 10);
}

}  // namespace
}  // namespace cbc::exact_product_test
