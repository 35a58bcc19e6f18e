#include "core/property/property_reader.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::property_reader_test {
namespace {

// In groups the tasks stand as HOVER LAND LOCALIZE | TALK | BOTH, so that places and ids differ.
const CompiledCatalog& catalog() {
  static const CompiledCatalog catalog = test::compile_text(R"(
tasks:
- task: HOVER
- task: TALK
- task: LAND
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- {task: SEE, start_on_request: false, execution_goal: keep_running}
- {task: LOOK, start_on_request: false, execution_goal: keep_running}
behaviors:
- {behavior: HOVER_MPC, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: TALK_LOUD, task: TALK}
- {behavior: HOVER_PID, task: HOVER}
- {behavior: LAND_PID, task: LAND}
- {behavior: GPS, task: LOCALIZE, situation: {SIGNAL: true}}
- {behavior: SLAM, task: LOCALIZE, situation: {LIGHT: [day, dusk]}}
- {behavior: EYE, tasks: [{task: SEE}, {task: LOOK}]}
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
situation:
- variable: SIGNAL
- {variable: LIGHT, values: [day, dusk, night]}
)");
  return catalog;
}

struct Result {
  std::optional<PropertyFile> file;
  std::string findings;
};

Result read_any(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "p.yaml", diagnostics);
  Result result;
  if (document != nullptr) result.file = read_properties(*document, catalog(), diagnostics);
  EXPECT_EQ(result.file.has_value(), !diagnostics.has_errors()) << text;
  result.findings = show(diagnostics);
  return result;
}

std::string findings(std::string_view text) { return read_any(text).findings; }

PropertyFile read(std::string_view text) {
  Result result = read_any(text);
  EXPECT_EQ(result.findings, "") << text;
  return result.file.value_or(PropertyFile{});
}

std::string name_of_task(TaskId task) { return std::string(catalog().name_of_task(task)); }
std::string name_of_behavior(BehaviorId behavior) {
  return std::string(catalog().name_of_behavior(behavior));
}

std::string describe(const SituationPart& part) {
  std::string text;
  for (const VariableValue value : part.variables) {
    text += " " + std::string(catalog().name_of_variable(value.variable)) + "=" +
            std::string(catalog().name_of_value(value));
  }
  for (const SituationPart::Own& own : part.behaviors) {
    text += " " + name_of_behavior(own.behavior) + (own.available ? "+" : "-");
  }
  return text;
}

std::string describe(const Assumptions& assumptions) {
  std::string text = "start";
  for (const Assumptions::Start& start : assumptions.start) {
    text += " " + name_of_task(start.task);
    for (const std::int32_t priority : start.priorities) text += " " + std::to_string(priority);
  }
  text += "; stop";
  for (const TaskId task : assumptions.stop) text += " " + name_of_task(task);
  if (!assumptions.successes) text += "; no successes";
  if (!assumptions.failures) text += "; no failures";
  text += "; faults " + std::to_string(assumptions.faults);
  if (assumptions.only_listed_fail) text += " of";
  if (!assumptions.only_listed_fail && !assumptions.listed_for_faults.empty()) text += " except";
  for (const BehaviorId behavior : assumptions.listed_for_faults) {
    text += " " + name_of_behavior(behavior);
  }
  text += "; changing";
  for (const std::uint32_t variable : assumptions.variables) {
    text += " " + std::string(catalog().name_of_variable(variable));
  }
  for (const BehaviorId behavior : assumptions.behaviors) text += " " + name_of_behavior(behavior);
  for (const SituationPart& never : assumptions.never) text += "; never" + describe(never);
  return text + "; initially" + describe(assumptions.initially);
}

/// All of the parts.
std::string describe(const StateCondition& condition) {
  using Kind = StateCondition::Kind;
  std::string text;
  for (const StateCondition& part : condition.parts) {
    std::string values;
    const auto add_value = [&values](const std::string& name) {
      values += (values.empty() ? "" : "|") + name;
    };
    for (const BehaviorId behavior : part.behaviors) add_value(name_of_behavior(behavior));
    for (const std::uint32_t value : part.values) {
      add_value(std::string(catalog().name_of_value({part.variable, value})));
    }
    switch (part.kind) {
      case Kind::running:
        text += " running " + name_of_task(part.task) + "=" + (values.empty() ? "any" : values);
        break;
      case Kind::stopped:
        text += " stopped " + name_of_task(part.task);
        break;
      case Kind::active:
        text += " active " + name_of_behavior(part.behavior);
        break;
      case Kind::only_active:
        text += describe(part) + " only";
        break;
      case Kind::faulty:
        text += " faulty " + name_of_behavior(part.behavior);
        break;
      case Kind::none_faulty:
        text += " faulty none";
        break;
      case Kind::failed:
        text += " failed " + name_of_behavior(part.behavior);
        break;
      case Kind::suspended:
        text += " suspended " + name_of_task(part.task);
        break;
      case Kind::available:
        text += " available " + name_of_behavior(part.behavior);
        break;
      case Kind::requested:
        text += concat(" requested ", name_of_task(part.task), " ", part.priority);
        break;
      case Kind::variable:
        text += " " + std::string(catalog().name_of_variable(part.variable)) + "=" + values;
        break;
      case Kind::own:
        text += describe(SituationPart{{}, {{part.behavior, part.wanted}}});
        break;
      case Kind::negated:
      case Kind::any:
      case Kind::all:
        for (const StateCondition& inner : part.parts) {
          const char* const word = part.kind == Kind::negated ? "not"
                                   : part.kind == Kind::any   ? "any"
                                                              : "all";
          text += concat(" ", word, "(", describe(inner), " )");
        }
    }
  }
  return text;
}

