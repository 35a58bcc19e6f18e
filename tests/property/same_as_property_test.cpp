// Comparisons of random small catalogs, and of those in catalogs/, with themselves, other forms of
// themselves, and changed ones, against a plain search over pairs of states. CBC_SEED and
// CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "catalog_changes.h"
#include "compiled_text.h"
#include "demand.h"
#include "plain_comparison.h"
#include "plain_exploration.h"
#include "question_generator.h"
#include "random.h"
#include "random_cases.h"
#include "script_run.h"
#include "support/read_file.h"
#include "verify_case.h"
#include "versions/lockstep/same_as.h"
#include "yaml_text.h"

namespace cbc::plain::same_as_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 500;
constexpr std::uint64_t most_states = 400;

struct PairCase {
  VerifyCase sample;  ///< the new one
  std::string old_yaml;
  CompiledCatalog old_catalog;
  Assumptions assumptions;
  std::string change;  ///< empty: both mean the same
  PlainRenames renames;
  bool allow_missing = false;
};

/// What both catalogs call differently, where exactly one name of a kind is in each catalog alone,
/// and renames it.
PlainRenames find_renames(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog) {
  using Names = std::set<std::string>;
  const auto rename = [](const Names& of_old, const Names& of_new, auto& renames) {
    Names lost;
    Names added;
    std::set_difference(of_old.begin(), of_old.end(), of_new.begin(), of_new.end(),
                        std::inserter(lost, lost.end()));
    std::set_difference(of_new.begin(), of_new.end(), of_old.begin(), of_old.end(),
                        std::inserter(added, added.end()));
    if (lost.size() == 1 && added.size() == 1) renames[*lost.begin()] = *added.begin();
  };
  const auto names_of = [](const Texts& texts) {
    Names names;
    for (const std::string_view text : texts) names.emplace(text);
    return names;
  };
  const auto variables_of = [](const CompiledCatalog& catalog) {
    Names names;
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      names.emplace(catalog.name_of_variable(variable));
    }
    return names;
  };
  PlainRenames renames;
  rename(names_of(old_catalog.task_names), names_of(new_catalog.task_names), renames.tasks);
  rename(names_of(old_catalog.behavior_names), names_of(new_catalog.behavior_names),
         renames.behaviors);
  rename(variables_of(old_catalog), variables_of(new_catalog), renames.variables);
  return renames;
}

Renames renames_of(const PairCase& pair) {
  Renames renames;
  for (const auto* names :
       {&pair.renames.tasks, &pair.renames.behaviors, &pair.renames.variables}) {
    for (const auto& [from, to] : *names) {
      const std::string fault =
          add_rename(pair.old_catalog, pair.sample.catalog, from, to, renames);
      demand(fault.empty(), fault);
    }
  }
  return renames;
}

PairCase generate_pair(std::uint64_t seed) {
  PairCase pair;
  pair.sample = generate_verify_case(seed);
  VerifyCase& sample = pair.sample;
  Random random(~seed);
  if (random.percent(20) || sample.source.behaviors.empty()) {
    const bool is_form = random.percent(70);
    pair.old_yaml =
        is_form ? oracle::catalog_yaml(rewrite(sample.source, random), random) : sample.yaml;
    pair.old_catalog = oracle::compile_yaml(pair.old_yaml).value();
  } else {
    for (;;) {
      oracle::Catalog changed = sample.source;
      if (random.percent(15)) {
        pair.change = remove_task(changed, random) ? "task removed" : "";
      } else {
        pair.change = change_one(changed, random);
      }
      if (pair.change.empty()) continue;
      pair.old_yaml = oracle::catalog_yaml(changed, random);
      auto compiled = oracle::compile_yaml(pair.old_yaml);
      if (!compiled) continue;
      pair.old_catalog = std::move(*compiled);
      break;
    }
    if (random.percent(50)) {
      std::swap(pair.old_yaml, sample.yaml);
      std::swap(pair.old_catalog, sample.catalog);
      sample.question = generate_question(random, sample.catalog);
    }
  }
  if (random.percent(50)) pair.renames = find_renames(pair.old_catalog, sample.catalog);
  pair.allow_missing = random.percent(50);
  pair.assumptions = random.percent(30)
                         ? common_assumptions(pair.old_catalog, sample.catalog, renames_of(pair))
                         : sample.question.assumptions;
  return pair;
}

