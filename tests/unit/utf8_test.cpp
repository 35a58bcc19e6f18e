#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "runtime/base/text.h"

namespace cbc::utf8_test {
namespace {

TEST(Utf8, CountsCharacters) {
  EXPECT_EQ(utf8::count_characters(""), 0U);
  EXPECT_EQ(utf8::count_characters("abc"), 3U);
  EXPECT_EQ(utf8::count_characters("é日😀"), 3U);
  EXPECT_EQ(utf8::count_characters("\xff\x80z"), 3U);
}

TEST(Utf8, FindsTheFirstInvalidByte) {
  EXPECT_EQ(utf8::find_invalid("aé日😀"), std::nullopt);
  EXPECT_EQ(utf8::find_invalid("ab\xff"), 2U);
  EXPECT_EQ(utf8::find_invalid("\x80"), 0U);                        // a continuation alone
  EXPECT_EQ(utf8::find_invalid("a\xc3"), 1U);                       // cut short
  EXPECT_EQ(utf8::find_invalid("a\xe6\x97"), 1U);                   // cut short
  EXPECT_EQ(utf8::find_invalid("\xc3z"), 0U);                       // no continuation
  EXPECT_EQ(utf8::find_invalid("\xc0\xaf"), 0U);                    // overlong
  EXPECT_EQ(utf8::find_invalid("\xe0\x80\x80"), 0U);                // overlong
  EXPECT_EQ(utf8::find_invalid("\xed\xa0\x80"), 0U);                // surrogate
  EXPECT_EQ(utf8::find_invalid("\xf4\x90\x80\x80"), 0U);            // beyond Unicode
  EXPECT_EQ(utf8::find_invalid("\xf4\x8f\xbf\xbf"), std::nullopt);  // the last one
}

TEST(Utf8, ByteOrderMarksAreNoPartOfATextUnlessCutOff) {
  EXPECT_EQ(utf8::without_byte_order_mark("\xEF\xBB\xBF# a"), "# a");
  EXPECT_EQ(utf8::without_byte_order_mark("\xEF\xBB"), "\xEF\xBB");
}

TEST(PositionMap, CountsLinesAndCharacters) {
  const PositionMap map("aé\nb\r\n\nc");
  EXPECT_EQ(map.at(0), (Position{1, 1}));
  EXPECT_EQ(map.at(1), (Position{1, 2}));
  EXPECT_EQ(map.at(3), (Position{1, 3}));  // the line break
  EXPECT_EQ(map.at(4), (Position{2, 1}));
  EXPECT_EQ(map.at(7), (Position{3, 1}));
  EXPECT_EQ(map.at(8), (Position{4, 1}));
  EXPECT_EQ(map.at(9), (Position{4, 2}));
  EXPECT_EQ(map.at(1'000), (Position{4, 2}));
  EXPECT_EQ(map.line(1), "aé");
  EXPECT_EQ(map.line(2), "b");
  EXPECT_EQ(map.line(3), "");
  EXPECT_EQ(map.line(4), "c");
  EXPECT_EQ(map.line(5), "");
  EXPECT_EQ(map.line(0), "");
}

TEST(PositionMap, AgreesWithCountingOnLongLines) {
  std::string text = "first line\n";
  while (text.size() < 5'000) text += "xé日😀";
  const PositionMap map(text);
  std::uint32_t column = 1;
  for (std::size_t offset = 11; offset < text.size(); ++column) {
    ASSERT_EQ(map.at(offset), (Position{2, column})) << offset;
    offset += utf8::decode(text, offset).bytes;
  }
}

TEST(PositionMap, OffsetsOfPlaces) {
  const PositionMap map("aé\nb\r\n\nc");
  EXPECT_EQ(map.offset({1, 1}), 0U);
  EXPECT_EQ(map.offset({1, 2}), 1U);
  EXPECT_EQ(map.offset({1, 3}), 3U);  // the line break
  EXPECT_EQ(map.offset({1, 9}), 3U);
  EXPECT_EQ(map.offset({2, 2}), 5U);
  EXPECT_EQ(map.offset({2, 9}), 6U);
  EXPECT_EQ(map.offset({4, 2}), 9U);
  EXPECT_EQ(map.offset({5, 1}), 9U);
}

TEST(PositionMap, OffsetsAreTheInverseOfPlaces) {
  std::string text;
  for (int line = 0; line < 40; ++line) {
    for (int i = 0; i < 10 * line; ++i) text += i % 3 == 0 ? "日😀" : "é";
    text += line % 2 == 0 ? "\n" : "\r\n";
  }
  const PositionMap map(text);
  for (std::size_t offset = 0; offset < text.size();) {
    ASSERT_EQ(map.offset(map.at(offset)), offset);
    offset += utf8::decode(text, offset).bytes;
  }
  EXPECT_EQ(map.offset(map.at(text.size())), text.size());
}

TEST(Quote, ShowsWhatIsNotPrintable) {
  EXPECT_EQ(quote("a b"), "'a b'");
  EXPECT_EQ(quote(""), "''");
  EXPECT_EQ(quote("é日"), "'é日'");
  EXPECT_EQ(quote("a\nb\tc\rd"), "'a\\nb\\tc\\rd'");
  EXPECT_EQ(quote(std::string_view("\0\x1b\x7f", 3)), "'\\x00\\x1b\\x7f'");
  EXPECT_EQ(quote("\xc2\x9b\xe2\x80\xa8"), "'\\x9b\\u2028'");
  EXPECT_EQ(quote("\xff"), "'\\xff'");
}

/// Whatever Unicode says to ignore where it is not supported, beside direction and line marks.
TEST(Quote, ShowsWhatIsInvisible) {
  EXPECT_EQ(quote("a\u200bb"), "'a\\u200bb'");
  EXPECT_EQ(quote("\u200e\u200f\u061c\ufeff\u00ad"), "'\\u200e\\u200f\\u061c\\ufeff\\xad'");
  EXPECT_EQ(quote("\u202e\u2066\u2060\u3164\ufe0f"), "'\\u202e\\u2066\\u2060\\u3164\\ufe0f'");
  EXPECT_EQ(quote("\U000e0041\U0001d173"), "'\\U000e0041\\U0001d173'");
  EXPECT_EQ(printable("\u200b"), "\\u200b");
  EXPECT_FALSE(is_invisible(U'\u00e9'));
  EXPECT_FALSE(is_invisible(U'\u200a'));
  EXPECT_FALSE(is_invisible(U'\U0001F680'));
}

TEST(Quote, CutsLongTexts) {
  EXPECT_EQ(quote(std::string(80, 'a')), "'" + std::string(80, 'a') + "'");
  EXPECT_EQ(quote(std::string(81, 'a')), "'" + std::string(80, 'a') + "...'");
}

}  // namespace
TEST(PositionMap, ExcerptOfALongLine) {
  std::string line;
  for (int i = 0; i < 3000; ++i) line += i % 3 == 0 ? "é" : "x";
  const std::string text = "a\n" + line + "\r\nb";
  const PositionMap map(text);
  for (const std::uint32_t column : {1U, 5U, 300U, 1500U, 2990U, 3000U, 3001U}) {
    const PositionMap::Excerpt excerpt = map.excerpt({2, column}, 10);
    const std::size_t begin = column > 11 ? column - 11 : 0;
    const std::size_t end = std::min<std::size_t>(column + 9, 3000);
    EXPECT_EQ(excerpt.characters_before, begin) << column;
    EXPECT_EQ(excerpt.is_cut_after, end < 3000) << column;
    // Every third character takes two bytes.
    const auto bytes = [](std::size_t characters) { return characters + (characters + 2) / 3; };
    EXPECT_EQ(excerpt.text, std::string_view(line).substr(bytes(begin), bytes(end) - bytes(begin)))
        << column;
  }
  EXPECT_EQ(map.excerpt({1, 1}, 10).text, "a");
  EXPECT_EQ(map.excerpt({4, 1}, 10).text, "");
}

}  // namespace cbc::utf8_test
