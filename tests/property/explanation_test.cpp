// Random catalogs and scripts: the explanations of every accepted event against brute force.
// CBC_SEED sets the seed of the first case, CBC_EXPLANATION_CASES their number.
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "environment.h"
#include "explanation_check.h"
#include "generator.h"
#include "random.h"
#include "statistics.h"
#include "subject.h"
#include "support/rounds.h"
#include "yaml_text.h"

namespace cbc::oracle::explanation_test {
namespace {

using nlohmann::ordered_json;

constexpr std::uint32_t most_alternatives = 7;
constexpr std::uint64_t cases_for_statistics = 150;  // fewer say nothing about how often

struct Sample {
  Case inputs;
  std::string catalog;
  std::string script;
};

Sample make_sample(std::uint64_t seed) {
  Sample sample;
  sample.inputs = generate_case(seed);
  Random forms(~seed);
  sample.catalog = catalog_yaml(sample.inputs.catalog, forms);
  sample.script = script_yaml(sample.inputs.catalog, sample.inputs.script, forms);
  return sample;
}

// How often something has to happen in 100 cases for the comparison to mean anything.
struct LowerBound {
  const char* what;
  std::int64_t per_hundred;
};

const LowerBound explanation_lower_bounds[] = {
    {"alternatives: all", 100},
    {"alternatives: the best", 100},
    {"alternatives: some are left out", 50},
    {"displaced", 20},
    {"loses by: requests", 100},
    {"loses by: request_order", 1},
    {"loses by: suitability", 100},
    {"loses by: idle", 100},
    {"loses by: changes", 20},
    {"loses by: canonical", 20},
    {"explained by reasons", 500},
    {"no other choice", 20},
    {"reason: protected", 20},
    {"reason: exclusive", 50},
    {"reason: on_request", 50},
    {"reason: requires", 50},
    {"reason: performance", 20},
    {"reason: unavailable", 50},
    {"reason: faulty", 10},
    {"reason: finished", 20},
    {"reason: situation", 50},
    {"reason: stopped", 30},
    {"queued: can start", 40},
    {"queued: something hinders it", 30},
};

TEST(Explanation, AgreesWithBruteForce) {
  const std::uint64_t first = environment("CBC_SEED", 1);
  const std::uint64_t cases = environment("CBC_EXPLANATION_CASES", test::rounds(200U));
  std::cout << "CBC_SEED=" << first << " CBC_EXPLANATION_CASES=" << cases << std::endl;
  Statistics statistics;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    const Sample sample = make_sample(seed);
    const ordered_json events = explain_subject(sample.catalog, sample.script, most_alternatives);
    const std::optional<std::string> fault = check_explanations(
        sample.inputs.catalog, sample.inputs.script, events, most_alternatives, statistics);
    ASSERT_FALSE(fault) << "seed " << seed << "\n--- catalog\n"
                        << sample.catalog << "--- script\n"
                        << sample.script << "---\n"
                        << *fault;
  }
  for (const auto& [what, times] : statistics.all()) std::cout << times << "  " << what << "\n";
  if (cases < cases_for_statistics) return;
  for (const LowerBound& bound : explanation_lower_bounds) {
    EXPECT_GE(statistics.of(bound.what), bound.per_hundred * static_cast<std::int64_t>(cases) / 100)
        << "too rare: " << bound.what;
  }
}

}  // namespace
}  // namespace cbc::oracle::explanation_test