std::string describe(const Property& property) {
  std::string text = std::to_string(property.line) + " " + std::string(name_of(property.kind));
  if (!property.name.empty()) text += " '" + property.name + "'";
  if (property.kind == Property::Kind::can_start) {
    text += " " + name_of_task(property.task) + " " + std::to_string(property.priority);
  }
  text += describe(property.condition);
  if (property.when) text += " when" + describe(*property.when);
  if (property.settled) text += " settled";
  return text;
}

/// Of a file with one property.
std::string property_of(const std::string& text) {
  const PropertyFile file = read("properties:\n- " + text);
  EXPECT_EQ(file.properties.size(), 1U) << text;
  return file.properties.empty() ? "" : describe(file.properties.front());
}

std::string findings_of_property(const std::string& text, const std::string& assume = "{}") {
  return findings("assume: " + assume + "\nproperties:\n- " + text);
}

// Assumptions ------------------------------------------------------------------------------------

constexpr const char* defaults =
    "start HOVER 1 TALK 1 LAND 1; stop HOVER TALK LAND; faults 0; changing SIGNAL LIGHT; initially";

TEST(Assumptions, HaveDefaults) {
  EXPECT_EQ(describe(default_assumptions(catalog())), defaults);
  EXPECT_EQ(describe(read("properties: []").assumptions), defaults);
  EXPECT_EQ(describe(read("{assume: {}, initially: {}, properties: []}").assumptions), defaults);
  EXPECT_EQ(describe(read("{assume: {start: ~, stop: ~, successes: ~, failures: ~, faults: ~, "
                          "situation: ~, never: ~}, initially: ~, properties: []}")
                         .assumptions),
            defaults);
}

std::string assuming(const std::string& text) {
  return describe(read("properties: []\nassume: {" + text + "}").assumptions);
}

TEST(Assumptions, AreInCatalogOrder) {
  EXPECT_EQ(assuming("start: [LOCALIZE, LAND, HOVER]"),
            "start HOVER 1 LAND 1 LOCALIZE 1; stop HOVER LAND LOCALIZE; faults 0; "
            "changing SIGNAL LIGHT; initially");
  EXPECT_EQ(assuming("start: {LAND: 3, HOVER: [2, 1]}, stop: [LAND, TALK]"),
            "start HOVER 2 1 LAND 3; stop TALK LAND; faults 0; changing SIGNAL LIGHT; initially");
  EXPECT_EQ(assuming("start: all"),
            "start HOVER 1 TALK 1 LAND 1 LOCALIZE 1 SEE 1 LOOK 1; "
            "stop HOVER TALK LAND LOCALIZE SEE LOOK; faults 0; changing SIGNAL LIGHT; initially");
  EXPECT_EQ(assuming("start: [], situation: [SLAM, LIGHT, HOVER_PID]"),
            "start; stop; faults 0; changing LIGHT HOVER_PID SLAM; initially");
  EXPECT_EQ(
      assuming("start: {}, stop: [], situation: [], successes: no, failures: false, faults: 2"),
      "start; stop; no successes; no failures; faults 2; changing; initially");
}

TEST(Assumptions, AreAboutSituations) {
  const PropertyFile file = read(R"(
assume: {never: [{LIGHT: night, SIGNAL: true}, {LIGHT: day}, {SLAM: false}]}
initially: {GPS: false, LIGHT: night, SIGNAL: no}
properties: [])");
  EXPECT_EQ(describe(file.assumptions),
            "start HOVER 1 TALK 1 LAND 1; stop HOVER TALK LAND; faults 0; changing SIGNAL LIGHT; "
            "never LIGHT=night SIGNAL=true; never LIGHT=day; never SLAM-; "
            "initially LIGHT=night SIGNAL=false GPS-");
}

