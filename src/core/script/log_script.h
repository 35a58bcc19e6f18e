#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Reads a recorded stream of events (`cbc solve --format jsonl`) as a script: what came from
/// outside, and a wait up to the last event. Empty if the log cannot be read, was made with another
/// catalog, or continues from a saved state; `error` says why, with the line.
[[nodiscard]] std::optional<Script> read_log(std::string_view text, const CompiledCatalog& catalog,
                                             std::string& error);

}  // namespace cbc
