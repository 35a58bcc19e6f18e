#pragma once

#include <nlohmann/json.hpp>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"

namespace cbc {

/// The answers to --why about one event.
[[nodiscard]] nlohmann::ordered_json why_to_json(const CompiledCatalog& catalog,
                                                 const EventRecord& record, const State& state);

/// The list of --alternatives of one event.
[[nodiscard]] nlohmann::ordered_json alternatives_to_json(const CompiledCatalog& catalog,
                                                          const EventRecord& record,
                                                          const State& state);

}  // namespace cbc
