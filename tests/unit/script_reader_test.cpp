#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::script_reader_test {
namespace {

const CompiledCatalog& catalog() {
  static const CompiledCatalog catalog = test::compile_text(R"(
tasks:
- task: TAKE_OFF
- {task: LAND, parameters: [{parameter: a}, {parameter: b}]}
- task: HOVER
  parameters:
  - {parameter: path, allowed_values: point_list}
  - {parameter: x}
  - {parameter: angle, allowed_values: [-360, 360]}
  - {parameter: direction, allowed_values: [LEFT, RIGHT, FORWARD]}
- task: BOTH
behaviors:
- {behavior: TAKE_OFF_BASIC, task: TAKE_OFF}
- {behavior: HOVER_PID, task: HOVER}
- {behavior: HOVER_MPC, task: HOVER}
- {behavior: BOTH, tasks: [{task: TAKE_OFF}, {task: LAND}, {task: HOVER}, {task: BOTH}]}
- {behavior: any, task: LAND}
)");
  return catalog;
}

struct Result {
  std::optional<Script> script;
  std::string findings;
};

Result read_any(std::string_view text, Severity of_parameters = Severity::warning) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  Result result;
  if (document != nullptr)
    result.script = read_script(*document, catalog(), of_parameters, diagnostics);
  EXPECT_EQ(result.script.has_value(), !diagnostics.has_errors()) << text;
  result.findings = show(diagnostics);
  return result;
}

std::string findings(std::string_view text) { return read_any(text).findings; }

Script read(std::string_view text) {
  Result result = read_any(text);
  EXPECT_EQ(result.findings, "") << text;
  return result.script.value_or(Script{});
}

// What is read ---------------------------------------------------------------------------------

TEST(ScriptReader, AScriptMayBeABareListOrJson) {
  EXPECT_EQ(read("- start: LAND\n- stop: LAND\n").steps.size(), 2U);
  const Script script = read(R"({"events": [{"start": "LAND", "priority": 3, "wait": 1e1}]})");
  ASSERT_EQ(script.steps.size(), 1U);
  EXPECT_EQ(script.steps[0].priority, 3);
  EXPECT_EQ(script.steps[0].time, 10 * second);
  EXPECT_EQ(read("[]").reactive_delay, 80'000);
  EXPECT_TRUE(read("[]").timeouts);
  EXPECT_TRUE(read("events: []").steps.empty());
}

TEST(ScriptReader, WhatIsWrittenIsReadAgain) {
  const std::string events = R"(- {at: 0, start: "HOVER", priority: 3, parameters: {"x":"5"}}
- {at: 0, fault: "HOVER_PID"}
- {at: 1.5, finish: {task: "HOVER"}, cause: process_failure}
- {at: 2, finish: "HOVER_MPC", cause: goal_achieved}
- {at: 2, situation: {"HOVER_PID": false}}
- {at: 2, repair: "HOVER_PID"}
- {at: 3, expect: {running: {"HOVER": "HOVER_PID"}}}
- {at: 4, stop: "HOVER"}
)";
  EXPECT_EQ(write_script(catalog(), read(events), ""), "events:\n" + events);
}

TEST(ScriptReader, NullIsAbsent) {
  const Script script = read(
      "catalog: ~\nreactive_delay:\nsituation: ~\nevents:\n"
      "- {start: LAND, priority: ~, parameters: null, at: ~, wait: ~, stop: ~, cause: ~}\n"
      "- {expect: {outcome: ~, running: ~, stopped: ~, active: ~}}\n");
  ASSERT_EQ(script.steps.size(), 2U);
  EXPECT_FALSE(script.steps[0].time || script.steps[0].priority || script.steps[0].parameters);
  EXPECT_FALSE(script.steps[1].expect->outcome || script.steps[1].expect->active);
  EXPECT_TRUE(read("situation: {HOVER_PID: ~}\nevents: []").situation.availability.empty());
  EXPECT_EQ(read("- {start: LAND, parameters: {}}").steps.at(0).parameters.value().canonical, "");
}

TEST(ScriptReader, TheCatalogOfAScript) {
  const auto catalog = [](std::string_view text) -> std::optional<std::string> {
    Diagnostics diagnostics;
    const auto document = yaml::parse(text, "s.yaml", diagnostics);
    if (document == nullptr) return std::nullopt;
    const yaml::Node* const named = catalog_of_script(*document);
    return named == nullptr ? std::nullopt : std::optional(named->text);
  };
  EXPECT_EQ(catalog("catalog: ../a.yaml\nevents: []"), "../a.yaml");
  EXPECT_EQ(catalog("events: []"), std::nullopt);
  EXPECT_EQ(catalog("catalog: ~\nevents: []"), std::nullopt);
  EXPECT_EQ(catalog("catalog: [a]\nevents: []"), std::nullopt);
  EXPECT_EQ(catalog("- start: LAND"), std::nullopt);
  EXPECT_EQ(catalog(""), std::nullopt);
}

