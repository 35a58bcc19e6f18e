#include "core/catalog/older_format.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "unit/findings.h"

namespace cbc::older_format_test {
namespace {

Conversion convert(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "old.yaml", diagnostics);
  EXPECT_EQ(show(diagnostics), "");
  if (document == nullptr) return {};
  EXPECT_TRUE(find_older_format(document->root()));
  return convert_older_format(*document, text);
}

/// The catalog that a text is converted to, which must be valid.
Catalog converted(std::string_view text) {
  const Conversion conversion = convert(text);
  EXPECT_FALSE(conversion.obstacle);
  Diagnostics diagnostics;
  const auto document = yaml::parse(conversion.text, "new.yaml", diagnostics);
  if (document == nullptr) {
    ADD_FAILURE() << show(diagnostics) << conversion.text;
    return {};
  }
  EXPECT_FALSE(find_older_format(document->root()));
  auto catalog = read_catalog(*document, diagnostics);
  EXPECT_EQ(show(diagnostics), "") << conversion.text;
  return catalog ? std::move(*catalog) : Catalog();
}

std::string describe_requirements(const Catalog& catalog) {
  std::string text;
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Requirement& requirement : behavior.requirements) {
      text += behavior.name + " " + catalog.tasks[requirement.task].name + "\n";
    }
  }
  return text;
}

std::string describe_exclusions(const Catalog& catalog) {
  return join(catalog.exclusivity, "\n", [&](const ExclusivityList& list) {
    return join(list.tasks, " ",
                [&](const auto& task) { return std::string(catalog.tasks[task].name); });
  });
}

std::string messages(const Conversion& conversion) {
  return join(conversion.leftovers, "\n", [](const Leftover& leftover) {
    return show(leftover.range) + " " + leftover.message;
  });
}

std::string features(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "old.yaml", diagnostics);
  const auto format = find_older_format(document->root());
  return format ? format->key->text + " " + std::string(format->features) : "none";
}

TEST(OlderFormat, HasItsDescription) {
  EXPECT_EQ(features("behavior_descriptors: [{behavior: A, capabilities: [B]}]"),
            "behavior_descriptors with capabilities and without tasks");
  EXPECT_EQ(features("behavior_descriptors: [{behavior: A, system: s}]"),
            "behavior_descriptors with behavior systems and precedence constraints, and without "
            "tasks");
  EXPECT_EQ(features("{behavior_descriptors: [{behavior: A}], precedence_constraints: [{}]}"),
            "behavior_descriptors with behavior systems and precedence constraints, and without "
            "tasks");
  EXPECT_EQ(features("behaviors: [{behavior: A, system: s}]"),
            "system with behavior systems and precedence constraints, and without tasks");
  EXPECT_EQ(features("basic_behaviors: [{behavior: A}]"),
            "basic_behaviors with basic behaviors and without tasks");
  EXPECT_EQ(features("behavior_descriptors: [{behavior: A}]"),
            "behavior_descriptors with behavior descriptors and without tasks");
}

TEST(OlderFormat, IsNoOtherFile) {
  EXPECT_EQ(features("behavior_descriptors: [speed, height]"), "none");
  EXPECT_EQ(features("behaviors: [{behavior: A, task: B, capabilities: [C]}]"), "none");
  EXPECT_EQ(features("{behaviors: [{behavior: A, task: B}], precedence_constraints: [{}]}"),
            "none");
  EXPECT_EQ(features("[1, 2]"), "none");
}

TEST(OlderFormat, BecomesTasksWithTheirAttributes) {
  const Catalog catalog = converted(R"(
default_values: {category: goal_based, default: no, timeout: 15}
behavior_descriptors:
- {behavior: HOVER, category: recurrent, default: yes, system: basic}
- behavior: FLY
  timeout: 30
  arguments:
  - {argument: SPEED, allowed_values: [0, 30], dimensions: 1}
)");
  ASSERT_EQ(catalog.tasks.size(), 2U);
  const Task& hover = catalog.tasks[0];
  EXPECT_EQ(hover.execution_goal, ExecutionGoal::keep_running);
  EXPECT_TRUE(hover.reactive_start);
  EXPECT_FALSE(hover.start_on_request);
  const Task& fly = catalog.tasks[1];
  EXPECT_EQ(fly.execution_goal, ExecutionGoal::achieve_goal);
  EXPECT_TRUE(fly.start_on_request);
  EXPECT_EQ(fly.timeout, 30'000'000);
  ASSERT_EQ(fly.parameters.size(), 1U);
  EXPECT_EQ(fly.parameters[0].name, "SPEED");
  EXPECT_EQ(catalog.behaviors[0].package, "basic");
}

