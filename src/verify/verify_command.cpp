#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"
#include "verify/verify.h"

namespace cbc::cli {

namespace {

Values situation_entry() {
  return pair_of_words("KEY=VALUE", "a situation variable or a behavior, and its value",
                       "GPS_SIGNAL=false");
}

/// An effect, and how much of the suitability has to be left.
Values effect_limit() {
  return {
      "EFFECT", "lost or degraded:PERCENT", [](const std::string& text) -> std::string {
        constexpr std::string_view degraded = "degraded:";
        const bool is_right =
            text == "lost" ||
            (text.starts_with(degraded) && percent().check(text.substr(degraded.size())).empty());
        if (is_right) return {};
        return "expected 'lost', or a percentage with at most one decimal such as 'degraded:60', "
               "found " +
               quote(text);
      }};
}

constexpr const char* verify_examples =
    "  cbc verify robot.yaml                     what can happen at all\n"
    "  cbc verify robot.properties.yaml          prove properties, or break them\n"
    "  cbc verify new.yaml --same-as old.yaml    do both decide alike, always?\n"
    "  cbc verify robot.yaml --cut-sets DRIVE    faults that together end DRIVE\n";

constexpr const char* verify_footer =
    "Exit status: 0 all is proved, 1 a property is violated or undecided, the catalogs differ, "
    "--fail-on is met, or a limit ended a search, 2 the input or the usage is wrong, 3 an internal "
    "error (please report it).\n"
    "\n"
    "Read more: man cbc-verify";

int run_verify(const VerifyOptions& options) {
  if (options.paths.empty()) {
    return usage_error("verify", "expected a catalog or a property file");
  }
  return verify(options);
}

}  // namespace

void add_verify_command(Program& program) {
  constexpr std::uint32_t highest_order = 1000;
  const auto options = std::make_shared<VerifyOptions>();
  const std::vector<std::string> formats = names_in(verify_formats());
  Command& command = program.add_command(
      "verify", "Visits every reachable state: proves properties, or shows how they break.",
      {{"[OPTION...] [CATALOG] [PROPERTIES...]"}, verify_examples, verify_footer});
  command.argument("CATALOG PROPERTIES", options->paths, input("...", ValueKind::catalog_or_script),
                   "Catalog, unless property files name it; property files");
  command.format_option(options->format, formats);
  command.output_option(options->output);
  command.option("--scripts", options->scripts, folder(),
                 "Write counterexamples and witnesses as scripts to DIR");
  command.option("--html", options->html, further_output("FILE"),
                 "Also write a page with a timeline of all of them");
  command.jobs_option(options->jobs, "Explore with N threads");
  command.add_confinement();

  command.option("--refused", options->refused, name_of("TASK", ValueKind::task),
                 "Show how a start of TASK can be refused");
  command.flag("--outcomes", options->outcomes, "List all that events can come to, with scripts")
      .not_with({"--cut-sets", "--effects", "--html", "--overrides", "--refused", "--same-as"})
      .only_with_values("--format", {"text", "json"});

  command.group("Comparison");
  command.option("--same-as", options->same_as, input("OLD", ValueKind::catalog),
                 "Prove that CATALOG decides as the catalog OLD does");
  command.option("--renamed", options->renamed, old_and_new_name(), "OLD is called NEW in CATALOG")
      .only_with({"--same-as"});
  command
      .flag("--allow-missing", options->allow_missing, "What only one of them has does not count")
      .only_with({"--same-as"});

  command.group("Limits");
  add_state_limits(command, options->limits);

  command.group("Faults");
  command
      .option("--cut-sets", options->cut_sets, name_of("TASK", ValueKind::task),
              "List the faults that make TASK impossible")
      .not_with({"--format junit", "--format github"}, "it has no place for cut sets");
  command
      .option("--order", options->order, whole_number("K", 1, highest_order),
              "At most K faults together")
      .without("2; effects: 1")
      .only_with({"--cut-sets", "--effects"});
  command
      .flag("--in-some-situation", options->in_some_situation,
            "Also sets that suffice in some situation")
      .only_with({"--cut-sets"});
  command.option("--situation", options->situation, situation_entry(), "In this situation")
      .only_with({"--cut-sets", "--effects", "--overrides"});
  command.flag("--effects", options->effects, "Tabulate what faults do to each task")
      .not_with({"--cut-sets", "--refused", "--same-as", "--scripts"})
      .only_with_values("--format", {"text", "json", "csv"});
  command.flag("--situations", options->situations, "Also what changes of the situation do")
      .only_with({"--effects"});
  command
      .option("--fail-on", options->fail_on, effect_limit(),
              "Exit with 1 on: lost, or degraded:60 (below 60 %)")
      .only_with({"--effects"});

  command.flag("--overrides", options->overrides, "Tabulate which of two requests gives way")
      .not_with({"--cut-sets", "--effects", "--html", "--refused", "--same-as", "--scripts"})
      .only_with_values("--format", {"text", "json"});

  command.action([options] { return run_verify(*options); });
}

}  // namespace cbc::cli