// Errors of form -------------------------------------------------------------------------------

TEST(ScriptReader, WrongScripts) {
  EXPECT_EQ(findings(""), "1:1-1 error missing-key: missing key 'events': the script is empty\n");
  EXPECT_EQ(findings("hello"),
            "1:1-6 error wrong-type: a script must be a list of events, or a mapping with the key "
            "'events', found 'hello'\n");
  EXPECT_EQ(findings("catalog: a.yaml"),
            "1:1-2 error missing-key: missing key 'events' in a script\n");
  EXPECT_EQ(
      findings("event: []"),
      "1:1-6 error missing-key: missing key 'events' in a script: 'event' is unknown; did you "
      "mean 'events'?\n");
  EXPECT_EQ(findings("events: {start: LAND}"),
            "1:9-10 error wrong-type: 'events' must be a list of events, found a mapping\n");
  EXPECT_EQ(findings("events: []\nevents: []\n"),
            "2:1-7 error duplicate-key: 'events' is given twice\n  1:1-7 first given here\n");
  EXPECT_EQ(
      findings("catalog: []\nreactive_delay: 0\nsituation: HOVER\ndelay: 1\nevents: []\n"),
      "1:10-11 error wrong-type: 'catalog' must be the path of a catalog, found an empty "
      "list\n"
      "2:17-18 error invalid-value: 'reactive_delay' must be a number of seconds above 0, up to "
      "1000000000, found '0'\n"
      "3:12-17 error wrong-type: 'situation' must be a mapping of behaviors to true or false, "
      "or of situation variables to values, found 'HOVER'\n"
      "4:1-6 error unknown-key: unknown key 'delay' in a script\n");
  EXPECT_EQ(findings("timeouts: 5\nevents: []\n"),
            "1:11-12 error wrong-type: 'timeouts' must be true or false, found '5'\n");
  EXPECT_EQ(findings("delay: 1\nevents: []\n"),
            "1:1-6 error unknown-key: unknown key 'delay' in a script; did you mean "
            "'reactive_delay'?\n");
}

TEST(ScriptReader, OneVerbForEachEvent) {
  EXPECT_EQ(
      findings("- {stop: LAND, start: LAND}\n- {}\n- {priority: 3}\n- start:\n- 7\n- ~\n"),
      "1:16-21 error invalid-value: an event must have exactly one verb, found 'stop' and 'start'; "
      "each needs an entry of its own\n"
      "  1:4-8 the first one is here\n"
      "2:3-4 error missing-key: an event needs one of 'start', 'stop', 'finish', 'situation', "
      "'fault', 'repair', 'expect', 'at' and 'wait'\n"
      "3:3-4 error missing-key: an event needs one of 'start', 'stop', 'finish', 'situation', "
      "'fault', 'repair', 'expect', 'at' and 'wait'\n"
      "4:3-8 error missing-key: 'start' has no value\n"
      "5:3-4 error wrong-type: an event must be a mapping ('start: TASK'), found '7'\n"
      "6:3-4 error wrong-type: an event must be a mapping ('start: TASK'), found nothing\n");
}

TEST(ScriptReader, AForgottenColonOrSpaceIsNamed) {
  const std::string_view start =
      "error wrong-type: an event must be a mapping ('start: TASK'), found ";
  EXPECT_EQ(findings("- stop LAND\n- stop:LAND\n- wait 5\n- go LAND\n- stop\n"),
            concat("1:3-12 ", start, "'stop LAND'; write 'stop: LAND'\n",  //
                   "2:3-12 ", start, "'stop:LAND'; write 'stop: LAND'\n",  //
                   "3:3-9 ", start, "'wait 5'; write 'wait: 5'\n",         //
                   "4:3-10 ", start, "'go LAND'\n",                        //
                   "5:3-7 ", start, "'stop'\n"));
}