CatalogComparison compare_with(
    const PairCase& pair, unsigned jobs,
    ComparisonScope::Differences differences = ComparisonScope::Differences::all,
    std::uint64_t max_states_of_groups = 0) {
  ExplorationOptions options;
  options.jobs = jobs;
  options.budget.max_states = max_states_of_groups;
  ComparisonScope scope;
  scope.differences = differences;
  scope.renames = renames_of(pair);
  scope.allow_missing = pair.allow_missing;
  return compare_catalogs(pair.old_catalog, pair.sample.catalog, pair.assumptions, options, scope);
}

const std::vector<Move>& moves_of(const CatalogComparison& result) {
  static const std::vector<Move> no_moves;
  const EventDifference* const first = result.first_difference();
  return first == nullptr ? no_moves : first->moves;
}

std::string answer_text(const PairCase& pair, bool differs, const std::vector<Move>& moves) {
  return differs ? "a difference after\n" + text_of(pair.sample.catalog, moves) : "no difference\n";
}

std::vector<TaskId> all_tasks(const CompiledCatalog& catalog) {
  return {catalog.task_ids.begin(), catalog.task_ids.end()};
}

std::vector<std::string> named(const CompiledCatalog& catalog, const ScriptRun& run) {
  std::vector<std::string> lines;
  for (const Happening& one : run.happenings) lines.push_back(named(catalog, one));
  return lines;
}

/// Whether only one catalog has a task that starts by itself, which it does in a script.
bool has_missing_starts(const CompiledCatalog& catalog, const std::vector<std::string>& missing) {
  return std::any_of(catalog.task_ids.begin(), catalog.task_ids.end(), [&](TaskId task) {
    return catalog.tasks[task].reactive_start != 0 &&
           oracle::contains(missing, "task " + std::string(catalog.name_of_task(task)));
  });
}

/// Both catalogs can read the scripts. They must end as they say with the new one, and the old one
/// must do something else.
void check_scripts(const PairCase& pair, const CatalogComparison& result) {
  const CompiledCatalog& catalog = pair.sample.catalog;
  for (const GroupComparison& groups : result.groups) {
    for (const EventDifference& difference : groups.differences) {
      const std::string& text = difference.witness.text;
      const std::string& old_text = difference.old_text.value_or(text);
      const ScriptRun of_new = run_text(catalog, text, all_tasks(catalog));
      const ScriptRun of_old = run_text(pair.old_catalog, old_text, all_tasks(pair.old_catalog));
      demand(pair.renames.tasks.empty() && pair.renames.behaviors.empty() &&
                     pair.renames.variables.empty()
                 ? !difference.old_text
                 : true,
             "two scripts without a rename");
      if (has_missing_starts(catalog, result.names.only_new) ||
          has_missing_starts(pair.old_catalog, result.names.only_old)) {
        continue;
      }
      demand(of_new.failures.empty(), "the new catalog does something else after\n" + text);
      demand(named(catalog, of_new) != named(pair.old_catalog, of_old),
             "no difference is seen in\n" + text);
    }
  }
}

/// The differences of each task against those in which it runs otherwise.
void check_tasks(const PairCase& pair, const CatalogComparison& result,
                 const PlainComparison& expected) {
  std::map<std::string, const EventDifference*> found;
  for (const GroupComparison& groups : result.groups) {
    for (const EventDifference& difference : groups.differences) {
      demand(!difference.tasks.empty(), "a difference of no task");
      for (const TaskDifference& task : difference.tasks) {
        demand(found.emplace(task.task, &difference).second, task.task + " stands twice");
        if (task.aspect != TaskDifference::Aspect::running) continue;
        const auto plain = expected.running.find(task.task);
        demand(plain != expected.running.end(), task.task + " runs alike");
        demand(plain->second == difference.moves,
               task.task + " runs otherwise after\n" + text_of(pair.sample.catalog, plain->second) +
                   "and not only after\n" + text_of(pair.sample.catalog, difference.moves));
      }
    }
  }
  for (const auto& [task, moves] : expected.running) {
    demand(found.contains(task), "nothing is said of " + task);
    demand(found[task]->moves.size() <= moves.size(), task + " differs earlier");
  }
}

