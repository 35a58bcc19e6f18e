#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "support/rounds.h"

namespace cbc::json_reader_test {
namespace {

using Json = nlohmann::json;
using yaml::Kind;
using yaml::Node;

void expect_alike(const Node& json, const Node& document) {
  EXPECT_EQ(json.kind, document.kind);
  EXPECT_EQ(json.plain, document.plain) << json.text;
  EXPECT_EQ(json.text, document.text);
  ASSERT_EQ(json.items.size(), document.items.size());
  for (std::size_t place = 0; place < json.items.size(); ++place) {
    expect_alike(*json.items[place], *document.items[place]);
  }
  ASSERT_EQ(json.entries.size(), document.entries.size());
  for (std::size_t place = 0; place < json.entries.size(); ++place) {
    expect_alike(*json.entries[place].first, *document.entries[place].first);
    expect_alike(*json.entries[place].second, *document.entries[place].second);
  }
}

TEST(JsonReader, GivesTheTreeOfTheYamlParser) {
  yaml::JsonReader reader;
  for (const std::string_view text : {
           R"({"start": "HOVER", "priority": 2, "at": 1.5e1})",
           R"( {"a":[1,-2.50,true,false,null,"",[],{}] , "b":{"c":"true"}} )",
           R"({"text":"a \"b\" \\ \/ \n \t \u00e9 \u20ac","é":"日本"})",
           R"([0, -0, 0.10, 1E+5, 123456789012345678901234567890])",
           R"({"a":1,"a":2})",
           R"("only a text")",
       }) {
    Diagnostics diagnostics;
    const auto document = yaml::parse(text, "", diagnostics);
    ASSERT_NE(document, nullptr) << text;
    const Node* const root = reader.read(text, 1);
    ASSERT_NE(root, nullptr) << text;
    expect_alike(*root, document->root());
  }
}

/// A value of any shape, at most `depth` deep.
Json random_value(std::mt19937_64& random, int depth) {
  const auto below = [&random](std::uint64_t bound) { return random() % bound; };
  static const std::vector<Json> scalars{nullptr, true, false,           0,       -7,
                                         2.5,     1e20, 123456789012345, "",      "HOVER",
                                         "é",     "\t", "\"\\\u0001",    "\u2028"};
  const std::uint64_t kind = below(depth > 0 ? 4 : 2);
  if (kind < 2) return scalars[below(scalars.size())];
  Json value = kind == 2 ? Json::array() : Json::object();
  for (std::uint64_t count = below(4); count > 0; --count) {
    Json item = random_value(random, depth - 1);
    if (kind == 2) {
      value.push_back(std::move(item));
    } else {
      value[std::to_string(below(5))] = std::move(item);
    }
  }
  return value;
}

/// The value that a tree stands for.
Json value_of(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      return nullptr;
    case Kind::scalar:
      return node.plain ? Json::parse(node.text) : Json(node.text);
    case Kind::sequence: {
      Json list = Json::array();
      for (const Node* item : node.items) list.push_back(value_of(*item));
      return list;
    }
    case Kind::mapping:
      break;
  }
  Json mapping = Json::object();
  for (const auto& [key, value] : node.entries) mapping[key->text] = value_of(*value);
  return mapping;
}

TEST(JsonReader, ReadsWhatAnotherReaderDoes) {
  constexpr std::string_view characters =
      " \t\r{}[]:,\"\\/bfnrtu0123456789.-+eE'x\x01\x7f\x80\xc3\xa9";
  std::mt19937_64 random(1);
  yaml::JsonReader reader;
  std::size_t read = 0;
  for (int round = 0; round < test::rounds(20'000); ++round) {
    std::string text = random_value(random, 4).dump(round % 3 == 0 ? 1 : -1);
    for (std::uint64_t changes = random() % 3; changes > 0; --changes) {
      const char character = characters[random() % characters.size()];
      const std::size_t place = random() % text.size();
      if (random() % 2 == 0) {
        text[place] = character;
      } else {
        text.insert(place, 1, character);
      }
    }
    const Node* const root = reader.read(text, 1);
    Json other(Json::value_t::discarded);
    try {
      other = Json::parse(text);
    } catch (const Json::parse_error&) {
    } catch (const Json::out_of_range&) {
      continue;  // a number that no double can hold; here it is only text
    }
    ASSERT_EQ(root != nullptr, !other.is_discarded()) << text;
    if (root == nullptr) continue;
    ASSERT_EQ(value_of(*root), other) << text;
    ++read;
  }
  EXPECT_GT(read, test::rounds(5'000U));
  EXPECT_LT(read, test::rounds(15'000U));
}

TEST(JsonReader, UnderstandsSurrogatePairs) {
  yaml::JsonReader reader;
  const Node* const root = reader.read(R"("\ud83d\ude80")", 1);
  ASSERT_NE(root, nullptr);
  EXPECT_EQ(root->text, "\U0001F680");
}

TEST(JsonReader, RefusesWhatIsNoJson) {
  yaml::JsonReader reader;
  for (const std::string_view text :
       {"",           " ",       "{",         "[1",          "{\"a\"}",     "{\"a\":}",
        "{\"a\":1,}", "[1,]",    "{a: 1}",    "01",          "1.",          ".5",
        "+1",         "1e",      "-",         "tru",         "nul",         "\"a",
        "\"\t\"",     R"("\x")", R"("\u12")", R"("\ud800")", R"("\udc00")", R"("\ud800A")",
        "{} {}",      "[1] x",   "\"\xff\"",  "'a'"}) {
    EXPECT_EQ(reader.read(text, 1), nullptr) << text;
  }
}

TEST(JsonReader, SkipsAByteOrderMark) {
  yaml::JsonReader reader;
  const yaml::Node* const root = reader.read("\xEF\xBB\xBF{\"a\": 1}");
  ASSERT_NE(root, nullptr);
  EXPECT_EQ(root->entries.size(), 1U);
  EXPECT_EQ(reader.read("\xEF\xBB\xBF\xEF\xBB\xBF{}"), nullptr);
}

TEST(JsonReader, SaysWhyATextIsNoJson) {
  yaml::JsonReader reader;
  const auto fault = [&reader](std::string_view text) {
    EXPECT_EQ(reader.read(text), nullptr);
    return reader.fault();
  };
  EXPECT_EQ(fault("{"), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("\0\0\0\0", 4)), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("\x14\0\0\0CBC1", 8)), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("P\0\0\0CBC1", 8)), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("\0\0\0\x14", 4)), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("P\0\0\0CBC", 7)), "it is not JSON, or it is damaged");
  EXPECT_EQ(fault(std::string_view("\xFF\xFE{\0}\0", 6)), "expected UTF-8, found UTF-16");
  EXPECT_EQ(fault(std::string_view("\xFF\xFE\0\0{\0\0\0", 8)), "expected UTF-8, found UTF-32");
}

