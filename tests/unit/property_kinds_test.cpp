// What goes on and what stays possible, and promises for a part of each run: their keys.
#include <string>

#include <gtest/gtest.h>

#include "core/property/property_reader.h"
#include "core/words/words.h"
#include "core/yaml/document.h"
#include "findings.h"
#include "support/catalog_files.h"

namespace cbc::property_kinds_test {
namespace {

const CompiledCatalog& catalog() {
  static const CompiledCatalog catalog = test::compile_text(R"(
situation: [{variable: ALARM}]
behaviors:
- {behavior: CARRY1, task: CARRY}
- {behavior: DOCK1, task: DOCK}
tasks:
- {task: CARRY}
- {task: DOCK}
)");
  return catalog;
}

std::string findings(const std::string& property) {
  Diagnostics diagnostics;
  const auto document = yaml::parse("assume: {stop: [DOCK]}\nproperties:\n- {" + property + "}",
                                    "p.yaml", diagnostics);
  if (document != nullptr) static_cast<void>(read_properties(*document, catalog(), diagnostics));
  std::string text;
  for (const Diagnostic& one : diagnostics.all()) text += one.message + "\n";
  return text;
}

std::string words(const std::string& property) {
  Diagnostics diagnostics;
  const auto document = yaml::parse("properties:\n- {" + property + "}", "p.yaml", diagnostics);
  const auto file = read_properties(*document, catalog(), diagnostics);
  return file && file->properties.size() == 1
             ? describe_property(catalog(), file->properties.front())
             : "";
}

TEST(PropertyKinds, AreSaidInWords) {
  EXPECT_EQ(words("keeps_running: CARRY, when: {running: [DOCK]}, by: [start, situation]"),
            "CARRY keeps running once it is requested, whatever moves there are of start and "
            "situation, when DOCK runs");
  EXPECT_EQ(
      words("always_possible: {running: [DOCK]}, by: [start: [DOCK], queue], within: 1"),
      "it is always possible that DOCK runs, within 1 more move, by moves of start (DOCK) and "
      "queue");
  EXPECT_EQ(
      words("always_possible: {running: [DOCK]}, by: [{start: [DOCK], stop: [CARRY, DOCK]}], "
            "settled: true"),
      "it is always possible that DOCK runs, by moves of start (DOCK) and stop (CARRY, DOCK), "
      "with nothing in the queue");
  EXPECT_EQ(words("never: {running: [CARRY]}, after: {situation: {ALARM: true}}, until: {stopped: "
                  "[DOCK]}"),
            "never CARRY runs, after ALARM is true, until DOCK does not run");
}

TEST(PropertyKinds, HaveKeysOfTheirOwn) {
  EXPECT_EQ(findings("keeps_running: CARRY, settled: true"),
            "'settled' does not belong to 'keeps_running', only to 'always', 'never', 'reachable' "
            "and 'always_possible'\n");
  EXPECT_EQ(findings("can_start: CARRY, by: [start]"),
            "'by' does not belong to 'can_start', only to 'keeps_running' and 'always_possible'\n");
  EXPECT_EQ(findings("keeps_running: CARRY, within: 1"),
            "'within' does not belong to 'keeps_running', only to 'always_possible'\n");
  EXPECT_EQ(findings("reachable: {running: [DOCK]}, after: {running: [CARRY]}"),
            "'after' does not belong to 'reachable', only to 'always' and 'never'\n");
  EXPECT_EQ(findings("never: {running: [DOCK]}, until: {running: [CARRY]}"),
            "'until' needs 'after', which says where the promise begins\n");
  EXPECT_EQ(findings("always_possible: {running: [DOCK]}, within: -1"),
            "'within' must be an integer from 0 to 2147483647, found '-1'\n");
}

TEST(PropertyKinds, NameKindsOfMoves) {
  const std::string expected =
      "'by' must be a list of kinds of moves: 'start', 'stop', 'successes', 'failures', 'fault', "
      "'repair', 'situation' and 'queue', found ";
  EXPECT_EQ(findings("keeps_running: CARRY, by: []"), expected + "an empty list\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [starts]"), expected + "'starts'\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [start, start]"), "'start' is listed twice\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [queue: [CARRY]]"),
            "only 'start' and 'stop' of 'by' take tasks, not 'queue'\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [start: []]"),
            "'start' must be a list of tasks, found an empty list\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [start: [DOC]]"),
            "there is no task 'DOC'; did you mean 'DOCK'?\n");
  EXPECT_EQ(findings("keeps_running: CARRY, by: [stop: [DOCK, CARRY]]"),
            "no such move is made, as 'stop' of 'assume' does not list task 'CARRY'\n");
}

}  // namespace
}  // namespace cbc::property_kinds_test