TEST(Assumptions, MustNotExcludeTheFirstState) {
  constexpr const char* message =
      "error invalid-value: this excludes the situation at the beginning; 'initially' sets another "
      "one\n";
  EXPECT_EQ(findings("{assume: {never: [{LIGHT: day}]}, properties: []}"),
            std::string("1:19-20 ") + message);
  EXPECT_EQ(findings("{assume: {never: [{GPS: true, SIGNAL: true}]}, properties: []}"),
            std::string("1:19-20 ") + message);
  EXPECT_EQ(findings("{initially: {LIGHT: night, GPS: no}, "
                     "assume: {never: [{LIGHT: night, GPS: false}]}, properties: []}"),
            std::string("1:55-56 ") + message);
  EXPECT_EQ(findings("{assume: {never: [{}]}, properties: []}"),
            "1:19-20 error invalid-value: an entry of 'never' must name a variable or a behavior: "
            "this one excludes every situation\n");
  // If it is not known where it begins, nothing follows.
  EXPECT_EQ(findings("{initialy: {LIGHT: dusk}, assume: {never: [{LIGHT: day}]}, properties: []}"),
            "1:2-10 error unknown-key: unknown key 'initialy' in a property file; did you mean "
            "'initially'?\n");
  EXPECT_EQ(findings("{initially: {LIGHT: dark}, assume: {never: [{LIGHT: day}]}, properties: []}"),
            "1:21-25 error situation-value: situation variable 'LIGHT' has no value 'dark'; its "
            "values are 'day', 'dusk' and 'night'\n");
}

TEST(Assumptions, NameThingsOnce) {
  EXPECT_EQ(findings(R"(
properties: []
assume:
  start: [LAND, LAND]
  stop: [HOVER, TALK, HOVER]
  situation: [GPS, GPS]
)"),
            "4:17-21 error invalid-value: 'LAND' is listed twice\n"
            "  4:11-15 first listed here\n"
            "5:23-28 error invalid-value: 'HOVER' is listed twice\n"
            "  5:10-15 first listed here\n"
            "6:20-23 error invalid-value: 'GPS' is listed twice\n"
            "  6:15-18 first listed here\n");
  EXPECT_EQ(findings("properties: []\nassume: {start: {LAND: [1, 2, 1], TALK: 1, LAND: 2}}"),
            "2:31-32 error invalid-value: '1' is listed twice\n"
            "  2:25-26 first listed here\n"
            "2:44-48 error duplicate-key: 'LAND' is given twice\n"
            "  2:18-22 first given here\n");
}

TEST(Assumptions, ReportAllMistakes) {
  EXPECT_EQ(
      findings(R"(
properties: []
assume:
  start: {LND: 1, HOVER: 0, TALK: [], LAND: ~}
  stop: LAND
  succeses: true
  failures: 3
  faults: -1
  situation: [LIGTH, LAND]
  never: {LIGHT: night}
)"),
      "4:11-14 error undefined-task: there is no task 'LND'\n"
      "4:26-27 error invalid-value: 'HOVER' must be an integer from 1 to 2147483647, found "
      "'0'\n"
      "4:35-36 error wrong-type: 'TALK' must be a priority or a list of priorities, found an "
      "empty list\n"
      "4:45-46 error wrong-type: 'LAND' must be a priority or a list of priorities, found "
      "nothing\n"
      "5:9-13 error wrong-type: 'stop' must be a list of tasks, found 'LAND'\n"
      "6:3-11 error unknown-key: unknown key 'succeses' in 'assume'; did you mean "
      "'successes'?\n"
      "7:13-14 error wrong-type: 'failures' must be true or false, found '3'\n"
      "8:11-13 error invalid-value: 'faults' must be an integer from 0 to 2147483647, found "
      "'-1'\n"
      "9:15-20 error undeclared-situation: there is no behavior or situation variable "
      "'LIGTH'; did you mean 'LIGHT'?\n"
      "9:22-26 error undeclared-situation: there is no behavior or situation variable 'LAND': "
      "it is a task; did you mean 'LAND_PID'?\n"
      "10:10-11 error wrong-type: 'never' must be a list of situations, found a mapping\n");
  EXPECT_EQ(
      findings("{assume: {start: LAND}, properties: []}"),
      "1:18-22 error wrong-type: 'start' must be a list of tasks, a mapping of tasks to lists "
      "of priorities, or 'all', found 'LAND'\n");
}

