#include "cli/solve_runs.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/ordered_work.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "report/memory_file.h"

namespace cbc::cli {
namespace {

constexpr const char* doing = "solving";

/// Passes everything on, and shows how far a run is.
class ProgressReport final : public SolveReport {
 public:
  ProgressReport(SolveReport& report, Progress& progress) : report_(report), progress_(progress) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override {
    script_ = &script;
    progress_.begin(script.file);
    report_.begin_run(catalog, script);
  }
  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    report_.on_event(record, step, state);
    if (step != nullptr) last_step_ = static_cast<std::size_t>(step - script_->steps.data()) + 1;
    constexpr std::uint64_t events_between = 4096;
    if (record.index % events_between == 0) {
      progress_.show(fmt::format(" ({} %)", last_step_ * 100 / script_->steps.size()));
    }
  }
  void on_failure(const Failure& failure) override { report_.on_failure(failure); }
  void on_end(const State& state) override { report_.on_end(state); }
  void end_run(const RunResult& result, const std::string& error) override {
    report_.end_run(result, error);
  }
  void end() override { report_.end(); }

 private:
  SolveReport& report_;
  Progress& progress_;
  const Script* script_ = nullptr;
  std::size_t last_step_ = 0;
};

void run_in_turn(const std::vector<Mission>& missions, SolveReport& report, const RunMission& run,
                 const AfterRun& after_run) {
  Progress progress(doing, missions.size());
  ProgressReport with_progress(report, progress);
  // On the same terminal the results themselves tell how far it is.
  const bool is_in_the_way = is_terminal(stdout);
  for (const Mission& mission : missions) {
    const RunResult result = is_in_the_way ? run(mission, report) : run(mission, with_progress);
    progress.clear();
    after_run(mission, result);
  }
}

/// A run, and what the report has of it.
struct Part {
  std::unique_ptr<MemoryFile> text;
  RunResult result;
};

void run_at_once(const std::vector<Mission>& missions, std::size_t jobs, SolveReport& report,
                 const RunMission& run, const AfterRun& after_run) {
  constexpr std::chrono::milliseconds between_looks(100);
  const auto run_apart = [&](std::size_t number) {
    Part part{std::make_unique<MemoryFile>(), {}};
    const std::unique_ptr<SolveReport> part_report = report.make_part(part.text->stream());
    part.result = run(missions[number], *part_report);
    return part;
  };
  Progress progress(doing, missions.size());
  OrderedWork<Part> work(missions.size(), jobs, run_apart);
  for (const Mission& mission : missions) {
    progress.begin(mission.script.file);
    while (!work.wait_for(between_looks)) progress.show();
    const Part part = work.take();
    progress.clear();
    report.add_part(part.text->text(), part.result);
    after_run(mission, part.result);
  }
}

}  // namespace

void run_all(const std::vector<Mission>& missions, std::size_t jobs, SolveReport& report,
             const RunMission& run, const AfterRun& after_run) {
  const std::size_t threads = std::min(jobs, missions.size());
  if (threads > 1 && report.make_part(stdout) != nullptr) {
    run_at_once(missions, threads, report, run, after_run);
  } else {
    run_in_turn(missions, report, run, after_run);
  }
  report.end();
}

}  // namespace cbc::cli
