#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "property/random.h"
#include "runtime/compiled/derive.h"
#include "support/rounds.h"

namespace cbc::log_cost_test {
namespace {

constexpr long double unit = 0x1p-40L;

TEST(LogCost, ADegreeOfOneCostsNothing) { EXPECT_EQ(log_cost(one_million), 0); }

// The numbers stand in compiled catalogs, which are the same on every machine.
TEST(LogCost, IsTheSameEverywhere) {
  EXPECT_EQ(log_cost(500'000), 762'123'384'786);    // ln 2
  EXPECT_EQ(log_cost(200'000), 1'769'595'698'905);  // ln 5
  EXPECT_EQ(log_cost(1), 6 * (762'123'384'786 + 1'769'595'698'905));
  EXPECT_EQ(log_cost(999'983), log_cost(1) - 15'190'295'810'287);  // a prime
}

TEST(LogCost, ADegreeOfZeroIsLeftToTheCaller) { EXPECT_EQ(log_cost(0), 0); }

TEST(LogCost, IsTheLogarithmOfEveryDegreeUpToItsErrorAndFalls) {
  std::int64_t before = log_cost(1) + 1;
  std::int64_t largest_error = 0;
  for (Millionths degree = 1; degree <= one_million; ++degree) {
    const std::int64_t cost = log_cost(degree);
    const long double exact = -std::log(static_cast<long double>(degree) / 1e6L) / unit;
    const auto error =
        static_cast<std::int64_t>(std::ceil(std::fabs(static_cast<long double>(cost) - exact)));
    largest_error = std::max(largest_error, error);
    ASSERT_LT(cost, before) << degree;
    before = cost;
  }
  EXPECT_LE(largest_error, log_cost_error);
}

/// Splits the prime factors of the numerators (and as many tens as the denominators hold) anew.
std::vector<Millionths> factor_anew(const std::vector<Millionths>& degrees,
                                    oracle::Random& random) {
  std::vector<Millionths> primes;
  for (Millionths degree : degrees) {
    for (Millionths divisor = 2; degree > 1; ++divisor) {
      for (; degree % divisor == 0; degree /= divisor) primes.push_back(divisor);
      if (divisor * divisor > degree && degree > 1) {
        primes.push_back(degree);
        degree = 1;
      }
    }
  }
  random.shuffle(primes);
  std::vector<Millionths> products(degrees.size(), 1);
  for (const Millionths prime : primes) {
    const std::size_t first = random.below(products.size());
    std::size_t place = first;
    while (std::uint64_t{products[place]} * prime > one_million) {
      place = (place + 1) % products.size();
      if (place == first) return {};
    }
    products[place] *= prime;
  }
  return products;
}

TEST(LogCost, EqualProductsHaveEqualSumsToTheBit) {
  oracle::Random random(2);
  int compared = 0;
  for (int round = 0; round < test::rounds(20'000); ++round) {
    std::vector<Millionths> degrees;
    const std::size_t count = 2 + random.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      degrees.push_back(
          static_cast<Millionths>(random.between(1, 100)) *
          (random.percent(50) ? 10'000 : static_cast<Millionths>(random.between(1, 100))));
    }
    const std::vector<Millionths> others = factor_anew(degrees, random);
    if (others.empty() || others == degrees) continue;
    std::int64_t sum = 0;
    std::int64_t other_sum = 0;
    for (const Millionths degree : degrees) sum += log_cost(degree);
    for (const Millionths degree : others) other_sum += log_cost(degree);
    ASSERT_EQ(sum, other_sum);
    ++compared;
  }
  EXPECT_GT(compared, test::rounds(5'000));
}

TEST(LogCost, SumsFurtherApartThanTheErrorAreInTheRightOrder) {
  // 0.999999 * 0.999999 is more than 1 * 0.999998, by 10^-12: too close for two factors.
  const std::int64_t difference = log_cost(999'998) - (log_cost(999'999) + log_cost(999'999));
  EXPECT_LE(std::abs(difference), 3 * log_cost_error);
  // Neighbors are far enough apart.
  EXPECT_GT(log_cost(999'999) - log_cost(one_million), 2 * log_cost_error);
}

TEST(HighestProduct, IsJustAboveTheProduct) {
  oracle::Random random(3);
  for (int round = 0; round < 2'000; ++round) {
    const auto factors = static_cast<std::uint32_t>(random.between(1, 200));
    std::int64_t cost = 0;
    long double product = 1;
    for (std::uint32_t factor = 0; factor < factors; ++factor) {
      const auto degree = static_cast<Millionths>(random.between(30'000, 1'000'000));
      cost += log_cost(degree);
      product *= static_cast<long double>(degree) / one_million;
    }
    if (product < 1e-300L) continue;
    const double highest = highest_product(cost, factors);
    ASSERT_GE(highest, product);
    ASSERT_LT(highest, product * (1 + 1e-8L));
  }
}

TEST(HighestProduct, AtTheEnds) {
  EXPECT_EQ(highest_product(0, 800), 1);
  EXPECT_EQ(highest_product(1, 1), 1) << "less than the error of one cost";
  EXPECT_EQ(highest_product(std::int64_t{1} << 61, 5), 0) << "a suitability of 0";
  for (const long double log : {698.5L, 699.5L, 699.999L, 700.0L, 700.001L}) {
    EXPECT_GE(highest_product(static_cast<std::int64_t>(log / unit), 5), std::exp(-log)) << log;
  }
  EXPECT_GT(highest_product(std::int64_t{1} << 50, 5), 0) << "e^-1024";
  EXPECT_LT(highest_product(std::int64_t{1} << 50, 5), 1e-300);
}

}  // namespace
}  // namespace cbc::log_cost_test
