// Conditions of property files that stand in one another, and lists in them: what is read, in
// words, and what can never hold.
#include <string>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/property/property_reader.h"
#include "core/words/words.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::nested_conditions_test {
namespace {

const CompiledCatalog& catalog() {
  static const CompiledCatalog catalog = test::compile_text(R"(
tasks:
- {task: DRIVE}
- {task: DOCK}
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
behaviors:
- {behavior: FAST, task: DRIVE, requires: [{task: LOCALIZE}], situation: {PEOPLE: far}}
- {behavior: CREEP, task: DRIVE, requires: [{task: LOCALIZE}]}
- {behavior: BLIND, task: DRIVE}
- {behavior: DOCK_BY, task: DOCK}
- {behavior: GPS, task: LOCALIZE}
- {behavior: SLAM, task: LOCALIZE}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, DOCK]
situation:
- {variable: PEOPLE, values: [far, near, touching]}
- variable: SIGNAL
)");
  return catalog;
}

struct Result {
  std::string words;  ///< of the first property
  std::string findings;
};

Result read(const std::string& property, const std::string& assume,
            const CompiledCatalog& catalog = nested_conditions_test::catalog()) {
  Diagnostics diagnostics;
  const auto document =
      yaml::parse(concat("assume: ", assume, "\nproperties:\n- ", property), "p.yaml", diagnostics);
  Result result;
  if (document != nullptr) {
    const auto file = read_properties(*document, catalog, diagnostics);
    if (file) result.words = describe_property(catalog, file->properties.at(0));
  }
  result.findings = show(diagnostics);
  return result;
}

std::string findings(const std::string& property,
                     const std::string& assume = "{start: all, faults: 2}") {
  return read(property, assume).findings;
}

std::string words(const std::string& property) {
  const Result result = read(property, "{start: all, faults: 2}");
  EXPECT_EQ(result.findings, "") << property;
  return result.words;
}

/// As deep as the number says.
std::string nested(std::size_t depth) {
  std::string text = "{running: [DOCK]}";
  for (std::size_t i = 0; i < depth; ++i) text = "{not: " + text + "}";
  return "never: " + text;
}

TEST(NestedConditions, AreToldInWords) {
  EXPECT_EQ(words("never: {not: {running: [DOCK]}}"), "never not (DOCK runs)");
  EXPECT_EQ(words("always: {any: [{running: [DOCK]}, {stopped: [DRIVE], faulty: [GPS]}]}"),
            "always DOCK runs or (DRIVE does not run and behavior GPS is faulty)");
  EXPECT_EQ(words("always: {stopped: [DOCK], any: [{faulty: [GPS]}, {faulty: [SLAM]}]}"),
            "always DOCK does not run and (behavior GPS is faulty or behavior SLAM is faulty)");
  EXPECT_EQ(words("always: {all: [{running: [DOCK]}, {any: [{faulty: [GPS]}]}], "
                  "not: {faulty: [SLAM], any: [{running: [DOCK]}, {running: [DRIVE]}]}}"),
            "always not (behavior SLAM is faulty and (DOCK runs or DRIVE runs)) and DOCK runs and "
            "behavior GPS is faulty");
}

TEST(NestedConditions, HaveListsOfValuesAndBehaviors) {
  EXPECT_EQ(words("always: {running: {DRIVE: [FAST, CREEP]}}"),
            "always DRIVE runs with FAST or CREEP");
  EXPECT_EQ(words("always: {situation: {PEOPLE: [near, touching], SIGNAL: yes}}"),
            "always (PEOPLE is near or touching) and SIGNAL is true");
  EXPECT_EQ(words("always: {running: {DRIVE: [FAST]}, situation: {PEOPLE: [far], GPS: true}}"),
            "always DRIVE runs with FAST and PEOPLE is far and the situation allows GPS");
  EXPECT_EQ(words("always: {any: [{running: {DRIVE: [FAST, CREEP]}}, {running: [DOCK]}]}"),
            "always (DRIVE runs with FAST or CREEP) or DOCK runs");
  EXPECT_EQ(words("never: {running: [DRIVE], faulty: none}"),
            "never DRIVE runs and no behavior is faulty");
}

