// Random catalogs and scripts: the implementation must give the same events as the oracle, in every
// field. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their number; the seed of a
// difference is printed, and CBC_SEED=<that> CBC_PROPERTY_CASES=1 repeats it alone.
#include <cstdint>
#include <exception>
#include <string>

#include <gtest/gtest.h>

#include "event_case.h"
#include "generator.h"
#include "random_cases.h"
#include "subject.h"
#include "yaml_text.h"

namespace cbc::oracle::property_test {
namespace {

constexpr std::uint64_t default_event_cases = 3000;

void run_event_case(std::uint64_t seed, Results& results) {
  Random forms(~seed);
  if (const auto fault = find_fault(generate_case(seed), forms, &results.statistics)) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n" + *fault});
  }
}

const LowerBound event_lower_bounds[] = {
    {"outcome: accepted", 5000},
    {"outcome: rejected", 1000},
    {"outcome: unchanged", 1000},
    {"origin: script", 5000},
    {"origin: timeout", 500},
    {"origin: reactive", 300},
    {"origin: fault", 100},
    {"origin: situation", 150},
    {"finish: goal_achieved", 200},
    {"finish: situation_change", 200},
    {"finish: time_out", 500},
    {"finish: wrong_progress", 100},
    {"finish: process_failure", 200},
    {"finish: interrupted", 100},
    {"finish of an inactive behavior, origin script", 50},
    {"finish of an inactive behavior, origin fault", 8},
    {"activate: requested", 3000},
    {"activate: reactive", 300},
    {"activate: required", 800},
    {"activate: restarted", 300},
    {"activate: undone", 200},
    {"activated for two or more tasks", 100},
    {"activated for two or more tasks: restarted", 10},
    {"due at the instant of a scripted event", 500},
    {"due at the instant of another that was due", 100},
    {"activation failed: requested", 500},
    {"activation failed: reactive", 50},
    {"activation failed: required", 150},
    {"activation failed: restarted", 80},
    {"activation failed: undone", 100},
    {"deactivate: requested", 200},
    {"deactivate: replaced", 300},
    {"deactivate: displaced", 300},
    {"deactivate: released", 200},
    {"deactivate: restarted", 300},
    {"deactivate: undone", 50},
    {"escalation: 0", 1000},
    {"escalation: 1", 30},
    {"escalation: 2", 20},
    {"escalation: 3 or more", 15},
    {"decided by: f1, number of requests", 1000},
    {"decided by: f1, order of requests", 12},
    {"decided by: f2, suitability", 2000},
    {"decided by: f3, idle tasks", 800},
    {"decided by: f4, changes", 800},
    {"decided by: canonical order", 600},
    {"performance: exactly its minimum", 800},
    {"performance: exactly its minimum, a true product", 50},
    {"rejected and taken back", 200},
    {"rejected by the priority of its own request: start", 100},
    {"rejected by the priority of its own request: stop", 20},
    {"reactive start: accepted", 200},
    {"reactive start: rejected", 60},
    {"reactive start: dropped", 40},
    {"finish by task", 250},
    {"finish by task, not running", 15},
    {"situation: variables change", 500},
    {"situation: several variables change", 80},
    {"situation: variables and behaviors", 200},
    {"situation: available because it fits", 500},
    {"situation: replaced by an earlier finish", 15},
    {"situation: several finishes", 12},
    {"reactive task stopped by a situation change of its own", 30},
    {"queue: waiting only", 1000},
    {"waiting: silent attempt", 150},
    {"waiting: an attempt with a failed activation", 12},
    {"waiting: joins the queue again", 200},
    {"waiting: until it starts", 30},
    {"waiting: until an exclusive task starts", 25},
    {"waiting: until a start is dropped", 2},
    {"waiting: until a stop", 10},
    {"conflict of a start", 1500},
    {"conflict of a stop", 30},
    {"conflict of a reactive start", 60},
    {"conflict of 1", 300},
    {"conflict of 2", 500},
    {"conflict of 3", 250},
    {"conflict of 4", 200},
    {"conflict of 5 or more", 250},
    {"conflict: priority", 250},
    {"conflict: no_behavior", 250},
    {"conflict: protected", 400},
    {"conflict: exclusive", 350},
    {"conflict: on_request", 350},
    {"conflict: requires", 1500},
    {"conflict: performance", 350},
    {"conflict: performance of a task alone", 250},
    {"conflict: unavailable", 450},
    {"conflict: unavailable, and does not fit", 30},
    {"conflict: situation", 500},
    {"conflict: faulty", 800},
};

void run_case_with_keys(std::uint64_t seed, Results& results) {
  Random forms(~seed);
  if (const auto fault = find_fault(generate_case_with_keys(seed), forms, &results.statistics)) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n" + *fault});
  }
}

const LowerBound bounds_with_keys[] = {
    {"suspended", 100},
    {"resumed", 50},
    {"suspended: until a stop", 10},
    {"state: with suspended requests", 500},
    {"state: with failures that are remembered", 500},
    {"failed: tried again by a start", 50},
    {"repair: of what has failed, and is not faulty", 20},
    {"reconsidered: accepted", 50},
    {"reconsidered: nothing better", 50},
    {"activate: resumed", 50},
    {"reactive start with a priority: accepted", 50},
    {"decided by: f1, suspended requests", 50},
    {"decided by: f1, product of what was asked for", 50},
    {"decided by: f1, what nobody asked for", 50},
};

constexpr std::uint64_t default_limit_cases = 1000;

void run_limit_case(std::uint64_t seed, Results& results) {
  const Case sample = generate_case(seed);
  Random forms(~seed);
  const std::string catalog = catalog_yaml(sample.catalog, forms);
  const std::string script = script_yaml(sample.catalog, sample.script, forms);
  try {
    check_limits(catalog, script, results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + catalog +
                                        "--- script\n" + script + "--- " + error.what() + "\n"});
  }
}

const LowerBound limit_lower_bounds[] = {
    {"limited: optimal", 1000},
    {"limited: feasible", 1000},
    {"limited: same requests", 500},
    {"limited: infeasible", 500},
};

TEST(Property, SameEventsAsTheOracle) {
  run_random_cases(default_event_cases, run_event_case, event_lower_bounds);
}

TEST(Property, SameEventsAsTheOracleWithFurtherKeys) {
  run_random_cases(default_event_cases, run_case_with_keys, bounds_with_keys);
}

// The proven answers are those of the oracle, by the test before.
TEST(Property, LimitsGiveAnswersWithinTheirBounds) {
  run_random_cases(default_limit_cases, run_limit_case, limit_lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::property_test