/// The behaviors that only one catalog has and that can be active in it, by its states; and the
/// tasks that can be requested.
void check_missing(const CompiledCatalog& catalog, const Assumptions& assumptions,
                   const std::vector<std::string>& missing, const CatalogComparison& result) {
  const auto is_said = [&](const std::string& line) {
    return std::any_of(result.direct.begin(), result.direct.end(),
                       [&](const DirectDifference& one) { return one.line == line; });
  };
  const std::string only = " in " + std::string(catalog.file) + " only";
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    const Exploration explored = explore_plainly(catalog, {group}, assumptions, {}, most_states);
    if (!explored.complete) continue;
    for (const BehaviorId behavior : catalog.behavior_ids) {
      const std::string name = "behavior " + std::string(catalog.name_of_behavior(behavior));
      if (catalog.group_of(behavior) != group) continue;
      const bool is_active =
          std::any_of(explored.active.begin(), explored.active.end(), [&](const auto& active) {
            return active.first == catalog.behaviors[behavior].catalog_index;
          });
      demand(
          is_said(name + " can be active" + only) == (is_active && oracle::contains(missing, name)),
          name + " can be active, or not");
    }
  }
  for (const TaskId task : catalog.task_ids) {
    const std::string name = "task " + std::string(catalog.name_of_task(task));
    const bool can_start = std::any_of(assumptions.start.begin(), assumptions.start.end(),
                                       [&](const auto& start) { return start.task == task; });
    demand(is_said(name + " can be requested" + only) ==
               (can_start && oracle::contains(missing, name)),
           name + " can be requested, or not");
  }
}

/// A search that a limit ends must find what the whole one finds at the depths that it searched.
void check_limited(const PairCase& pair, const CatalogComparison& whole,
                   oracle::Statistics& statistics) {
  const CatalogComparison limited = compare_with(pair, 2, ComparisonScope::Differences::all,
                                                 std::max<std::uint64_t>(2, whole.states / 3));
  demand(limited.groups.size() == whole.groups.size(), "a limit takes groups");
  for (std::size_t place = 0; place < whole.groups.size(); ++place) {
    const GroupComparison& part = limited.groups[place];
    std::size_t next = 0;
    for (const EventDifference& difference : whole.groups[place].differences) {
      const bool is_searched =
          (!part.end || part.depth > 0) && difference.moves.size() <= part.depth + 1;
      const bool is_found = next < part.differences.size() &&
                            part.differences[next].witness.text == difference.witness.text;
      if (is_found) ++next;
      demand(is_found || !is_searched, "a limit hides a difference");
    }
    demand(next == part.differences.size(), "a limit adds a difference");
    if (part.end && next > 0) statistics.count("difference before a limit");
  }
}