TEST(ScriptReader, KeysOfOtherVerbs) {
  EXPECT_EQ(
      findings("- {finish: HOVER_PID, priority: 2}\n- {start: LAND, cause: time_out}\n"
               "- {stop: LAND, parameters: {}}\n- {wait: 3, priority: 1}\n"
               "- {expect: {}, cause: time_out}\n"),
      "1:23-31 error unknown-key: 'priority' does not belong to 'finish', only to 'start' and "
      "'stop'\n"
      "2:17-22 error unknown-key: 'cause' does not belong to 'start', only to 'finish'\n"
      "3:16-26 error unknown-key: 'parameters' does not belong to 'stop', only to 'start'\n"
      "4:13-21 error unknown-key: 'priority' does not belong to 'wait', only to 'start' and "
      "'stop'\n"
      "5:16-21 error unknown-key: 'cause' does not belong to 'expect', only to 'finish'\n");
}

// Names and values -----------------------------------------------------------------------------

TEST(ScriptReader, NamesInExpectations) {
  EXPECT_EQ(
      findings("- expect:\n    outcome: acepted\n    running: {LAMD: any, LAND: HOVER, HOVER: ~}\n"
               "    stopped: LAND\n    active: [HOVER_PIT, ~]\n"),
      "2:14-21 error invalid-value: 'outcome' must be accepted, rejected or unchanged, found "
      "'acepted'; did you mean 'accepted'?\n"
      "3:15-19 error undefined-task: there is no task 'LAMD'\n"
      "3:32-37 error undefined-behavior: there is no behavior 'HOVER': it is a task; did you "
      "mean 'HOVER_PID'?\n"
      "3:46-47 error wrong-type: 'HOVER' must be a behavior, a list of behaviors or 'any', found "
      "nothing\n"
      "4:14-18 error wrong-type: 'stopped' must be a list of tasks, found 'LAND'\n"
      "5:14-23 error undefined-behavior: there is no behavior 'HOVER_PIT'; did you mean "
      "'HOVER_PID'?\n"
      "5:25-26 error wrong-type: 'active' must be the name of a behavior, found nothing\n");
}

TEST(ScriptReader, Priorities) {
  const std::string must = "error invalid-value: 'priority' must be an integer from ";
  EXPECT_EQ(findings("- {start: LAND, priority: 0}\n- {stop: LAND, priority: -1}\n"
                     "- {start: LAND, priority: 2147483648}\n"),
            "1:27-28 " + must + "1 to 2147483647, found '0'\n" + "2:26-28 " + must +
                "0 to 2147483647, found '-1'\n" + "3:27-37 " + must +
                "1 to 2147483647, found '2147483648'\n");
  EXPECT_EQ(findings("- {start: LAND, priority: 1.5}\n- {start: LAND, priority: '1'}\n"),
            "1:27-30 error wrong-type: 'priority' must be an integer from 1 to 2147483647, found "
            "'1.5'\n"
            "2:27-30 error wrong-type: 'priority' must be an integer from 1 to 2147483647, found "
            "'1' in quotes\n");
  EXPECT_EQ(findings("- {start: LAND, priority: 2147483647}"), "");
}

constexpr const char* with_variables = R"(behaviors:
- {behavior: CAMERA, task: LOOK, situation: {LIGHT: [day, dusk]}}
- {behavior: LIDAR, task: LOOK, situation: {LIGHT: night, DRY: true}}
situation:
- {variable: LIGHT, values: [day, dusk, night]}
- {variable: DRY}
)";

TEST(ScriptReader, WrongSituationVariables) {
  Diagnostics diagnostics;
  const CompiledCatalog catalog = test::compile_text(with_variables);
  const auto document = yaml::parse(R"(- situation: {LIGTH: day}
- situation: {LIGHT: nigth}
- situation: {DRY: wet}
- situation: {LIGHT: [day]}
- finish: {task: CAMERA}
- finish: {behavior: CAMERA}
)",
                                    "script.yaml", diagnostics);
  ASSERT_NE(document, nullptr);
  EXPECT_FALSE(read_script(*document, catalog, Severity::warning, diagnostics));
  std::string messages;
  for (const Diagnostic& finding : diagnostics.all()) {
    messages += std::to_string(finding.range.begin.line) + " " + std::string(finding.rule) + ": " +
                finding.message + "\n";
  }
  EXPECT_EQ(messages,
            "1 undeclared-situation: there is no behavior or situation variable 'LIGTH'; did you "
            "mean 'LIGHT'?\n"
            "2 situation-value: situation variable 'LIGHT' has no value 'nigth'; did you mean "
            "'night'?\n"
            "3 situation-value: situation variable 'DRY' has no value 'wet'; its values are 'true' "
            "and 'false'\n"
            "4 wrong-type: 'LIGHT' must be a value of the situation variable, found a list\n"
            "5 undefined-task: there is no task 'CAMERA': it is a behavior\n"
            "6 missing-key: missing key 'task' in a finish\n"
            "6 unknown-key: unknown key 'behavior' in a finish\n");
}

