#include "explore/sets/diagrams.h"

#include <bit>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cbc {
namespace {

constexpr std::uint32_t bits = 7;
constexpr std::size_t strings = std::size_t{1} << bits;

/// A set as a table of all strings; bit 0 of a string is the highest one of its number.
using Table = std::vector<bool>;

bool bit_of(std::size_t string, std::uint32_t bit) {
  return ((string >> (bits - 1 - bit)) & 1U) != 0;
}
std::size_t with_bit(std::size_t string, std::uint32_t bit, bool value) {
  const std::size_t mask = std::size_t{1} << (bits - 1 - bit);
  return value ? string | mask : string & ~mask;
}

Table table_of(const Diagrams& diagrams, Diagrams::Set set) {
  Table table(strings);
  std::vector<std::uint8_t> string(bits);
  for (std::size_t number = 0; number < strings; ++number) {
    for (std::uint32_t bit = 0; bit < bits; ++bit) string[bit] = bit_of(number, bit) ? 1 : 0;
    table[number] = diagrams.contains(set, string);
  }
  return table;
}

struct Shape {
  std::uint32_t seed = 0;
  std::uint32_t tail = 0;
  std::uint32_t most_ones = 0;
};

class RandomDiagrams : public testing::TestWithParam<Shape> {
 protected:
  std::uint32_t draw(std::size_t below) { return static_cast<std::uint32_t>(random_() % below); }

  Diagrams::Values draw_values() {
    Diagrams::Values values;
    for (std::uint32_t bit = 0; bit < bits - GetParam().tail; ++bit) {
      if (draw(3) == 0) values.bits.emplace_back(bit, draw(2) == 0);
    }
    return values;
  }
  /// Whether its tail has not too many ones.
  static bool exists(std::size_t string) {
    const std::size_t tail = string & ((std::size_t{1} << GetParam().tail) - 1);
    return static_cast<std::uint32_t>(std::popcount(tail)) <= GetParam().most_ones;
  }
  static std::size_t change(std::size_t string, const Diagrams::Values& values) {
    for (const auto& [bit, value] : values.bits) string = with_bit(string, bit, value);
    return string;
  }
  void add(Diagrams::Set set, Table table) {
    EXPECT_EQ(table_of(diagrams_, set), table);
    std::uint64_t count = 0;
    for (const bool is_member : table) count += is_member ? 1 : 0;
    EXPECT_EQ(diagrams_.count(set), count);
    if (count > 0) {
      std::vector<std::uint8_t> string;
      diagrams_.pick(set, string);
      EXPECT_TRUE(diagrams_.contains(set, string));
    }
    for (std::size_t other = 0; other < sets_.size(); ++other) {
      EXPECT_EQ(sets_[other] == set, tables_[other] == table) << "equal sets are the same number";
    }
    sets_.push_back(set);
    tables_.push_back(std::move(table));
  }
  Table table(const std::function<bool(std::size_t string)>& is_member) const {
    Table table(strings);
    for (std::size_t string = 0; string < strings; ++string) {
      table[string] = exists(string) && is_member(string);
    }
    return table;
  }

