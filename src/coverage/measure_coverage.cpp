#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/file_set.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/signals.h"
#include "coverage/coverage.h"
#include "coverage/engine/coverage.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

namespace cbc::cli {

void watch_missions(const std::vector<Mission>& missions, std::optional<std::uint64_t> jobs,
                    const CoordinatorOptions& options,
                    const std::function<const std::vector<Goal>&(const Mission&)>& goals_of,
                    const std::function<bool(const Mission&, MonitoredResult)>& take) {
  constexpr std::chrono::milliseconds between_looks(100);
  if (missions.empty()) return;
  const auto watch = [&](std::size_t number) {
    const Mission& mission = missions[number];
    return run_monitored(*mission.catalog, goals_of(mission), mission.script, options);
  };
  Progress progress("solving", missions.size());
  OrderedWork<MonitoredResult> work(
      missions.size(), std::min<std::size_t>(thread_count(jobs), missions.size()), watch);
  for (const Mission& mission : missions) {
    progress.begin(mission.script.file);
    while (!work.wait_for(between_looks)) progress.show();
    MonitoredResult result = work.take();
    progress.clear();
    if (!take(mission, std::move(result))) return;
  }
}

Budget budget_of(const CoverageOptions& options, const StopSignals& signals) {
  Budget budget = options.limits.budget().started();
  budget.is_stopped = [&signals] { return signals.have_come(); };
  return budget;
}

namespace {

CatalogCoverage coverage_of(const CheckedCatalog& catalog) {
  std::vector<Goal> goals = find_goals(*catalog.compiled);
  add_lines(catalog.reading.catalog, *catalog.compiled, goals);
  return {catalog.compiled, *catalog.text, std::move(goals)};
}

/// Says why there can be no coverage of a catalog, if so.
bool can_be_covered(const CheckedCatalog& catalog) {
  if (catalog.text == nullptr) {
    complain("the catalog {} was compiled; expected the YAML, whose lines count",
             quote(catalog.compiled->file));
    return false;
  }
  if (catalog.compiled->tasks.empty()) {
    complain("catalog {} has no tasks to cover", quote(catalog.compiled->file));
    return false;
  }
  const std::optional<std::string> too_many = find_too_many_pairs(*catalog.compiled);
  if (too_many) complain(*too_many);
  return !too_many;
}

/// Null if there is none of this catalog.
CatalogCoverage* find(Coverage& coverage, const CompiledCatalog& catalog) {
  const auto found =
      std::find_if(coverage.catalogs.begin(), coverage.catalogs.end(),
                   [&](const CatalogCoverage& one) { return &one.catalog() == &catalog; });
  return found == coverage.catalogs.end() ? nullptr : &*found;
}

/// The goals of all catalogs, none of them met. Empty if a catalog has none; the reason is printed.
std::optional<Coverage> find_goals(const std::vector<Mission>& missions) {
  Coverage coverage;
  for (const Mission& mission : missions) {
    if (find(coverage, *mission.catalog) != nullptr) continue;
    if (!can_be_covered(*mission.source)) return std::nullopt;
    coverage.catalogs.push_back(coverage_of(*mission.source));
  }
  return coverage;
}

std::optional<Assumptions> read_assumptions(const std::string& path,
                                            const CompiledCatalog& catalog) {
  FileSet files;
  std::optional<PropertyFile> properties;
  if (const auto file = files.read(path)) {
    if (file->is(FileKind::properties)) {
      properties = files.read_properties(*file, catalog);
    } else {
      complain("--assume: {} is not a property file", quote(file->name));
    }
  }
  files.print_findings();
  if (!properties) return std::nullopt;
  return std::move(properties->assumptions);
}

}  // namespace

std::optional<std::vector<StatedAssumptions>> find_assumptions(
    const std::vector<const CompiledCatalog*>& catalogs, const CoverageOptions& options) {
  if (options.assume && catalogs.size() > 1) {
    complain("--assume: a property file is about one catalog, and these scripts have {}",
             catalogs.size());
    return std::nullopt;
  }
  std::vector<StatedAssumptions> stated;
  for (const CompiledCatalog* const catalog : catalogs) {
    if (!options.assume) {
      stated.push_back({assumptions_of_goals(*catalog), {}});
    } else if (std::optional<Assumptions> found = read_assumptions(*options.assume, *catalog)) {
      stated.push_back({std::move(*found), display_name(*options.assume)});
    } else {
      return std::nullopt;
    }
  }
  return stated;
}

namespace {

/// The assumptions under which goals of a coverage are proven unreachable; of none if no proof is
/// wanted.
std::optional<std::vector<StatedAssumptions>> find_assumptions(const Coverage& coverage,
                                                               const CoverageOptions& options) {
  std::vector<const CompiledCatalog*> catalogs;
  for (const CatalogCoverage& one : coverage.catalogs) {
    if (options.prove) catalogs.push_back(&one.catalog());
  }
  return find_assumptions(catalogs, options);
}

/// False if nothing can be proven; the reason is printed.
bool prove(CatalogCoverage& coverage, const StatedAssumptions& stated,
           const CoverageOptions& options, const Budget& budget) {
  const CompiledCatalog& catalog = coverage.catalog();
  Progress progress("proving", catalog.group_count());
  GoalSearchOptions of_proof{budget, thread_count(options.jobs)};
  of_proof.budget.tell = progress.listener();
  GoalProof proof = prove_unreachable(catalog, coverage.goals(), stated.assumptions, of_proof);
  progress.clear();
  if (proof.error) {
    complain("--prove: {}", *proof.error);
    return false;
  }
  for (GroupId group(0); group < proof.groups.size(); ++group) {
    if (proof.groups[group].is_complete) continue;
    complain("--prove: not all states of group {} of {} were visited; nothing is proven about it",
             group, quote(catalog.file));
  }
  for (const auto& [variable, search] : proof.situations) {
    if (search.is_complete) continue;
    complain(
        "--prove: not all situations of variable {} of {} were visited; nothing is proven about "
        "it",
        quote(catalog.name_of_variable(variable)), quote(catalog.file));
  }
  const bool is_complete =
      std::all_of(proof.groups.begin(), proof.groups.end(),
                  [](const GoalSearchResult& one) { return one.is_complete; }) &&
      std::all_of(proof.situations.begin(), proof.situations.end(),
                  [](const auto& one) { return one.second.is_complete; });
  coverage.set_unreachable(std::move(proof.unreachable), stated, is_complete);
  return true;
}

/// Proves which goals are unreachable, if there are assumptions for that, and writes the report.
/// Returns the exit status.
int report(Coverage coverage, const std::vector<StatedAssumptions>& assumptions,
           const CoverageOptions& options) {
  if (!assumptions.empty()) {
    const StopSignals signals;
    const Budget budget = budget_of(options, signals);
    for (std::size_t place = 0; place < assumptions.size(); ++place) {
      if (!prove(coverage.catalogs[place], assumptions[place], options, budget)) {
        return exit_unusable;
      }
    }
  }
  int status = write_report(coverage_formats(), options.format, coverage, options.output);
  const bool is_proved = std::all_of(coverage.catalogs.begin(), coverage.catalogs.end(),
                                     std::mem_fn(&CatalogCoverage::is_proved));
  if (!is_proved) status = std::max<int>(status, exit_no);
  if (options.fail_under.empty()) return status;
  const GoalCount total = coverage.total();
  if (total.met * 1000 >= tenths_in(options.fail_under) * total.goals) return status;
  complain("the coverage is {}, less than {} (--fail-under)", cbc::describe_percent(total),
           describe_percent(options.fail_under));
  return std::max<int>(status, exit_no);
}

}  // namespace

int measure_coverage(const CoverageOptions& options, const std::vector<Mission>& missions) {
  std::optional<Coverage> coverage = find_goals(missions);
  if (!coverage) return exit_unusable;
  const auto assumptions = find_assumptions(*coverage, options);
  if (!assumptions || !can_write_output(options.output)) return exit_unusable;
  const CoordinatorOptions coordination = coordinator_options(options.search);
  int status = exit_ok;
  watch_missions(
      missions, options.jobs, coordination,
      [&](const Mission& mission) -> const std::vector<Goal>& {
        return find(*coverage, *mission.catalog)->goals();
      },
      [&](const Mission& mission, const MonitoredResult& watched) {
        const std::string reason = describe_end(watched.result, coordination);
        if (!reason.empty()) complain_of_run(mission, watched.result, reason);
        // Coverage alone is reported, but failures should not go unnoticed.
        for (const FailedExpectation& failure : watched.result.failures) {
          fmt::print(stderr, "{}: {}\n",
                     format_place(printable(mission.script.file), failure.range.begin),
                     failure.message);
        }
        find(*coverage, *mission.catalog)->add(mission.script.file, watched.met);
        status = std::max(status, status_of(watched.result));
        return true;
      });
  return std::max(status, report(std::move(*coverage), *assumptions, options));
}

}  // namespace cbc::cli
