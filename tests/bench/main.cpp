#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.h"

namespace {

/// What the command line can override. Without a filter of its own the fleet, which takes long, is
/// left out.
std::vector<std::string> with_defaults(int argc, char** argv) {
  std::vector<std::string> arguments(argv, argv + 1);
  arguments.insert(arguments.end(),
                   {"--benchmark_min_time=0.002", "--benchmark_repetitions=5",
                    "--benchmark_report_aggregates_only=true", "--benchmark_counters_tabular=true",
                    "--benchmark_filter=-^fleet/"});
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  return arguments;
}

int run(int argc, char** argv) {
  std::vector<std::string> arguments = with_defaults(argc, argv);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size());
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;

  cbc::bench::register_mission_benchmarks();
  cbc::bench::register_catalog_benchmarks();
  cbc::bench::register_compiled_benchmarks();
  cbc::bench::register_stream_benchmarks();
  cbc::bench::register_sweep_benchmarks();
  cbc::bench::register_cut_set_benchmarks();
  cbc::bench::register_exploration_benchmarks();
  cbc::bench::register_fleet_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "cbc_bench: " << error.what() << '\n';
    return 2;
  }
}