TEST(Assumptions, SayWhatCanBecomeFaulty) {
  constexpr const char* start = "start HOVER 1 TALK 1 LAND 1; stop HOVER TALK LAND; faults ";
  constexpr const char* end = "; changing SIGNAL LIGHT; initially";
  EXPECT_EQ(assuming("faults: {most: 2, of: [SLAM, HOVER_MPC]}"),
            std::string(start) + "2 of HOVER_MPC SLAM" + end);
  EXPECT_EQ(assuming("faults: {most: 1, except: [GPS], of: ~}"),
            std::string(start) + "1 except GPS" + end);
  EXPECT_EQ(assuming("faults: {most: 3}"), std::string(start) + "3" + end);

  const Assumptions of =
      read("{assume: {faults: {most: 1, of: [GPS]}}, properties: []}").assumptions;
  const Assumptions except =
      read("{assume: {faults: {most: 1, except: [GPS]}}, properties: []}").assumptions;
  const Assumptions no_faults =
      read("{assume: {faults: {most: 0, of: [GPS]}}, properties: []}").assumptions;
  for (const BehaviorId behavior : catalog().behavior_ids) {
    const bool is_gps = catalog().name_of_behavior(behavior) == "GPS";
    EXPECT_EQ(can_become_faulty(of, behavior), is_gps);
    EXPECT_EQ(can_become_faulty(except, behavior), !is_gps);
    EXPECT_FALSE(can_become_faulty(no_faults, behavior));
    EXPECT_FALSE(can_become_faulty(default_assumptions(catalog()), behavior));
  }
}

TEST(Assumptions, ReportMistakesAboutFaults) {
  const auto findings_of = [](const std::string& faults) {
    return findings("properties: []\nassume:\n  faults: " + faults);
  };
  EXPECT_EQ(findings_of("[GPS]"),
            "3:11-12 error wrong-type: 'faults' must be a number of behaviors, or a mapping with "
            "'most', found a list\n");
  EXPECT_EQ(findings_of("{of: [GPS]}"),
            "3:11-12 error missing-key: 'faults' needs 'most': how many behaviors may be faulty at "
            "a time\n");
  EXPECT_EQ(findings_of("{mst: 1, of: [GPS]}"),
            "3:12-15 error unknown-key: unknown key 'mst' in 'faults'; did you mean 'most'?\n");
  EXPECT_EQ(findings_of("{most: -1, of: GPS}"),
            "3:18-20 error invalid-value: 'most' must be an integer from 0 to 2147483647, found "
            "'-1'\n"
            "3:26-29 error wrong-type: 'of' must be a list of behaviors, found 'GPS'\n");
  EXPECT_EQ(findings_of("{most: 1, of: []}"),
            "3:25-26 error invalid-value: expected at least one behavior in 'of', found an empty "
            "list\n");
  EXPECT_EQ(findings_of("{most: 1, except: [GPS, LAND, SLM, GPS]}"),
            "3:35-39 error undefined-behavior: there is no behavior 'LAND': it is a task; did you "
            "mean 'LAND_PID'?\n"
            "3:41-44 error undefined-behavior: there is no behavior 'SLM'; did you mean 'SLAM'?\n"
            "3:46-49 error invalid-value: 'GPS' is listed twice\n"
            "  3:30-33 first listed here\n");
  EXPECT_EQ(findings_of("{most: 1, of: [GPS], except: [SLAM]}"),
            "3:32-38 error invalid-value: 'faults' takes 'of' or 'except', not both\n"
            "  3:21-23 'of' is here\n");
}

TEST(Assumptions, LetVariablesChangeTogether) {
  const auto lists_of = [](const std::string& text) {
    std::string lists;
    for (const auto& list : read("properties: []\nassume: {" + text + "}").assumptions.together) {
      for (const std::uint32_t variable : list) lists += std::to_string(variable) + " ";
      lists += "; ";
    }
    return lists;
  };
  EXPECT_EQ(lists_of("together: [[LIGHT, SIGNAL], [SIGNAL, LIGHT]]"), "0 1 ; 0 1 ; ");
  EXPECT_EQ(lists_of("together: [], situation: [GPS]"), "");
  const auto findings_of = [](const std::string& together, const std::string& rest = "") {
    return findings("properties: []\nassume: {" + rest + "together: " + together + "}");
  };
  EXPECT_EQ(findings_of("LIGHT"),
            "2:20-25 error wrong-type: 'together' must be a list of lists of situation variables, "
            "found 'LIGHT'\n");
  EXPECT_EQ(findings_of("[LIGHT, SIGNAL]"),
            "2:21-26 error wrong-type: 'together' must be lists of situation variables, found "
            "'LIGHT'\n"
            "2:28-34 error wrong-type: 'together' must be lists of situation variables, found "
            "'SIGNAL'\n");
  EXPECT_EQ(findings_of("[[], [SIGNAL]]"),
            "2:21-22 error invalid-value: expected at least two variables that change at once, "
            "found none\n"
            "2:25-26 error invalid-value: expected at least two variables that change at once, "
            "found one\n");
  EXPECT_EQ(findings_of("[[SIGNAL, GPS, LIGTH, SIGNAL]]"),
            "2:30-33 error invalid-value: 'together' lists situation variables, found behavior "
            "'GPS'\n"
            "2:35-40 error undeclared-situation: there is no behavior or situation variable "
            "'LIGTH'; did you mean 'LIGHT'?\n"
            "2:42-48 error invalid-value: 'SIGNAL' is listed twice\n"
            "  2:22-28 first listed here\n");
  EXPECT_EQ(findings_of("[[SIGNAL, LIGHT]]", "situation: [LIGHT], "),
            "2:42-48 error invalid-value: 'SIGNAL' never changes, as 'situation' of 'assume' does "
            "not list it\n");
}

