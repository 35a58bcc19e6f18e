#pragma once

#include <string_view>

#include "core/property/properties.h"
#include "core/support/json.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Writes what describe_assumptions says, with names, as the keys of a property file have it:
///
///     {"file": "landing.yaml",           null: the default ones
///      "start": {"LAND": [1, 3]},        tasks with the priorities of their requests
///      "stop": ["LAND"], "successes": true, "failures": true, "faults": 0,
///      "situation": ["SIGNAL"],          what may change: variables, then behaviors
///      "never": [{"SIGNAL": false}],
///      "initially": {"GPS": false}}
void write_assumptions(JsonWriter& json, const CompiledCatalog& catalog,
                       const StatedAssumptions& stated);

}  // namespace cbc
