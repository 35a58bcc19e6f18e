#pragma once

#include <optional>
#include <string>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc::test {

/// Lets everything happen to a catalog, from a state or from the beginning: each task is started
/// and each behavior fails, with limits that keep it short. Returns why the checker refused an
/// answer; empty if it refused none.
[[nodiscard]] std::optional<std::string> exercise(const CompiledCatalog& catalog,
                                                  const Snapshot* state = nullptr);

}  // namespace cbc::test