// What a start gives -----------------------------------------------------------------------------

TEST(ScriptReader, ParametersOfAnUnknownTaskAreNotChecked) {
  EXPECT_EQ(findings("- {start: HOVR, parameters: {angle: 400, y: 3}}\n"
                     "- {stop: TAKE_OFF, parameters: {y: 3}}\n"),
            "1:11-15 error undefined-task: there is no task 'HOVR'; did you mean 'HOVER'?\n"
            "2:20-30 error unknown-key: 'parameters' does not belong to 'stop', only to 'start'\n");
}

TEST(ScriptReader, FindingsAboutParametersHaveTheSeverityThatIsAskedFor) {
  const std::string text = "- {start: HOVER, parameters: {angle: 400, yaw: 3}}\n";
  const Result mild = read_any(text, Severity::warning);
  EXPECT_TRUE(mild.script.has_value());
  EXPECT_EQ(mild.findings.find("error"), std::string::npos) << mild.findings;
  const Result strict = read_any(text, Severity::error);
  EXPECT_FALSE(strict.script.has_value());
  EXPECT_EQ(strict.findings.find("warning"), std::string::npos) << strict.findings;
  // Of other findings it says nothing.
  EXPECT_TRUE(read_any("- {finish: HOVER_PID, cause: situation_change}\n", Severity::error)
                  .script.has_value());
}

// What the situation says
// --------------------------------------------------------------------------

std::string still_available(const std::string& place, const std::string& behavior) {
  return place + " warning still-available: behavior '" + behavior +
         "' is still available here, so that it can be chosen again at once; add 'situation: {" +
         behavior + ": false}' before it\n";
}

TEST(ScriptReader, AFinishByTheSituationOfWhatStaysAvailable) {
  EXPECT_EQ(findings("- {finish: HOVER_PID, cause: situation_change}\n"),
            still_available("1:12-21", "HOVER_PID"));
  EXPECT_EQ(findings("- situation: {HOVER_MPC: false}\n"
                     "- {cause: situation_change, finish: HOVER_PID}\n"
                     "- situation: {HOVER_PID: false}\n"),
            still_available("2:37-46", "HOVER_PID"));
  // Other causes are no news of the situation.
  EXPECT_EQ(findings("- {finish: HOVER_PID, cause: time_out}\n- finish: HOVER_PID\n"), "");
}

TEST(ScriptReader, TheSituationIsThatOfThePlaceInTheScript) {
  EXPECT_EQ(findings("events:\n"
                     "- {finish: HOVER_PID, cause: situation_change}\n"
                     "- situation: {HOVER_PID: true, HOVER_MPC: true}\n"
                     "- {finish: HOVER_PID, cause: situation_change}\n"
                     "- {finish: HOVER_MPC, cause: situation_change}\n"
                     "- situation: {HOVER_PID: false}\n"
                     "- {finish: HOVER_PID, cause: situation_change}\n"
                     "- situation: {HOVER_MPC: false}\n"
                     "- {finish: HOVER_PID, cause: situation_change}\n"
                     "- situation: {HOVER_PID: yes}\n"
                     "- {finish: HOVER_PID, cause: situation_change}\n"
                     "- {finish: HOVER_MPC, cause: situation_change}\n"
                     "situation: {HOVER_PID: no}\n"),
            still_available("4:12-21", "HOVER_PID") + still_available("5:12-21", "HOVER_MPC") +
                still_available("11:12-21", "HOVER_PID"));
}

/// The finish of a task is that of the behavior that performs it.
TEST(ScriptReader, AFinishByTaskOfWhatStaysAvailable) {
  EXPECT_EQ(findings("- {finish: {task: HOVER}, cause: situation_change}\n"),
            "1:19-24 warning still-available: every behavior that performs task 'HOVER' is still "
            "available here, so that it can be chosen again at once; add an event 'situation' "
            "before it that rules out the one that is active\n");
  EXPECT_EQ(
      findings("- {finish: {task: BOTH}, cause: situation_change}\n"),
      "1:19-23 warning still-available: behavior 'BOTH', which performs task 'BOTH', is still "
      "available here, so that it can be chosen again at once; add 'situation: {BOTH: "
      "false}' before it\n");
  // The one that performs it may be the one that is ruled out.
  EXPECT_EQ(findings("- situation: {HOVER_MPC: false}\n"
                     "- {finish: {task: HOVER}, cause: situation_change}\n"),
            "");
  EXPECT_EQ(findings("- {finish: {task: HOVER}, cause: time_out}\n- finish: {task: HOVER}\n"), "");
}

