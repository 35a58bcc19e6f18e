#include <string>
#include <vector>

#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "solve/solve.h"

// The log of a stream, for `cbc solve --replay`.
namespace cbc::fuzz {
namespace {

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  cli::SolveOptions options = bounded_options();
  options.paths = {compiled_file_of(parts.front())};
  if (options.paths.front().empty()) return;
  options.stream.replay = "-";
  static_cast<void>(run_program(parts.back(), [&options] { return cli::replay(options); }));
}

/// What streams write.
std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : catalogs_with_scripts()) {
    cli::SolveOptions options = bounded_options();
    options.format = "jsonl";
    options.paths = {compiled_file_of(pair.catalog), "-"};
    const ProgramRun stream =
        run_program(stream_of(pair.text), [&options] { return cli::solve_stream(options); });
    inputs.push_back(join_parts(std::vector{pair.catalog, stream.output}));
  }
  return inputs;
}

}  // namespace

Target replay_target() {
  return {"replay", "the log of a stream, on a catalog", Language::json_lines, 1, 8192, run, seeds};
}

}  // namespace cbc::fuzz
