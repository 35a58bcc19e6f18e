#include <array>
#include <chrono>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/compiled_inputs.h"
#include "bench/fleet_generator.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/report/graph_report.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::bench {
namespace {

constexpr FleetShape shape_of(std::size_t robots, std::size_t first = 0) {
  return {.robots = robots, .tasks = 10, .behaviors = 30, .seed = 7, .first = first};
}
constexpr std::array<std::size_t, 4> sizes{1'250, 2'500, 5'000, 10'000};
/// The robot that the events are for.
constexpr std::size_t robot = 4'711;

/// A generated catalog, compiled.
struct Fleet {
  explicit Fleet(const FleetShape& shape) : Fleet(generate_fleet(shape)) {}
  explicit Fleet(const std::string& text)
      : source_size(text.size()), compilation(compile_to_bytes(text, "fleet.yaml")) {}

  std::size_t source_size;
  Compilation compilation;
};

CompiledCatalog load(const TemporaryFile& file) {
  CompiledFileResult result = load_compiled(file.path());
  if (!result.file) throw std::runtime_error("cannot load " + file.path() + ": " + result.error);
  return std::move(result.file->catalog);
}

/// The largest fleet, which is compiled once, when it is first asked for.
class LargestFleet {
 public:
  static const Fleet& get() {
    static const Fleet fleet(shape_of(sizes.back()));
    return fleet;
  }
  static const TemporaryFile& file() {
    static const TemporaryFile file(get().compilation.bytes);
    return file;
  }
};

void show_compilation(benchmark::State& state, const Fleet& fleet) {
  while (state.KeepRunning()) state.SetIterationTime(fleet.compilation.total());
  const auto source_size = static_cast<double>(fleet.source_size);
  const auto size = static_cast<double>(fleet.compilation.bytes.size());
  state.counters["source_mb"] = source_size / 1e6;
  state.counters["mb"] = size / 1e6;
  state.counters["size_ratio"] = size / source_size;
  state.counters["parsing_s"] = fleet.compilation.parsing;
  state.counters["understanding_s"] = fleet.compilation.understanding;
  state.counters["compiling_s"] = fleet.compilation.compiling;
}

/// A coordinator on a fleet. Each event comes a microsecond after the one before, so that no task
/// runs out of time.
class Control final : public EventListener {
 public:
  explicit Control(const TemporaryFile& file)
      : catalog_(load(file)), coordinator_(catalog_, CoordinatorOptions(), *this) {
    coordinator_.begin({});
  }

  /// Place in the catalog of a mission.
  [[nodiscard]] std::uint32_t find_mission(std::size_t of_robot, std::size_t place) const {
    return catalog_.find_task(name_of_mission(of_robot, place)).value();
  }

  void handle(Verb verb, std::uint32_t task) {
    Event event;
    event.verb = verb;
    event.subject = task;
    if (coordinator_.advance_to(coordinator_.now() + 1) != Coordinator::Status::ok ||
        coordinator_.handle(event) != Coordinator::Status::ok) {
      throw std::runtime_error("the coordinator failed: " + coordinator_.internal_error());
    }
  }

  void on_event(const EventRecord& record) override {
    if (record.outcome != Outcome::accepted) throw std::runtime_error("an event is not accepted");
  }

