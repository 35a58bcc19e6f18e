#include "random_cases.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "environment.h"
#include "support/rounds.h"

namespace cbc::oracle {
namespace {

constexpr std::uint64_t default_seed = 1;
constexpr std::uint64_t cases_for_statistics = 500;  // fewer say nothing about how often
constexpr std::size_t faults_shown = 3;
constexpr std::uint64_t worker_count = 2;

// Every worker takes each worker_count-th case, and stops by itself, so the answer does not depend
// on which is faster.
Results run_all(std::uint64_t first_seed, std::uint64_t cases, RunCase run_case) {
  std::vector<Results> shares(worker_count);
  std::vector<std::thread> workers;
  for (std::uint64_t worker = 0; worker < worker_count; ++worker) {
    workers.emplace_back([&share = shares[worker], first_seed, cases, worker, run_case] {
      for (std::uint64_t i = worker; i < cases && share.faults.size() < faults_shown;
           i += worker_count) {
        run_case(first_seed + i, share);
      }
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

}  // namespace

void run_random_cases(std::uint64_t default_cases, RunCase run_case,
                      std::span<const LowerBound> lower_bounds) {
  const std::uint64_t seed = environment("CBC_SEED", default_seed);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", test::rounds(default_cases));
  std::cout << "CBC_SEED=" << seed << " CBC_PROPERTY_CASES=" << cases << std::endl;

  const Results results = run_all(seed, cases, run_case);
  const std::size_t shown = std::min(results.faults.size(), faults_shown);
  for (std::size_t i = 0; i < shown; ++i) ADD_FAILURE() << results.faults[i].report;
  std::cout << "What happened:\n";
  for (const auto& [what, times] : results.statistics.all()) {
    std::cout << std::setw(10) << times << "  " << what << "\n";
  }
  if (!results.faults.empty() || cases < cases_for_statistics) return;
  for (const LowerBound& bound : lower_bounds) {
    const std::int64_t needed = bound.per_thousand * static_cast<std::int64_t>(cases) / 1000;
    EXPECT_GE(results.statistics.of(bound.what), needed) << "too rare: " << bound.what;
  }
}

}  // namespace cbc::oracle
