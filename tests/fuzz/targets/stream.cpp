#include <string>
#include <vector>

#include "core/files/output.h"
#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "solve/solve.h"

// Lines of events from standard input. What comes out is a log, on which a replay must agree.
namespace cbc::fuzz {
namespace {

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  const std::string catalog = compiled_file_of(parts.front());
  if (catalog.empty()) return;
  cli::SolveOptions options = bounded_options();
  options.format = "jsonl";
  options.paths = {catalog, "-"};
  const ProgramRun stream =
      run_program(parts.back(), [&options] { return cli::solve_stream(options); });
  options.format = "text";
  options.paths = {catalog};
  options.stream.replay = "-";
  const ProgramRun replay = run_program(stream.output, [&options] { return cli::replay(options); });
  require(replay.status != cli::exit_no, "the replay differs from the log");
  // Lines that were refused, and a run that ended early, make the status of the stream another one.
  if (stream.status != cli::exit_unusable) {
    require(replay.status == cli::exit_ok, "the log cannot be replayed");
  }
}

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : catalogs_with_scripts()) {
    inputs.push_back(join_parts(std::vector{pair.catalog, stream_of(pair.text)}));
  }
  return inputs;
}

}  // namespace

Target stream_target() {
  return {"stream",
          "lines of events, on a catalog; what comes out is replayed",
          Language::json_lines,
          1,
          6144,
          run,
          seeds};
}

}  // namespace cbc::fuzz