TEST(ScriptReader, AFinishByTheSituationOfWhatDependsOnVariables) {
  const CompiledCatalog catalog = test::compile_text(R"(situation:
- {variable: LIGHT, values: [day, dusk, night]}
- {variable: GPS}
behaviors:
- {behavior: CAMERA, task: SEE, situation: {LIGHT: [day, night], GPS: true}}
- {behavior: RECEIVER, task: LOCALIZE, situation: {GPS: true}}
)");
  Diagnostics diagnostics;
  const auto document = yaml::parse(R"(- {finish: CAMERA, cause: situation_change}
- {finish: {task: LOCALIZE}, cause: situation_change}
- situation: {GPS: false}
- {finish: CAMERA, cause: situation_change}
- {finish: {task: LOCALIZE}, cause: situation_change}
)",
                                    "script.yaml", diagnostics);
  ASSERT_NE(document, nullptr);
  EXPECT_TRUE(read_script(*document, catalog, Severity::warning, diagnostics));
  EXPECT_EQ(show(diagnostics),
            "1:12-18 warning still-available: behavior 'CAMERA' is still available here, so that "
            "it can be chosen again at once; write 'situation: {LIGHT: dusk}' in its place: the "
            "behavior then finishes by itself\n"
            "2:19-27 warning still-available: behavior 'RECEIVER', which performs task 'LOCALIZE', "
            "is still available here, so that it can be chosen again at once; write 'situation: "
            "{GPS: false}' in its place: the behavior then finishes by itself\n");
}

TEST(ScriptReader, ASituationThatIsNotUnderstoodMayMakeItUnavailable) {
  const std::string finish = "- {finish: HOVER_PID, cause: situation_change}\n";
  for (const std::string before :
       {"- situation: {HOVER_PIT: false}\n", "- situation: {HOVER_PID: nope}\n",
        "- situation: HOVER_PID\n", "- situtaion: {HOVER_PID: false}\n", "- situation:\n"}) {
    const Result result = read_any(before + finish);
    EXPECT_EQ(result.findings.find("still-available"), std::string::npos) << result.findings;
    EXPECT_NE(result.findings.find("error"), std::string::npos) << before;
  }
  EXPECT_EQ(findings("situatoin: {HOVER_PID: false}\nevents:\n" + finish),
            "1:1-10 error unknown-key: unknown key 'situatoin' in a script; did you mean "
            "'situation'?\n");
}

// What can never hold
// ------------------------------------------------------------------------------

/// The range of the finding in an expectation, and why it can never hold; then the notes.
std::string contradictions(const std::string& expectation) {
  return findings("- expect: {" + expectation + "}\n");
}

TEST(ScriptReader, ActiveBehaviorsNeedATask) {
  EXPECT_EQ(contradictions("stopped: [HOVER], active: [HOVER_MPC]"),
            "1:39-48 warning impossible-expectation: this can never hold: HOVER does not "
            "run and behavior HOVER_MPC is active\n"
            "  1:22-27 expected here\n");
  EXPECT_EQ(contradictions("running: {HOVER: HOVER_PID}, active: [HOVER_PID, HOVER_MPC]"),
            "1:61-70 warning impossible-expectation: this can never hold: HOVER runs with "
            "HOVER_PID and behavior HOVER_MPC is active\n"
            "  1:22-27 expected here\n");
  // It performs several tasks, of which one is left.
  EXPECT_EQ(contradictions("stopped: [TAKE_OFF, HOVER, LAND], active: [BOTH]"), "");
  EXPECT_EQ(contradictions("active: [HOVER_PID, BOTH], stopped: [TAKE_OFF, BOTH]"), "");
  // The behavior of one task only takes the last task of the other, which is named first.
  EXPECT_EQ(contradictions("active: [BOTH, HOVER_PID], stopped: [TAKE_OFF, LAND, BOTH]"),
            "1:27-36 warning impossible-expectation: this can never hold: TAKE_OFF does "
            "not run and LAND does not run and BOTH does not run and 2 more\n"
            "  1:49-57 expected here\n"
            "  1:59-63 expected here\n"
            "  1:65-69 expected here\n"
            "  1:21-25 expected here\n");
}