TEST(OlderFormat, CapabilitiesBecomeRequirements) {
  const Catalog catalog = converted(R"(
behavior_descriptors:
- {behavior: GO, capabilities: [PLAN, GO, UNKNOWN]}
capability_descriptors:
- {capability: PLAN, required_capabilities: [MAP], incompatible_capabilities: [GO]}
- {capability: GO}
- {capability: MAP}
)");
  EXPECT_EQ(describe_requirements(catalog), "GO PLAN\nGO GO_CAPABILITY\nGO UNKNOWN\nPLAN MAP\n");
  EXPECT_EQ(describe_exclusions(catalog), "PLAN GO_CAPABILITY");
}

TEST(OlderFormat, ListsBecomeExclusions) {
  EXPECT_EQ(describe_exclusions(converted(R"(
behavior_descriptors:
- {behavior: A, incompatible_lists: [motion]}
- {behavior: B, incompatible_lists: [motion]}
- {behavior: OUTSIDE, incompatible_lists: [motion]}
- {behavior: SILENT}
behavior_lists:
- {list: motion, behaviors: [A, B, SILENT]}
)")),
            "A B\nA SILENT\nB SILENT\nOUTSIDE A\nOUTSIDE B\nOUTSIDE SILENT");
  EXPECT_EQ(describe_exclusions(converted(R"(
behavior_descriptors:
- {behavior: A, incompatible_lists: [motion]}
- {behavior: B, incompatible_lists: [motion]}
)")),
            "A B");
}

TEST(OlderFormat, PrecedencesBecomeRequirements) {
  constexpr std::string_view text = R"(
behavior_descriptors:
- {behavior: SEE, category: recurrent}
- {behavior: HEAR, category: recurrent}
- {behavior: GO}
- {behavior: STOP}
precedence_constraints:
- {active: [SEE], before: [GO, STOP]}
- {active: [SEE, HEAR], before: [GO]}
- {active: [GO], before: [STOP, GO]}
exclusivity_constraints:
- mutually_exclusive: [GO, STOP]
)";
  const Catalog catalog = converted(text);
  EXPECT_EQ(describe_requirements(catalog), "GO SEE\nSTOP SEE\n");
  EXPECT_FALSE(catalog.tasks[0].start_on_request);
  EXPECT_EQ(
      messages(convert(text)),
      "8:3-4 a precedence becomes a requirement, which holds as long as the later behavior "
      "runs: it ends with the earlier one (2 times)\n"
      "9:3-4 this precedence is kept as 'x-precedence_constraints', not as a requirement: one "
      "of several behaviors has to be active, while a behavior requires one task; where they "
      "are alternatives, let them perform the same task\n"
      "10:3-4 this precedence is kept as 'x-precedence_constraints', not as a requirement: 'GO' "
      "and 'STOP' exclude each other\n"
      "10:3-4 this precedence is kept as 'x-precedence_constraints', not as a requirement: a "
      "behavior cannot require itself");
}

TEST(OlderFormat, KeepsWhatIsNotKnown) {
  const Conversion conversion = convert(R"(# head
mission: {name: 'a: b', tries: 3}
behavior_descriptors:
- behavior: "GO: 1"  # fast
  color: ~
  hidden: "\U000E0041"
# tail
)");
  EXPECT_EQ(conversion.text, R"(# head
behaviors:
# fast
- behavior: "GO: 1"
  task: "GO: 1"
  x-color: ~
  x-hidden: "\U000e0041"
tasks:
- task: "GO: 1"
x-mission: {name: "a: b", tries: 3}
# tail
)");
  EXPECT_EQ(messages(conversion),
            "2:1-8 'mission' is not known; it is kept as 'x-mission'\n"
            "5:3-8 'color' is not known; it is kept as 'x-color'\n"
            "6:3-9 'hidden' is not known; it is kept as 'x-hidden'");
}

TEST(OlderFormat, HasObstacles) {
  const auto obstacle = [](std::string_view text) {
    const Conversion conversion = convert(text);
    EXPECT_EQ(conversion.text, "");
    return conversion.obstacle ? conversion.obstacle->message : "none";
  };
  EXPECT_EQ(obstacle("behavior_descriptors:"), "it has no behaviors");
  EXPECT_EQ(obstacle("behavior_descriptors: [{name: A}]"),
            "an entry of 'behavior_descriptors' has no 'behavior'");
  EXPECT_EQ(obstacle("{behavior_descriptors: [{behavior: A}], tasks: [{task: A}]}"),
            "it has a section 'tasks' as well");
  EXPECT_EQ(obstacle("behaviors: [{behavior: A, system: s}, {behavior: B, task: B}]"),
            "behavior 'B' has a task already");
  EXPECT_EQ(obstacle("{behavior_descriptors: [{behavior: A}], behavior_lists: 3}"),
            "'behavior_lists' is no list of mappings");
}

}  // namespace
}  // namespace cbc::older_format_test
