#include <cstddef>
#include <string>
#include <vector>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "sweep/engine/sweep.h"
#include "sweep/report/sweep_report.h"

// The shards of a sweep, for `cbc sweep --merge`.
namespace cbc::fuzz {
namespace {

ProgramRun merge(const std::vector<std::string>& shards) {
  std::vector<std::string> arguments{"sweep", "--merge", "--format", "json"};
  for (std::size_t shard = 0; shard < shards.size(); ++shard) {
    arguments.push_back(memory_file(shard, shards[shard]));
  }
  return run_program("", [&arguments] {
    cli::Program program({}, {}, {}, {});
    cli::add_sweep_command(program);
    return program.run(arguments);
  });
}

void run(const std::string& input) {
  constexpr std::size_t most_shards_of_input = 8;
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() > most_shards_of_input) return;
  const ProgramRun merged = merge(parts);
  require(merged.status == cli::exit_ok || merged.status == cli::exit_unusable,
          "an unknown exit status");
  if (merged.status != cli::exit_ok) return;
  // What comes out is a sweep of one shard.
  const ProgramRun again = merge({merged.output});
  require(again.status == cli::exit_ok, "the merged sweep is refused");
  require(again.output == merged.output, "merging a whole sweep changes it");
}

std::vector<std::string> seeds() {
  constexpr std::uint64_t most_seed_shards = 3;
  std::vector<std::string> inputs;
  const std::vector<std::string> catalogs = catalog_texts();
  for (std::size_t place = 0; place < catalogs.size(); place += 10) {
    const auto catalog = catalog_of(catalogs[place]);
    if (catalog == nullptr || catalog->tasks.empty()) continue;
    for (std::uint64_t count = 1; count <= most_seed_shards; ++count) {
      std::vector<std::string> shards;
      for (std::uint64_t index = 1; index <= count; ++index) {
        SweepSettings settings;
        settings.sequences = 3;
        settings.seed = place + 1;
        settings.shape.events = 8;
        settings.shard = {index, count};
        SweepOutcome outcome = sweep(*catalog, settings, 1, [](std::uint64_t) {});
        if (index % 2 == 0) outcome.result.times.reset();
        shards.push_back(sweep_to_json(outcome.result));
      }
      inputs.push_back(join_parts(shards));
    }
  }
  return inputs;
}

}  // namespace

Target merge_target() {
  return {"merge", "the shards of a sweep", Language::json, 0, 12288, run, seeds};
}

}  // namespace cbc::fuzz
