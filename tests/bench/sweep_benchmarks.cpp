#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/catalog_generator.h"
#include "bench/inputs.h"
#include "sweep/engine/sweep.h"

namespace cbc::bench {
namespace {

std::uint64_t rejections(const SweepCounts& counts) {
  std::uint64_t sum = 0;
  for (const OutcomeCounts& kind : counts.events) sum += kind.rejected;
  return sum;
}

/// 10 sequences of 100 events, on one thread. A tenth of the events or more is rejected, which
/// takes a search for the reasons.
void register_sweep(const std::string& name, std::shared_ptr<const CompiledCatalog> catalog) {
  const auto run = [catalog = std::move(catalog)](benchmark::State& state) {
    SweepSettings settings;
    settings.sequences = 10;
    std::uint64_t rejected = 0;
    for ([[maybe_unused]] const auto iteration : state) {
      rejected = rejections(sweep(*catalog, settings, 1, nullptr).result.counts);
    }
    state.counters["rejected"] = static_cast<double>(rejected);
  };
  benchmark::RegisterBenchmark(("sweep/" + name).c_str(), run)->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_sweep_benchmarks() {
  register_sweep("quadrotor", load_mission("quadrotor")->catalog);
  // The last one of the paper, and a larger one.
  for (const CatalogShape& shape : {CatalogShape{9, 3, 3, 3, 3, 67}, {20, 4, 3, 5, 5, 67}}) {
    const std::string name = fmt::format("generated{}", shape.tasks * shape.levels);
    register_sweep(name, compile_text(generate_catalog(shape), name));
  }
}

}  // namespace cbc::bench