TEST(Assumptions, SayWhichVariablesNeverKeeps) {
  const auto frozen_by = [](const std::string& assume) {
    const Result result = read_any("properties: []\nassume: {" + assume + "}");
    return result.file ? result.file->assumptions.frozen : std::vector<std::uint32_t>{};
  };
  using Variables = std::vector<std::uint32_t>;
  // There is no situation with another value, so what is proved of it is so.
  EXPECT_EQ(findings("assume: {never: [{SIGNAL: false}]}\nproperties: []"), "");
  EXPECT_EQ(frozen_by("never: [{SIGNAL: false}]"), Variables{0});
  constexpr const char* coupled =
      "never: [{LIGHT: day, SIGNAL: false}, {LIGHT: dusk, SIGNAL: true}, "
      "{LIGHT: night, SIGNAL: true}]";
  EXPECT_EQ(findings(std::string("properties: []\nassume: {") + coupled + "}"),
            "2:18-19 warning impossible-expectation: 'never' keeps 'SIGNAL' and 'LIGHT' from ever "
            "changing, as it excludes each change of one variable; 'together: [[SIGNAL, LIGHT]]' "
            "lets several change at once\n"
            "  2:47-48 as does this\n"
            "  2:76-77 as does this\n");
  EXPECT_EQ(findings(std::string("properties: []\nassume: {together: [[LIGHT, SIGNAL]], ") +
                     coupled + "}"),
            "");
  EXPECT_EQ(findings("assume: {never: [{SIGNAL: false}], situation: [LIGHT]}\nproperties: []"), "");
  EXPECT_EQ(frozen_by(coupled), (Variables{0, 1}));
  EXPECT_EQ(frozen_by("never: [{SIGNAL: false}], situation: [LIGHT]"), Variables{});
  // LIGHT changes, but not SIGNAL.
  EXPECT_EQ(frozen_by("never: [{SIGNAL: false, LIGHT: day}, {SIGNAL: false, LIGHT: dusk}, "
                      "{SIGNAL: false, LIGHT: night}]"),
            Variables{0});
}

// Properties -------------------------------------------------------------------------------------

TEST(PropertyFiles, AreMappings) {
  EXPECT_EQ(findings(""),
            "1:1-1 error missing-key: missing key 'properties': the property file is empty\n");
  EXPECT_EQ(findings("[can_start: LAND]"),
            "1:1-2 error wrong-type: a property file must be a mapping with the key 'properties', "
            "found a list\n");
  EXPECT_EQ(findings("{properties: {can_start: LAND}, asume: {}}"),
            "1:14-15 error wrong-type: 'properties' must be a list of properties, found a mapping\n"
            "1:33-38 error unknown-key: unknown key 'asume' in a property file; did you mean "
            "'assume'?\n");
  EXPECT_EQ(findings("assume: {faults: 1}"),
            "1:1-2 note missing-key: without 'properties' there is nothing to prove\n");
}

TEST(PropertyFiles, NameTheirCatalog) {
  const PropertyFile file = read("{catalog: robot.yaml, properties: []}");
  EXPECT_EQ(file.path, "p.yaml");
  EXPECT_EQ(file.catalog, "robot.yaml");
  EXPECT_EQ(read("properties: []").catalog, std::nullopt);
}

TEST(Properties, AreOfFourKinds) {
  EXPECT_EQ(property_of("can_start: LAND"), "2 can_start LAND 1");
  EXPECT_EQ(property_of("{can_start: LAND, priority: 3, name: it lands, always: ~, when: ~}"),
            "2 can_start 'it lands' LAND 3");
  EXPECT_EQ(property_of("{always: {running: [LAND]}, when: {stopped: [TALK]}, settled: yes}"),
            "2 always running LAND=any when stopped TALK settled");
  EXPECT_EQ(property_of("{never: {active: [EYE]}, settled: false}"), "2 never active EYE only");
  EXPECT_EQ(property_of("{never: {active_includes: [EYE]}}"), "2 never active EYE");
  EXPECT_EQ(property_of("{reachable: {available: [GPS]}, settled: true}"),
            "2 reachable available GPS settled");
}

