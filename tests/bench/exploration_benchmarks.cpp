#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/inputs.h"
#include "explore/properties/explore.h"

namespace cbc::bench {
namespace {

/// One group, with up to so many faulty behaviors at a time.
void register_exploration(const std::string& name, std::shared_ptr<const CompiledCatalog> catalog,
                          GroupId group, std::uint32_t faults, unsigned jobs) {
  const auto run = [=, catalog = std::move(catalog)](benchmark::State& state) {
    Assumptions assumptions = default_assumptions(*catalog);
    assumptions.faults = faults;
    ExplorationOptions options;
    options.jobs = jobs;
    Exploration result;
    for ([[maybe_unused]] const auto iteration : state) {
      result = explore(*catalog, {group}, assumptions, {}, options);
    }
    const auto count = [](std::uint64_t number) { return static_cast<double>(number); };
    state.counters["states"] = count(result.states);
    state.counters["transitions"] = benchmark::Counter(
        count(result.transitions), benchmark::Counter::kIsIterationInvariantRate);
    state.counters["remembered"] = count(result.decisions_remembered) /
                                   count(result.decisions_remembered + result.decisions_computed);
    state.counters["controls"] = count(result.controls);
    state.counters["regions"] = count(result.regions);
    state.counters["nodes"] = count(result.diagram_nodes);
    state.counters["bytes"] = count(result.bytes) / count(result.states);
  };
  benchmark::RegisterBenchmark(
      fmt::format("explore/{}/faults:{}/jobs:{}", name, faults, jobs).c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_exploration_benchmarks() {
  const auto hospital = load_mission("hospital")->catalog;
  const TaskId deliver = hospital->task_ids[hospital->find_task("DELIVER").value()];
  for (const unsigned jobs : {1U, 2U}) {
    register_exploration("hospital", hospital, hospital->tasks[deliver].group, 0, jobs);
  }
  const auto quadrotor = load_mission("quadrotor")->catalog;
  const TaskId land = quadrotor->task_ids[quadrotor->find_task("LAND").value()];
  for (const std::uint32_t faults : {1U, 2U}) {
    for (const unsigned jobs : {1U, 2U}) {
      register_exploration("quadrotor", quadrotor, quadrotor->tasks[land].group, faults, jobs);
    }
  }
}

}  // namespace cbc::bench
