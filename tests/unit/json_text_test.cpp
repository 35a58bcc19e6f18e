#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/support/json.h"
#include "runtime/base/text.h"
#include "support/rounds.h"

namespace cbc::json_text_test {
namespace {

using Json = nlohmann::ordered_json;

/// As another writer has it.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string text_of(std::string_view text) {
  std::string json = "[";
  append_text(json, text);
  return json.substr(1);
}

std::string seconds_of(Microseconds time) {
  std::string json;
  JsonBuffer(json).put_millionths(time);
  return json;
}

TEST(JsonText, TextIsThatOfTheTree) {
  for (std::size_t size = 0; size <= 20; ++size) {
    const std::string plain(size, 'x');
    EXPECT_EQ(text_of(plain), dump(plain));
    for (std::size_t place = 0; place < size; ++place) {
      for (int byte = 0; byte < 256; ++byte) {
        std::string text = plain;
        text[place] = static_cast<char>(byte);
        if (byte == 0x7F) continue;  // see below
        ASSERT_EQ(text_of(text), dump(text)) << size << " " << place << " " << byte;
      }
    }
  }
  EXPECT_EQ(text_of("d\u00e9j\u00e0 vu \U0001F680"), "\"d\u00e9j\u00e0 vu \U0001F680\"");
}

/// Terminals would act on them, or show nothing; the value of the text is the same.
TEST(JsonText, WhatDoesNotPrintIsEscaped) {
  const std::string text =
      "a\x7f\u0085\u200b\u200e\u061c\ufeff\u202e\u2028\U000e0041\u00e9\U0001F680\\u200b";
  EXPECT_EQ(text_of(text),
            "\"a\\u007f\\u0085\\u200b\\u200e\\u061c\\ufeff\\u202e\\u2028\\udb40\\udc41\u00e9"
            "\U0001F680\\\\u200b\"");
  EXPECT_EQ(Json::parse(text_of(text)), text);
  std::string object = "{";
  JsonBuffer(object).put_name(text, false);
  EXPECT_EQ(Json::parse(object + "0}").items().begin().key(), text);
}

TEST(JsonText, NumberIsThatOfTheTree) {
  const auto check = [](double number) {
    std::string json;
    append_value(json, number);
    ASSERT_EQ(json, dump(number));
  };
  for (const double number :
       {0.0, -0.0, 1.0, -1.0, 0.5, 1e8, 999999999.0, 1e9, 1e15, 1e16, 1e300, 5e-324, 0.1}) {
    check(number);
    check(-number);
  }
  for (int number = 0; number <= 1000; ++number) check(number / 1000.0);
  std::mt19937_64 random(1);
  for (int round = 0; round < test::rounds(100'000); ++round) {
    check(static_cast<double>(random() % 1'000'000) / 1'000'000);
    check(static_cast<double>(static_cast<std::int64_t>(random() >> (random() % 64))));
  }
  std::string json;
  append_value(json, std::numeric_limits<std::int64_t>::min());
  append_value(json, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(json, "-922337203685477580818446744073709551615");
}

TEST(JsonText, WhatIsWrittenAsANumberStaysAsItIs) {
  const auto as_written = [](std::string_view text) {
    std::string json;
    append_as_written(json, text);
    return json;
  };
  for (const std::string_view number : {"0", "-7", "0.50", "1e3", "1.25E-2"}) {
    EXPECT_EQ(as_written(number), number);
  }
  for (const std::string_view text : {"", ".5", "5.", "05", "+1", "inf", "1e999", "0x1", "7 m"}) {
    EXPECT_EQ(as_written(text), dump(text));
  }
}

TEST(JsonText, TheShortestFormOfANumberHasItsValue) {
  const auto shortest = [](std::string_view text) {
    std::string json;
    append_shortest(json, text);
    return json;
  };
  EXPECT_EQ(shortest("0.50"), "0.5");
  EXPECT_EQ(shortest("-7"), "-7");
  EXPECT_EQ(shortest("1e3"), "1000.0");
  EXPECT_EQ(shortest("18446744073709551615"), "18446744073709551615");
  for (const std::string_view text : {"", ".5", "1e999", "true", "7 m", "a\"b"}) {
    EXPECT_EQ(shortest(text), dump(text));
  }
}

/// Every kind of value, as a tree and as it is written, on one line and indented.
TEST(JsonWriter, WritesWhatTheTreeDoes) {
  const Json tree = {{"text", "a\"b"},
                     {"numbers", {1, -2, 0.25, std::numeric_limits<std::uint64_t>::max()}},
                     {"truth", true},
                     {"null", nullptr},
                     {"list", Json::array()},
                     {"object", Json::object()},
                     {"nested", {{{"a", 1}}, Json::array({Json::array()})}}};
  for (const auto layout : {JsonWriter::Layout::line, JsonWriter::Layout::indented}) {
    std::string text;
    JsonWriter json(text, layout);
    json.open('{');
    json.write("text", "a\"b");
    json.open("numbers", '[');
    json.write(1);
    json.write(-2);
    json.write(std::optional(0.25));
    json.write(std::numeric_limits<std::uint64_t>::max());
    json.close(']');
    json.write("truth", true);
    json.write("null", std::optional<int>());
    json.write_list("list", std::vector<int>());
    json.open("object", '{');
    json.close('}');
    json.write_list("nested", std::vector{0, 1}, [&](int item) {
      json.open(item == 0 ? '{' : '[');
      if (item == 0) {
        json.write("a", 1);
      } else {
        json.open('[');
        json.close(']');
      }
      json.close(item == 0 ? '}' : ']');
    });
    json.close('}');
    EXPECT_EQ(text, tree.dump(layout == JsonWriter::Layout::line ? -1 : 1));
  }
}

TEST(JsonWriter, WritesObjectsOfPlainMembers) {
  const auto text = json_line([](JsonWriter& json) {
    json.write_members({{"text", std::string("a\"b")}, {"truth", false}, {"less", -1}});
    json.write_object("numbers", {{"most", std::numeric_limits<std::uint64_t>::max()},
                                  {"whole", 2.0},
                                  {"part", 0.5},
                                  {"some", std::optional(3)}});
    json.write_object("empty", {{"null", nullptr}, {"none", std::optional<int>()}});
  });
  EXPECT_EQ(text, R"({"text":"a\"b","truth":false,"less":-1,)"
                  R"("numbers":{"most":18446744073709551615,"whole":2.0,"part":0.5,"some":3},)"
                  R"("empty":{"null":null,"none":null}})"
                  "\n");
}

TEST(JsonWriter, PutsItemsOnLinesOfTheirOwn) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.open("list", '[');
  for (const int item : {1, 2}) json.on_new_line().write(item);
  json.close(']');
  json.on_new_line().key("whole");
  json.put_percent(80 * (one_million / 100));
  json.key("part");
  json.put_percent(1);
  json.close('}');
  EXPECT_EQ(text, "{\"list\":[\n1,\n2],\n\"whole\":80,\"part\":0.0001}");
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
}  // namespace cbc::json_text_test
