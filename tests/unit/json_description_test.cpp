#include "core/support/json_description.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/yaml/document.h"
#include "core/yaml/json_value.h"

namespace cbc::json_description_test {
namespace {

using Json = nlohmann::json;

enum class Shape : std::uint8_t { point, box };

std::string_view name_of(Shape shape) { return shape == Shape::point ? "point" : "box"; }

struct Figure {
  std::string name;
  Shape shape = Shape::point;
  std::uint32_t width = 0;
  std::optional<std::int64_t> weight;
  std::vector<std::string> colors;
  std::optional<bool> is_old;
};

constexpr auto figure = json::object(
    "figure", "What is drawn.", json::member("name", json::text, "Of people.", &Figure::name),
    json::member("shape", json::words(Shape::box), "", &Figure::shape),
    json::member("width", json::integer(1, 9), "", &Figure::width),
    json::member("weight", json::nullable(json::count), "", &Figure::weight),
    json::member("colors", json::names, "", &Figure::colors),
    json::optional("old", json::boolean, "", &Figure::is_old),
    json::member("letters", json::count, "", [](const Figure& of) { return of.name.size(); }));

const Figure house{"house", Shape::box, 3, std::nullopt, {"red", "blue"}, true};

/// The message if it cannot be read.
std::string read(const std::string& text, Figure& to) {
  yaml::JsonReader reader;
  try {
    figure.read(yaml::JsonValue(*reader.read(text)), to, json::NoContext());
  } catch (const yaml::JsonFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(JsonDescription, Writes) {
  EXPECT_EQ(json::document(figure, house),
            R"({"name":"house","shape":"box","width":3,"weight":null,"colors":["red","blue"],)"
            R"("old":true,"letters":5})"
            "\n");
  EXPECT_EQ(json::document(figure, Figure{}),
            R"({"name":"","shape":"point","width":0,"weight":null,"colors":[],"letters":0})"
            "\n");
}

TEST(JsonDescription, HasASchema) {
  const Json schema = Json::parse(json::schema("figures", "Figures", json::list(figure)));
  EXPECT_EQ(schema, Json::parse(R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "urn:cbc:schema:figures:1",
    "title": "Figures",
    "type": "array",
    "items": {"$ref": "#/$defs/figure"},
    "$defs": {"figure": {
      "description": "What is drawn.",
      "type": "object",
      "properties": {
        "name": {"description": "Of people.", "type": "string", "minLength": 1},
        "shape": {"enum": ["point", "box"]},
        "width": {"type": "integer", "minimum": 1, "maximum": 9},
        "weight": {"anyOf": [{"type": "integer", "minimum": 0}, {"type": "null"}]},
        "colors": {"type": "array", "items": {"type": "string", "minLength": 1},
                   "uniqueItems": true},
        "old": {"type": "boolean"},
        "letters": {"type": "integer", "minimum": 0}
      },
      "required": ["name", "shape", "width", "weight", "colors", "letters"],
      "additionalProperties": false
    }}
  })"));
}

TEST(JsonDescription, RefusesTwoDefinitionsOfOneName) {
  constexpr auto other = json::object("figure", "Something else.");
  constexpr auto both =
      json::object("", "", json::member("a", figure, "", 0), json::member("b", other, "", 0));
  EXPECT_THROW(static_cast<void>(json::schema("both", "Both", both)), std::logic_error);
}

TEST(JsonDescription, Reads) {
  Figure found;
  EXPECT_EQ(read(json::document(figure, house), found), "");
  EXPECT_EQ(json::document(figure, found), json::document(figure, house));
}

TEST(JsonDescription, SaysWhatIsWrong) {
  const Json good = Json::parse(json::document(figure, house));
  const auto fault = [&](const char* member, const Json& value) {
    Json bad = good;
    bad[member] = value;
    Figure found;
    return read(bad.dump(), found);
  };
  EXPECT_EQ(fault("name", 7), "'name' is not a text");
  EXPECT_EQ(fault("shape", "ball"), "there is no shape 'ball'");
  EXPECT_EQ(fault("width", 0), "'width' is not a whole number from 1 to 9");
  EXPECT_EQ(fault("weight", true), "'weight' is not a whole number in its range");
  EXPECT_EQ(fault("colors", "red"), "'colors' is not a list");
  EXPECT_EQ(fault("old", "yes"), "'old' is not true or false");
  EXPECT_EQ(fault("letters", "what is computed is not read"), "");
  Figure found;
  EXPECT_EQ(read("{}", found), "'name' is missing");
}

TEST(JsonDescription, ChoosesMembersByKind) {
  constexpr auto by_shape = json::variants(
      "figure", "", json::group(), "shape", &Figure::shape, json::group(),
      json::variant({Shape::point}, "", json::member("name", json::text, "", &Figure::name)),
      json::variant({Shape::box}, "", json::member("width", json::integer(1), "", &Figure::width)));
  EXPECT_EQ(json::document(by_shape, house), "{\"shape\":\"box\",\"width\":3}\n");
  EXPECT_EQ(json::document(by_shape, Figure{}), "{\"shape\":\"point\",\"name\":\"\"}\n");
}

}  // namespace
}  // namespace cbc::json_description_test
