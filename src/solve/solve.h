#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/command_line/command_line.h"
#include "core/files/input.h"
#include "core/property/properties.h"
#include "core/report/event_json.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "coverage/engine/coverage.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "sweep/engine/sequence.h"

namespace cbc::cli {

/// The options of `cbc solve` that make it a sweep.
struct SweepOptions {
  std::optional<std::uint64_t> sequences;  ///< set: a sweep
  bool merge = false;
  std::uint64_t seed = 1;
  std::uint32_t events = SweepShape{}.events;
  std::int32_t priorities = SweepShape{}.priorities;
  std::string failures = "0.3";
  std::string faults = "0.1";
  std::string shard = "1/1";
  std::optional<std::string> slowest;
  std::optional<std::string> slowest_by_time;

  [[nodiscard]] bool is_wanted() const { return sequences.has_value() || merge; }
};

/// What to explain, as given on the command line.
struct ExplainOptions {
  std::vector<std::string> why;  ///< names of tasks and behaviors
  std::uint32_t alternatives = 0;
};

/// Whether the catalog has all names. Prints the first one that it lacks to standard error.
[[nodiscard]] bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options);

/// The options of `cbc solve` for streams of events, and for missions that continue.
struct StreamOptions {
  std::optional<std::string> state_in;
  std::optional<std::string> state_out;
  std::optional<std::string> replay;
  std::string clock = "events";      ///< or "real"
  std::optional<std::string> serve;  ///< where a page shows the stream
};

/// The options of `cbc solve` that are about coverage.
struct CoverageOptions {
  std::optional<std::string> file;    ///< set: coverage is wanted; "-": in place of the runs
  std::string fail_under;             ///< percent; empty: whatever it is
  bool prove = false;                 ///< set goals apart that are proven unreachable
  std::optional<std::string> assume;  ///< the property file with the assumptions of the proof

  [[nodiscard]] bool replaces_runs() const { return file == "-"; }
};

/// The options of `cbc solve`.
struct SolveOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::optional<std::string> html;
  std::optional<std::uint64_t> jobs;
  bool stats = false;
  bool brief = false;
  ExplainOptions explain;
  std::uint64_t max_solutions = 0;
  std::string time_limit;
  std::uint64_t max_nodes = 0;
  std::optional<std::uint64_t> tie_seed;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;
  StreamOptions stream;
  SweepOptions sweep;
  CoverageOptions coverage;
};

/// The options of the coordinator for a run on this catalog, which must know all names.
[[nodiscard]] CoordinatorOptions coordinator_options(const SolveOptions& options,
                                                     const CompiledCatalog& catalog);

/// The optional members of events in JSON.
[[nodiscard]] EventAdditions event_additions(const SolveOptions& options);

void add_sweep_options(Command& command, SweepOptions& options);
void add_coverage_options(Command& command, CoverageOptions& options);

/// Reads a JSON result to be merged. If that is impossible, prints why to standard error.
[[nodiscard]] std::optional<std::string> read_result(const std::string& path);

/// Runs a sweep on the catalog of the path, or merges the shards there. Returns the exit status.
[[nodiscard]] int run_sweep(const SolveOptions& options);

/// A script and the catalog it runs on.
struct Mission {
  std::shared_ptr<const CompiledCatalog> catalog;
  Script script;
  std::shared_ptr<const CatalogSource> source{};  ///< if the loader was to keep it
};

/// Reads the files of a command line, and checks every script against its catalog before anything
/// runs. Findings and other problems go to standard error.
class MissionLoader {
 public:
  /// From now on, also keeps what catalogs were compiled from.
  void keep_sources() { catalogs_.keep_sources(); }

  /// `paths`: a catalog (which may be missing if the scripts name theirs), then scripts; "-" is a
  /// script from standard input, a folder stands for the scripts in it. Empty if anything is wrong.
  [[nodiscard]] std::optional<std::vector<Mission>> load(const std::vector<std::string>& paths);
  /// The same for scripts alone, which run on this catalog. There may be none. Those in the folder
  /// `left_out`, if there is one, do not count.
  [[nodiscard]] std::optional<std::vector<Mission>> load_for(
      std::shared_ptr<const CompiledCatalog> catalog, const std::vector<std::string>& paths,
      const std::optional<std::string>& left_out);

