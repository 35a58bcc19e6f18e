#pragma once

#include <string>
#include <vector>

#include "happening.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::plain {

/// What a script does to some tasks.
struct ScriptRun {
  std::vector<Happening> happenings;  ///< of the groups of these tasks
  VisibleState end;
  std::vector<std::string> failures;  ///< of expectations
};

/// Reads a script as `cbc solve` does, and runs it with its own header. Throws std::runtime_error
/// if there is any finding about it, other than that an expectation that fails can never hold, a
/// timeout fires, or it has not exactly one expectation and `timeouts: false`.
[[nodiscard]] ScriptRun run_text(const CompiledCatalog& catalog, const std::string& text,
                                 const std::vector<TaskId>& tasks);

}  // namespace cbc::plain