TEST(Properties, HaveConditionsOfManyParts) {
  EXPECT_EQ(property_of("never: {running: {HOVER: HOVER_PID, TALK: any}, stopped: [LAND, SEE], "
                        "active_includes: [GPS, TALK_LOUD], available: [SLAM], "
                        "requested: {TALK: 1, HOVER: 0}, situation: {LIGHT: dusk, SLAM: true}}"),
            "2 never running HOVER=HOVER_PID running TALK=any stopped LAND stopped SEE "
            "active GPS active TALK_LOUD requested TALK 1 requested HOVER 0 LIGHT=dusk "
            "SLAM+ available SLAM");
}

TEST(Properties, HaveOneKind) {
  EXPECT_EQ(
      findings_of_property("{can_start: LAND, never: {running: [LAND]}}"),
      "3:21-26 error invalid-value: a property must be of exactly one kind, found 'can_start' "
      "and 'never'; each needs an entry of its own\n"
      "  3:4-13 the first one is here\n");
  EXPECT_EQ(findings_of_property("name: x"),
            "3:3-4 error missing-key: a property needs one of 'can_start', 'always', 'never', "
            "'reachable', 'keeps_running' and 'always_possible'\n");
  EXPECT_EQ(findings_of_property("always: ~"), "3:3-9 error missing-key: 'always' has no value\n");
  EXPECT_EQ(findings_of_property("eventually: {running: [LAND]}"),
            "3:3-13 error unknown-key: unknown key 'eventually' in a property; there are 'name', "
            "'can_start', 'priority', 'always', 'never', 'reachable', 'keeps_running', "
            "'always_possible', 'when', 'settled', 'after', 'until', 'by' and 'within'\n");
  EXPECT_EQ(findings_of_property("can_strat: LAND"),
            "3:3-12 error unknown-key: unknown key 'can_strat' in a property; did you mean "
            "'can_start'?\n");
  EXPECT_EQ(findings_of_property("LAND"),
            "3:3-7 error wrong-type: a property must be a mapping ('can_start: TASK'), found "
            "'LAND'\n");
}

TEST(Properties, HaveConditionsThatSaySomething) {
  constexpr const char* message =
      "error missing-key: 'never' needs a condition: one of 'running', 'stopped', 'active', "
      "'active_includes', 'faulty', 'available', 'requested', 'suspended', 'failed', 'situation', "
      "'not', 'any' and 'all'\n";
  EXPECT_EQ(findings_of_property("never: {}"), std::string("3:10-11 ") + message);
  EXPECT_EQ(findings_of_property("never: {running: ~}"), std::string("3:10-11 ") + message);
  EXPECT_EQ(
      findings_of_property("never: {running: []}"),
      "3:20-21 error invalid-value: 'running' must be a list of tasks, found an empty list\n");
  EXPECT_EQ(findings_of_property("{always: {running: [LAND]}, when: [LAND]}"),
            "3:37-38 error wrong-type: 'when' must be a mapping, found a list\n");
}

TEST(Properties, ReportAllMistakesOfTheirConditions) {
  EXPECT_EQ(
      findings(R"(
properties:
- always:
    running: LAND
    stoped: [LAND]
    active: [LAND, GPS, GPS]
    faulty: GPS
    requested: {TALK: high, LND: 1}
    situation: {SIGNAL: maybe, LIGHT: 1}
    outcome: accepted
)"),
      "4:14-18 error wrong-type: 'running' must be a list of tasks, or a mapping of tasks to "
      "behaviors or 'any', found 'LAND'\n"
      "5:5-11 error unknown-key: unknown key 'stoped' in a condition; did you mean "
      "'stopped'?\n"
      "6:14-18 error undefined-behavior: there is no behavior 'LAND': it is a task; did you "
      "mean 'LAND_PID'?\n"
      "6:25-28 error invalid-value: 'GPS' is listed twice\n"
      "  6:20-23 first listed here\n"
      "7:13-16 error wrong-type: 'faulty' must be a list of behaviors or 'none', found 'GPS'\n"
      "8:23-27 error wrong-type: 'TALK' must be an integer from 0 to 2147483647, found "
      "'high'\n"
      "8:29-32 error undefined-task: there is no task 'LND'; did you mean 'LAND'?\n"
      "9:25-30 error situation-value: situation variable 'SIGNAL' has no value 'maybe'; its "
      "values are 'true' and 'false'\n"
      "9:39-40 error situation-value: situation variable 'LIGHT' has no value '1'; its values "
      "are 'day', 'dusk' and 'night'\n"
      "10:5-12 error unknown-key: unknown key 'outcome' in a condition; there are 'running', "
      "'stopped', 'active', 'active_includes', 'faulty', 'available', 'requested', 'suspended', "
      "'failed', 'situation', 'not', 'any' and 'all'\n");
}

// Conditions that never hold ---------------------------------------------------------------------