void compare(const PairCase& pair, oracle::Statistics& statistics) {
  PlainScope scope;
  scope.renames = pair.renames;
  scope.allow_missing = pair.allow_missing;
  const PlainComparison expected =
      compare_plainly(pair.old_catalog, pair.sample.catalog, pair.assumptions, most_states, scope);
  if (!expected.is_complete) return statistics.count("too many states");
  const CatalogComparison result = compare_with(pair, 1);
  if (result.error && !expected.has_error) return statistics.count("excluded without the other");
  demand(result.error.has_value() == expected.has_error, "error or not");
  if (expected.has_error) return statistics.count("excluded first state");
  const bool differs = result.explored == Verdict::Result::violated;
  const std::string found = answer_text(pair, differs, moves_of(result));
  const std::string wanted = answer_text(pair, expected.differs, expected.moves);
  demand(found == wanted, found + "--- but the plain search finds " + wanted);
  demand(differs || result.explored == Verdict::Result::proved, "undecided");
  demand(differs || result.is_compared == expected.is_compared, "compared or not");
  check_limited(pair, result, statistics);
  const CatalogComparison other = compare_with(pair, 3);
  demand(other.result == result.result && moves_of(other) == moves_of(result), "3 jobs, and not 1");
  for (const CatalogComparison* one : {&result, &other}) {
    demand(one->states == expected.states,
           "states: " + std::to_string(one->states) + ", not " + std::to_string(expected.states));
    demand(one->transitions == expected.transitions,
           "transitions: " + std::to_string(one->transitions) + ", not " +
               std::to_string(expected.transitions));
    demand(one->depth == expected.depth, "depth");
    check_tasks(pair, *one, expected);
  }
  if (!pair.allow_missing) {
    check_missing(pair.sample.catalog, pair.assumptions, result.names.only_new, result);
  }
  const bool is_answer = differs || !result.direct.empty() || !result.is_compared;
  demand(is_answer == (result.result != Verdict::Result::proved),
         "proved in spite of a difference");
  if (!result.direct.empty()) statistics.count("direct difference");
  if (!result.names.renamed.empty() && !differs) statistics.count("renamed, and alike");
  if (pair.change == "task removed" && !differs) statistics.count("alike without a task");
  if (result.result == Verdict::Result::proved && !result.names.only_old.empty()) {
    statistics.count("allowed to be missing");
  }
  if (!result.is_compared) statistics.count("nothing compared");
  if (differs) {
    demand(!pair.change.empty(), "forms that mean the same differ: " + found);
    check_scripts(pair, result);
    demand(other.first_difference()->witness.text == result.first_difference()->witness.text,
           "another script by 3 jobs");
    statistics.count("difference by " + pair.change);
    statistics.count("difference");
    if (moves_of(result).size() > 2) statistics.count("difference after two moves");
    if (moves_of(result).back().kind == Move::Kind::due) statistics.count("difference when due");
    return;
  }
  statistics.count(pair.change.empty() ? "same meaning" : "no difference by a change");
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  PairCase pair;
  try {
    pair = generate_pair(seed);
    compare(pair, results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + ", " + pair.change +
                                        "\n--- new catalog\n" + text_of(pair.sample) +
                                        "--- old catalog\n" + pair.old_yaml + "--- fault\n" +
                                        error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"same meaning", 100},
    {"no difference by a change", 150},
    {"difference", 200},
    {"difference after two moves", 15},
    {"difference when due", 10},
    {"difference before a limit", 70},
    {"difference by suitability", 4},
    {"difference by minimum of a requirement", 2},
    {"difference by minimum of a task", 4},
    {"difference by exclusivity", 4},
    {"difference by requirement", 4},
    {"difference by start_on_request", 4},
    {"difference by reactive_start", 4},
    {"difference by situation", 4},
    {"difference by initial value", 1},
    {"difference by name", 4},
    {"difference by behavior removed", 4},
    {"difference by order of behaviors", 2},
    {"difference by task removed", 4},
    {"direct difference", 30},
    {"renamed, and alike", 5},
    {"alike without a task", 5},
    {"allowed to be missing", 3},
    {"nothing compared", 3},
};

TEST(SameAs, FindsWhatThePlainSearchFinds) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

TEST(SameAs, ACatalogDecidesAsItself) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CBC_SOURCE_DIR "/catalogs")) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".yaml" || path.stem().has_extension()) continue;
    SCOPED_TRACE(path.filename().string());
    const CompiledCatalog catalog = oracle::compile_yaml(test::read_file(path)).value();
    ExplorationOptions options;
    options.budget.max_states = 4'000;
    const CatalogComparison result =
        compare_catalogs(catalog, catalog, common_assumptions(catalog, catalog), options);
    EXPECT_NE(result.result, Verdict::Result::violated);
    if (result.result == Verdict::Result::proved) ++count;
  }
  EXPECT_GE(count, 2U);
}