TEST(ScriptReader, OnlyTheActiveBehaviorsPerformTasks) {
  EXPECT_EQ(contradictions("running: {HOVER: HOVER_PID}, active: []"),
            "1:41-47 warning impossible-expectation: this can never hold: HOVER runs with "
            "HOVER_PID and no behavior is active\n"
            "  1:22-27 expected here\n");
  EXPECT_EQ(contradictions("running: {LAND: any}, active: [HOVER_PID]"),
            "1:34-40 warning impossible-expectation: this can never hold: LAND runs and "
            "only behavior HOVER_PID is active\n"
            "  1:22-26 expected here\n");
  EXPECT_EQ(contradictions("running: {LAND: any, HOVER: HOVER_PID}, active: [BOTH, HOVER_PID]"),
            "");
  EXPECT_EQ(contradictions("running: {LAND: any}"), "");
  EXPECT_EQ(contradictions("running: {LAND: any}, active_includes: [BOTH]"), "");
  EXPECT_EQ(contradictions("active: [BOTH], active_includes: [BOTH]"),
            "1:28-43 error invalid-value: 'active' lists all behaviors that are active: leave out "
            "'active_includes', or 'active'\n"
            "  1:12-18 all active behaviors are here\n");
  EXPECT_EQ(contradictions("active: [], stopped: [LAND]"), "");
}

/// What lint says of an expectation, with a catalog of requirements and exclusions.
std::string ruled_out(const std::string& expectation) {
  static const CompiledCatalog chain = test::compile_text(R"(
tasks:
- task: DRIVE
- task: PARK
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- {task: SENSE, start_on_request: false, execution_goal: keep_running}
- task: CHARGE
behaviors:
- {behavior: DRIVE_BY_MAP, task: DRIVE, requires: [{task: LOCALIZE}]}
- {behavior: DRIVE_BLIND, task: DRIVE}
- {behavior: PARK, task: PARK, requires: [{task: LOCALIZE}]}
- {behavior: LIDAR, task: LOCALIZE, requires: [{task: SENSE}]}
- {behavior: CAMERA, task: LOCALIZE, requires: [{task: SENSE}]}
- {behavior: SCANNER, task: SENSE}
- {behavior: CHARGE, task: CHARGE}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, PARK]
- mutually_exclusive: [SENSE, CHARGE]
)");
  Diagnostics diagnostics;
  const auto document = yaml::parse("- expect: {" + expectation + "}\n", "s.yaml", diagnostics);
  EXPECT_TRUE(read_script(*document, chain, Severity::warning, diagnostics).has_value());
  return show(diagnostics);
}

TEST(ScriptReader, ExclusionsRuleOutExpectations) {
  EXPECT_EQ(ruled_out("running: {DRIVE: any, PARK: any}"),
            "1:34-38 warning impossible-expectation: this can never hold: DRIVE runs and "
            "PARK runs, as 'DRIVE' excludes 'PARK' (a.yaml:17)\n"
            "  1:22-27 expected here\n");
  EXPECT_EQ(ruled_out("running: {DRIVE: any}, stopped: [PARK]"), "");
  EXPECT_EQ(ruled_out("active: [DRIVE_BLIND, CHARGE]"), "");
}

TEST(ScriptReader, RequirementsRuleOutExpectations) {
  EXPECT_EQ(ruled_out("running: {DRIVE: DRIVE_BY_MAP}, stopped: [LOCALIZE]"),
            "1:54-62 warning impossible-expectation: this can never hold: DRIVE runs with "
            "DRIVE_BY_MAP and LOCALIZE does not run, as behavior 'DRIVE_BY_MAP' requires "
            "task 'LOCALIZE' (a.yaml:9)\n"
            "  1:22-27 expected here\n");
  // It may run with the other behavior.
  EXPECT_EQ(ruled_out("running: {DRIVE: any}, stopped: [LOCALIZE]"), "");
  EXPECT_EQ(ruled_out("active: [DRIVE_BY_MAP, SCANNER]"),
            "1:12-18 warning impossible-expectation: this can never hold: behavior "
            "DRIVE_BY_MAP is active and only the behaviors DRIVE_BY_MAP, SCANNER are "
            "active, as behavior 'DRIVE_BY_MAP' requires task 'LOCALIZE' (a.yaml:9)\n"
            "  1:21-33 expected here\n");
  EXPECT_EQ(ruled_out("active: [DRIVE_BY_MAP, CAMERA, SCANNER]"), "");
}

