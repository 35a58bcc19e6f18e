#include "versions/difference/catalog_diff.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "graph/report/graph_report.h"

namespace cbc::catalog_diff_test {
namespace {

CompiledCatalog compiled(const std::string& yaml) {
  Diagnostics diagnostics;
  return compile(read_catalog(yaml, "catalog.yaml", diagnostics).value());
}

std::string text_of(const std::string& before, const std::string& after) {
  return diff_text(compare_catalogs(compiled(before), compiled(after)), plain_style());
}

const std::string robot =
    "tasks:\n"
    "- {task: FLY, timeout: 20, parameters: [{parameter: speed, allowed_values: [0, 30]}]}\n"
    "- {task: LAND, reactive_start: true, start_on_request: false}\n"
    "behaviors:\n"
    "- {behavior: FLY_FAST, task: FLY, suitability: 80, requires: [{task: SEE, "
    "minimum_performance: 50}]}\n"
    "- {behavior: LAND, task: LAND}\n"
    "- {behavior: SEE, task: SEE}\n"
    "exclusivity_constraints:\n"
    "- mutually_exclusive: [FLY, LAND]\n";

std::string replaced(std::string_view old, std::string_view by) {
  std::string result = robot;
  result.replace(result.find(old), old.size(), by);
  return result;
}

TEST(CatalogDiff, HasSituationVariablesAndConditions) {
  const std::string before =
      "situation:\n"
      "- {variable: TARGET, values: [far, near, 'by, the way']}\n"
      "- {variable: GPS}\n"
      "behaviors:\n"
      "- {behavior: SEE, task: SEE, situation: {TARGET: [far, near], GPS: true}}\n"
      "- {behavior: HEAR, task: HEAR, situation: {TARGET: near, GPS: false}}\n";
  const auto text_after = [&](std::string_view old, std::string_view by) {
    std::string after = before;
    after.replace(after.find(old), old.size(), by);
    return text_of(before, after);
  };
  EXPECT_EQ(text_after("[far, near],", "[near, far],"), "");
  EXPECT_EQ(text_after("[far, near, 'by, the way']", "[far, 'by, the way', near]"), "");
  EXPECT_EQ(text_after("[far, near, 'by, the way']", "[near, far, 'by, the way']"),
            "~ situation variable TARGET: initial value far -> near\n");
  EXPECT_EQ(text_after(", 'by, the way'", ""),
            "~ situation variable TARGET: values [far, near, 'by, the way'] -> [far, near]\n");
  EXPECT_EQ(text_after("variable: GPS", "variable: GPS, values: ['true', 'false']"),
            "~ behavior HEAR: situation GPS false -> [false]\n"
            "~ behavior SEE: situation GPS true -> [true]\n"
            "~ situation variable GPS: values none -> [true, false]\n");
  EXPECT_EQ(text_after("- {variable: GPS}\n", "- {variable: GPS}\n- {variable: WIND}\n"),
            "+ situation variable WIND\n");
  EXPECT_EQ(text_after("[far, near],", "far,"),
            "~ behavior SEE: situation TARGET [far, near] -> [far]\n");
  EXPECT_EQ(text_after(", situation: {TARGET: near, GPS: false}", ""),
            "~ behavior HEAR: situation GPS false -> any, situation TARGET [near] -> any\n");
}

TEST(CatalogDiff, WordsAreASetAndTwoNumbersARange) {
  const std::string before = replaced("[0, 30]", "[LEFT, RIGHT]");
  EXPECT_EQ(text_of(before, replaced("[0, 30]", "[RIGHT, LEFT]")), "");
  EXPECT_EQ(text_of(before, replaced("[0, 30]", "[RIGHT, LEFT, RIGHT]")), "");
  EXPECT_EQ(text_of(robot, replaced("[0, 30]", "[-5, 30]")),
            "~ task FLY: parameter speed [0, 30] -> [-5, 30]\n");
}

TEST(CatalogDiff, ValuesThatLookAlikeDiffer) {
  EXPECT_EQ(text_of(replaced("[0, 30]", "['LEFT, RIGHT']"), replaced("[0, 30]", "[LEFT, RIGHT]")),
            "~ task FLY: parameter speed ['LEFT, RIGHT'] -> [LEFT, RIGHT]\n");
  EXPECT_EQ(text_of(replaced("[0, 30]", "['A'', ''B', C]"), replaced("[0, 30]", "[A, B, C]")),
            "~ task FLY: parameter speed ['A'', ''B', C] -> [A, B, C]\n");
  EXPECT_EQ(text_of(replaced("[0, 30]", "point"), replaced("[0, 30]", "[point]")),
            "~ task FLY: parameter speed point -> [point]\n");
  EXPECT_EQ(text_of(replaced("[0, 30]", "['']"), replaced("[0, 30]", "[]")),
            "~ task FLY: parameter speed [''] -> any\n");
  EXPECT_EQ(text_of(replaced("[0, 30]", "[]"), replaced(", allowed_values: [0, 30]", "")), "");
}

/// A catalog of tasks T1000 up to T1000 + count - 1, of which at most one runs.
std::string exclusive(int count, bool with_list) {
  std::string behaviors = "behaviors:\n";
  std::string names;
  for (int number = 1000; number < 1000 + count; ++number) {
    const std::string name = "T" + std::to_string(number);
    behaviors.append("- {behavior: ").append(name).append(", task: ").append(name).append("}\n");
    names += (names.empty() ? "" : ", ") + name;
  }
  if (with_list) behaviors += "exclusivity_constraints:\n- mutually_exclusive: [" + names + "]\n";
  return behaviors;
}

TEST(CatalogDiff, CountsExclusionsThatAreTooManyToList) {
  const CompiledCatalog with = compiled(exclusive(600, true));
  const CompiledCatalog without = compiled(exclusive(600, false));
  constexpr std::uint64_t pairs = 600 * 599 / 2;
  for (const CatalogDiff& diff :
       {compare_catalogs(with, without), compare_catalogs(without, with)}) {
    EXPECT_EQ(diff.changes.size(), most_listed_exclusions);
    EXPECT_EQ(diff.size(), pairs);
  }
  const CatalogDiff none = compare_catalogs(with, with);
  EXPECT_EQ(none.size(), 0U);
  // One more task is in 600 more pairs, each of which is listed.
  const CatalogDiff one_more = compare_catalogs(with, compiled(exclusive(601, true)));
  EXPECT_EQ(one_more.further_exclusions, 0U);
  EXPECT_EQ(one_more.size(), 600U + 3U);
}

TEST(CatalogDiff, ListsTheSameExclusionsWhateverTheOrder) {
  const auto catalog = [](int first, int step) {
    std::string behaviors = "behaviors:\n";
    std::string lists = "exclusivity_constraints:\n";
    for (int place = 0; place < 1000; ++place) {
      const std::string name = "T" + std::to_string(first + step * place);
      behaviors.append("- {behavior: ").append(name).append(", task: ").append(name).append("}\n");
      lists += place % 500 == 0 ? "- mutually_exclusive:\n" : "";
      lists.append("  - ").append(name).append("\n");
    }
    return behaviors + lists;
  };
  const std::string none = exclusive(1000, false);
  const std::string up = catalog(1000, 1);
  const std::string down = catalog(1999, -1);
  ASSERT_GT(compare_catalogs(compiled(none), compiled(up)).further_exclusions, 0U);
  EXPECT_TRUE(text_of(none, up) == text_of(none, down));
  EXPECT_TRUE(text_of(up, none) == text_of(down, none));
}

/// As `cbc graph --diff --format text` has it. `given`: what --renamed says.
std::string people_text(const std::string& before, const std::string& after,
                        const std::vector<std::pair<std::string, std::string>>& given = {}) {
  const CompiledCatalog old_catalog = compiled(before);
  const CompiledCatalog new_catalog = compiled(after);
  Renames renames;
  for (const auto& [from, to] : given) {
    EXPECT_EQ(add_rename(old_catalog, new_catalog, from, to, renames), "");
  }
  renames = find_renames(old_catalog, new_catalog, renames);
  return diff_text(compare_catalogs(old_catalog, new_catalog, renames), plain_style()) +
         fitting_text(compare_fitting(old_catalog, new_catalog, renames), plain_style());
}

std::string with(std::string text, std::string_view old, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size()) {
    text.replace(at, old.size(), by);
  }
  return text;
}

const std::string rover =
    "situation:\n"
    "- {variable: DOOR, values: [open, closed]}\n"
    "behaviors:\n"
    "- {behavior: WHEELS, task: DRIVE, suitability: 90, situation: {DOOR: open}}\n"
    "- {behavior: TRACKS, task: DRIVE, suitability: 60}\n"
    "- {behavior: BRING, task: DELIVER, requires: [{task: DRIVE, minimum_performance: 50}]}\n"
    "- {behavior: BROOM, task: CLEAN}\n"
    "exclusivity_constraints:\n"
    "- mutually_exclusive: [DELIVER, CLEAN]\n";

TEST(CatalogDiff, SeesARenameAsOne) {
  EXPECT_EQ(people_text(rover, with(rover, "DRIVE", "MOVE")), "~ task DRIVE renamed to MOVE\n");
  EXPECT_EQ(people_text(rover, with(rover, "WHEELS", "FOUR_WHEELS")),
            "~ behavior WHEELS renamed to FOUR_WHEELS\n");
  EXPECT_EQ(people_text(rover, with(rover, "DOOR", "GATE")),
            "~ situation variable DOOR renamed to GATE\n");
  EXPECT_EQ(people_text(rover,
                        with(with(with(rover, "DRIVE", "MOVE"), "WHEELS", "FEET"), "DOOR", "GATE")),
            "~ task DRIVE renamed to MOVE\n"
            "~ behavior WHEELS renamed to FEET\n"
            "~ situation variable DOOR renamed to GATE\n");
}

TEST(CatalogDiff, SeesNoRenameOfAnotherContent) {
  EXPECT_EQ(people_text(rover, with(with(rover, "CLEAN", "WASH"), "BROOM, task: WASH",
                                    "BROOM, task: WASH, suitability: 80")),
            "- task CLEAN\n"
            "+ task WASH\n"
            "- BROOM performs CLEAN: suitability 100 %\n"
            "+ BROOM performs WASH: suitability 80 %\n"
            "- CLEAN excludes DELIVER\n"
            "+ DELIVER excludes WASH\n");
  // A new thing with the content of what is still there is new.
  EXPECT_EQ(people_text(rover, with(rover, "BROOM, task: CLEAN}\n",
                                    "BROOM, task: CLEAN}\n- {behavior: MOP, task: CLEAN}\n")),
            "+ behavior MOP\n"
            "+ MOP performs CLEAN: suitability 100 %\n");
}

TEST(CatalogDiff, DoesNotGuessWhichOfSeveralWasRenamed) {
  const std::string two = "behaviors:\n- {behavior: A, task: T}\n- {behavior: B, task: T}\n";
  EXPECT_EQ(people_text(two, with(with(two, "A", "C"), "B", "D")),
            "- behavior A\n- behavior B\n+ behavior C\n+ behavior D\n"
            "- A performs T: suitability 100 %\n- B performs T: suitability 100 %\n"
            "+ C performs T: suitability 100 %\n+ D performs T: suitability 100 %\n");
  EXPECT_EQ(people_text(two, with(with(two, "A", "C"), "B", "D"), {{"A", "D"}}),
            "~ behavior A renamed to D\n~ behavior B renamed to C\n");
}

TEST(CatalogDiff, TellsTheRestOfWhatWasRenamed) {
  EXPECT_EQ(
      people_text(rover, with(with(rover, "DRIVE", "MOVE"), "suitability: 90", "suitability: 80"),
                  {{"DRIVE", "MOVE"}}),
      "~ task DRIVE renamed to MOVE\n"
      "~ WHEELS performs MOVE: suitability 90 % -> 80 %\n");
}

TEST(CatalogDiff, ListsPerformancesByTheSituation) {
  EXPECT_EQ(people_text(rover, with(rover, "DOOR: open", "DOOR: closed")),
            "~ behavior WHEELS: situation DOOR [open] -> [closed]\n"
            "~ DRIVE in DOOR open: WHEELS 90 %, TRACKS 60 % -> TRACKS 60 %\n"
            "~ DRIVE in DOOR closed: TRACKS 60 % -> WHEELS 90 %, TRACKS 60 %\n");
  EXPECT_EQ(people_text(rover, with(rover, "[open, closed]", "[open, closed, ajar]")),
            "~ situation variable DOOR: values [open, closed] -> [open, closed, ajar]\n"
            "~ DRIVE in DOOR ajar: no such value -> TRACKS 60 %\n");
  EXPECT_EQ(people_text(rover, with(rover, "- {behavior: TRACKS, task: DRIVE, suitability: 60}\n",
                                    "- {behavior: LEGS, task: DRIVE, suitability: 60, situation: "
                                    "{DOOR: closed}}\n")),
            "+ behavior LEGS: situation DOOR [closed]\n"
            "- behavior TRACKS\n"
            "+ LEGS performs DRIVE: suitability 60 %\n"
            "- TRACKS performs DRIVE: suitability 60 %\n"
            "~ DRIVE in DOOR open: WHEELS 90 %, TRACKS 60 % -> WHEELS 90 %\n"
            "~ DRIVE in DOOR closed: TRACKS 60 % -> LEGS 60 %\n");
}

}  // namespace
}  // namespace cbc::catalog_diff_test
