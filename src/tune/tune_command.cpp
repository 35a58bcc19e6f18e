#include <memory>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "tune/report/tune_report.h"
#include "tune/tune.h"

namespace cbc::cli {
namespace {

constexpr const char* tune_examples =
    "  cbc tune robot.yaml missions/                  how wrong each number may be\n"
    "  cbc tune robot.yaml missions/ --fail-under 2   by at least 2 points? for CI\n"
    "  cbc tune robot.yaml missions/ --write          repair, with one number\n"
    "  cbc tune robot.yaml --all-states               over all reachable states\n";

constexpr const char* tune_footer =
    "Exit status: 0 success, 1 an expectation fails, or --fail-under was missed, 2 the input or "
    "the "
    "usage is wrong, 3 an internal error (please report it).\n"
    "\n"
    "Read more: man cbc-tune";

}  // namespace

void add_tune_command(Program& program) {
  const auto options = std::make_shared<TuneOptions>();
  Command& command = program.add_command(
      "tune", "Reports how wrong each number of a catalog may be before missions go differently.",
      {{"[OPTION...] [CATALOG] SCRIPT...", "[OPTION...] --all-states [CATALOG] [PROPERTIES]"},
       tune_examples,
       tune_footer});
  command.argument("CATALOG SCRIPT", options->paths, input("...", ValueKind::catalog_or_script),
                   "The catalog, unless the scripts name it; then event scripts, folders of them, "
                   "or - for standard input; with --all-states a property file");
  command.format_option(options->format, names_in(tune_formats()));
  command.option("--html", options->html, further_output("FILE"),
                 "Also write a page with each number as a bar");
  command.option("--only", options->only, name_of("BEHAVIOR:TASK", ValueKind::text),
                 "Only the numbers of this behavior for this task");
  command.option("--fail-under", options->fail_under, percent(),
                 "Exit with 1 if a number may be wrong by less than this");
  command.jobs_option(options->jobs, "Look at N numbers at once");
  command.add_confinement();

  command.group("All states in place of scripts");
  command.flag("--all-states", options->all_states,
               "Look at every decision in every reachable state");
  for (Option* const option : add_state_limits(command, options->limits)) {
    option->only_with({"--all-states"});
  }

  command.group("Repairs of expectations that fail");
  command
      .option("--margin", options->margin, percent(),
              "Stay so far away from values with which one fails")
      .not_with({"--all-states"}, "there are no expectations");
  command.flag("--write", options->write, "Change the number in the catalog that changes least")
      .not_with({"--all-states"}, "there are no expectations")
      .only_with_values("--format", {"text"});
  command.action([options] { return tune(*options); });
}

}  // namespace cbc::cli
