#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"
#include "verify/verify.h"

namespace cbc::cli {

std::optional<std::uint64_t> parse_memory(const std::string& text) {
  constexpr std::string_view units = "KMGT";
  constexpr std::uint64_t most = std::uint64_t{1} << 60U;
  std::uint64_t size = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, size);
  if (error != std::errc() || size == 0) return std::nullopt;
  if (rest == end) return size;
  const std::size_t unit = units.find(*rest);
  if (unit == std::string_view::npos || rest + 1 != end) return std::nullopt;
  const auto shift = static_cast<unsigned>(10 * (unit + 1));
  if (size > most >> shift) return std::nullopt;
  return size << shift;
}

namespace {

Values memory() {
  Values values;
  values.placeholder = "SIZE";
  values.expected = "a size of memory";
  values.check = [](const std::string& text) -> std::string {
    if (parse_memory(text)) return {};
    return fmt::format("expected a number of bytes, or one with K, M, G or T, such as 8G, found {}",
                       quote(text));
  };
  return values;
}

Values folder() {
  Values values = name_of("DIR", ValueKind::file);
  values.expected = "a folder";
  values.check = [](const std::string& text) {
    return std::string(text.empty() || text == "-" ? "expected the name of a folder" : "");
  };
  return values;
}

Values situation_entry() {
  Values values;
  values.placeholder = "KEY=VALUE";
  values.expected = "a situation variable or a behavior, and its value";
  values.check = [](const std::string& text) -> std::string {
    const std::size_t equals = text.find('=');
    if (equals != 0 && equals != std::string::npos && equals + 1 < text.size()) return {};
    return fmt::format("expected KEY=VALUE, such as GPS_SIGNAL=false, found {}", quote(text));
  };
  return values;
}

constexpr const char* verify_examples =
    "  cbc verify robot.yaml                     what can happen at all\n"
    "  cbc verify robot.yaml robot.properties.yaml\n"
    "                                            prove properties, or break them\n"
    "  cbc verify robot.yaml --cut-sets DRIVE    faults that together end DRIVE\n";

constexpr const char* verify_footer =
    "More examples:\n"
    "  cbc verify robot.properties.yaml          the file names its catalog\n"
    "  cbc verify robot.properties.yaml --scripts broken --html broken.html\n"
    "                                            what breaks them, as scripts for\n"
    "                                            'cbc solve' and as a timeline\n"
    "  cbc verify robot.properties.yaml --format junit > results.xml\n"
    "                                            for CI, a test suite per file\n"
    "  cbc verify new.yaml --same-as old.yaml    whether both decide alike, always\n"
    "  cbc verify robot.yaml --write-tests tests --beside missions\n"
    "                                            the missions that are missing\n"
    "  cbc verify robot.yaml --mutants --beside missions/ --fail-under 80\n"
    "                                            whether the missions notice changes\n"
    "\n"
    "A property file says what may happen (assume), how it begins (initially), and what has to "
    "hold (properties: can_start, always, never, reachable). Without one, all tasks with "
    "start_on_request may be requested and stopped, behaviors may succeed and fail, and "
    "situation variables may change.\n"
    "\n"
    "Exit status: 0 all properties are proved, 1 one is violated or undecided, a limit ended "
    "an exploration, no script was found for a goal, or too few mutants are noticed, 2 the "
    "input or the usage is wrong, 3 an "
    "internal error (please report it).\n"
    "\n"
    "Read more: man cbc-verify, man cbc-events (scripts)";

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
      "verify",
      "Visits every reachable state of a catalog, and proves properties or shows the shortest "
      "script that breaks them.",
      {{"[OPTION...] [CATALOG] [PROPERTIES...]"}, verify_examples, verify_footer});
  command.argument("CATALOG PROPERTIES", options->paths, input("...", ValueKind::catalog_or_script),
                   "The catalog (YAML or compiled), then property files, or - for standard input. "
                   "Without a catalog the property files name it (catalog: FILE).");
  command.option("--format", options->format, one_of("FORMAT", formats),
                 fmt::format("{} (default: {})", join_with_or(formats), formats.front()));
  command.option("-o,--output", options->output, output("OUT"),
                 "The file to write, or - for standard output (default)");
  command.option("--scripts", options->scripts, folder(),
                 "Write each counterexample and witness as a script to the folder DIR, which is "
                 "made if it is missing");
  command.option("--html", options->html, further_output("FILE"),
                 "Also write an HTML page with a timeline of all counterexamples and witnesses to "
                 "FILE");
  command.option("-j,--jobs", options->jobs, whole_number("N", 1),
                 "Explore with N threads (default: the number of processors); the output is the "
                 "same for any N");

  command.flag("--reduce", options->reduce,
               "Treat states as one that differ only in the order of requests that cannot "
               "interact: the same verdicts and scripts, but fewer states to visit and to count");
  command
      .option("--same-as", options->same_as, input("OLD", ValueKind::catalog),
              "Prove that CATALOG decides every reachable event as the catalog OLD does, or show "
              "the shortest script whose last event differs; under the assumptions of a property "
              "file, if one is given")
      .not_with({"--format junit", "--format github"}, "it has no place for a comparison");
  command
      .option("--beside", options->beside, input("MISSION", ValueKind::script),
              "A script that exists, or a folder of them. May be repeated")
      .only_with({"--write-tests", "--mutants"});
  command
      .option("--write-tests", options->write_tests, folder(),
              "Write scripts to the folder DIR, as few as possible, that meet all goals of "
              "coverage that can be met and that those of --beside do not meet, with "
              "expectations; scripts of an earlier call are replaced")
      .not_with({"--scripts", "--html", "--same-as", "--cut-sets", "--reduce", "--jobs",
                 "--max-memory", "--format json", "--format junit", "--format github"},
                "it makes an exploration of its own");
  command
      .flag("--mutants", options->mutants,
            "Change one thing of CATALOG at a time, and report which changes the missions of "
            "--beside notice, in place of all else; of the others, whether a mission can, and "
            "which one. The assumptions of a property file count")
      .only_with({"--beside"})
      .not_with(
          {"--same-as", "--cut-sets", "--html", "--reduce", "--format junit", "--write-tests"});
  command
      .option("--fail-under", options->fail_under, percent(),
              "Exit with status 1 if the missions notice fewer mutants than this")
      .only_with({"--mutants"});
  command.add_confinement();

  command.group("Limits");
  command.option("--max-states", options->max_states, whole_number("N", 1),
                 "End each exploration after N states, and report how far it came");
  command.option("--max-memory", options->max_memory, memory(),
                 "The same when its states take this much memory, such as 512M or 8G (default: "
                 "three quarters of the memory of the machine)");
  command.option("--time-limit", options->time_limit, seconds(),
                 "The same after this time; also ends each search for cut sets, and all of "
                 "--write-tests or --mutants");

  command.group("Faults");
  const std::string no_place = "it has no place for cut sets";
  command
      .option("--cut-sets", options->cut_sets, name_of("TASK", ValueKind::task),
              "List the minimal sets of behaviors whose faults together make TASK impossible; "
              "without property files nothing else is done. May be repeated")
      .not_with({"--format junit", "--format github"}, no_place);
  command
      .option("--order", options->order, whole_number("K", 1, highest_order),
              "Sets of at most K behaviors (default: 2)")
      .only_with({"--cut-sets"});
  command
      .option("--situation", options->situation, situation_entry(),
              "Behaviors that do not fit this situation cannot be active: the value of a "
              "situation variable, or of a behavior true or false. Without it, 'initially' of a "
              "property file counts. May be repeated")
      .only_with({"--cut-sets"});
  command.action([options] { return run_verify(*options); });
}

}  // namespace cbc::cli
