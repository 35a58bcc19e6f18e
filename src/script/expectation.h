#pragma once

#include <optional>
#include <string>

#include "cbc/event.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"
#include "script/script.h"

namespace cbc {

/// What of the expectation does not hold, in a sentence; empty if all of it holds. `outcome` is
/// that of the last scripted start, stop or finish.
[[nodiscard]] std::string find_mismatch(const Expectation& expectation,
                                        const CompiledCatalog& catalog, const State& state,
                                        std::optional<Outcome> outcome);

}  // namespace cbc
