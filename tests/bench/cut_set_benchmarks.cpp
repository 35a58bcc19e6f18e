#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/inputs.h"
#include "verify/engine/effects.h"

namespace cbc::bench {
namespace {

/// The minimal cut sets of some tasks, one after the other.
void register_cut_sets(const std::string& name, std::shared_ptr<const CompiledCatalog> catalog,
                       std::vector<TaskId> tasks, std::uint32_t order) {
  const auto run = [=, catalog = std::move(catalog),
                    tasks = std::move(tasks)](benchmark::State& state) {
    EffectOptions options;
    options.order = order;
    const SituationSpace situations(*catalog, {}, {});
    std::size_t found = 0;
    for ([[maybe_unused]] const auto iteration : state) {
      found = 0;
      for (const TaskId task : tasks) {
        found += find_cut_sets(situations, task, options).effects.size();
      }
    }
    state.counters["found"] = static_cast<double>(found);
  };
  benchmark::RegisterBenchmark(("cut_sets/" + name).c_str(), run)->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_cut_set_benchmarks() {
  const auto autoware = load_mission("autoware")->catalog;
  for (const TaskId task : autoware->task_ids) {
    const std::string_view name = autoware->name_of_task(task);
    constexpr std::string_view modes = "/autoware/modes/";
    if (!name.starts_with(modes)) continue;
    register_cut_sets(fmt::format("autoware/{}", name.substr(modes.size())), autoware, {task}, 2);
  }
  const auto quadrotor = load_mission("quadrotor")->catalog;
  register_cut_sets("quadrotor", quadrotor,
                    {quadrotor->task_ids.begin(), quadrotor->task_ids.end()}, 3);
}

}  // namespace cbc::bench
