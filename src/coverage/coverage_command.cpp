#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/report/test_report.h"
#include "coverage/coverage.h"
#include "coverage/report/coverage_report.h"

namespace cbc::cli {
namespace {

/// What --write-missing and --mutants ask. Empty if anything is wrong; the reason is printed.
std::optional<CoverageQuestion> find_question(std::shared_ptr<const CompiledCatalog> catalog,
                                              std::vector<Mission> missions,
                                              const CoverageOptions& options) {
  const char* const option = options.mutants ? "--mutants" : "--write-missing";
  if (catalog == nullptr) {
    usage_error("coverage", "{} needs a catalog before the scripts", option);
    return std::nullopt;
  }
  if (catalog->tasks.empty()) {
    complain("{}: catalog {} has no tasks", option, quote(catalog->file));
    return std::nullopt;
  }
  if (const auto too_many = find_too_many_pairs(*catalog)) {
    complain("{}: {}", option, *too_many);
    return std::nullopt;
  }
  auto assumptions = find_assumptions({catalog.get()}, options);
  if (!assumptions) return std::nullopt;
  return CoverageQuestion{std::move(catalog), std::move(missions), std::move(assumptions->front())};
}

int run_coverage(const CoverageOptions& options) {
  if (options.paths.empty()) return usage_error("coverage", "expected a catalog and a script");
  MissionLoader loader;
  const bool is_measured = !options.write_missing && !options.mutants;
  if (!is_measured) loader.need_none();
  if (options.write_missing) loader.leave_out(*options.write_missing);
  std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) {
    return report_unreadable("cbc coverage", options.format, options.output, loader.findings());
  }
  if (is_measured) return measure_coverage(options, *missions);
  const auto question = find_question(loader.given_catalog(), std::move(*missions), options);
  if (!question) return exit_unusable;
  return options.mutants ? judge_mutants(options, *question) : write_missing(options, *question);
}

constexpr const char* coverage_examples =
    "  cbc coverage robot.yaml missions/         what the missions test, and miss\n"
    "  cbc coverage robot.yaml missions/ --write-missing tests/   write the rest\n"
    "  cbc coverage robot.yaml missions/ tests/ --mutants   what they do not notice\n";

constexpr const char* coverage_footer =
    "Exit status: 0 success, 1 an expectation failed, --fail-under was missed, or a limit "
    "left a question open, 2 the input or the usage is wrong, 3 an internal error (please report "
    "it).\n"
    "\n"
    "Read more: man cbc-coverage";

}  // namespace

void add_coverage_command(Program& program) {
  const auto options = std::make_shared<CoverageOptions>();
  const std::vector<std::string> formats = names_in(coverage_formats());
  Command& command = program.add_command(
      "coverage", "Reports what event scripts test of a catalog, and writes what is missing.",
      {{"[OPTION...] [CATALOG] SCRIPT...", "--write-missing DIR [OPTION...] CATALOG [SCRIPT...]",
        "--mutants [OPTION...] CATALOG SCRIPT..."},
       coverage_examples,
       coverage_footer});
  command.argument("CATALOG SCRIPT", options->paths, input("...", ValueKind::catalog_or_script),
                   "The catalog, unless the scripts name it; then event scripts, folders of them, "
                   "or - for standard input");
  command.format_option(options->format, formats);
  command.output_option(options->output);
  command.option("--fail-under", options->fail_under, percent(),
                 "Exit with 1 if fewer goals are met than this");
  command.jobs_option(options->jobs, "Use N threads");
  command.add_confinement();

  command.group("Proofs");
  command.flag("--prove", options->prove, "Mark the goals that no mission can reach")
      .not_with({"--mutants", "--write-missing"}, "it proves that, too");
  command
      .option("--write-missing", options->write_missing, folder(),
              "Write scripts to DIR that meet the other goals")
      .not_with({"--mutants", "--fail-under"})
      .only_with_values("--format", {"text"});
  command.flag("--mutants", options->mutants, "Report which changes of the catalog nothing notices")
      .only_with_values("--format", names_in(mutants_formats()));
  command
      .option("--scripts", options->scripts, folder(),
              "Write scripts to DIR that notice these changes")
      .only_with({"--mutants"});
  const std::vector<std::string> proofs = {"--prove", "--write-missing", "--mutants"};
  command
      .option("--assume", options->assume, input("FILE", ValueKind::file),
              "The property file that says which events may happen")
      .only_with(proofs);
  for (Option* const option : add_state_limits(command, options->limits)) option->only_with(proofs);

  command.group("Search");
  for (Option* const option : add_search_limits(command, options->search)) {
    option->not_with({"--mutants", "--write-missing"});
  }
  command.action([options] { return run_coverage(*options); });
}

}  // namespace cbc::cli
