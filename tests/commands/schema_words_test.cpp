// The JSON Schemas of what people write have the words that the program reads, and no others.
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cbc/event.h"
#include "core/catalog/shape.h"
#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/script.h"
#include "core/yaml/values.h"
#include "runtime/coordinator/record.h"
#include "support/read_file.h"

namespace cbc::schema_words_test {
namespace {

using Json = nlohmann::json;
using Words = std::set<std::string, std::less<>>;

Json schema(const std::string& name) {
  return Json::parse(test::read_file(CBC_SOURCE_DIR "/schemas/" + name + ".json"));
}

/// Null stands for the empty word.
void add_words(const Json& part, Words& words) {
  if (part.contains("const")) words.insert(part["const"].get<std::string>());
  if (!part.contains("enum")) return;
  for (const Json& word : part["enum"]) {
    words.insert(word.is_null() ? std::string() : word.get<std::string>());
  }
}

/// Of the part that a JSON pointer leads to.
Words words_at(const Json& schema, const std::string& pointer) {
  Words words;
  add_words(schema.at(Json::json_pointer(pointer)), words);
  return words;
}

template <typename Enumeration>
Words names_up_to(Enumeration last) {
  Words names;
  for (int value = 0; value <= static_cast<int>(last); ++value) {
    names.emplace(name_of(static_cast<Enumeration>(value)));
  }
  return names;
}

TEST(SchemaFiles, AreInTheirReadme) {
  const std::string readme = test::read_file(CBC_SOURCE_DIR "/schemas/README.md");
  for (const auto& file : std::filesystem::directory_iterator(CBC_SOURCE_DIR "/schemas")) {
    if (file.path().extension() != ".json") continue;
    const std::string name = file.path().filename().string();
    EXPECT_NE(readme.find("| `" + name + "` |"), std::string::npos) << name;
  }
}

TEST(SchemaWords, OfSettings) {
  const Json settings = schema("settings");
  for (const auto& [key, value] : settings["properties"].items()) {
    Diagnostics diagnostics;
    EXPECT_TRUE(read_settings(key + ":", ".cbc.yaml", diagnostics)) << key;
  }
  for (const RuleSetting setting : rule_settings) {
    EXPECT_TRUE(settings["properties"].contains(name_of(setting)));
  }
  for (const Json& example : settings["examples"]) {
    Diagnostics diagnostics;
    EXPECT_TRUE(read_settings(example.dump(), ".cbc.yaml", diagnostics)) << example;
  }
}

/// The part that a reference of this schema leads to; the part itself if it is none.
const Json& resolve(const Json& schema, const Json& part) {
  if (!part.contains("$ref")) return part;
  return schema.at(Json::json_pointer(part["$ref"].get<std::string>().substr(1)));
}

/// The keys of a mapping in the schema are those that the program reads, older names and all.
void expect_keys(const Json& schema, const std::string& pointer, const yaml::Shape& shape) {
  const Json& properties = schema.at(Json::json_pointer(pointer + "/properties"));
  Words expected;
  for (const yaml::Key& key : shape.keys) {
    expected.emplace(key.name);
    const auto found = properties.find(key.name);
    if (found == properties.end()) continue;
    const bool is_older = !key.replaced_by.empty();
    EXPECT_EQ(resolve(schema, *found).contains("deprecated"), is_older) << pointer << key.name;
    const bool has_text =
        found->contains("description") || resolve(schema, *found).contains("description");
    EXPECT_TRUE(has_text) << pointer << key.name;
  }
  Words found;
  for (const auto& property : properties.items()) found.insert(property.key());
  EXPECT_EQ(found, expected) << pointer;
}

TEST(SchemaWords, OfCatalogs) {
  const Json catalog = schema("catalog");
  expect_keys(catalog, "", shape::catalog);
  expect_keys(catalog, "/$defs/default_values", shape::default_values);
  expect_keys(catalog, "/$defs/situation_variable", shape::variable);
  expect_keys(catalog, "/$defs/task_defaults", shape::task_defaults);
  expect_keys(catalog, "/$defs/behavior_defaults", shape::behavior_defaults);
  expect_keys(catalog, "/$defs/behavior", shape::behavior);
  expect_keys(catalog, "/$defs/performance", shape::performance);
  expect_keys(catalog, "/$defs/requirement", shape::requirement);
  expect_keys(catalog, "/$defs/task", shape::task);
  expect_keys(catalog, "/$defs/parameter", shape::parameter);
  expect_keys(catalog, "/$defs/exclusivity_constraint", shape::exclusivity_list);
}

TEST(SchemaWords, OfScripts) {
  const Json script = schema("script");
  expect_keys(script, "", shape::script);
  expect_keys(script, "/$defs/event", shape::event);
  expect_keys(script, "/$defs/expectation", shape::expectation);
  EXPECT_EQ(words_at(script, "/$defs/event/properties/cause/anyOf/0"),
            names_up_to(FinishCause::interrupted));
  EXPECT_EQ(words_at(script, "/$defs/expectation/properties/outcome/anyOf/0"),
            names_up_to(Outcome::unchanged));
}

TEST(SchemaWords, OfPropertyFiles) {
  const Json properties = schema("properties");
  expect_keys(properties, "", shape::property_file);
  expect_keys(properties, "/$defs/assumptions", shape::assumptions);
  expect_keys(properties, "/$defs/faults", shape::faults);
  expect_keys(properties, "/$defs/property", shape::property);
  expect_keys(properties, "/$defs/condition", shape::condition);
}

}  // namespace
}  // namespace cbc::schema_words_test
