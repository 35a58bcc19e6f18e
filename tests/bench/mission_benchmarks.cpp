#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "bench/benchmarks.h"

namespace cbc::bench {
namespace {

void register_events(const std::string& mission, const std::shared_ptr<const Scenario>& scenario) {
  for (std::size_t place = 0; place < scenario->moments.size(); ++place) {
    const Moment& moment = scenario->moments[place];
    if (moment.coordinations == 0) continue;
    register_event("mission/" + mission + '/' + moment.name, scenario, place);
  }
}

/// Mean, least and greatest time of a coordination: over the mission, of medians over its replays.
void time_mission(benchmark::State& state, const Scenario& scenario) {
  const std::uint32_t coordinations = scenario.coordinations();
  std::vector<std::vector<double>> times(scenario.moments.size());
  while (state.KeepRunningBatch(std::int64_t{Batch::default_size} * coordinations)) {
    Batch batch(scenario);
    for (std::size_t place = 0; place < scenario.moments.size(); ++place) {
      const Moment& moment = scenario.moments[place];
      const double time = batch.take(moment);
      if (moment.coordinations == 0) continue;
      times[place].push_back(time / Batch::default_size / moment.coordinations);
    }
  }
  std::vector<double> medians;
  double sum = 0;
  for (std::size_t place = 0; place < times.size(); ++place) {
    if (times[place].empty()) continue;
    medians.push_back(median(std::move(times[place])));
    sum += medians.back() * scenario.moments[place].coordinations;
  }
  state.SetIterationTime(sum / coordinations * static_cast<double>(state.iterations()));
  state.counters["coordinations"] = coordinations;
  state.counters["mean_us"] = sum / coordinations * 1e6;
  state.counters["min_us"] = *std::min_element(medians.begin(), medians.end()) * 1e6;
  state.counters["max_us"] = *std::max_element(medians.begin(), medians.end()) * 1e6;
}

/// What precedes the search: a coordination's domains, made in the state just before it.
class DomainInitialization {
 public:
  DomainInitialization(const Scenario& scenario, std::size_t place)
      : batch_(scenario, 1),
        problem_builder_(*scenario.mission->catalog, batch_.state()),
        trigger_(scenario.moments[place].trigger) {
    for (std::size_t earlier = 0; earlier < place; ++earlier) {
      batch_.take(scenario.moments[earlier]);
    }
  }

  const Problem& run() {
    problem_builder_.load(trigger_, 1);
    return problem_builder_.build(problem_builder_.first_protection());
  }

 private:
  Batch batch_;
  ProblemBuilder problem_builder_;
  Trigger trigger_;
};

void time_domains(benchmark::State& state, const Scenario& scenario) {
  std::deque<DomainInitialization> initializations;
  for (std::size_t place = 0; place < scenario.moments.size(); ++place) {
    if (scenario.moments[place].coordinations > 0) initializations.emplace_back(scenario, place);
  }
  const auto count = static_cast<double>(initializations.size());
  std::vector<double> times;
  while (state.KeepRunningBatch(static_cast<std::int64_t>(count))) {
    const auto begin = std::chrono::steady_clock::now();
    for (DomainInitialization& initialization : initializations) {
      benchmark::DoNotOptimize(initialization.run().domains.data());
    }
    const auto end = std::chrono::steady_clock::now();
    times.push_back(std::chrono::duration<double>(end - begin).count() / count);
  }
  state.SetIterationTime(median(std::move(times)) * static_cast<double>(state.iterations()));
}

}  // namespace

void register_mission_benchmarks() {
  for (const char* const name : {"quadrotor", "target-following"}) {
    const std::string table_row = std::string("table1/") + name;
    const std::shared_ptr<const Mission> mission = load_mission(name);
    const std::shared_ptr<const Scenario> proven = plan(mission, 0);
    register_events(name, proven);
    for (const std::uint64_t m : {1U, 10U, 0U}) {
      benchmark::RegisterBenchmark((table_row + '/' + name_of_m(m)).c_str(),
                                   [scenario = plan(mission, m)](benchmark::State& state) {
                                     time_mission(state, *scenario);
                                   })
          ->UseManualTime();
    }
    benchmark::RegisterBenchmark((table_row + "/domains").c_str(), [proven](
                                                                       benchmark::State& state) {
      time_domains(state, *proven);
    })->UseManualTime();
  }
}

}  // namespace cbc::bench