TEST(NestedConditions, QualifyStarts) {
  EXPECT_EQ(words("{can_start: DOCK, priority: 2, when: {not: {running: [DRIVE]}}}"),
            "DOCK can always start with priority 2, when not (DRIVE runs)");
  EXPECT_EQ(findings("{never: {running: [DOCK]}, when: {faulty: none}}"),
            "3:30-34 error unknown-key: 'when' does not belong to 'never', only to 'can_start', "
            "'always', 'keeps_running' and 'always_possible'\n");
}

TEST(NestedConditions, AreNotTooDeep) {
  EXPECT_EQ(findings(nested(16)), "");
  EXPECT_EQ(findings(nested(17)),
            "3:112-113 error invalid-value: conditions may stand in one another 16 deep, and this "
            "one is deeper\n");
}

TEST(NestedConditions, SaySomething) {
  EXPECT_EQ(findings("never: {any: []}"),
            "3:16-17 error invalid-value: 'any' must be a list of conditions, found an empty "
            "list\n");
  EXPECT_EQ(findings("never: {all: []}"),
            "3:16-17 error invalid-value: 'all' must be a list of conditions, found an empty "
            "list\n");
  EXPECT_EQ(findings("never: {not: [{running: [DOCK]}]}"),
            "3:16-17 error wrong-type: 'not' must be a mapping, found a list\n");
  EXPECT_EQ(findings("never: {any: {running: [DOCK]}}"),
            "3:16-17 error wrong-type: 'any' must be a list of conditions, found a mapping\n");
  EXPECT_EQ(findings("never: {any: [{running: [DOCK]}, DOCK]}"),
            "3:36-40 error wrong-type: 'any' must be a mapping, found 'DOCK'\n");
  EXPECT_EQ(
      findings("never: {not: {}}"),
      "3:16-17 error missing-key: 'not' needs a condition: one of 'running', 'stopped', "
      "'active', 'active_includes', 'faulty', 'available', 'requested', 'suspended', 'failed', "
      "'situation', 'not', 'any' and 'all'\n");
  EXPECT_EQ(findings("never: {faulty: []}"),
            "3:19-20 error invalid-value: 'faulty' must be a list of behaviors or 'none', found an "
            "empty list\n");
  EXPECT_EQ(findings("never: {faulty: nothing}"),
            "3:19-26 error wrong-type: 'faulty' must be a list of behaviors or 'none', found "
            "'nothing'\n");
}

TEST(NestedConditions, ListThingsOnce) {
  EXPECT_EQ(findings("never: {not: {running: {DRIVE: [FAST, CREEP, FAST]}}}"),
            "3:48-52 error invalid-value: 'FAST' is listed twice\n"
            "  3:35-39 first listed here\n");
  EXPECT_EQ(findings("never: {running: {DRIVE: []}}"),
            "3:28-29 error wrong-type: 'DRIVE' must be a behavior, a list of behaviors or 'any', "
            "found an empty list\n");
  EXPECT_EQ(findings("never: {running: {DRIVE: [FAST, CREP]}}"),
            "3:35-39 error undefined-behavior: there is no behavior 'CREP'; did you mean "
            "'CREEP'?\n");
  EXPECT_EQ(findings("never: {running: {DRIVE: [FAST, any]}}"),
            "3:35-38 error invalid-value: 'any' stands in place of a list, not in it\n");
  EXPECT_EQ(findings("never: {situation: {PEOPLE: [near, far, near]}}"),
            "3:43-47 error invalid-value: 'near' is listed twice\n"
            "  3:32-36 first listed here\n");
  EXPECT_EQ(findings("never: {situation: {PEOPLE: []}}"),
            "3:31-32 error wrong-type: 'PEOPLE' must be a value of the situation variable or a "
            "list of some, found an empty list\n");
  EXPECT_EQ(findings("never: {situation: {PEOPLE: [nera]}}"),
            "3:32-36 error situation-value: situation variable 'PEOPLE' has no value 'nera'; did "
            "you mean 'near'?\n");
  // A script gives one value.
  EXPECT_EQ(findings("never: {running: [DOCK]}", "{never: [{PEOPLE: [near]}]}"),
            "1:27-28 error wrong-type: 'PEOPLE' must be a value of the situation variable, found "
            "a list\n");
}

