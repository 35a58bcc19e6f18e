// Random catalogs and scripts: the implementation must give the same events as the oracle, in every
// field. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their number; the seed of a
// difference is printed, and CBC_SEED=<that> CBC_PROPERTY_CASES=1 repeats it alone.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "conflict_check.h"
#include "generator.h"
#include "oracle.h"
#include "statistics.h"
#include "subject.h"
#include "yaml_text.h"

namespace cbc::oracle {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uint64_t default_seed = 1;
constexpr std::uint64_t default_cases = 3000;
constexpr std::uint64_t cases_for_statistics = 500;  // fewer say nothing about how often
constexpr std::size_t differences_shown = 3;
constexpr std::uint64_t worker_count = 2;

std::uint64_t environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::strtoull(value, nullptr, 0);
}

// The type that a scalar of a parameter has in JSON is free; its text is not.
json scalars_as_text(const ordered_json& value) {
  if (value.is_object() || value.is_array()) {
    json result = value.is_object() ? json::object() : json::array();
    for (const auto& [key, item] : value.items()) {
      if (value.is_object()) {
        result[key] = scalars_as_text(item);
      } else {
        result.push_back(scalars_as_text(item));
      }
    }
    return result;
  }
  return value.is_null() || value.is_string() ? json(value) : json(value.dump());
}

// What is compared of an event. The order of keys matters only where it is catalog order.
json comparable(ordered_json event) {
  event.erase("conflict");
  if (event.contains("search") && event["search"].is_object()) {
    event["search"].erase("solutions");
    event["search"].erase("nodes");
    event["search"].erase("elapsed_us");
  }
  json result = event;
  if (event.contains("parameters")) {
    result["parameters"] = scalars_as_text(event["parameters"]);
  }
  for (const char* key : {"running", "requests", "queue"}) {
    json pairs = json::array();
    if (event.contains(key)) {
      for (const auto& [name, value] : event[key].items()) {
        pairs.push_back({name, value});
      }
    }
    result[key] = pairs;
  }
  return result;
}

// The index of the first event that differs; the number of events if none does.
std::size_t first_difference(const ordered_json& expected, const ordered_json& actual) {
  std::size_t i = 0;
  while (i < expected.size() && i < actual.size() &&
         comparable(expected[i]) == comparable(actual[i])) {
    ++i;
  }
  return i;
}

std::string event_text(const ordered_json& events, std::size_t index) {
  return index < events.size() ? events[index].dump(1) : "no such event";
}

struct Difference {
  std::uint64_t seed = 0;
  std::string report;
};

struct Results {
  Statistics statistics;
  std::vector<Difference> differences;
};

void run_case(std::uint64_t seed, Results& results) {
  const Case sample = generate_case(seed);
  Random forms(~seed);
  const std::string catalog = catalog_yaml(sample.catalog, forms);
  const std::string script = script_yaml(sample.catalog, sample.script, forms);
  const ordered_json expected = run_oracle(sample.catalog, sample.script, &results.statistics);

  const std::string inputs =
      "seed " + std::to_string(seed) + "\n--- catalog\n" + catalog + "--- script\n" + script;
  try {
    const ordered_json actual = run_subject(catalog, script);
    const std::size_t index = first_difference(expected, actual);
    if (index < expected.size() || index < actual.size()) {
      results.differences.push_back({seed, inputs + "--- first difference: event " +
                                               std::to_string(index + 1) + "\n--- oracle\n" +
                                               event_text(expected, index) + "\n--- subject\n" +
                                               event_text(actual, index) + "\n"});
      return;
    }
    const std::optional<ConflictFault> fault = check_conflicts(
        CatalogFacts(sample.catalog), catalog, sample.script, actual, &results.statistics);
    if (fault) {
      results.differences.push_back(
          {seed, inputs + "--- wrong conflict: event " + std::to_string(fault->event + 1) + "\n" +
                     fault->what + "\n--- subject\n" + event_text(actual, fault->event) + "\n"});
    }
  } catch (const std::exception& error) {
    results.differences.push_back({seed, inputs + "--- refused\n" + error.what() + "\n"});
  }
}

// Every worker takes each worker_count-th case, and stops by itself, so the answer does not depend
// on which is faster.
void run_share(std::uint64_t first_seed, std::uint64_t cases, std::uint64_t worker,
               Results& results) {
  for (std::uint64_t i = worker; i < cases; i += worker_count) {
    run_case(first_seed + i, results);
    if (results.differences.size() >= differences_shown) {
      return;
    }
  }
}

