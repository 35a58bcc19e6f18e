#include <array>
#include <cstdint>
#include <fcntl.h>
#include <memory>
#include <random>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "bench/benchmarks.h"
#include "bench/compiled_inputs.h"
#include "bench/inputs.h"
#include "support/read_file.h"

namespace cbc::bench {
namespace {

constexpr const char* quadrotor = CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";
constexpr int stream_events = 200'000;

/// Starts of motions, and stops, most of which are accepted and change something.
std::string make_events() {
  constexpr std::array motions{"TAKE_OFF", "HOVER", "ROTATE", "FOLLOW_PATH", "HOVER", "LAND"};
  std::string text;
  for (int event = 0; event < stream_events; ++event) {
    const std::string motion = motions[static_cast<std::size_t>(event) % motions.size()];
    if (event % 16 == 0) {
      text += R"({"stop":"TAKE_OFF","wait":0.5})";
    } else {
      text += R"({"start":")" + motion + R"(","parameters":{"number":)" + std::to_string(event) +
              R"(},"wait":0.25})";
    }
    text += '\n';
  }
  return text;
}

/// Starts with priorities, stops and finishes in mixed order.
std::string make_mixed_events() {
  constexpr std::array motions{"TAKE_OFF", "HOVER", "ROTATE", "FOLLOW_PATH", "LAND"};
  std::mt19937_64 random(1);
  const auto below = [&random](std::uint64_t bound) { return random() % bound; };
  std::string text;
  for (int event = 0; event < stream_events; ++event) {
    const std::string motion = motions[below(motions.size())];
    const std::uint64_t kind = below(20);
    if (kind < 11) {
      text += R"({"start":")" + motion + R"(","priority":)" + std::to_string(1 + below(5));
    } else if (kind < 15) {
      text += R"({"stop":")" + motion + '"';
    } else {
      text += R"({"finish":{"task":")" + motion + R"("},"cause":"goal_achieved")";
    }
    text += R"(,"wait":0.25})"
            "\n";
  }
  return text;
}

/// Runs the stream with its output going to a file; returns what it took.
rusage run_stream(const std::string& input, const std::string& output) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<std::string> arguments{CBC_PROGRAM_PATH, "solve", quadrotor, "-",
                                     "--format",       "jsonl"};
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t process = 0;
  int status = 0;
  rusage usage{};
  const bool has_run =
      posix_spawn(&process, pointers[0], &actions, nullptr, pointers.data(), environ) == 0 &&
      wait4(process, &status, 0, &usage) == process && WIFEXITED(status) &&
      WEXITSTATUS(status) == 0;
  posix_spawn_file_actions_destroy(&actions);
  if (!has_run) throw std::runtime_error("the stream fails");
  return usage;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// The share of the events that are accepted and change something.
double find_share(const std::string& log) {
  constexpr std::string_view change = R"("outcome":"accepted","changes":[{)";
  int count = 0;
  for (std::size_t place = log.find(change); place != std::string::npos;
       place = log.find(change, place + 1)) {
    ++count;
  }
  return static_cast<double>(count) / stream_events;
}

/// Time is that of the processor, as other programs are on the machine.
void time_stream(benchmark::State& state, const TemporaryFile& input) {
  const TemporaryFile output("");
  run_stream(input.path(), output.path());
  state.counters["share_with_changes"] = find_share(test::read_file(output.path()));
  std::vector<double> times;
  while (state.KeepRunning()) {
    const rusage usage = run_stream(input.path(), output.path());
    times.push_back(seconds(usage.ru_utime) + seconds(usage.ru_stime));
  }
  const double time = median(std::move(times));
  state.SetIterationTime(time * static_cast<double>(state.iterations()));
  state.counters["events_per_s"] = stream_events / time;
}

}  // namespace

void register_stream_benchmarks() {
  const auto add = [](const char* name, const std::string& text) {
    const auto input = std::make_shared<const TemporaryFile>(text);
    benchmark::RegisterBenchmark(name,
                                 [input](benchmark::State& state) { time_stream(state, *input); })
        ->UseManualTime()
        ->Iterations(1);
  };
  add("stream/quadrotor", make_events());
  add("stream/quadrotor-mixed", make_mixed_events());
}

}  // namespace cbc::bench
