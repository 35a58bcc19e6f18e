#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cbc/units.h"
#include "core/report/layout.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"

// What stands at the end of the text about runs, where people look first.

namespace cbc {

/// The summary of one run: how many events were accepted and rejected, which were rejected, which
/// behaviors time out again and again while the script does nothing, and which expectations failed,
/// with their places.
class RunSummary {
 public:
  /// Starts a run.
  void begin_run(const CompiledCatalog& catalog, const Script& script);
  void add(const EventRecord& record, const Step* step);

  void write(const RunResult& result, Text& text);

 private:
  /// Timeouts since the last event of the script.
  struct Timeouts {
    Microseconds first = 0;
    Microseconds last = 0;
    std::map<BehaviorId, std::uint64_t> counts;
  };

  void note_timeout(const EventRecord& record);
  void end_timeouts();

  const CompiledCatalog* catalog_ = nullptr;
  std::string file_;
  std::vector<std::string> rejected_;
  Timeouts timeouts_;
  std::vector<std::string> cycles_;
};

/// The summary of several runs: a row for each script, and the places of all failures.
void write_scripts(const std::vector<RunResult>& results, Text& text);

}  // namespace cbc