TEST(Conditions, MustNotContradictThemselves) {
  EXPECT_EQ(findings_of_property("never: {running: [LAND], stopped: [TALK, LAND]}"),
            "3:44-48 error impossible-expectation: this can never hold: LAND runs and LAND "
            "does not run\n"
            "  3:21-25 expected here\n");
  EXPECT_EQ(findings_of_property("always: {running: {LAND: GPS}}"),
            "3:28-31 error impossible-expectation: this can never hold: behavior 'GPS' does not "
            "perform task 'LAND', it performs 'LOCALIZE'\n");
  EXPECT_EQ(findings_of_property("reachable: {requested: {LAND: 1}, stopped: [LAND]}"),
            "3:27-31 error impossible-expectation: this can never hold: LAND does not run "
            "and LAND is requested with priority 1 or more\n"
            "  3:47-51 expected here\n");
  EXPECT_EQ(findings_of_property("never: {available: [GPS], situation: {GPS: false}}"),
            "3:23-26 error impossible-expectation: this can never hold: the situation "
            "forbids GPS and behavior GPS is available\n"
            "  3:41-44 expected here\n");
}

TEST(Conditions, LeaveATaskForEachActiveBehavior) {
  EXPECT_EQ(
      findings_of_property("never: {active_includes: [HOVER_PID], running: {HOVER: HOVER_MPC}}"),
      "3:29-38 error impossible-expectation: this can never hold: HOVER runs with "
      "HOVER_MPC and behavior HOVER_PID is active\n"
      "  3:51-56 expected here\n");
  EXPECT_EQ(findings_of_property("never: {active_includes: [HOVER_PID, HOVER_MPC]}"),
            "3:40-49 error impossible-expectation: this can never hold: behavior HOVER_PID "
            "is active and behavior HOVER_MPC is active\n"
            "  3:29-38 expected here\n");
  EXPECT_EQ(findings_of_property("never: {active_includes: [EYE], stopped: [SEE, LOOK]}"),
            "3:29-32 error impossible-expectation: this can never hold: SEE does not run "
            "and LOOK does not run and behavior EYE is active\n"
            "  3:45-48 expected here\n"
            "  3:50-54 expected here\n");
  EXPECT_EQ(
      findings_of_property("never: {active_includes: [EYE], stopped: [SEE], running: {LOOK: EYE}}"),
      "");
}

TEST(Conditions, ListAllActiveBehaviorsOrSome) {
  EXPECT_EQ(findings_of_property("never: {active: [HOVER_PID], running: [LAND]}"),
            "3:11-17 error impossible-expectation: this can never hold: LAND runs and only "
            "behavior HOVER_PID is active\n"
            "  3:42-46 expected here\n");
  EXPECT_EQ(findings_of_property("never: {active_includes: [HOVER_PID], running: [LAND]}"),
            "3:29-38 note impossible-expectation: this is ruled out already: LAND runs and "
            "behavior HOVER_PID is active, as 'HOVER' excludes 'LAND' (a.yaml:18)\n"
            "  3:51-55 expected here\n");
  EXPECT_EQ(findings_of_property("never: {active: [GPS], active_includes: [SLAM]}"),
            "3:26-41 error invalid-value: 'active' lists all behaviors that are active: leave out "
            "'active_includes', or 'active'\n"
            "  3:11-17 all active behaviors are here\n");
  EXPECT_EQ(findings_of_property("never: {active: []}"),
            "3:19-20 error invalid-value: 'active' must be a list of behaviors, found an empty "
            "list\n");
}

TEST(Conditions, MayBeRuledOutByTheCatalog) {
  // What "never" demands is no mistake.
  EXPECT_EQ(findings_of_property("reachable: {running: [HOVER, LAND]}"),
            "3:32-36 warning impossible-expectation: this can never hold: HOVER runs and "
            "LAND runs, as 'HOVER' excludes 'LAND' (a.yaml:18)\n"
            "  3:25-30 expected here\n");
  EXPECT_EQ(findings_of_property("never: {running: [HOVER, LAND]}"),
            "3:28-32 note impossible-expectation: this is ruled out already: HOVER runs "
            "and LAND runs, as 'HOVER' excludes 'LAND' (a.yaml:18)\n"
            "  3:21-26 expected here\n");
  EXPECT_EQ(
      findings_of_property(
          "{always: {running: [TALK]}, when: {running: [HOVER], active_includes: [LAND_PID]}}"),
      "3:74-82 warning impossible-expectation: this can never hold: HOVER runs and "
      "behavior LAND_PID is active, as 'HOVER' excludes 'LAND' (a.yaml:18)\n"
      "  3:48-53 expected here\n");
  EXPECT_EQ(findings_of_property("reachable: {requested: {HOVER: 1, LAND: 0}}"),
            "3:37-41 warning impossible-expectation: this can never hold: HOVER is "
            "requested with priority 1 or more and LAND is requested with priority 0 or "
            "more, as 'HOVER' excludes 'LAND' (a.yaml:18)\n"
            "  3:27-32 expected here\n");
  EXPECT_EQ(findings_of_property("reachable: {active_includes: [SLAM], situation: {LIGHT: night}}"),
            "3:52-57 warning impossible-expectation: this can never hold: behavior SLAM is "
            "active and LIGHT is night, as behavior 'SLAM' fits only where 'LIGHT' is "
            "'day' or 'dusk'\n"
            "  3:33-37 expected here\n");
  EXPECT_EQ(findings_of_property("reachable: {active_includes: [SLAM], situation: {LIGHT: dusk}}"),
            "");
}