TEST(ScriptReader, WhatIsRequiredHasRequirementsToo) {
  EXPECT_EQ(ruled_out("running: {PARK:       PARK}, stopped: [SENSE]"),
            "1:51-56 warning impossible-expectation: this can never hold: PARK runs with "
            "PARK and SENSE does not run, as behavior 'CAMERA' requires task 'SENSE' "
            "(a.yaml:13) and behavior 'LIDAR' requires task 'SENSE' (a.yaml:12) and "
            "behavior 'PARK' requires task 'LOCALIZE' (a.yaml:11)\n"
            "  1:22-26 expected here\n");
  EXPECT_EQ(ruled_out("running: {CHARGE: any, LOCALIZE: LIDAR}"),
            "1:35-43 warning impossible-expectation: this can never hold: CHARGE runs and "
            "LOCALIZE runs with LIDAR, as behavior 'LIDAR' requires task 'SENSE' "
            "(a.yaml:12) and 'SENSE' excludes 'CHARGE' (a.yaml:18)\n"
            "  1:22-28 expected here\n");
  EXPECT_EQ(ruled_out("running: {LOCALIZE: any}, stopped: [SENSE]"),
            "1:48-53 warning impossible-expectation: this can never hold: LOCALIZE runs "
            "and SENSE does not run, as behavior 'CAMERA' requires task 'SENSE' "
            "(a.yaml:13) and behavior 'LIDAR' requires task 'SENSE' (a.yaml:12)\n"
            "  1:22-30 expected here\n");
}

TEST(ScriptReader, LongChainsRuleOutExpectations) {
  constexpr int tasks = 20'000;
  std::string catalog = "behaviors:\n";
  for (int i = 0; i < tasks; ++i) {
    catalog +=
        fmt::format("- {{behavior: b{0}, task: T{0}, requires: [{{task: T{1}}}]}}\n", i, i + 1);
  }
  catalog += fmt::format("- {{behavior: b{0}, task: T{0}}}\n", tasks);
  const CompiledCatalog chain = test::compile_text(catalog);
  const std::string script =
      fmt::format("- expect: {{running: {{T0: any}}, stopped: [T{}]}}\n", tasks);
  Diagnostics diagnostics;
  const auto document = yaml::parse(script, "s.yaml", diagnostics);
  EXPECT_TRUE(read_script(*document, chain, Severity::warning, diagnostics).has_value());
  EXPECT_EQ(diagnostics.all().front().message,
            "this can never hold: T0 runs and T20000 does not run");
}

// Time -----------------------------------------------------------------------------------------

TEST(ScriptReader, Times) {
  EXPECT_EQ(findings("- {at: 1, wait: 2}\n- {wait: 2, start: LAND, at: 1}\n"),
            "1:11-15 error invalid-value: 'at' and 'wait' are both given in an event\n"
            "  1:4-6 first given here\n"
            "2:26-28 error invalid-value: 'at' and 'wait' are both given in an event\n"
            "  2:4-8 first given here\n");
  const std::string must = " must be a number of seconds from 0 to 1000000000, found ";
  EXPECT_EQ(
      findings("- at: -1\n- wait: soon\n- wait: '1'\n- wait: 0.0000001\n- at: 1000000000.1\n"),
      "1:7-9 error invalid-value: 'at'" + must + "'-1'\n" + "2:9-13 error wrong-type: 'wait'" +
          must + "'soon'\n" + "3:9-12 error wrong-type: 'wait'" + must + "'1' in quotes\n" +
          "4:9-18 error invalid-value: 'wait' may have at most 6 decimals, found '0.0000001'\n" +
          "5:7-19 error invalid-value: 'at'" + must + "'1000000000.1'\n");
  EXPECT_EQ(findings("- at: 1000000000\n- wait: 0\n- wait: 0.000001\n"),
            "3:9-17 error invalid-value: after this wait it is later than 1000000000 s, the end of "
            "time\n");
}

// Parameters -----------------------------------------------------------------------------------

Parameters parameters(const std::string& value) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(value, "s.yaml", diagnostics);
  Reporter reporter("s.yaml", diagnostics);
  std::optional<Parameters> result;
  if (document != nullptr) result = read_parameters(document->root(), reporter);
  EXPECT_EQ(show(diagnostics), "") << value;
  return result.value_or(Parameters{});
}

bool same(const std::string& a, const std::string& b) {
  return parameters(a).canonical == parameters(b).canonical;
}

TEST(ScriptParameters, AreComparedAsData) {
  EXPECT_TRUE(same("{a: 1, b: 2}", "{b: 2, a: 1}"));
  EXPECT_TRUE(same("{a: 1}", "{'a': \"1\"}"));
  EXPECT_TRUE(same("{a: {x: 1, y: [1, 2]}}", "{a: {y: ['1', 2], x: 1}}"));
  EXPECT_FALSE(same("{a: 1}", "{a: 2}"));
  EXPECT_FALSE(same("{a: 1}", "{b: 1}"));
  EXPECT_FALSE(same("{a: 1}", "{a: 1.0}"));
  EXPECT_FALSE(same("{a: [1, 2]}", "{a: [2, 1]}"));
  EXPECT_FALSE(same("{a: 1}", "{a: [1]}"));
  EXPECT_FALSE(same("{a: {b: 1}}", "{a: [b, 1]}"));
}

