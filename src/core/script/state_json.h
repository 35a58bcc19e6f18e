#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

/// The state of a coordinator as a JSON document (see `cbc solve --state-out`).
[[nodiscard]] std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot);
[[nodiscard]] std::string state_schema();

/// A snapshot that a coordinator on the catalog can continue from, or why there is none.
struct StateReading {
  std::optional<Snapshot> snapshot;
  std::string error;
};
[[nodiscard]] StateReading read_state(std::string_view text, const CompiledCatalog& catalog);

}  // namespace cbc
