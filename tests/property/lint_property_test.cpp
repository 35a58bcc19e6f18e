// Random catalogs in which much is impossible: the semantic rules of lint must find what brute
// force finds, and nothing else. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their
// number; the seed of a fault is printed, and CBC_SEED=<that> CBC_PROPERTY_CASES=1 repeats it
// alone.
#include <cstdint>
#include <exception>
#include <string>

#include <gtest/gtest.h>

#include "enumeration.h"
#include "lint_check.h"
#include "lint_findings.h"
#include "lint_generator.h"
#include "lint_oracle.h"
#include "random.h"
#include "random_cases.h"
#include "statistics.h"
#include "yaml_text.h"

namespace cbc::oracle::lint_property_test {
namespace {

constexpr std::uint64_t default_lint_cases = 5000;

void run_lint_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  const Catalog catalog = generate_strict_catalog(random);
  const std::string yaml = catalog_yaml(catalog, random);
  try {
    const CatalogFacts facts(catalog);
    const LintOracle oracle(facts);
    check_findings(oracle, lint_findings(oracle, yaml), results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

const LowerBound lint_lower_bounds[] = {
    {"exclusive-requirement", 150},
    {"conflicting-requirements", 30},
    {"unreachable-performance", 150},
    {"unreachable-performance of a task", 100},
    {"dead-behavior", 100},
    {"dead-behavior of several tasks", 8},
    {"dead-behavior: reason of 1", 50},
    {"dead-behavior: reason of 2", 40},
    {"dead-behavior: reason of 3", 25},
    {"dead-behavior: reason of 4", 15},
    {"dead-behavior: reason of 5 or more", 5},
    {"dead-task", 50},
    {"dead-task: reason of 1", 12},
    {"dead-task: reason of 2", 15},
    {"dead-task: reason of 3", 10},
    {"dead-task: reason of 4", 7},
    {"dead-task: reason of 5 or more", 4},
    {"dead behavior without a finding of its own", 500},
    {"dead task without a finding of its own", 350},
    {"redundant-requirement", 120},
    {"redundant-requirement with a minimum", 5},
    {"redundant-requirement: reason of 2", 90},
    {"redundant-requirement: reason of 3", 50},
    {"redundant-requirement: reason of 4", 15},
    {"redundant-requirement: reason of 5 or more", 2},
    {"redundant-requirement: repeated", 120},
    {"requires-on-request", 350},
    {"requires-on-request: more than one request", 90},
    {"nothing is dead", 200},
};

TEST(LintProperty, SameFindingsAsBruteForce) {
  run_random_cases(default_lint_cases, run_lint_case, lint_lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::lint_property_test
