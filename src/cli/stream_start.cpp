#include "cli/stream_start.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/run_end.h"
#include "coordinator/saved_state.h"
#include "file/atomic_file.h"
#include "text/quote.h"

namespace cbc::cli {

bool can_use_files(const SolveOptions& options) {
  const StreamOptions& stream = options.stream;
  const auto from_stdin = std::count(options.paths.begin(), options.paths.end(), "-") +
                          (stream.state_in == "-" ? 1 : 0) + (stream.replay == "-" ? 1 : 0);
  if (from_stdin > 1) {
    complain(stdin_only_once);
    return false;
  }
  if (!stream.state_out) return true;
  const auto obstacle = find_obstacle(*stream.state_out);
  if (obstacle) complain(fmt::format("cannot write {}: {}", quote(*stream.state_out), *obstacle));
  return !obstacle;
}

bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                std::optional<Snapshot>& state) {
  if (!options.state_in) return true;
  const std::optional<std::string> text = read_input(*options.state_in);
  if (!text) return false;
  StateReading reading = read_state(*text, catalog);
  if (!reading.snapshot) {
    complain(fmt::format("cannot use the state {}: {}", quote(display_name(*options.state_in)),
                         reading.error));
    return false;
  }
  state = std::move(reading.snapshot);
  return true;
}

bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                const Runner& runner) {
  if (!options.state_out || runner.result().status != Coordinator::Status::ok) return true;
  return write_output(*options.state_out, write_state(catalog, runner.snapshot())) == exit_ok;
}

int report_end(const Runner& runner, const CoordinatorOptions& options) {
  const RunResult& result = runner.result();
  const std::string reason = describe_end(result, options);
  if (!reason.empty()) complain(reason);
  if (result.status == Coordinator::Status::refused_answer) {
    complain("this is a fault of cbc, not of the catalog; please report it");
  }
  return status_of(result);
}

}  // namespace cbc::cli