  std::mt19937 random_{GetParam().seed};
  Diagrams diagrams_{bits, GetParam().tail, GetParam().most_ones};
  std::vector<Diagrams::Set> sets_;
  std::vector<Table> tables_;
};

TEST_P(RandomDiagrams, AreTheSetsOfAllStrings) {
  add(Diagrams::empty, Table(strings, false));
  add(Diagrams::all, table([](std::size_t) { return true; }));
  for (int step = 0; step < 60; ++step) {
    const std::uint32_t one = draw(sets_.size());
    const std::uint32_t other = draw(sets_.size());
    const Diagrams::Set set = sets_[one];
    const Table a = tables_[one];
    const Table b = tables_[other];
    switch (draw(7)) {
      case 0: {
        const std::uint32_t bit = draw(bits);
        const bool value = draw(2) == 0;
        add(diagrams_.with(bit, value),
            table([&](std::size_t string) { return bit_of(string, bit) == value; }));
        break;
      }
      case 1:
        add(diagrams_.both(set, sets_[other]),
            table([&](std::size_t string) { return a[string] && b[string]; }));
        break;
      case 2:
        add(diagrams_.either(set, sets_[other]),
            table([&](std::size_t string) { return a[string] || b[string]; }));
        break;
      case 3:
        add(diagrams_.without(set, sets_[other]),
            table([&](std::size_t string) { return a[string] && !b[string]; }));
        break;
      case 4: {
        const Diagrams::Values values = draw_values();
        Table changed(strings, false);
        for (std::size_t string = 0; string < strings; ++string) {
          if (a[string]) changed[change(string, values)] = true;
        }
        add(diagrams_.changed(set, diagrams_.keep(values)), changed);
        break;
      }
      case 5: {
        const Diagrams::Values values = draw_values();
        add(diagrams_.before_change(set, diagrams_.keep(values)),
            table([&](std::size_t string) { return a[change(string, values)]; }));
        break;
      }
      default: {
        std::vector<bool> listed(bits);
        for (std::uint32_t bit = 0; bit < bits; ++bit) listed[bit] = draw(2) == 0;
        const bool to = draw(2) == 0;
        Table changed(strings, false);
        for (std::size_t string = 0; string < strings; ++string) {
          for (std::uint32_t bit = 0; bit < bits; ++bit) {
            if (!a[string] || !listed[bit] || bit_of(string, bit) == to) continue;
            const std::size_t next = with_bit(string, bit, to);
            if (exists(next)) changed[next] = true;
          }
        }
        add(diagrams_.one_changed(set, diagrams_.keep_bits(listed), to), changed);
        break;
      }
    }
    if (step % 20 == 19) {
      // What is kept stays the same set; what is not may be forgotten.
      for (std::size_t left = sets_.size() / 3; left > 2; --left) {
        const std::uint32_t dropped = 2 + draw(sets_.size() - 2);
        sets_.erase(sets_.begin() + dropped);
        tables_.erase(tables_.begin() + dropped);
      }
      diagrams_.collect([&](auto&& keep) {
        for (const Diagrams::Set kept : sets_) keep(kept);
      });
      for (std::size_t place = 0; place < sets_.size(); ++place) {
        EXPECT_EQ(table_of(diagrams_, sets_[place]), tables_[place]);
      }
    }
  }
}

std::vector<Shape> shapes() {
  std::vector<Shape> shapes;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const std::uint32_t tail = seed % (bits + 1);
    shapes.push_back({seed, tail, seed % 4});
  }
  return shapes;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomDiagrams, testing::ValuesIn(shapes()));

TEST(Diagrams, HaveTailsOfAModerateNumberOfStrings) {
  EXPECT_EQ(Diagrams::tail_for(50, 0), 50U);
  EXPECT_EQ(Diagrams::tail_for(50, 2), 50U);
  EXPECT_EQ(SparseStrings::count(50, 3), 1U + 50 + 1225 + 19600);
  EXPECT_EQ(SparseStrings::count(1000, 1000), UINT64_MAX);
  const std::uint32_t tail = Diagrams::tail_for(1000, 2);
  EXPECT_GT(tail, 100U);
  EXPECT_LT(tail, 1000U);
}

TEST(Diagrams, CountsUpToTheLargestNumber) {
  Diagrams diagrams(200);
  EXPECT_EQ(diagrams.count(Diagrams::all), UINT64_MAX);
  Diagrams::Values values;
  for (std::uint32_t bit = 0; bit < 190; ++bit) values.bits.emplace_back(bit, bit % 3 == 0);
  EXPECT_EQ(diagrams.count(diagrams.with(values)), 1024U);
}

}  // namespace
}  // namespace cbc
