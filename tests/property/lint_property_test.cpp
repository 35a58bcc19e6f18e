// Random catalogs in which much is impossible: the semantic rules of lint must find what brute
// force finds, and nothing else. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their
// number; the seed of a fault is printed, and CBC_SEED=<that> CBC_PROPERTY_CASES=1 repeats it
// alone.
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

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

struct Sample {
  Catalog catalog;
  std::string yaml;
};

Sample make_sample(std::uint64_t seed) {
  Random random(seed);
  Sample sample;
  sample.catalog = generate_strict_catalog(random);
  sample.yaml = catalog_yaml(sample.catalog, random);
  return sample;
}

void run_lint_case(std::uint64_t seed, Results& results) {
  const Sample sample = make_sample(seed);
  try {
    const CatalogFacts facts(sample.catalog);
    const LintOracle oracle(facts);
    check_findings(oracle, lint_findings(oracle, sample.yaml), results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        sample.yaml + "--- fault\n" + error.what() + "\n"});
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
    {"redundant-requirement: reason of 5 or more", 4},
    {"redundant-requirement: repeated", 120},
    {"redundant-minimum", 100},
    {"redundant-minimum of a task", 50},
    {"requires-on-request", 350},
    {"requires-on-request: more than one request", 90},
    {"nothing is dead", 200},
};

void expect_fault(const LintOracle& oracle, const Findings& wrong, const std::string& what) {
  Statistics statistics;
  EXPECT_THROW(check_findings(oracle, wrong, statistics), std::runtime_error) << what;
}

// Findings with one left out, or with another reason, must not pass.
template <typename Key, typename Value>
void expect_faults(const LintOracle& oracle, const Findings& findings,
                   std::map<Key, Value> Findings::*part, const std::function<void(Value&)>& spoil,
                   const std::string& what) {
  for (const auto& [key, value] : findings.*part) {
    Findings wrong = findings;
    (wrong.*part).erase(key);
    expect_fault(oracle, wrong, what + ": one less");
    wrong = findings;
    spoil((wrong.*part)[key]);
    expect_fault(oracle, wrong, what + ": spoiled");
  }
}

TEST(LintProperty, CheckSeesWhatIsWrong) {
  constexpr std::uint64_t cases = 150;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    const Sample sample = make_sample(seed);
    const CatalogFacts facts(sample.catalog);
    const LintOracle oracle(facts);
    const Findings findings = lint_findings(oracle, sample.yaml);
    const std::string at = " of seed " + std::to_string(seed);

    const std::function<void(ConstraintSet&)> leave_out = [](ConstraintSet& reason) {
      reason &= reason - 1;
    };
    const std::function<void(std::string&)> round_up = [](std::string& best) { best += "1"; };
    const std::function<void(std::vector<std::size_t>&)> forget = [](auto& requests) {
      requests.erase(requests.begin());
      if (requests.empty()) requests.push_back(none);
    };
    expect_faults(oracle, findings, &Findings::dead_tasks, leave_out, "dead-task" + at);
    expect_faults(oracle, findings, &Findings::dead_behaviors, leave_out, "dead-behavior" + at);
    expect_faults(oracle, findings, &Findings::redundant, leave_out, "redundant-requirement" + at);
    for (const auto& [entry, minimum] : findings.redundant_minimums) {
      Findings wrong = findings;
      wrong.redundant_minimums.erase(entry);
      expect_fault(oracle, wrong, "redundant-minimum" + at + ": one less");
    }
    expect_faults(oracle, findings, &Findings::unreachable, round_up, "unreachable" + at);
    expect_faults(oracle, findings, &Findings::unreachable_minimums, round_up,
                  "unreachable minimum" + at);
    expect_faults(oracle, findings, &Findings::on_request, forget, "requires-on-request" + at);
  }
}

TEST(LintProperty, SameFindingsAsBruteForce) {
  run_random_cases(default_lint_cases, run_lint_case, lint_lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::lint_property_test
