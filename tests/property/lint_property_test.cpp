// Random catalogs in which much is impossible: the semantic rules of lint must find what brute
// force finds, and nothing else. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their
// number; the seed of a fault is printed, and CBC_SEED=<that> CBC_PROPERTY_CASES=1 repeats it
// alone.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "enumeration.h"
#include "lint_check.h"
#include "lint_findings.h"
#include "lint_generator.h"
#include "lint_oracle.h"
#include "random.h"
#include "statistics.h"
#include "yaml_text.h"

namespace cbc::oracle {
namespace {

constexpr std::uint64_t default_seed = 1;
constexpr std::uint64_t default_cases = 5000;
constexpr std::uint64_t cases_for_statistics = 500;  // fewer say nothing about how often
constexpr std::size_t faults_shown = 3;
constexpr std::uint64_t worker_count = 2;

std::uint64_t environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::strtoull(value, nullptr, 0);
}

struct Fault {
  std::uint64_t seed = 0;
  std::string report;
};

struct Results {
  Statistics statistics;
  std::vector<Fault> faults;
};

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

void run_case(std::uint64_t seed, Results& results) {
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

// Every worker takes each worker_count-th case, and stops by itself, so the answer does not depend
// on which is faster.
Results run_share(std::uint64_t first_seed, std::uint64_t cases, std::uint64_t worker) {
  Results results;
  for (std::uint64_t i = worker; i < cases && results.faults.size() < faults_shown;
       i += worker_count) {
    run_case(first_seed + i, results);
  }
  return results;
}

Results run_all(std::uint64_t first_seed, std::uint64_t cases) {
  std::vector<Results> shares(worker_count);
  std::vector<std::thread> workers;
  for (std::uint64_t worker = 0; worker < worker_count; ++worker) {
    workers.emplace_back([&shares, first_seed, cases, worker] {
      shares[worker] = run_share(first_seed, cases, worker);
    });
  }
  Results all;
  for (std::uint64_t worker = 0; worker < worker_count; ++worker) {
    workers[worker].join();
    all.statistics.merge(shares[worker].statistics);
    for (Fault& fault : shares[worker].faults) all.faults.push_back(std::move(fault));
  }
  std::sort(all.faults.begin(), all.faults.end(),
            [](const Fault& a, const Fault& b) { return a.seed < b.seed; });
  return all;
}

// How often something has to happen in 1000 cases for the comparison to mean anything.
struct LowerBound {
  const char* what;
  std::int64_t per_thousand;
};

const LowerBound lower_bounds[] = {
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
    {"redundant-requirement with a minimum", 50},
    {"redundant-requirement: reason of 2", 90},
    {"redundant-requirement: reason of 3", 50},
    {"redundant-requirement: reason of 4", 15},
    {"redundant-requirement: reason of 5 or more", 4},
    {"redundant-requirement: repeated", 120},
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
  for (std::uint64_t seed = default_seed; seed < default_seed + cases; ++seed) {
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
    expect_faults(oracle, findings, &Findings::unreachable, round_up, "unreachable" + at);
    expect_faults(oracle, findings, &Findings::unreachable_minimums, round_up,
                  "unreachable minimum" + at);
    expect_faults(oracle, findings, &Findings::on_request, forget, "requires-on-request" + at);
  }
}

TEST(LintProperty, SameFindingsAsBruteForce) {
  const std::uint64_t seed = environment("CBC_SEED", default_seed);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", default_cases);
  std::cout << "CBC_SEED=" << seed << " CBC_PROPERTY_CASES=" << cases << std::endl;

  const Results results = run_all(seed, cases);
  const std::size_t shown = std::min(results.faults.size(), faults_shown);
  for (std::size_t i = 0; i < shown; ++i) ADD_FAILURE() << results.faults[i].report;
  for (const auto& [what, times] : results.statistics.all()) {
    std::cout << "  " << times << "  " << what << "\n";
  }
  if (!results.faults.empty() || cases < cases_for_statistics) return;
  for (const LowerBound& bound : lower_bounds) {
    const std::int64_t needed = bound.per_thousand * static_cast<std::int64_t>(cases) / 1000;
    EXPECT_GE(results.statistics.of(bound.what), needed) << "too rare: " << bound.what;
  }
}

}  // namespace
}  // namespace cbc::oracle
