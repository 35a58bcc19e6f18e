#include "cli/stream_options.h"

#include <CLI/CLI.hpp>

#include "cli/value_kind.h"

namespace cbc::cli {

void add_stream_options(CLI::App& command, StreamOptions& options) {
  command
      .add_option("--state-out", options.state_out,
                  "Save the state at the end of a stream (jsonl) to FILE; what is due at its last "
                  "instant is left to what goes on")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--state-in", options.state_in,
                  "Go on from a saved state of the same catalog, with its clock, its situation and "
                  "its reactive delay")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--replay", options.replay,
                  "Run the scripted events of LOG, which --format jsonl wrote, again, and compare, "
                  "byte for byte; with the same options")
      ->option_text("LOG")
      ->check(stands_for(ValueKind::file));
}

}  // namespace cbc::cli
