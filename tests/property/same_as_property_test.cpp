// Comparisons of random small catalogs, and of those in catalogs/, with themselves, other forms of
// themselves, and changed ones, against a plain search over pairs of states. CBC_SEED and
// CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "catalog_changes.h"
#include "compiled_text.h"
#include "demand.h"
#include "plain_comparison.h"
#include "question_generator.h"
#include "random.h"
#include "random_cases.h"
#include "script_run.h"
#include "support/read_file.h"
#include "verify/engine/same_as.h"
#include "verify_case.h"
#include "yaml_text.h"

namespace cbc::plain::same_as_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 500;
constexpr std::uint64_t most_states = 700;

struct PairCase {
  VerifyCase sample;  ///< the new one
  std::string old_yaml;
  CompiledCatalog old_catalog;
  Assumptions assumptions;
  std::string change;  ///< empty: both mean the same
};

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
      pair.change = change_one(changed, random);
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
  pair.assumptions = random.percent(30) ? common_assumptions(pair.old_catalog, sample.catalog)
                                        : sample.question.assumptions;
  return pair;
}

CatalogComparison compare_with(const PairCase& pair, unsigned jobs) {
  ExplorationOptions options;
  options.jobs = jobs;
  return compare_catalogs(pair.old_catalog, pair.sample.catalog, pair.assumptions, options);
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

/// The script must end as it says with the new catalog, and the old one must do something else.
void check_witness(const PairCase& pair, const CatalogComparison& result) {
  demand(result.witness.has_value(), "no script");
  const std::string& text = result.witness->text;
  const CompiledCatalog& catalog = pair.sample.catalog;
  const ScriptRun of_new = run_text(catalog, text, all_tasks(catalog));
  demand(of_new.failures.empty(), "the new catalog does something else after\n" + text);
  // The expectation names what only the new one has.
  if (!result.names.only_new.empty()) return;
  const ScriptRun of_old = run_text(pair.old_catalog, text, all_tasks(pair.old_catalog));
  demand(named(catalog, of_new) != named(pair.old_catalog, of_old),
         "no difference is seen in\n" + text);
}

void compare(const PairCase& pair, oracle::Statistics& statistics) {
  const PlainComparison expected =
      compare_plainly(pair.old_catalog, pair.sample.catalog, pair.assumptions, most_states);
  if (!expected.is_complete) return statistics.count("too many states");
  const CatalogComparison result = compare_with(pair, 1);
  demand(result.error.has_value() == expected.has_error, "error or not");
  if (expected.has_error) return statistics.count("excluded first state");
  const bool differs = result.result == Verdict::Result::violated;
  const std::string found = answer_text(pair, differs, result.moves);
  const std::string wanted = answer_text(pair, expected.differs, expected.moves);
  demand(found == wanted, found + "--- but the plain search finds " + wanted);
  demand(differs || result.result == Verdict::Result::proved, "undecided");
  const CatalogComparison other = compare_with(pair, 3);
  demand(other.result == result.result && other.moves == result.moves, "3 jobs, and not 1");
  if (differs) {
    demand(!pair.change.empty(), "forms that mean the same differ: " + found);
    check_witness(pair, result);
    demand(other.witness->text == result.witness->text, "another script by 3 jobs");
    statistics.count("difference by " + pair.change);
    statistics.count("difference");
    if (result.moves.size() > 2) statistics.count("difference after two moves");
    if (result.moves.back().kind == Move::Kind::due) statistics.count("difference when due");
    return;
  }
  for (const CatalogComparison* one : {&result, &other}) {
    demand(one->states == expected.states,
           "states: " + std::to_string(one->states) + ", not " + std::to_string(expected.states));
    demand(one->transitions == expected.transitions,
           "transitions: " + std::to_string(one->transitions) + ", not " +
               std::to_string(expected.transitions));
    demand(one->depth == expected.depth, "depth");
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
    {"difference by suitability", 4},
    {"difference by minimum of a requirement", 2},
    {"difference by minimum of a task", 4},
    {"difference by exclusivity", 4},
    {"difference by requirement", 4},
    {"difference by start_on_request", 4},
    {"difference by reactive_start", 4},
    {"difference by situation", 4},
    {"difference by initial value", 2},
    {"difference by name", 4},
    {"difference by behavior removed", 4},
    {"difference by order of behaviors", 2},
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
    options.limits.max_states = 4'000;
    const CatalogComparison result =
        compare_catalogs(catalog, catalog, common_assumptions(catalog, catalog), options);
    EXPECT_NE(result.result, Verdict::Result::violated);
    if (result.result == Verdict::Result::proved) ++count;
  }
  EXPECT_GE(count, 2U);
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
    const CatalogComparison result = compare_with(pair, jobs);
    EXPECT_EQ(result.result, Verdict::Result::violated);
    EXPECT_EQ(result.moves, expected);
    EXPECT_GT(result.states, 1000U);
    EXPECT_NO_THROW(check_witness(pair, result));
  }
}

}  // namespace
}  // namespace cbc::plain::same_as_property_test