  /// The findings about the files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return files_.findings(); }

 private:
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_of(const std::string& script_path,
                                                                  const yaml::Document& script);
  void add_script(const std::string& path, const yaml::Document& document);
  void add_folder(const std::string& path);
  void add_path(const std::string& path);
  [[nodiscard]] bool is_left_out(const std::string& path) const;
  void complain_of_catalog(const std::string& path);

  InputFiles files_;
  CatalogLoader catalogs_{files_};
  std::shared_ptr<const CompiledCatalog> given_catalog_;
  bool is_given_catalog_bad_ = false;
  std::vector<Mission> missions_;
  std::optional<std::string> left_out_;
  bool has_failed_ = false;
};

/// Collects which goals of their catalogs missions meet (docs/coverage.md).
class CoverageCollector {
 public:
  /// Null if a catalog was compiled before, and so has no lines; the reason is printed. The
  /// missions must outlive it.
  [[nodiscard]] static std::unique_ptr<CoverageCollector> make(
      const std::vector<Mission>& missions);

  /// Runs a mission. May be called on several threads at once, with different missions.
  [[nodiscard]] RunResult run(const Mission& mission, const CoordinatorOptions& options,
                              RunListener& listener);
  /// Adds what the mission has met.
  void take(const Mission& mission);

  [[nodiscard]] const Coverage& coverage() const { return coverage_; }
  [[nodiscard]] Coverage take_coverage() { return std::move(coverage_); }

 private:
  explicit CoverageCollector(const std::vector<Mission>& missions)
      : missions_(missions), met_(missions.size()) {}
  [[nodiscard]] CatalogCoverage* find(const CompiledCatalog& catalog);

  const std::vector<Mission>& missions_;
  Coverage coverage_;
  std::vector<std::vector<std::uint8_t>> met_;  ///< by mission: by goal
};

/// The assumptions under which goals are proven unreachable, by catalog. Empty if the property file
/// cannot be used; the reason is printed.
[[nodiscard]] std::optional<std::vector<Assumptions>> find_assumptions(
    const Coverage& coverage, const CoverageOptions& options);

/// Proves, if that is asked for, which goals are unreachable, and writes the coverage as the
/// options say. Returns the exit status.
[[nodiscard]] int report_coverage(Coverage coverage, const std::vector<Assumptions>& assumptions,
                                  const SolveOptions& options);

/// Merges JSON results. The paths are those of the catalog and of the results. Returns the exit
/// status.
[[nodiscard]] int merge_coverage(const SolveOptions& options);

/// Runs scripts, and reports them in one of the formats for whole runs. Returns the exit status.
[[nodiscard]] int solve_missions(const SolveOptions& options);

/// Says that a page lacks the last events, if it lacks any.
void tell_left_out(const std::string& page, std::uint64_t events);

// The beginning and the end of streams and replays. Problems go to standard error.

/// Whether the file of --state-out, if the option is given, can be written. All has been read.
[[nodiscard]] bool can_save_state(const StreamOptions& options);
/// Loads the state of --state-in, if the option is given. False if it cannot be used.
[[nodiscard]] bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              std::optional<Snapshot>& state);
/// Writes the state of --state-out, if the option is given, however the run ended: only after a
/// fault of cbc there is none. False after an error.
[[nodiscard]] bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              const Runner& runner);
/// Reports why a run ended early, if it did. Returns the exit status of the run.
[[nodiscard]] int report_end(const Runner& runner, const CoordinatorOptions& options);

/// Runs one script, or events from standard input, and writes each event as a line. The paths are
/// a catalog and a script, "-" for a stream; or a script that names its catalog. Returns the exit
/// status.
[[nodiscard]] int solve_stream(const SolveOptions& options);

/// Runs the events of a recorded stream again, and compares the outputs. The path is that of the
/// catalog.
[[nodiscard]] int replay_stream(const SolveOptions& options);

}  // namespace cbc::cli
