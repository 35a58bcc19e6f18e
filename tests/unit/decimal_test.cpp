#include <cstddef>
#include <iterator>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "runtime/base/text.h"

namespace cbc::decimal_test {
namespace {

using enum DecimalError;

TEST(Decimal, ReadsPercentExactly) {
  EXPECT_EQ(parse_percent("0").value, 0);
  EXPECT_EQ(parse_percent("100").value, 1'000'000);
  EXPECT_EQ(parse_percent("72").value, 720'000);
  EXPECT_EQ(parse_percent("0.0001").value, 1);
  EXPECT_EQ(parse_percent("99.9999").value, 999'999);
  EXPECT_EQ(parse_percent("33.3").value, 333'000);
}

TEST(Decimal, ReadsSecondsExactly) {
  EXPECT_EQ(parse_seconds("15").value, 15'000'000);
  EXPECT_EQ(parse_seconds("0.08").value, 80'000);
  EXPECT_EQ(parse_seconds("0.000001").value, 1);
  EXPECT_EQ(parse_seconds("1000000000").value, longest_time);
}

TEST(Decimal, AllowsEveryPlainSpelling) {
  for (const std::string text : {"10", "+10", "10.", "10.0000000000", "010", "1e1", "1E+1", "1.0e1",
                                 "100e-1", ".1e2", "0.00001e6"}) {
    const Decimal decimal = parse_percent(text);
    EXPECT_EQ(decimal.error, no_error) << text;
    EXPECT_EQ(decimal.value, 100'000) << text;
  }
  EXPECT_EQ(parse_percent(".5").value, 5'000);
  EXPECT_EQ(parse_percent("-0").error, no_error);
  EXPECT_EQ(parse_percent("0e999999999999999999999").error, no_error);
}

TEST(Number, IsReadInEverySpelling) {
  for (const std::string text : {"10", "+10", "10.", "10.000", "010", "1e1", "100e-1", ".1E+2"}) {
    EXPECT_EQ(parse_number(text), parse_number("10")) << text;
  }
  for (const std::string text : {"-0", "0.0", "+.0", "0e99", "-0e-999999999999999"}) {
    EXPECT_EQ(parse_number(text), Number{}) << text;
  }
  for (const std::string text :
       {"", ".", "-", "e1", "1e", "1e+", "0x1", "1 ", " 1", "inf", "--1", "1.2.3", "1e1e1"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
}

TEST(Number, IsComparedByValue) {
  const std::string ascending[] = {"-1e999999999999999999",
                                   "-1e999999999",
                                   "-10.01",
                                   "-10",
                                   "-9.99",
                                   "-1",
                                   "-.5",
                                   "-1e-99",
                                   "0",
                                   "1e-999999999",
                                   "1e-99",
                                   ".5",
                                   ".51",
                                   "1",
                                   "1.00000000000000000000001",
                                   "9.99",
                                   "10",
                                   "10.01",
                                   "1e999",
                                   "1.1e999"};
  for (std::size_t a = 0; a < std::size(ascending); ++a) {
    for (std::size_t b = 0; b < std::size(ascending); ++b) {
      EXPECT_EQ(*parse_number(ascending[a]) <=> *parse_number(ascending[b]), a <=> b)
          << ascending[a] << " " << ascending[b];
    }
  }
}

TEST(Decimal, TellsErrorsApart) {
  for (const std::string text :
       {"",   "abc", "1a",   "1e",    "1e+",  ".",    "-",   "+",     "--1", "+-1",  "1,5",
        "1 ", " 1",  "0x10", "1_000", ".inf", ".nan", "inf", "1.2.3", "e5",  "1e1.5"}) {
    EXPECT_EQ(parse_percent(text).error, not_a_number) << text;
  }
  for (const std::string text : {"-1", "-0.0001", "100.0001", "101", "100.00001", "-0.00001",
                                 "1e999999999999999999999", "-1e99"}) {
    EXPECT_EQ(parse_percent(text).error, out_of_range) << text;
  }
  for (const std::string text : {"0.00001", "99.99999", "1e-5", "1e-99999999999999999999999"}) {
    EXPECT_EQ(parse_percent(text).error, too_precise) << text;
  }
  EXPECT_EQ(parse_seconds("0.0000001").error, too_precise);
  EXPECT_EQ(parse_seconds("1000000000.000001").error, out_of_range);
  EXPECT_EQ(parse_seconds("-1").error, out_of_range);
}

TEST(Decimal, ReadsLongTexts) {
  const std::string zeros(1'000'000, '0');
  EXPECT_EQ(parse_percent(zeros + "7." + zeros).value, 70'000);
  EXPECT_EQ(parse_percent("0." + zeros + "1").error, too_precise);
  EXPECT_EQ(parse_percent("1" + zeros).error, out_of_range);
  EXPECT_EQ(parse_percent("1" + zeros + "e-1000000").value, 10'000);
}

TEST(Decimal, ReadsNegativeNumbers) {
  EXPECT_EQ(parse_decimal("-1.5", 1, -20, 20).value, -15);
  EXPECT_EQ(parse_decimal("-2", 1, -20, 20).value, -20);
  EXPECT_EQ(parse_decimal("-2.1", 1, -20, 20).error, out_of_range);
  EXPECT_EQ(parse_decimal("-2.01", 1, -20, 20).error, out_of_range);
  EXPECT_EQ(parse_decimal("-1.99", 1, -20, 20).error, too_precise);
}

TEST(Decimal, ReadsIntegers) {
  EXPECT_EQ(parse_integer("12", 1, 100).value, 12);
  EXPECT_EQ(parse_integer("+12", 1, 100).value, 12);
  EXPECT_EQ(parse_integer("0", 1, 100).error, out_of_range);
  EXPECT_EQ(parse_integer("101", 1, 100).error, out_of_range);
  EXPECT_EQ(parse_integer("99999999999999999999", 1, 100).error, out_of_range);
  EXPECT_EQ(parse_integer("1.0", 1, 100).error, not_a_number);
  EXPECT_EQ(parse_integer("1e1", 1, 100).error, not_a_number);
  EXPECT_EQ(parse_integer("", 1, 100).error, not_a_number);
}

TEST(Decimal, FormatsTheShortestText) {
  EXPECT_EQ(format_decimal(0, 6), "0");
  EXPECT_EQ(format_decimal(1, 6), "0.000001");
  EXPECT_EQ(format_decimal(1'500'000, 6), "1.5");
  EXPECT_EQ(format_decimal(15'000'000, 6), "15");
  EXPECT_EQ(format_decimal(100'000'000, 6), "100");
  EXPECT_EQ(format_decimal(-1'500'000, 6), "-1.5");
  EXPECT_EQ(format_decimal(720'000, 4), "72");
}

}  // namespace
}  // namespace cbc::decimal_test