TEST(JsonReader, TellsOfMergeKeys) {
  yaml::JsonReader reader;
  ASSERT_NE(reader.read(R"({"<<": {}})", 1), nullptr);
  EXPECT_TRUE(reader.has_merge_key());
  ASSERT_NE(reader.read(R"({"a": "<<"})", 1), nullptr);
  EXPECT_FALSE(reader.has_merge_key());
}

/// What the reading of a value ends with.
template <typename Read>
std::string fault_of(std::string_view text, Read read) {
  yaml::JsonReader reader;
  const Node* const root = reader.read(text);
  if (root == nullptr) return "no JSON";
  try {
    static_cast<void>(read(yaml::JsonValue(*root)));
  } catch (const yaml::JsonFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(JsonValue, GivesValuesOfTheirTypes) {
  yaml::JsonReader reader;
  const Node* const root =
      reader.read(R"({"text":"","number":0.5,"whole":18446744073709551615,"no":false,
                      "null":null,"list":[1,2],"text":"second"})");
  ASSERT_NE(root, nullptr);
  const yaml::JsonValue value(*root);
  EXPECT_EQ(value["text"].text(), "");
  EXPECT_EQ(value["number"].number(0, 1, ""), 0.5);
  EXPECT_EQ(value["whole"].integer<std::uint64_t>(), UINT64_MAX);
  EXPECT_FALSE(value["no"].truth());
  EXPECT_TRUE(value["null"].is_null());
  EXPECT_EQ(value["list"].items()[1].integer<int>(), 2);
  EXPECT_FALSE(value.find("nothing"));
  EXPECT_EQ(value.members().size(), 7U);
}

TEST(JsonValue, SaysWhatIsWrong) {
  using Value = yaml::JsonValue;
  const auto whole = [](const Value& value) { return value["a"].integer<std::uint32_t>(1, 9); };
  for (const std::string_view wrong :
       {"-1", "0", "10", "1.0", "1e0", "\"1\"", "true", "null", "[]"}) {
    EXPECT_EQ(fault_of(R"({"a":)" + std::string(wrong) + "}", whole),
              "'a' is not a whole number from 1 to 9");
  }
  EXPECT_EQ(fault_of(R"({"a":1})", whole), "");
  EXPECT_EQ(fault_of("{}", whole), "'a' is missing");
  EXPECT_EQ(fault_of("[]", whole), "it is not an object");
  EXPECT_EQ(fault_of(R"({"a":1})", [](const Value& value) { return value["a"].text(); }),
            "'a' is not a text");
  EXPECT_EQ(fault_of(R"({"a":"true"})", [](const Value& value) { return value["a"].truth(); }),
            "'a' is not true or false");
  EXPECT_EQ(fault_of(R"({"a":{}})", [](const Value& value) { return value["a"].items(); }),
            "'a' is not a list");
  EXPECT_EQ(fault_of(R"({"a":2})",
                     [](const Value& value) { return value["a"].number(0, 1, "from 0 to 1"); }),
            "'a' is not a number from 0 to 1");
}

TEST(JsonReader, RefusesWhatIsTooDeep) {
  yaml::JsonReader reader;
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_NE(reader.read(nested(yaml::maximum_depth), 1), nullptr);
  EXPECT_EQ(reader.read(nested(yaml::maximum_depth + 1), 1), nullptr);
  EXPECT_EQ(reader.read(std::string(1'000'000, '['), 1), nullptr);
}

TEST(JsonReader, CanBeUsedAgain) {
  yaml::JsonReader reader;
  ASSERT_EQ(reader.read(R"({"a":[1,2)", 1), nullptr);
  const Node* const root = reader.read(R"({"b":"x"})", 7);
  ASSERT_NE(root, nullptr);
  ASSERT_EQ(root->entries.size(), 1U);
  EXPECT_EQ(root->entries[0].first->text, "b");
  EXPECT_EQ(root->entries[0].second->text, "x");
  EXPECT_TRUE(root->items.empty());
  EXPECT_EQ(root->range.begin.line, 7U);
}

}  // namespace
}  // namespace cbc::json_reader_test
