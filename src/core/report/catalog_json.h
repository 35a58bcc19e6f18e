#pragma once

#include <cstdint>
#include <span>

#include "core/catalog/situation.h"
#include "core/compile/compile.h"
#include "core/support/json.h"
#include "runtime/compiled/compiled_catalog.h"

// Parts of catalogs, as JSON.

namespace cbc {

/// Writes a value of a situation variable: a text, or true or false if the variable was declared
/// without values.
void write_plain_value(JsonWriter& json, const CompiledCatalog& catalog, VariableValue value);

/// Writes a situation variable: {"variable": "TARGET", "values": ["far", "near"]}. The values of
/// one without values of its own are true and false.
void write_variable(JsonWriter& json, const CompiledCatalog& catalog, std::uint32_t index);

/// Writes the member "situation" of an object: {"TARGET": ["near", "far"], "GPS": [true]}.
void write_conditions(JsonWriter& json, std::span<const NamedCondition> conditions);

/// Writes the member "constraints" of an object, which counts them.
void write_constraints(JsonWriter& json, const ConstraintCount& constraints);

}  // namespace cbc
