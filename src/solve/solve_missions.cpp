#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/diagnostic/diagnostic.h"
#include "core/files/input.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/read_files.h"
#include "core/report/run_report.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/support/memory_file.h"
#include "core/support/wording.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "solve/report/solve_report.h"
#include "solve/solve.h"

namespace cbc::cli {

std::optional<std::vector<Mission>> MissionLoader::load(const std::vector<std::string>& paths) {
  std::size_t first_script = 0;
  if (!is_folder(paths.front())) {
    std::optional<InputFile> first = files_.read(paths.front());
    if (first && first->document != nullptr &&
        (is_script(*first->document) || is_property_file(*first->document))) {
      add_script(paths.front(), *first->document);
    } else {
      if (first) given_catalog_ = catalogs_.load(*first);
      is_given_catalog_bad_ = given_catalog_ == nullptr;
      has_failed_ = is_given_catalog_bad_;
    }
    first_script = 1;
  }
  for (std::size_t place = first_script; place < paths.size(); ++place) {
    const std::size_t known = missions_.size();
    add_path(paths[place]);
    if (has_failed_ || missions_.size() > known) continue;
    complain("found no event script in {}", quote(paths[place]));
    has_failed_ = true;
  }
  files_.print_findings();
  if (has_failed_) return std::nullopt;
  if (missions_.empty()) {
    complain("no event script given to solve on catalog {}", quote(display_name(paths.front())));
    return std::nullopt;
  }
  return std::move(missions_);
}

std::optional<std::vector<Mission>> MissionLoader::load_for(
    std::shared_ptr<const CompiledCatalog> catalog, const std::vector<std::string>& paths,
    const std::optional<std::string>& left_out) {
  left_out_ = left_out;
  given_catalog_ = std::move(catalog);
  for (const std::string& path : paths) add_path(path);
  files_.print_findings();
  if (has_failed_) return std::nullopt;
  return std::move(missions_);
}

void MissionLoader::add_path(const std::string& path) {
  if (is_folder(path)) {
    add_folder(path);
    return;
  }
  if (is_left_out(path)) return;
  std::optional<InputFile> file = files_.read(path);
  if (!file) {
    has_failed_ = true;
  } else if (file->document == nullptr) {
    complain_of_catalog(path);
  } else {
    add_script(path, *file->document);
  }
}

/// Adds the scripts of a folder. It may contain other files, but a script is not skipped because of
/// a mistake in it.
void MissionLoader::add_folder(const std::string& path) {
  for (const std::string& name : list_folder(path, {".yaml", ".yml", ".json"}, has_failed_)) {
    if (is_left_out(name)) continue;
    const NamedBy named_by = leads_out_of(path, name) ? NamedBy::link : NamedBy::command_line;
    std::optional<InputFile> file = files_.read(name, named_by);
    if (!file) {
      has_failed_ = true;
    } else if (file->document != nullptr && looks_like_script(*file->document)) {
      add_script(name, *file->document);
    }
  }
}

bool MissionLoader::is_left_out(const std::string& path) const {
  if (!left_out_) return false;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return is_same_file(folder.empty() ? "." : folder.string(), *left_out_);
}

void MissionLoader::complain_of_catalog(const std::string& path) {
  complain("{} is a catalog; expected a script here (a catalog goes first)",
           quote(display_name(path)));
  has_failed_ = true;
}

void MissionLoader::add_script(const std::string& path, const yaml::Document& document) {
  if (is_catalog(document)) {
    complain_of_catalog(path);
    return;
  }
  if (is_property_file(document)) {
    complain("{} is a property file; expected a script here", quote(display_name(path)));
    has_failed_ = true;
    return;
  }
  std::shared_ptr<const CompiledCatalog> catalog = catalog_of(path, document);
  if (catalog == nullptr) {
    has_failed_ = true;
    return;
  }
  Diagnostics diagnostics;
  std::optional<Script> script = read_script(document, *catalog, Severity::warning, diagnostics);
  if (files_.take_findings(path, document, std::move(diagnostics), script.has_value()) && script) {
    std::shared_ptr<const CatalogSource> source = catalogs_.source_of(*catalog);
    missions_.push_back({std::move(catalog), std::move(*script), std::move(source)});
  } else {
    has_failed_ = true;
  }
}

std::shared_ptr<const CompiledCatalog> MissionLoader::catalog_of(const std::string& script_path,
                                                                 const yaml::Document& script) {
  if (given_catalog_ != nullptr || is_given_catalog_bad_) return given_catalog_;
  const std::optional<NamedCatalog> named = catalog_named_by(script_path, script);
  if (!named) {
    complain(
        "script {} names no catalog, and none is given; give one on the command line, or write "
        "'catalog: FILE' into it",
        quote(display_name(script_path)));
    return nullptr;
  }
  return catalogs_.load(*named);
}

namespace {

constexpr const char* doing = "solving";

/// Runs a mission, and reports it from begin to end. May be called on several threads at once, with
/// a report for each.
using RunMission = std::function<RunResult(const Mission& mission, SolveReport& report)>;

/// Called after each run that was reported.
using AfterRun = std::function<void(const Mission& mission, const RunResult& result)>;

/// Forwards everything, and shows the progress of a run.
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
  // On the same terminal, the results themselves show the progress.
  const bool is_in_the_way = is_terminal(stdout);
  for (const Mission& mission : missions) {
    const RunResult result = is_in_the_way ? run(mission, report) : run(mission, with_progress);
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

/// Where something else is reported than the runs.
class SilentReport final : public SolveReport {
 public:
  void begin_run(const CompiledCatalog& /*catalog*/, const Script& /*script*/) override {}
  void on_event(const EventRecord& /*record*/, const Step* /*step*/,
                const State& /*state*/) override {}
  void end_run(const RunResult& /*result*/, const std::string& /*error*/) override {}
  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* /*out*/) const override {
    return std::make_unique<SilentReport>();
  }
};

/// Reports on standard error why a run ended early.
void complain_of_run(const Mission& mission, const RunResult& result, const std::string& reason) {
  fmt::print(stderr, "cbc: {}: {}\n", quote(mission.script.file), reason);
  if (result.status == Coordinator::Status::refused_answer) {
    fmt::print(stderr,
               "cbc: this is a bug in cbc, not in the catalog {}; please report it with the "
               "catalog and the script\n",
               quote(mission.catalog->file));
  }
}

/// Coverage alone is reported, but failures should not go unnoticed.
void complain_of_failures(const Mission& mission, const RunResult& result) {
  for (const FailedExpectation& failure : result.failures) {
    fmt::print(stderr, "{}: {}\n",
               format_place(printable(mission.script.file), failure.range.begin), failure.message);
  }
}

/// `collector`: null if coverage is not asked for.
int run_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                 SolveReport& report, CoverageCollector* collector) {
  const auto run = [&](const Mission& mission, SolveReport& report_of_run) {
    CoordinatorOptions coordination = coordinator_options(options, *mission.catalog);
    coordination.last_decisions =
        !options.coverage.replaces_runs();  // to explain failed expectations
    report_of_run.begin_run(*mission.catalog, mission.script);
    RunResult result = collector != nullptr ? collector->run(mission, coordination, report_of_run)
                                            : run_script(*mission.catalog, mission.script,
                                                         coordination, report_of_run);
    report_of_run.end_run(result, describe_end(result, coordination));
    return result;
  };
  int status = exit_ok;
  const auto after_run = [&](const Mission& mission, const RunResult& result) {
    const std::string reason = describe_end(result, coordinator_options(options, *mission.catalog));
    if (!reason.empty()) complain_of_run(mission, result, reason);
    if (options.coverage.replaces_runs()) complain_of_failures(mission, result);
    if (collector != nullptr) collector->take(mission);
    status = std::max(status, status_of(result));
  };
  run_all(missions, thread_count(options.jobs), report, run, after_run);
  return status;
}

/// Runs missions with an HTML page in addition to the report.
int draw_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                  SolveReport& report, CoverageCollector* collector) {
  HtmlReport picture(event_additions(options));
  ReportPair both(report, picture);
  const int status = run_missions(missions, options, both, collector);
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
  const SolveFormat* const format = find_named(solve_formats(), options.format);
  const CoverageOptions& of_coverage = options.coverage;
  MissionLoader loader;
  if (of_coverage.file) loader.keep_sources();
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) {
    // CI systems could take a missing report for one without failures.
    if (format != nullptr && format->report_unreadable) {
      format->report_unreadable(stdout, loader.findings());
    }
    return exit_unusable;
  }
  if (!know_names(*missions, options.explain)) return exit_unusable;
  // What else may prevent them is told after the report, which is of use without them.
  for (const std::optional<std::string>& output : {options.html, of_coverage.file}) {
    if (!output) continue;
    if (const auto refusal = find_read_file(*output)) return complain(*refusal);
  }
  std::unique_ptr<CoverageCollector> collector;
  std::optional<std::vector<Assumptions>> assumptions;
  if (of_coverage.file) {
    collector = CoverageCollector::make(*missions);
    if (collector == nullptr) return exit_unusable;
    assumptions = find_assumptions(collector->coverage(), of_coverage);
    if (!assumptions) return exit_unusable;
  }
  std::unique_ptr<SolveReport> report = std::make_unique<SilentReport>();
  if (!of_coverage.replaces_runs()) {
    report = format->make({stdout,
                           style_for(stdout),
                           event_additions(options),
                           // Lines in files and pipes stay whole, for programs such as grep.
                           {columns_for(stdout), options.brief}});
  }
  const int status = options.html ? draw_missions(*missions, options, *report, collector.get())
                                  : run_missions(*missions, options, *report, collector.get());
  if (collector == nullptr) return status;
  return std::max(status, report_coverage(collector->take_coverage(), *assumptions, options));
}

}  // namespace cbc::cli