// A robot of real size, which single states were too many for: 556,462 pairs. Counting the turns of
// the wheels may do with a worse measurement of motion, which shows where all other ways to
// localize are faulty or do not fit.
TEST(SameAs, FindsALateDifferenceOfALargeRobotWithFaults) {
  const std::string old_yaml = test::read_file(CBC_SOURCE_DIR "/catalogs/hospital.yaml");
  std::string new_yaml = old_yaml;
  const std::string before = "minimum_performance: 80";
  const std::size_t behavior = new_yaml.find("- behavior: COUNT_TURNS_OF_WHEELS");
  ASSERT_NE(behavior, std::string::npos);
  const std::size_t minimum = new_yaml.find(before, behavior);
  ASSERT_NE(minimum, std::string::npos);
  new_yaml.replace(minimum, before.size(), "minimum_performance: 60");
  PairCase pair;
  pair.old_catalog = oracle::compile_yaml(old_yaml).value();
  pair.sample.catalog = oracle::compile_yaml(new_yaml).value();
  const CompiledCatalog& catalog = pair.sample.catalog;
  const auto task = [&](const char* name) { return catalog.task_ids[*catalog.find_task(name)]; };
  pair.assumptions = common_assumptions(pair.old_catalog, catalog);
  pair.assumptions.start = {{task("DELIVER"), {1}}, {task("CHARGE"), {2}}};
  pair.assumptions.faults = 1;
  const CatalogComparison result = compare_with(pair, 2);
  EXPECT_EQ(result.result, Verdict::Result::violated);
  EXPECT_FALSE(result.end);
  EXPECT_EQ(text_of(catalog, moves_of(result)),
            "  fault MATCH_SCANS\n  start DELIVER 1\n  PLACE = ward\n  NETWORK = false\n"
            "  LIGHT = dark\n  failure WHEELS_AND_GYROSCOPE\n");
  EXPECT_NO_THROW(check_scripts(pair, result));
  pair.sample.catalog = pair.old_catalog;
  const CatalogComparison same = compare_with(pair, 2);
  EXPECT_EQ(same.result, Verdict::Result::proved);
  EXPECT_EQ(same.states, 556'462U);
}

/// Z needs the last five of eight tasks that start on request only, and the order of its behaviors
/// differs.
std::string late_difference(const std::string& behaviors_of_z) {
  std::string text = "behaviors:\n";
  for (int i = 1; i <= 8; ++i) {
    const std::string name = "A" + std::to_string(i);
    text += "- {behavior: " + name + "_BY, task: " + name + "}\n";
  }
  for (const char letter : behaviors_of_z) {
    text += std::string("- {behavior: Z_BY_") + letter +
            ", task: Z, requires: [{task: A4}, {task: A5}, {task: A6}, {task: A7}, {task: A8}]}\n";
  }
  return text + "exclusivity_constraints:\n- mutually_exclusive: [Z, A1]\n" +
         "- mutually_exclusive: [Z, A2]\n- mutually_exclusive: [Z, A3]\n";
}

// Thousands of states come before it, and every order of the five starts leads to one.
TEST(SameAs, TheFirstDifferenceDoesNotDependOnTheNumberOfJobs) {
  PairCase pair;
  pair.old_catalog = oracle::compile_yaml(late_difference("ab")).value();
  pair.sample.catalog = oracle::compile_yaml(late_difference("ba")).value();
  pair.assumptions = common_assumptions(pair.old_catalog, pair.sample.catalog);
  std::vector<Move> expected;
  for (const std::uint32_t task : {3U, 4U, 5U, 6U, 7U, 8U}) {
    expected.push_back({Move::Kind::start, task, 1});
  }
  for (const unsigned jobs : {1U, 2U, 2U, 2U, 2U, 5U, 5U}) {
    const CatalogComparison result =
        compare_with(pair, jobs, ComparisonScope::Differences::expectable);
    EXPECT_EQ(result.result, Verdict::Result::violated);
    EXPECT_EQ(moves_of(result), expected);
    EXPECT_GT(result.states, 1000U);
    EXPECT_NO_THROW(check_scripts(pair, result));
  }
}

}  // namespace
}  // namespace cbc::plain::same_as_property_test
