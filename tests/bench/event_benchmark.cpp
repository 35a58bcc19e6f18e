#include <algorithm>
#include <utility>

#include "bench/benchmarks.h"
#include "core/compile/compile.h"

namespace cbc::bench {
namespace {

double constraints_of(const CompiledCatalog& catalog) {
  return static_cast<double>(summarize(catalog).total.constraints.total());
}

double search_space(const SearchRecord& search) {
  double product = 1;
  for (const std::uint32_t size : search.domain_sizes) product *= size;
  return product;
}

/// A mean would tell of the other programs on the machine, so every iteration is given the median.
void time_event(benchmark::State& state, const Scenario& scenario, std::size_t place) {
  const Moment& moment = scenario.moments[place];
  std::vector<double> times;
  while (state.KeepRunningBatch(Batch::default_size)) {
    Batch batch(scenario);
    for (std::size_t earlier = 0; earlier < place; ++earlier) batch.take(scenario.moments[earlier]);
    times.push_back(batch.take(moment) / Batch::default_size / moment.coordinations);
  }
  state.SetIterationTime(median(std::move(times)) * static_cast<double>(state.iterations()));
  state.counters["constraints"] = constraints_of(*scenario.mission->catalog);
  state.counters["space"] = search_space(*moment.search);
  state.counters["solutions"] = static_cast<double>(moment.search->result.solutions);
  state.counters["nodes"] = static_cast<double>(moment.search->result.nodes);
  state.SetLabel(std::string(name_of(moment.search->result.status)));
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string name_of_m(std::uint64_t m) { return m == 0 ? "optimum" : 'm' + std::to_string(m); }

void register_event(const std::string& name, std::shared_ptr<const Scenario> scenario,
                    std::size_t moment) {
  benchmark::RegisterBenchmark(name.c_str(), [scenario = std::move(scenario),
                                              moment](benchmark::State& state) {
    time_event(state, *scenario, moment);
  })->UseManualTime();
}

}  // namespace cbc::bench
