#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "support/json.h"
#include "support/rounds.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(std::string_view text) {
  std::string json = "[";
  append_text(json, text);
  return json.substr(1);
}

std::string seconds_of(Microseconds time) {
  std::string json;
  append_seconds(json, time);
  return json;
}

TEST(JsonText, TextIsThatOfTheTree) {
  for (std::size_t size = 0; size <= 20; ++size) {
    const std::string plain(size, 'x');
    EXPECT_EQ(text_of(plain), to_text(plain));
    for (std::size_t place = 0; place < size; ++place) {
      for (int byte = 0; byte < 256; ++byte) {
        std::string text = plain;
        text[place] = static_cast<char>(byte);
        ASSERT_EQ(text_of(text), to_text(text)) << size << " " << place << " " << byte;
      }
    }
  }
  EXPECT_EQ(text_of("d\u00e9j\u00e0 vu \U0001F680"), "\"d\u00e9j\u00e0 vu \U0001F680\"");
}

TEST(JsonText, NumberIsThatOfTheTree) {
  const auto check = [](double number) {
    std::string json;
    append_number(json, number);
    ASSERT_EQ(json, to_text(number));
  };
  for (const double number :
       {0.0, -0.0, 1.0, -1.0, 0.5, 1e8, 999999999.0, 1e9, 1e15, 1e16, 1e300, 5e-324, 0.1}) {
    check(number);
    check(-number);
  }
  std::mt19937_64 random(1);
  for (int round = 0; round < test::rounds(100'000); ++round) {
    check(static_cast<double>(random() % 1'000'000) / 1'000'000);
    check(static_cast<double>(static_cast<std::int64_t>(random() >> (random() % 64))));
  }
  std::string json;
  append_integer(json, std::numeric_limits<std::int64_t>::min());
  append_integer(json, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(json, "-922337203685477580818446744073709551615");
}

TEST(JsonText, SecondsAreExact) {
  EXPECT_EQ(seconds_of(0), "0.0");
  EXPECT_EQ(seconds_of(1), "0.000001");
  EXPECT_EQ(seconds_of(80'000), "0.08");
  EXPECT_EQ(seconds_of(12 * second), "12.0");
  EXPECT_EQ(seconds_of(longest_time), "1000000000.0");
  EXPECT_EQ(seconds_of(649), "0.000649");  // the tree has 0.0006489999999999999
  std::mt19937_64 random(1);
  for (int round = 0; round < test::rounds(100'000); ++round) {
    const auto time = static_cast<Microseconds>((random() >> (random() % 64)) %
                                                static_cast<std::uint64_t>(longest_time + 1));
    const std::string text = seconds_of(time);
    ASSERT_EQ(text, format_decimal(time, 6) + (time % second == 0 ? ".0" : ""));
    ASSERT_TRUE(Json::accept(text)) << text;
    const Decimal again = parse_seconds(text);
    ASSERT_EQ(again.error, DecimalError::no_error) << text;
    ASSERT_EQ(again.value, time);
  }
}

}  // namespace
}  // namespace cbc