 private:
  const CompiledCatalog catalog_;
  Coordinator coordinator_;
};

/// Seconds for one event, of those that start and stop each of the missions. What comes last is
/// the first that comes again, if `first` is stop.
double time_round(Control& control, const std::vector<std::uint32_t>& missions, Verb first) {
  const Verb second = first == Verb::start ? Verb::stop : Verb::start;
  const auto begin = std::chrono::steady_clock::now();
  for (const std::uint32_t mission : missions) {
    control.handle(first, mission);
    control.handle(second, mission);
  }
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(end - begin).count() /
         static_cast<double>(2 * missions.size());
}

/// The same events for a robot, in a catalog that has only this one and in the fleet.
void time_events(benchmark::State& state, bool is_busy) {
  const Fleet single(shape_of(1, robot));
  const TemporaryFile single_file(single.compilation.bytes);
  Control alone(single_file);
  Control fleet(LargestFleet::file());
  if (is_busy) {
    for (std::size_t other = 0; other < sizes.back(); ++other) {
      if (other != robot) fleet.handle(Verb::start, fleet.find_mission(other, 0));
    }
  }
  std::vector<std::uint32_t> missions_alone;
  std::vector<std::uint32_t> missions;
  for (const std::size_t place : {0U, 1U, 2U, 3U}) {
    missions_alone.push_back(alone.find_mission(robot, place));
    missions.push_back(fleet.find_mission(robot, place));
  }
  std::mt19937_64 random(7);
  std::vector<double> times_alone;
  std::vector<double> times;
  while (state.KeepRunning()) {
    times_alone.push_back(time_round(alone, missions_alone, Verb::start));
    times.push_back(time_round(fleet, missions, Verb::start));
  }
  // Of another robot each time, of which nothing is in the caches.
  std::vector<double> times_elsewhere;
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::size_t other = random() % sizes.back();
    if (other == robot) ++other;
    const std::vector<std::uint32_t> mission{fleet.find_mission(other, 0)};
    times_elsewhere.push_back(time_round(fleet, mission, is_busy ? Verb::stop : Verb::start));
  }
  const double time_alone = median(std::move(times_alone));
  const double time = median(std::move(times));
  state.SetIterationTime(time * static_cast<double>(state.iterations()));
  state.counters["alone_us"] = time_alone * 1e6;
  state.counters["fleet_us"] = time * 1e6;
  state.counters["ratio"] = time / time_alone;
  state.counters["elsewhere_us"] = median(std::move(times_elsewhere)) * 1e6;
}

/// What `cbc graph FILE --task NAME` does, from the file to the text for Graphviz.
void draw_neighborhood(benchmark::State& state) {
  while (state.KeepRunning()) {
    const CompiledCatalog catalog = load(LargestFleet::file());
    const draw::CatalogGraph graph = draw::to_graph(catalog);
    const std::uint32_t task = catalog.find_task(name_of_mission(robot, 0)).value();
    const draw::Part part = part_around(graph, {task}, {});
    const std::string dot = graph_dot(make_diagram(graph, part, {}));
    if (dot.empty()) throw std::runtime_error("nothing is drawn");
  }
}

}  // namespace

void register_fleet_benchmarks() {
  for (const std::size_t robots : sizes) {
    const std::string name = fmt::format("fleet/{}/compile", robots * shape_of(robots).tasks);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [robots](benchmark::State& state) {
                                   show_compilation(state, robots == sizes.back()
                                                               ? LargestFleet::get()
                                                               : Fleet(shape_of(robots)));
                                 })
        ->UseManualTime()
        ->Iterations(1)
        ->Repetitions(1)
        ->Unit(benchmark::kMillisecond);
  }
  const std::string largest = fmt::format("fleet/{}/", sizes.back() * shape_of(1).tasks);
  benchmark::RegisterBenchmark(
      (largest + "load").c_str(),
      [](benchmark::State& state) { time_loading(state, LargestFleet::file().path()); })
      ->UseManualTime()
      ->Iterations(20);
  benchmark::RegisterBenchmark((largest + "draw").c_str(), draw_neighborhood)
      ->Iterations(20)
      ->Unit(benchmark::kMillisecond);
  for (const bool is_busy : {false, true}) {
    benchmark::RegisterBenchmark(
        (largest + (is_busy ? "busy" : "idle")).c_str(),
        [is_busy](benchmark::State& state) { time_events(state, is_busy); })
        ->UseManualTime()
        ->Iterations(2'000);
  }
}

}  // namespace cbc::bench