TEST(NestedConditions, OfOneAllMustNotContradictOneAnother) {
  EXPECT_EQ(findings("never: {running: [DRIVE], all: [{stopped: [DOCK]}, {stopped: [DRIVE]}]}"),
            "3:65-70 error impossible-expectation: this can never hold: DRIVE runs and "
            "DRIVE does not run\n"
            "  3:21-26 expected here\n");
  EXPECT_EQ(
      findings("never: {all: [{running: {DRIVE: [FAST, CREEP]}}, {running: {DRIVE: BLIND}}]}"),
      "3:63-68 error impossible-expectation: this can never hold: DRIVE runs with "
      "FAST or CREEP and DRIVE runs with BLIND\n"
      "  3:28-33 expected here\n");
  EXPECT_EQ(findings("never: {all: [{running: {DRIVE: [FAST, CREEP]}}, "
                     "{running: {DRIVE: [CREEP, BLIND]}}, {active_includes: [CREEP]}]}"),
            "");
  EXPECT_EQ(findings("never: {situation: {PEOPLE: [near, far]}, "
                     "all: [{situation: {PEOPLE: touching}}]}"),
            "3:64-70 error impossible-expectation: this can never hold: PEOPLE is near or "
            "far and PEOPLE is touching\n"
            "  3:23-29 expected here\n");
  EXPECT_EQ(findings("never: {faulty: [GPS], all: [{faulty: none}]}"),
            "3:33-39 error impossible-expectation: this can never hold: behavior GPS is "
            "faulty and no behavior is faulty\n"
            "  3:20-23 expected here\n");
  EXPECT_EQ(findings("never: {situation: {GPS: true}, all: [{situation: {GPS: false}}]}"),
            "3:54-57 error impossible-expectation: this can never hold: the situation "
            "allows GPS and the situation forbids GPS\n"
            "  3:23-26 expected here\n");
  EXPECT_EQ(findings("never: {active: [GPS, CREEP], all: [{active_includes: [SLAM]}]}"),
            "3:58-62 error impossible-expectation: this can never hold: behavior GPS is "
            "active and behavior SLAM is active\n"
            "  3:20-23 expected here\n");
}

TEST(NestedConditions, OfOneAnyMayHoldInPart) {
  EXPECT_EQ(findings("never: {running: [DRIVE], any: [{stopped: [DRIVE]}, {faulty: [GPS]}]}"),
            "3:46-51 warning impossible-expectation: this can never hold: DRIVE runs and "
            "DRIVE does not run\n"
            "  3:21-26 expected here\n");
  EXPECT_EQ(findings("never: {running: [DRIVE], any: [{stopped: [DRIVE]}]}"),
            "3:46-51 error impossible-expectation: this can never hold: DRIVE runs and "
            "DRIVE does not run\n"
            "  3:21-26 expected here\n");
  EXPECT_EQ(findings("never: {running: [DRIVE], "
                     "any: [{any: [{stopped: [DRIVE]}]}, {faulty: [GPS], all: [{faulty: none}]}]}"),
            "3:53-58 error impossible-expectation: this can never hold: DRIVE runs and "
            "DRIVE does not run\n"
            "  3:21-26 expected here\n"
            "3:87-93 error impossible-expectation: this can never hold: behavior GPS is "
            "faulty and no behavior is faulty\n"
            "  3:74-77 expected here\n");
  // What the catalog rules out is said of the alternative alone.
  EXPECT_EQ(findings("reachable: {running: [DRIVE], any: [{running: [DOCK]}, {faulty: [GPS]}]}"),
            "3:50-54 warning impossible-expectation: this can never hold: DRIVE runs and "
            "DOCK runs, as 'DRIVE' excludes 'DOCK' (a.yaml:14)\n"
            "  3:25-30 expected here\n");
}

TEST(NestedConditions, MayBeImpossibleUnderNot) {
  EXPECT_EQ(findings("always: {not: {running: [DRIVE, DOCK], stopped: [DRIVE]}}"), "");
  EXPECT_EQ(findings("always: {not: {all: [{faulty: [GPS, SLAM, FAST]}, {faulty: none}]}}"), "");
  EXPECT_EQ(findings("always: {not: {running: {DRIVE: GPS}}}"), "");
  EXPECT_EQ(findings("always: {not: {running: {DRIVE: GSP}}}"),
            "3:35-38 error undefined-behavior: there is no behavior 'GSP'; did you mean 'GPS'?\n");
}

