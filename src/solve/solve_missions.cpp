#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/files/missions.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/read.h"
#include "core/report/run_report.h"
#include "core/script/runner.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "core/words/layout.h"
#include "page/html_report.h"
#include "page/simulator.h"
#include "runtime/base/text.h"
#include "solve/report/solve_report.h"
#include "solve/solve.h"

namespace cbc::cli {

namespace {

constexpr const char* doing = "solving";

/// Runs a mission, and reports it from begin to end. May be called on several threads at once, with
/// a report for each.
using RunMission = std::function<RunResult(const Mission& mission, SolveReport& report)>;

/// Called after each run that was reported.
using AfterRun = std::function<void(const Mission& mission, const RunResult& result)>;

/// Shows the progress of runs, and writes nothing.
class ProgressReport final : public SolveReport {
 public:
  explicit ProgressReport(Progress& progress) : progress_(progress) {}

  void begin_run(const CompiledCatalog& /*catalog*/, const Script& script) override {
    script_ = &script;
    progress_.begin(script.file);
  }
  void on_event(const ExplainedRecord& record, const Step* step, const State& /*state*/) override {
    if (step != nullptr) last_step_ = static_cast<std::size_t>(step - script_->steps.data()) + 1;
    constexpr std::uint64_t events_between = 4096;
    if (record.index % events_between == 0) {
      progress_.show(fmt::format(" ({} %)", last_step_ * 100 / script_->steps.size()));
    }
  }
  void end_run(const RunResult& /*result*/, const std::string& /*error*/) override {}

 private:
  Progress& progress_;
  const Script* script_ = nullptr;
  std::size_t last_step_ = 0;
};

void run_in_turn(const std::vector<Mission>& missions, SolveReport& report, const RunMission& run,
                 const AfterRun& after_run) {
  Progress progress(doing, missions.size());
  ProgressReport shown(progress);
  ReportPair both(shown, report);
  // On the same terminal, the results themselves show the progress.
  SolveReport& of_runs = is_terminal(stdout) ? report : static_cast<SolveReport&>(both);
  for (const Mission& mission : missions) {
    const RunResult result = run(mission, of_runs);
    progress.clear();
    after_run(mission, result);
  }
}

/// The result of a run, and its part of the report.
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

/// Runs all missions, up to `jobs` at once if the report supports it. The report and `after_run`
/// see the missions in order, so the result does not depend on `jobs`. A terminal shows the
/// progress.
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

/// What to run next where an expectation fails.
void point_to_tuning(const std::vector<Mission>& missions, const SolveOptions& options) {
  const CheckedCatalog& source = *missions.front().source;
  const bool have_one_catalog =
      std::all_of(missions.begin(), missions.end(),
                  [&](const Mission& mission) { return mission.source.get() == &source; });
  const bool is_text = options.format == "text";
  if (!is_text || !have_one_catalog || source.text == nullptr) return;
  const std::string hint = fmt::format(
      "which number of the catalog would have to change: cbc tune {}",
      join(options.paths, " ", [](const std::string& path) {
        return path.find_first_of(" '\"$&()*;<>?[]\\`|~") == std::string::npos ? printable(path)
                                                                               : quote(path);
      }));
  fmt::print("{}\n", wrap_line(hint, columns_for(stdout), 2));
}

int run_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                 SolveReport& report) {
  const auto run = [&](const Mission& mission, SolveReport& report_of_run) {
    const CoordinatorOptions coordination = coordinator_options(options);
    report_of_run.begin_run(*mission.catalog, mission.script);
    if (!mission.outdated.empty()) {
      RunResult result;
      result.script = &mission.script;
      result.was_run = false;
      report_of_run.end_run(result, mission.outdated);
      return result;
    }
    Questions questions = questions_of(options, *mission.catalog);
    questions.failures = true;
    RunResult result = run_script(*mission.catalog, mission.script, coordination, report_of_run,
                                  std::move(questions));
    report_of_run.end_run(result, describe_end(result, coordination));
    return result;
  };
  int status = exit_ok;
  bool has_failed = false;
  const auto after_run = [&](const Mission& mission, const RunResult& result) {
    has_failed |= result.failed > 0;
    const std::string reason = describe_end(result, coordinator_options(options));
    if (!reason.empty()) complain_of_run(mission, result, reason);
    status = std::max(status, status_of(result));
  };
  run_all(missions, thread_count(options.jobs), report, run, after_run);
  if (has_failed) point_to_tuning(missions, options);
  return status;
}

/// Runs missions with an HTML page in addition to the report.
int draw_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                  SolveReport& report) {
  HtmlReport picture(event_additions(options));
  if (const auto simulator = installed_simulator()) {
    picture.continue_in(*simulator, [&](const CompiledCatalog& catalog) {
      const auto mission = std::find_if(missions.begin(), missions.end(), [&](const Mission& one) {
        return one.catalog.get() == &catalog;
      });
      return mission == missions.end() ? nullptr : mission->source->text.get();
    });
  }
  ReportPair both(report, picture);
  const int status = run_missions(missions, options, both);
  tell_left_out(*options.html, picture.left_out());
  return std::max(status, write_output(*options.html, picture.page()));
}

/// Whether all catalogs have the names in the options.
bool know_names(const std::vector<Mission>& missions, const ExplainOptions& options) {
  return std::all_of(missions.begin(), missions.end(), [&](const Mission& mission) {
    return knows_names(*mission.catalog, options);
  });
}

}  // namespace

void tell_left_out(const std::string& page, std::uint64_t events) {
  if (events == 0) return;
  complain("the page {} leaves out the last {}: it holds at most {} MiB of them", quote(page),
           quantity(events, "event"), HtmlReport::most_data >> 20U);
}

int solve_missions(const SolveOptions& options) {
  const SolveFormat& format = *find_named(solve_formats(), options.format);
  MissionLoader loader;
  loader.keep_outdated();
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) return report_unreadable("cbc solve", options.format, "-", loader.findings());
  if (!know_names(*missions, options.explain)) return exit_unusable;
  // What else may prevent the page is told after the report, which is of use without it.
  if (options.html) {
    if (const auto refusal = find_read_file(*options.html)) return complain(*refusal);
  }
  const std::unique_ptr<SolveReport> report =
      format.make({stdout,
                   style_for(stdout),
                   event_additions(options),
                   // Lines in files and pipes stay whole, for programs such as grep.
                   {columns_for(stdout), options.brief}});
  return options.html ? draw_missions(*missions, options, *report)
                      : run_missions(*missions, options, *report);
}

}  // namespace cbc::cli
