// The JSON Schemas in schemas/ have the words that the program has, and no others.
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cbc/event.h"
#include "core/catalog/draft.h"
#include "core/check/controls.h"
#include "core/check/together.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/yaml/values.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/mutants/judge.h"
#include "coverage/engine/mutants/mutants.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/catalog_graph.h"
#include "runtime/coordinator/record.h"
#include "runtime/explain/alternatives.h"
#include "runtime/explain/reasons.h"
#include "support/read_file.h"
#include "sweep/engine/sequence.h"
#include "verify/report/verify_report.h"

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

/// Of one member, in all parts of a list.
Words words_in_list(const Json& schema, const std::string& pointer, const char* member) {
  Words words;
  for (const Json& part : schema.at(Json::json_pointer(pointer))) {
    add_words(part["properties"][member], words);
  }
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

TEST(SchemaWords, OfTogether) {
  EXPECT_EQ(words_at(schema("together"), "/$defs/pair/properties/together"),
            names_up_to(Together::undecided));
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

TEST(SchemaWords, OfEvents) {
  const Json events = schema("events");
  const std::string event = "/$defs/event/properties/";
  EXPECT_EQ(words_at(events, event + "origin"), names_up_to(Origin::situation));
  EXPECT_EQ(words_at(events, event + "verb"), names_up_to(Verb::wait));
  EXPECT_EQ(words_at(events, event + "outcome"), names_up_to(Outcome::unchanged));
  EXPECT_EQ(words_at(events, "/$defs/finish_cause"), names_up_to(FinishCause::interrupted));
  EXPECT_EQ(words_at(events, "/$defs/change/properties/cause"), names_up_to(ChangeCause::undone));
  EXPECT_EQ(words_at(events, "/$defs/search/properties/status"),
            names_up_to(SearchStatus::unknown));
  EXPECT_EQ(words_in_list(events, "/$defs/reason/oneOf", "kind"),
            names_up_to(Reason::Kind::stopped));
  EXPECT_EQ(words_in_list(events, "/$defs/loss/oneOf", "objective"),
            names_up_to(Criterion::canonical));
}

TEST(SchemaWords, OfTotals) {
  Words verbs;
  Words origins;
  for (const SearchTotals::Kind& kind : SearchTotals::kinds) {
    verbs.emplace(name_of(kind.verb));
    origins.emplace(name_of(kind.origin));
  }
  const Json events = schema("events");
  EXPECT_EQ(words_at(events, "/$defs/effort_of_kind/properties/verb"), verbs);
  EXPECT_EQ(words_at(events, "/$defs/effort_of_kind/properties/origin"), origins);
}

TEST(SchemaWords, OfSweeps) {
  const Json sweep = schema("sweep");
  EXPECT_EQ(words_in_list(sweep, "/properties/events/prefixItems", "kind"),
            names_up_to(SweepKind::lost));
  // That a behavior finished is a reason of no rejection.
  EXPECT_EQ(words_in_list(sweep, "/$defs/reason/oneOf", "kind"), names_up_to(Reason::Kind::faulty));
}

TEST(SchemaWords, OfCoverage) {
  const Json coverage = schema("coverage");
  EXPECT_EQ(words_in_list(coverage, "/$defs/goal/oneOf", "kind"),
            names_up_to(Goal::Kind::equal_displaced));
  EXPECT_EQ(words_at(coverage, "/$defs/catalog/properties/sections/items/properties/section"),
            names_up_to(GoalSection::priorities));
}

TEST(SchemaWords, OfMutants) {
  const Json mutants = schema("mutants");
  EXPECT_EQ(words_in_list(mutants, "/$defs/mutant/oneOf", "kind"),
            names_up_to(Mutant::Kind::execution_goal_turned));
  const std::string judged = "/$defs/judged/properties/";
  EXPECT_EQ(words_at(mutants, judged + "result"), names_up_to(MutantVerdict::Result::unjudged));
  EXPECT_EQ(words_at(mutants, judged + "reason"), names_up_to(MutantVerdict::Doubt::no_script));
  EXPECT_EQ(words_at(mutants, judged + "noticed_by/properties/how"),
            names_up_to(Notice::How::ended));
}

TEST(SchemaWords, OfVerifications) {
  const Json verify = schema("verify");
  EXPECT_EQ(words_at(verify, "/$defs/property/properties/kind"),
            names_up_to(Property::Kind::reachable));
  EXPECT_EQ(words_at(verify, "/$defs/result"), names_up_to(Verdict::Result::undecided));
}

TEST(SchemaWords, OfLint) {
  const Json lint = schema("lint");
  const std::string diagnostic = "/$defs/diagnostic/properties/";
  const Json& rule = lint.at(Json::json_pointer(diagnostic + "rule"));
  const std::regex pattern(rule["pattern"].get<std::string>());
  for (const Rule& known : all_rules()) {
    EXPECT_TRUE(std::regex_match(std::string(known.name), pattern)) << known.name;
  }
  EXPECT_EQ(words_at(lint, diagnostic + "severity"), names_up_to(Severity::error));
}

TEST(SchemaWords, OfPictures) {
  Words marks = names_up_to(draw::Mark::unavailable);
  // Pictures of two catalogs are not written as JSON, but what they have not in common is.
  for (const char* mark : {"added", "removed", "changed"}) marks.erase(mark);
  EXPECT_EQ(words_at(schema("graph"), "/$defs/mark"), marks);
  const Json diff = schema("diff");
  EXPECT_EQ(words_at(diff, "/$defs/kind"), names_up_to(CatalogChange::Kind::changed));
  EXPECT_EQ(words_in_list(diff, "/$defs/change/oneOf", "subject"),
            names_up_to(CatalogChange::Subject::exclusion));
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
  expect_keys(properties, "/$defs/property", shape::property);
  expect_keys(properties, "/$defs/condition", shape::condition);
}

}  // namespace
}  // namespace cbc::schema_words_test
