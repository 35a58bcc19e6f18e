#pragma once

#include <optional>
#include <string>

#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

/// Which behaviors fit in which values of the situation variables (`cbc graph --view situation`).
namespace cbc {

/// Why there can be no table of a catalog, if so.
[[nodiscard]] std::optional<std::string> find_too_large_situation(const CompiledCatalog& catalog);

/// The table for people, at most 80 columns wide: a row for each behavior that names a variable, a
/// column for each value, and a sign where they meet; then the tasks without a
/// behavior that fits. Colors are those of the signs.
[[nodiscard]] std::string situation_text(const CompiledCatalog& catalog, const Style& style);

/// The table as JSON (schema "cbc.situation/1"):
///
///     {"schema": "cbc.situation/1",
///      "catalog": "robot.yaml",
///      "variables": [                           in catalog order
///        {"variable": "TARGET",
///         "values": [                           the first one is the initial value
///           {"value": "near",                   or true, false
///            "fit": ["RECOGNIZE_NEAR"],         behaviors that name the variable, by whether they
///            "do_not_fit": ["RECOGNIZE_FAR"],   fit in this value; in catalog order
///            "tasks_without_behavior": []}]}],  tasks whose behaviors all do not fit in it
///      "behaviors": [                           that name variables
///        {"behavior": "RECOGNIZE_FAR", "situation": {"TARGET": ["far"]}}],
///      "unconditional": 5}                      number of the behaviors that name none
///
/// Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string situation_json(const CompiledCatalog& catalog);

}  // namespace cbc
