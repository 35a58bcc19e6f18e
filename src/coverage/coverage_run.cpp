#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/input.h"
#include "core/files/output.h"
#include "core/property/property_reader.h"
#include "coverage/engine/coverage.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/goals.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"
#include "solve/solve.h"
#include "verify/engine/explore.h"

namespace cbc::cli {
namespace {

CatalogCoverage coverage_of(std::shared_ptr<const CompiledCatalog> catalog,
                            const CatalogSource& source) {
  std::vector<Goal> goals = find_goals(*catalog);
  add_lines(source.catalog, *catalog, goals);
  return {std::move(catalog), source.text, std::move(goals)};
}

/// Says why there can be no coverage of a catalog, if so. `source`: null if it was compiled.
bool can_be_covered(const CompiledCatalog& catalog, const CatalogSource* source) {
  if (source == nullptr) {
    complain("--coverage: the catalog {} was compiled; expected the YAML, whose lines count",
             quote(catalog.file));
    return false;
  }
  const std::optional<std::string> too_many = find_too_many_pairs(catalog);
  if (too_many) complain("--coverage: {}", *too_many);
  return !too_many;
}

/// The next word is taken for the file, so one that looks like an argument is refused.
Values coverage_file() {
  Values values = output("[FILE]");
  values.expected = "FILE";
  values.check = [](const std::string& path) -> std::string {
    std::error_code ignored;
    const bool is_input = std::filesystem::is_directory(path, ignored) || path.ends_with(".yaml") ||
                          path.ends_with(".yml") || path.ends_with(".cbc");
    if (!is_input) return {};
    return fmt::format(
        "expected a file to write, found {}; without a value, --coverage stands last or before "
        "another option",
        quote(path));
  };
  return values;
}

}  // namespace

void add_coverage_options(Command& command, CoverageOptions& options) {
  command
      .option("--coverage", options.file, coverage_file(),
              "Report which goals of the catalog the scripts reach together: in place of the runs, "
              "or beside them in FILE: as JSON, HTML or LCOV if its name ends with .json, .html, "
              ".info or .lcov, otherwise as text")
      .value_or("-")
      .not_with({"--sweep", "--replay", "--format jsonl"}, "it is about whole scripts");
  command
      .option("--fail-under", options.fail_under, percent(),
              "Exit with status 1 if fewer goals than this are reached")
      .only_with({"--coverage"});
  command
      .flag(
          "--prove", options.prove,
          "Visit all reachable states as cbc verify does, and set apart what no mission can reach")
      .only_with({"--coverage"});
  command
      .option(
          "--assume", options.assume, input("FILE", ValueKind::file),
          "Which events may happen in the proof: the assumptions of this property file (default: "
          "those of cbc verify, with the priorities 1 and 2)")
      .only_with({"--prove"});
}

std::unique_ptr<CoverageCollector> CoverageCollector::make(const std::vector<Mission>& missions) {
  std::unique_ptr<CoverageCollector> collector(new CoverageCollector(missions));
  for (const Mission& mission : missions) {
    if (collector->find(*mission.catalog) != nullptr) continue;
    if (!can_be_covered(*mission.catalog, mission.source.get())) return nullptr;
    collector->coverage_.catalogs.push_back(coverage_of(mission.catalog, *mission.source));
  }
  return collector;
}

CatalogCoverage* CoverageCollector::find(const CompiledCatalog& catalog) {
  const auto found =
      std::find_if(coverage_.catalogs.begin(), coverage_.catalogs.end(),
                   [&](const CatalogCoverage& one) { return &one.catalog() == &catalog; });
  return found == coverage_.catalogs.end() ? nullptr : &*found;
}

RunResult CoverageCollector::run(const Mission& mission, const CoordinatorOptions& options,
                                 RunListener& listener) {
  const CompiledCatalog& catalog = *mission.catalog;
  MonitoredResult watched =
      run_monitored(catalog, find(catalog)->goals(), mission.script, options, listener);
  met_[static_cast<std::size_t>(&mission - missions_.data())] = std::move(watched.met);
  return std::move(watched.result);
}

void CoverageCollector::take(const Mission& mission) {
  std::vector<std::uint8_t>& met = met_[static_cast<std::size_t>(&mission - missions_.data())];
  find(*mission.catalog)->add(mission.script.file, std::exchange(met, {}));
}

namespace {

std::optional<Assumptions> read_assumptions(const std::string& path,
                                            const CompiledCatalog& catalog) {
  InputFiles files;
  const std::optional<InputFile> file = files.read(path);
  std::optional<PropertyFile> properties;
  if (file && (file->document == nullptr || !is_property_file(*file->document))) {
    complain("--assume: {} is not a property file", quote(display_name(path)));
  } else if (file) {
    Diagnostics diagnostics;
    properties = read_properties(*file->document, catalog, diagnostics);
    const bool is_complete = properties.has_value();
    if (!files.take_findings(path, *file->document, std::move(diagnostics), is_complete)) {
      properties.reset();
    }
  }
  files.print_findings();
  if (!properties) return std::nullopt;
  return std::move(properties->assumptions);
}

/// False if nothing can be proven; the reason is printed.
bool prove(CatalogCoverage& coverage, const Assumptions& assumptions, const std::string& file,
           const StopSignals& signals) {
  const CompiledCatalog& catalog = coverage.catalog();
  GroupProgress progress("proving", catalog.group_count());
  GoalProofOptions options;
  options.search.on_progress = [&](std::uint32_t group, std::uint64_t states) {
    progress.show(group, states);
    return !signals.have_come();
  };
  GoalProof proof = prove_unreachable(catalog, coverage.goals(), assumptions, options);
  progress.line().clear();
  if (proof.error) {
    complain("--prove: {}", *proof.error);
    return false;
  }
  for (std::size_t group = 0; group < proof.groups.size(); ++group) {
    if (proof.groups[group].is_complete) continue;
    complain("--prove: not all states of group {} of {} were visited; nothing is proven about it",
             group, quote(catalog.file));
  }
  coverage.set_unreachable(std::move(proof.unreachable), {assumptions, file});
  return true;
}

}  // namespace

std::optional<std::vector<Assumptions>> find_assumptions(const Coverage& coverage,
                                                         const CoverageOptions& options) {
  std::vector<Assumptions> assumptions;
  if (!options.prove) return assumptions;
  if (options.assume && coverage.catalogs.size() > 1) {
    complain("--assume: a property file is about one catalog, and these scripts have {}",
             coverage.catalogs.size());
    return std::nullopt;
  }
  for (const CatalogCoverage& one : coverage.catalogs) {
    std::optional<Assumptions> found = options.assume
                                           ? read_assumptions(*options.assume, one.catalog())
                                           : assumptions_of_goals(one.catalog());
    if (!found) return std::nullopt;
    assumptions.push_back(std::move(*found));
  }
  return assumptions;
}

int report_coverage(Coverage coverage, const std::vector<Assumptions>& assumptions,
                    const SolveOptions& options) {
  if (!assumptions.empty()) {
    const StopSignals signals;
    for (std::size_t place = 0; place < assumptions.size(); ++place) {
      const std::string file =
          options.coverage.assume ? display_name(*options.coverage.assume) : std::string();
      if (!prove(coverage.catalogs[place], assumptions[place], file, signals)) {
        return exit_unusable;
      }
    }
  }
  int status = exit_ok;
  if (options.coverage.replaces_runs()) {
    const CoverageFormat& format = *find_named(coverage_formats(), options.format);
    fmt::print("{}", format.write(coverage, style_for(stdout), columns_for(stdout)));
  } else {
    const std::string& file = *options.coverage.file;
    status = write_output(file, coverage_format_of(file).write(coverage, plain_style(), 0));
  }
  if (options.coverage.fail_under.empty()) return status;
  const std::uint64_t least = tenths_in(options.coverage.fail_under);
  const GoalCount total = coverage.total();
  if (total.met * 1000 >= least * total.goals) return status;
  complain("the coverage is {}, less than {} (--fail-under)", cbc::describe_percent(total),
           describe_percent(options.coverage.fail_under));
  return std::max<int>(status, exit_no);
}

int merge_coverage(const SolveOptions& options) {
  if (options.paths.size() < 2) {
    return usage_error("solve", "expected the catalog, and JSON results of --coverage to merge");
  }
  InputFiles files;
  CatalogLoader catalogs(files);
  catalogs.keep_sources();
  const auto catalog = catalogs.load(options.paths.front());
  files.print_findings();
  if (catalog == nullptr) return exit_unusable;
  const std::shared_ptr<const CatalogSource> source = catalogs.source_of(*catalog);
  if (!can_be_covered(*catalog, source.get())) return exit_unusable;
  Coverage coverage;
  coverage.catalogs.push_back(coverage_of(catalog, *source));
  const auto assumptions = find_assumptions(coverage, options.coverage);
  if (!assumptions) return exit_unusable;
  for (std::size_t place = 1; place < options.paths.size(); ++place) {
    const std::string& path = options.paths[place];
    const std::optional<std::string> text = read_result(path);
    if (!text) return exit_unusable;
    const std::string fault = add_coverage_json(*text, coverage.catalogs.front());
    if (!fault.empty()) return complain("cannot merge {}: {}", quote(display_name(path)), fault);
  }
  return report_coverage(std::move(coverage), *assumptions, options);
}

}  // namespace cbc::cli