TEST(NestedConditions, HaveListsOfWhichOneIsPossible) {
  const std::string misplaced =
      " impossible-expectation: this can never hold: behavior 'GPS' does not perform task 'DRIVE', "
      "it performs 'LOCALIZE'\n";
  EXPECT_EQ(findings("reachable: {running: {DRIVE: [GPS, CREEP]}}"), "3:33-36 warning" + misplaced);
  EXPECT_EQ(findings("reachable: {running: {DRIVE: [GPS]}}"), "3:33-36 error" + misplaced);
  EXPECT_EQ(findings("reachable: {running: {DRIVE: [FAST, CREEP]}, situation: {PEOPLE: near}}"),
            "");
  EXPECT_EQ(
      findings("reachable: {running: {DRIVE: [FAST]}, situation: {PEOPLE: [near, touching]}}"),
      "3:53-59 warning impossible-expectation: this can never hold: DRIVE runs with "
      "FAST and PEOPLE is near or touching, as behavior 'FAST' fits only where "
      "'PEOPLE' is 'far'\n"
      "  3:25-30 expected here\n");
  EXPECT_EQ(findings("reachable: {running: {DRIVE: [FAST, CREEP]}, stopped: [LOCALIZE]}"),
            "3:58-66 warning impossible-expectation: this can never hold: DRIVE runs with "
            "FAST or CREEP and LOCALIZE does not run, as behavior 'CREEP' requires task "
            "'LOCALIZE' (a.yaml:8) and behavior 'FAST' requires task 'LOCALIZE' "
            "(a.yaml:7)\n"
            "  3:25-30 expected here\n");
  EXPECT_EQ(findings("reachable: {running: {DRIVE: [FAST, BLIND]}, stopped: [LOCALIZE]}"), "");
  EXPECT_EQ(findings("reachable: {all: [{running: {DRIVE: [FAST, CREEP]}}, {active: [BLIND]}]}"),
            "3:57-63 error impossible-expectation: this can never hold: DRIVE runs with "
            "FAST or CREEP and only behavior BLIND is active\n"
            "  3:32-37 expected here\n"
            "3:66-71 error impossible-expectation: this can never hold: DRIVE runs with "
            "FAST or CREEP and behavior BLIND is active\n"
            "  3:32-37 expected here\n");
}

TEST(NestedConditions, MayDependOnWhatNothingPerforms) {
  const CompiledCatalog catalog = test::compile_text(R"(
tasks: [{task: LIT}]
behaviors: [{behavior: LOOK, task: SEE, requires: [{task: LIT}]}]
)");
  EXPECT_EQ(read("reachable: {active_includes: [LOOK]}", "{}", catalog).findings,
            "3:33-37 warning impossible-expectation: this can never hold: behavior LOOK is "
            "active, as behavior 'LOOK' requires task 'LIT' (a.yaml:3), but no behavior "
            "performs it\n");
}

TEST(NestedConditions, MayBeRuledOutByTheAssumptions) {
  EXPECT_EQ(findings("reachable: {situation: {PEOPLE: [near, touching]}}", "{situation: []}"),
            "3:27-33 warning impossible-expectation: this can never hold: PEOPLE is near "
            "or touching, which 'assume' rules out\n");
  EXPECT_EQ(findings("reachable: {situation: {PEOPLE: [near, far]}}", "{situation: []}"), "");
  EXPECT_EQ(findings("reachable: {faulty: [GPS], all: [{faulty: [SLAM]}]}", "{faults: 1}"),
            "3:46-50 warning impossible-expectation: this can never hold: behavior GPS is "
            "faulty and behavior SLAM is faulty, which 'assume' rules out\n"
            "  3:24-27 expected here\n");
  EXPECT_EQ(findings("reachable: {faulty: [GPS], all: [{faulty: [GPS]}]}", "{faults: 1}"), "");
}

/// Not all of very many alternatives are looked at, so it is not known that none can hold.
TEST(NestedConditions, AreJudgedInBoundedTime) {
  const auto with_alternatives = [](int count) {
    std::string text = "always: {all: [{faulty: [GPS]}";
    for (int i = 0; i < count; ++i) text += ", {faulty: [GPS]}";
    text += "], any: [{faulty: none}";
    for (int i = 0; i < count; ++i) text += ", {faulty: none}";
    return findings(text + "]}");
  };
  EXPECT_NE(with_alternatives(100).find(" error "), std::string::npos);
  EXPECT_EQ(with_alternatives(20'000).find(" error "), std::string::npos);
}

}  // namespace
}  // namespace cbc::nested_conditions_test