TEST(ScriptParameters, NullEmptyAndAbsentAreAlikeAtEveryDepth) {
  for (const std::string nothing :
       {"~", "null", "''", "[]", "{}", "[[], ~, '']", "{b: ~, c: {d: []}}"}) {
    EXPECT_EQ(parameters("{a: " + nothing + "}").canonical, "") << nothing;
    EXPECT_TRUE(same("{x: 1, a: " + nothing + "}", "{x: 1}")) << nothing;
    EXPECT_TRUE(same("{x: [1, " + nothing + "]}", "{x: [1]}")) << nothing;
    EXPECT_TRUE(same("{x: [" + nothing + ", 1]}", "{x: [~, 1]}")) << nothing;
  }
  EXPECT_EQ(parameters("{}").canonical, "");
  EXPECT_FALSE(same("{x: [~, 1]}", "{x: [1]}"));
  EXPECT_FALSE(same("{x: [1, ~, 2]}", "{x: [1, 2]}"));
  EXPECT_FALSE(same("{x: 'null'}", "{x: null}"));
  EXPECT_FALSE(same("{x: '~'}", "{}"));
}

TEST(ScriptParameters, DifferentDataHaveDifferentTexts) {
  EXPECT_FALSE(same("{a: '1s1:bs1:2'}", "{a: 1, b: 2}"));
  EXPECT_FALSE(same("{a: [1, 2]}", "{a: ['1, 2']}"));
  EXPECT_FALSE(same("{a: [s1:x]}", "{a: [[x]]}"));
  EXPECT_FALSE(same("{a: [n, 1]}", "{a: [~, 1]}"));
  EXPECT_FALSE(same("{a: [[1], 2]}", "{a: [[1, 2]]}"));
  EXPECT_FALSE(same("{a: {b: 1}, c: 2}", "{a: {b: 1, c: 2}}"));
}

TEST(ScriptParameters, JsonKeepsTheOrderAndTheValues) {
  EXPECT_EQ(parameters("{b: 1, a: [1.5, -2, true, false, ~, x], c: {}, d: []}").json,
            R"({"b":1,"a":[1.5,-2,true,false,null,"x"],"c":{},"d":[]})");
  EXPECT_EQ(parameters("{}").json, "{}");
}

TEST(ScriptParameters, JsonHasNumbersAsTheyWereWritten) {
  // 0.000649 is one of those that some programs write with more digits than it needs.
  for (const std::string number :
       {"0", "10", "-1", "0.1", "1.0", "1.50", "-0", "0.000649", "1e5", "-1.5E+07", "1e-300",
        "18446744073709551615", "123456789012345678901234567890"}) {
    EXPECT_EQ(parameters("{a: [" + number + "]}").json, "{\"a\":[" + number + "]}");
  }
  // What JSON does not have as a number, or what no double can hold.
  for (const std::string text : {"01", "-01", "+1", ".5", "-.5", "1.", "1.e5", "1e", "0x10", "1_0",
                                 ".inf", "inf", "nan", "-", "1e999", "1e-999", "1 2"}) {
    EXPECT_EQ(parameters("{a: [" + text + "]}").json, "{\"a\":[\"" + text + "\"]}");
  }
  EXPECT_EQ(parameters("{a: ['1', 'true', 'null', True, yes, Null]}").json,
            R"({"a":["1","true","null","True","yes",null]})");
}

TEST(ScriptParameters, JsonIsValidForAnyText) {
  const std::string json = parameters(R"({"a\"\\\n\0": "é\t\x01\u2028/"})").json;
  EXPECT_EQ(json, "{\"a\\\"\\\\\\n\\u0000\":\"é\\t\\u0001\\u2028/\"}");
  EXPECT_TRUE(nlohmann::json::accept(json));
}

TEST(ScriptParameters, AliasesAreWrittenOut) {
  EXPECT_EQ(parameters("{a: &x [1], b: *x}").json, R"({"a":[1],"b":[1]})");
  EXPECT_EQ(parameters("{a: &x 1, b: [*x, *x]}").json, R"({"a":1,"b":[1,1]})");
  EXPECT_TRUE(same("{a: &x [1], b: *x}", "{a: [1], b: [1]}"));
}

}  // namespace
}  // namespace cbc::script_reader_test
