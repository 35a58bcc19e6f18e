#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/scenario.h"

namespace cbc::bench {

/// The paper's m as in names: "m1", "m5", or "optimum" for 0.
[[nodiscard]] std::string name_of_m(std::uint64_t m);

[[nodiscard]] double median(std::vector<double> values);

/// One handled event: initialization of the domains, search, checker and applying.
void register_event(const std::string& name, std::shared_ptr<const Scenario> scenario,
                    std::size_t moment);

/// Loading (open, map, verify) of a compiled file.
void time_loading(benchmark::State& state, const std::string& path);

/// mission/NAME/…, every event of the missions of catalogs/; table1/…, the missions as a whole.
void register_mission_benchmarks();

/// table2/…, a first event on catalogs of growing size; optimum/…, all such events of theirs.
void register_catalog_benchmarks();

/// compiled/quadrotor/…: loading of the compiled reference catalog, and whole processes on it and
/// on the YAML.
void register_compiled_benchmarks();

/// stream/quadrotor: 200,000 events as JSON lines, from end to end.
void register_stream_benchmarks();
/// sweep/…: random events on the reference catalog and on generated ones of one group.
void register_sweep_benchmarks();

/// cut_sets/…: the minimal cut sets of order 2 of the modes of Autoware, one by one, and those of
/// order 3 of all tasks of the quadrotor together.
void register_cut_set_benchmarks();

/// explore/hospital/…: all states of its large group, which are many for its situation variables;
/// explore/quadrotor/…: all states of its group of LAND with one or two faulty behaviors; on one
/// core and on two: transitions in a second, the share of decisions that were remembered, the bytes
/// of a state.
void register_exploration_benchmarks();

/// fleet/…, generated catalogs of up to 100,000 tasks: compiling, loading, events of one
/// robot, and a picture of one task.
/// Together they take about a minute.
void register_fleet_benchmarks();

}  // namespace cbc::bench
