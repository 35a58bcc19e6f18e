#include <string>
#include <utility>

#include "core/files/output.h"
#include "core/files/read.h"
#include "core/script/state_json.h"
#include "runtime/base/text.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// Whether the new state replaces the one that was read.
bool goes_on(const StreamOptions& options) {
  return options.state_in && *options.state_in != "-" &&
         is_same_file(*options.state_in, *options.state_out);
}

}  // namespace

bool can_save_state(const StreamOptions& options) {
  return !options.state_out || goes_on(options) || can_write_output(*options.state_out);
}

bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                std::optional<Snapshot>& state) {
  if (!options.state_in) return true;
  const std::optional<std::string> text = read_input(*options.state_in);
  if (!text) return false;
  StateReading reading = read_state(*text, catalog);
  if (!reading.snapshot) {
    complain("cannot use the state {}: {}", quote(display_name(*options.state_in)), reading.error);
    return false;
  }
  state = std::move(reading.snapshot);
  return true;
}

bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                const Runner& runner) {
  if (!options.state_out || runner.result().status == Coordinator::Status::refused_answer) {
    return true;
  }
  const std::string state = write_state(catalog, runner.snapshot());
  return (goes_on(options) ? replace_input(*options.state_out, state)
                           : write_output(*options.state_out, state)) == exit_ok;
}

int report_end(const Runner& runner, const CoordinatorOptions& options) {
  const RunResult& result = runner.result();
  const std::string reason = describe_end(result, options);
  if (!reason.empty()) complain(reason);
  if (result.status == Coordinator::Status::refused_answer) {
    complain("this is a bug in cbc, not in the catalog; please report it");
  }
  return status_of(result);
}

}  // namespace cbc::cli
