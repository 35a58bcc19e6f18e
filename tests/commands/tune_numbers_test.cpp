// Which numbers a catalog has, and what they stand for.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/yaml/document.h"
#include "tune/engine/numbers.h"

namespace cbc::tune_numbers_test {
namespace {

CatalogReading read(const std::string& text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "robot.yaml", diagnostics);
  CatalogReading reading = understand_catalog(*document, diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::error), 0U);
  return reading;
}

/// "3: suitability of B for A: 90 (1)": line, what it is, value, and for how many it stands.
std::vector<std::string> list(const CatalogReading& reading) {
  std::vector<std::string> lines;
  for (const TunableNumber& number : find_numbers(reading)) {
    lines.push_back(concat(number.line(), ": ", describe(number, reading.catalog), ": ",
                           format_decimal(number.value, 4), " (", number.uses.size(), ")"));
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(Numbers, OfEachPlace) {
  EXPECT_EQ(list(read(R"(behaviors:
- behavior: B
  task: A
  suitability: 90
  requires: [{task: C, minimum_performance: 12.5}]
- {behavior: D, task: C, efficacy: 80}
tasks:
- {task: A, minimum_performance: 0}
- {task: C}
)")),
            (Lines{"4: suitability of B for A: 90 (1)", "5: minimum of C for B: 12.5 (1)",
                   "6: suitability of D for C: 80 (1)", "8: minimum of A: 0 (1)"}));
}

TEST(Numbers, ThatStandForSeveralPairs) {
  EXPECT_EQ(list(read(R"(default_values: {behaviors: {suitability: 70}}
behaviors:
- {behavior: B, task: A}
- {behavior: C, task: A}
- {behavior: D, suitability: 60, tasks: [{task: A}, {task: E}, {task: F, suitability: 50}]}
)")),
            (Lines{"1: default suitability: 70 (2)", "5: suitability of D: 60 (2)",
                   "5: suitability of D for F: 50 (1)"}));
}

TEST(Numbers, ThatStandForNothing) {
  EXPECT_EQ(list(read(R"(default_values: {behaviors: {suitability: 70}}
behaviors:
- {behavior: B, suitability: 60, tasks: [{task: A, suitability: 50}]}
tasks:
- {task: A, minimum_performance: 20}
- {task: A, minimum_performance: 30}
)")),
            (Lines{"1: default suitability: 70 (0)", "3: suitability: 60 (0)",
                   "3: suitability of B for A: 50 (1)", "5: minimum: 20 (0)",
                   "6: minimum of A: 30 (1)"}));
}

TEST(Numbers, OfTheDefaultThatStandsNowhere) {
  EXPECT_EQ(list(read("behaviors:\n- {behavior: B, task: A}\n")),
            (Lines{"0: default suitability: 100 (1)"}));
}

TEST(Numbers, OfAnAliasAreOneOfEachKind) {
  EXPECT_EQ(list(read(R"(behaviors:
- {behavior: B, task: A, suitability: &good 90}
- {behavior: C, task: A, suitability: *good}
- {behavior: D, task: E, requires: [{task: A, minimum_performance: *good}]}
)")),
            (Lines{"2: suitability for A: 90 (2)", "2: minimum of A for D: 90 (1)",
                   "0: default suitability: 100 (1)"}));
}

TEST(Numbers, ChangeInTheirPlaces) {
  const CatalogReading reading = read(R"(behaviors:
- behavior: B
  suitability: 90
  tasks: [{task: A}, {task: C}]
  requires: [{task: E, minimum_performance: 10}, {task: E, minimum_performance: 20}]
- {behavior: D, task: E, suitability: 80}
tasks:
- {task: A, minimum_performance: 30}
)");
  Catalog catalog = reading.catalog;
  Millionths value = 0;
  for (const TunableNumber& number : find_numbers(reading)) set_number(catalog, number, ++value);
  const Behavior& first = catalog.behaviors[0];
  EXPECT_EQ(first.performs[0].suitability, 1U);
  EXPECT_EQ(first.performs[1].suitability, 1U);
  EXPECT_EQ(first.requirements[0].minimum_performance, 2U);
  EXPECT_EQ(first.requirements[1].minimum_performance, 3U);
  EXPECT_EQ(catalog.behaviors[1].performs[0].suitability, 4U);
  EXPECT_EQ(catalog.tasks[0].minimum_performance, 5U);
}

}  // namespace
}  // namespace cbc::tune_numbers_test