TEST(Conditions, MayBeRuledOutByRequirements) {
  EXPECT_EQ(findings_of_property("reachable: {active_includes: [HOVER_MPC], stopped: [LOCALIZE]}"),
            "3:33-42 warning impossible-expectation: this can never hold: LOCALIZE does "
            "not run and behavior HOVER_MPC is active, as behavior 'HOVER_MPC' requires "
            "task 'LOCALIZE' (a.yaml:10)\n"
            "  3:55-63 expected here\n");
  EXPECT_EQ(findings_of_property("reachable: {running: [HOVER], stopped: [LOCALIZE]}"), "");
  // That it is ruled out is what the property is there to prove.
  EXPECT_EQ(findings_of_property("never: {active_includes: [HOVER_MPC], stopped: [LOCALIZE]}"), "");
  // Other behaviors may be active.
  EXPECT_EQ(findings_of_property("reachable: {active_includes: [HOVER_MPC]}"), "");
}

TEST(Conditions, MayBeRuledOutByTheAssumptions) {
  constexpr const char* assume = "{start: {LAND: [1, 2]}, situation: [SIGNAL, SLAM], faults: 1}";
  EXPECT_EQ(findings_of_property("reachable: {faulty: [GPS]}", assume), "");
  EXPECT_EQ(findings_of_property("reachable: {faulty: [GPS, SLAM]}", assume),
            "3:29-33 warning impossible-expectation: this can never hold: behavior GPS is "
            "faulty and behavior SLAM is faulty, which 'assume' rules out\n"
            "  3:24-27 expected here\n");
  EXPECT_EQ(findings_of_property("reachable: {faulty: [GPS]}", "{faults: {most: 1, of: [SLAM]}}"),
            "3:24-27 warning impossible-expectation: this can never hold: behavior GPS is "
            "faulty, which 'assume' rules out\n");
  EXPECT_EQ(
      findings_of_property("reachable: {faulty: [GPS]}", "{faults: {most: 1, except: [SLAM]}}"),
      "");
  EXPECT_EQ(findings_of_property("reachable: {faulty: [GPS]}"),
            "3:24-27 warning impossible-expectation: this can never hold: behavior GPS is "
            "faulty, which 'assume' rules out\n");
  EXPECT_EQ(findings_of_property("reachable: {situation: {SIGNAL: false, SLAM: false}}", assume),
            "");
  EXPECT_EQ(findings_of_property("reachable: {situation: {LIGHT: night, GPS: false}}", assume),
            "3:27-32 warning impossible-expectation: this can never hold: LIGHT is night, "
            "which 'assume' rules out\n"
            "3:41-44 warning impossible-expectation: this can never hold: the situation "
            "forbids GPS, which 'assume' rules out\n");
  EXPECT_EQ(findings_of_property("reachable: {requested: {LAND: 2, TALK: 0}}", assume), "");
  EXPECT_EQ(findings_of_property("reachable: {requested: {LAND: 3}}", assume),
            "3:27-31 warning impossible-expectation: this can never hold: 'start' of 'assume' "
            "requests task 'LAND' with at most priority 2\n");
  EXPECT_EQ(findings_of_property("reachable: {requested: {TALK: 1}}", assume),
            "3:27-31 warning impossible-expectation: this can never hold: task 'TALK' is never "
            "requested, as 'start' of 'assume' does not list it\n");
  // What follows from mistakes in the assumptions is not reported.
  EXPECT_EQ(findings_of_property("reachable: {faulty: [GPS]}", "{fault: 1}"),
            "1:10-15 error unknown-key: unknown key 'fault' in 'assume'; did you mean 'faults'?\n");
}

TEST(Conditions, MayBeginWithTheirSituation) {
  EXPECT_EQ(findings(R"(
assume: {situation: []}
initially: {LIGHT: night, GPS: false}
properties:
- always: {situation: {LIGHT: night, GPS: false, SIGNAL: true}}
)"),
            "");
}

}  // namespace
}  // namespace cbc::property_reader_test
