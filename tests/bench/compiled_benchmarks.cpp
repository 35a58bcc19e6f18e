#include <array>
#include <chrono>
#include <fcntl.h>
#include <memory>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>

#include "bench/benchmarks.h"
#include "bench/compiled_inputs.h"
#include "bench/inputs.h"
#include "runtime/compiled/compiled_file.h"
#include "support/read_file.h"

namespace cbc::bench {
namespace {

constexpr const char* catalog_path = CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";
constexpr const char* mission_path = CBC_SOURCE_DIR "/catalogs/quadrotor.mission.yaml";

/// Starts a program of which the output goes nowhere.
class QuietProgram {
 public:
  QuietProgram() {
    posix_spawn_file_actions_init(&actions_);
    for (const int stream : {1, 2}) {
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_WRONLY, 0);
    }
  }
  ~QuietProgram() { posix_spawn_file_actions_destroy(&actions_); }
  QuietProgram(const QuietProgram&) = delete;
  QuietProgram& operator=(const QuietProgram&) = delete;

  /// Runs it to its end. The exit status, or -1.
  int run(std::vector<std::string> arguments) const {
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    int status = 0;
    if (posix_spawn(&process, pointers[0], &actions_, nullptr, pointers.data(), environ) != 0 ||
        waitpid(process, &status, 0) != process || !WIFEXITED(status)) {
      return -1;
    }
    return WEXITSTATUS(status);
  }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Whole processes, one after the other on the YAML and on the compiled catalog.
void time_processes(benchmark::State& state, const TemporaryFile& compiled) {
  const QuietProgram program;
  const std::array<std::string, 2> catalogs{catalog_path, compiled.path()};
  std::array<std::vector<double>, 2> times;
  // The first runs read the program from the disk.
  for (const std::string& catalog : catalogs) {
    const int status = program.run({CBC_PROGRAM_PATH, "solve", catalog, mission_path});
    if (status == 0) continue;
    const std::string message = "cbc solve fails on " + catalog;
    state.SkipWithError(message.c_str());
    return;
  }
  while (state.KeepRunning()) {
    for (std::size_t form = 0; form < catalogs.size(); ++form) {
      const auto begin = std::chrono::steady_clock::now();
      program.run({CBC_PROGRAM_PATH, "solve", catalogs[form], mission_path});
      const auto end = std::chrono::steady_clock::now();
      times[form].push_back(std::chrono::duration<double>(end - begin).count());
    }
  }
  const double of_yaml = median(std::move(times[0]));
  const double of_compiled = median(std::move(times[1]));
  state.SetIterationTime(of_compiled * static_cast<double>(state.iterations()));
  state.counters["yaml_us"] = of_yaml * 1e6;
  state.counters["compiled_us"] = of_compiled * 1e6;
  state.counters["ratio"] = of_compiled / of_yaml;
}

}  // namespace

void time_loading(benchmark::State& state, const std::string& path) {
  std::vector<double> times;
  while (state.KeepRunning()) {
    const auto begin = std::chrono::steady_clock::now();
    const CompiledFileResult result = load_compiled(path);
    const auto end = std::chrono::steady_clock::now();
    if (!result.file) throw std::runtime_error("cannot load " + path + ": " + result.error);
    times.push_back(std::chrono::duration<double>(end - begin).count());
  }
  state.SetIterationTime(median(std::move(times)) * static_cast<double>(state.iterations()));
}

void register_compiled_benchmarks() {
  const auto compiled = std::make_shared<const TemporaryFile>(
      compile_to_bytes(test::read_file(catalog_path), catalog_path).bytes);
  benchmark::RegisterBenchmark("compiled/quadrotor/load", [compiled](benchmark::State& state) {
    time_loading(state, compiled->path());
  })->UseManualTime();
  benchmark::RegisterBenchmark(
      "compiled/quadrotor/solve",
      [compiled](benchmark::State& state) { time_processes(state, *compiled); })
      ->UseManualTime()
      ->Iterations(50);
}

}  // namespace cbc::bench