Results run_all(std::uint64_t first_seed, std::uint64_t cases) {
  std::vector<Results> shares(worker_count);
  std::vector<std::thread> workers;
  for (std::uint64_t worker = 0; worker < worker_count; ++worker) {
    workers.emplace_back([&shares, first_seed, cases, worker] {
      run_share(first_seed, cases, worker, shares[worker]);
    });
  }
  Results all;
  for (std::uint64_t worker = 0; worker < worker_count; ++worker) {
    workers[worker].join();
    all.statistics.merge(shares[worker].statistics);
    for (Difference& difference : shares[worker].differences) {
      all.differences.push_back(std::move(difference));
    }
  }
  std::sort(all.differences.begin(), all.differences.end(),
            [](const Difference& a, const Difference& b) { return a.seed < b.seed; });
  return all;
}

// How often something has to happen in 1000 cases for the comparison to mean anything.
struct LowerBound {
  const char* what;
  std::int64_t per_thousand;
};

const LowerBound lower_bounds[] = {
    {"outcome: accepted", 5000},
    {"outcome: rejected", 1000},
    {"outcome: unchanged", 1000},
    {"origin: script", 5000},
    {"origin: timeout", 500},
    {"origin: reactive", 300},
    {"origin: fault", 100},
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
    {"decided by: rule 5, ranks", 600},
    {"performance: exactly its minimum", 800},
    {"performance: exactly its minimum, a true product", 50},
    {"rejected and taken back", 200},
    {"rejected by the priority of its own request: start", 100},
    {"rejected by the priority of its own request: stop", 20},
    {"reactive start: accepted", 200},
    {"reactive start: rejected", 60},
    {"reactive start: dropped", 40},
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
    {"conflict: faulty", 800},
};

void print_statistics(const Statistics& statistics) {
  std::cout << "What happened:\n";
  for (const auto& [what, times] : statistics.all()) {
    const std::string count = std::to_string(times);
    std::cout << std::string(10 - std::min<std::size_t>(count.size(), 9), ' ') << count << "  "
              << what << "\n";
  }
}

// A conflict with something left out, added or altered must not pass.
TEST(Property, ConflictCheckSeesWhatIsWrong) {
  constexpr std::uint64_t cases = 40;
  for (std::uint64_t seed = default_seed; seed < default_seed + cases; ++seed) {
    const Case sample = generate_case(seed);
    Random forms(~seed);
    const std::string catalog = catalog_yaml(sample.catalog, forms);
    const std::string script = script_yaml(sample.catalog, sample.script, forms);
    const CatalogFacts facts(sample.catalog);
    ordered_json events = run_subject(catalog, script);
    for (ordered_json& event : events) {
      const ordered_json conflict = event["conflict"];
      const auto expect_fault = [&](const ordered_json& wrong) {
        event["conflict"] = wrong;
        EXPECT_TRUE(check_conflicts(facts, catalog, sample.script, events, nullptr))
            << "seed " << seed << ": " << event.dump(1);
        event["conflict"] = conflict;
      };
      for (std::size_t i = 0; i < conflict.size(); ++i) {
        ordered_json one_less = conflict;
        one_less.erase(i);
        expect_fault(one_less);
        ordered_json one_twice = conflict;
        one_twice.push_back(conflict[i]);
        expect_fault(one_twice);
        ordered_json silent = conflict;
        silent[i]["message"] = "";
        expect_fault(silent);
        // The list on the next line may exclude the same pair.
        if (conflict[i].contains("line") && !conflict[i].contains("tasks")) {
          ordered_json next_line = conflict;
          next_line[i]["line"] = conflict[i]["line"].get<int>() + 1;
          expect_fault(next_line);
        }
      }
    }
  }
}

TEST(Property, SameEventsAsTheOracle) {
  const std::uint64_t seed = environment("CBC_SEED", default_seed);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", default_cases);
  std::cout << "CBC_SEED=" << seed << " CBC_PROPERTY_CASES=" << cases << std::endl;

  const Results results = run_all(seed, cases);
  const std::size_t shown = std::min(results.differences.size(), differences_shown);
  for (std::size_t i = 0; i < shown; ++i) {
    ADD_FAILURE() << results.differences[i].report;
  }
  print_statistics(results.statistics);
  if (!results.differences.empty() || cases < cases_for_statistics) {
    return;
  }
  for (const LowerBound& bound : lower_bounds) {
    const std::int64_t needed = bound.per_thousand * static_cast<std::int64_t>(cases) / 1000;
    EXPECT_GE(results.statistics.of(bound.what), needed) << "too rare: " << bound.what;
  }
}

}  // namespace
}  // namespace cbc::oracle
