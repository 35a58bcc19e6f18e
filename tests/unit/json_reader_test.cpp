#include "yaml/json_reader.h"

#include <memory>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "yaml/document.h"

namespace cbc {
namespace {

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

TEST(JsonReader, UnderstandsSurrogatePairs) {
  yaml::JsonReader reader;
  const Node* const root = reader.read(R"("\ud83d\ude80")", 1);
  ASSERT_NE(root, nullptr);
  EXPECT_EQ(root->text, "\U0001F680");
}

TEST(JsonReader, RefusesWhatIsNoJson) {
  yaml::JsonReader reader;
  for (const std::string_view text :
       {"",           " ",       "{",         "[1",          "{\"a\"}",      "{\"a\":}",
        "{\"a\":1,}", "[1,]",    "{a: 1}",    "01",          "1.",           ".5",
        "+1",         "1e",      "-",         "tru",         "nul",          "\"a",
        "\"\t\"",     R"("\x")", R"("\u12")", R"("\ud800")", R"("\udc00")",  R"("\ud800A")",
        "{} {}",      "[1] x",   "\"\xff\"",  "'a'",         R"({"<<": {}})"}) {
    EXPECT_EQ(reader.read(text, 1), nullptr) << text;
  }
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
}  // namespace cbc
