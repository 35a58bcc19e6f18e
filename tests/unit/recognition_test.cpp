#include "core/files/recognition.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/catalog/foreign_file.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

namespace cbc::cli::recognition_test {
namespace {

/// "catalog", "faulty script", "catalog?" if it is not sure.
std::string kind(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "a.yaml", diagnostics);
  const Recognition what = recognize("a.yaml", text, document.get());
  constexpr const char* names[] = {"catalog",  "compiled", "script", "properties",
                                   "settings", "log",      "other"};
  return std::string(what.is_faulty ? "faulty " : "") + names[static_cast<int>(what.kind)] +
         (what.is_sure ? "" : "?");
}

/// In an encoding whose characters have `width` bytes.
std::string widen(std::string_view text, std::size_t width, bool is_big_endian) {
  std::string wide;
  for (const char byte : text) {
    const std::string zeros(width - 1, '\0');
    wide += is_big_endian ? zeros + byte : byte + zeros;
  }
  return wide;
}

TEST(Recognition, FindsCatalogsThatAreNoYaml) {
  for (const std::string text :
       {"\tbehaviors:\n- {behavior: A, task: B}\n", "  behaviors:\n- {behavior: A, task: B}\n",
        "behaviors:\n\t- behavior: A\n", "behaviors :\n\t- behavior: A\n",
        "\"behaviors\" : [\n\t{\n", "{x: 1, behaviors: [{\n", "basic_behaviors:\n\t- behavior: A\n",
        "x: 1\n\tbehavior_descriptors:\n",
        "exclusivity_constraints:\n\t- mutually_exclusive: [A]\n", "tasks:\n\t- task: A\n",
        "tasks:\n\t- x\ndefault_values:\n", "\u00A0behaviors:\n\t- a\n",
        "behaviors:\r- {behavior: A}\r", "a: 1\n---\nbehaviors:\n- {behavior: A, task: B}\n"}) {
    EXPECT_EQ(kind(text), "faulty catalog") << text;
  }
  for (const std::size_t width : {std::size_t{2}, std::size_t{4}}) {
    EXPECT_EQ(kind(widen("behaviors:\n", width, true)), "faulty catalog") << width;
    EXPECT_EQ(kind(widen("behaviors:\n", width, false)), "faulty catalog") << width;
  }
  EXPECT_EQ(kind("\xFF\xFE" + widen("  behaviors:\n", 2, false)), "faulty catalog");
}

TEST(Recognition, FindsScriptsAndPropertiesThatAreNoYaml) {
  EXPECT_EQ(kind("events:\n\t- start: A\n"), "faulty script");
  EXPECT_EQ(kind("catalog: a.yaml\nevents:\n- {expect: {running: [A}}\n"), "faulty script");
  EXPECT_EQ(kind("- start: A\n\t- expect: {outcome: accepted}\n"), "faulty script");
  EXPECT_EQ(kind("properties:\n\t- can_start: A\n"), "faulty properties");
  EXPECT_EQ(kind("assume:\n\tfaults: 1\nproperties:\n"), "faulty properties");
}

TEST(Recognition, LeavesOtherFilesAlone) {
  for (const char* const text :
       {"# behaviors:\na: [\n", "a: the behaviors: [\n", "my_behaviors: [\n", "behaviors [\n",
        "{{ if x }}\nname: y\n", "%YAML:1.0\n---\nrows: 3\n",
        "a: !Ref b\nproperties:\n  start: 1\n",
        "kind: A\n---\nspec: {properties: {events: {}, start: {}}}\n",
        "spec: {tasks: [{name: build}]}\n---\nkind: Task\n"}) {
    EXPECT_EQ(kind(text), "other") << text;
  }
  EXPECT_EQ(kind("tasks:\n- name: a\n  key: !vault x\n"), "faulty catalog?");
}

TEST(Recognition, FindsSectionsInOtherPlaces) {
  EXPECT_EQ(kind("robot: {behaviors: [{behavior: A, task: B}]}"), "faulty catalog");
  EXPECT_EQ(kind("- {behavior: A, task: B, situation: {X: y}}"), "faulty catalog");
  EXPECT_EQ(kind("tasks: [{task: A}]"), "catalog");
  EXPECT_EQ(kind("robot: {behaviors: [spin, wait], tasks: [{name: a}]}"), "other");
  EXPECT_EQ(kind("tasks: [{name: a}]"), "other");
  EXPECT_EQ(kind("steps: [{task: A}]"), "other");
}

TEST(Recognition, ForgivesMisspeltVerbs) {
  EXPECT_EQ(kind("events: [{strat: A}]"), "script");
  EXPECT_EQ(kind("events: [{http: {path: x}}]"), "script?");
}

TEST(ForeignFile, IsKnownByItsText) {
  EXPECT_EQ(find_foreign_file("<?xml version='1.0'?>\n<root BTCPP_format='4'/>"),
            "a behavior tree of BehaviorTree.CPP");
  EXPECT_EQ(find_foreign_file("\xEF\xBB\xBF \n<launch/>"), "a ROS launch file in XML");
  EXPECT_EQ(find_foreign_file("def generate_launch_description():\n"),
            "a ROS launch file in Python");
  EXPECT_EQ(find_foreign_file("import rospy\nimport smach\n"),
            "a state machine of SMACH, in Python");
  EXPECT_EQ(find_foreign_file("; a comment\n(define (domain d))"), "a PDDL domain");
  EXPECT_EQ(find_foreign_file("(define (problem p) (:domain d))"), "a PDDL problem");
  for (const char* const text : {"", ";", "(", "behaviors:\n\t- x", "# <launch>"}) {
    EXPECT_EQ(find_foreign_file(text), "") << text;
  }
}

}  // namespace
}  // namespace cbc::cli::recognition_test
