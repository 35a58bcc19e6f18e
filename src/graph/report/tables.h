#pragma once

#include <optional>
#include <string>

#include "core/check/together.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

/// The tables of `cbc graph`: which tasks can run together (`--view together`), and which behaviors
/// fit in which values of the situation variables (`--view situation`).
namespace cbc {

/// The table of pairs of tasks for people, at most 80 columns wide unless a reason is longer: a
/// triangular matrix with a sign for each pair, then the reasons of pairs that no exclusivity list
/// has. Colors are those of the signs.
[[nodiscard]] std::string together_text(const CompiledCatalog& catalog, const TogetherTable& table,
                                        const Style& style);

/// The table as JSON, one pair on a line (schema "cbc.together/1"):
///
///     {"schema": "cbc.together/1",
///      "catalog": "robot.yaml",
///      "all_tasks": false,               whether no task starts on request, so that all count
///      "tasks": ["HOVER", "LAND"],       that start on request and can run, in catalog order
///      "never_run": [],                  that start on request and can never run
///      "possible": 0,                    numbers of pairs, by "together"
///      "excluded": 1, "excluded_indirectly": 0, "excluded_in_each_situation": 0,
///      "excluded_by_situation": 0, "undecided": 0,
///      "forbidden": 0,                   of the possible ones, those that the settings forbid
///      "pairs": [
///        {"tasks": ["HOVER", "LAND"],
///         "together": "excluded",        or another of these words
///         "forbidden": false,
///         "reasons": [                   as in "conflict" of cbc.solve/1: why not
///           {"kind": "exclusive", "tasks": ["HOVER", "LAND"], "line": 20, "message": "…"}]}]}
///
/// Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string together_json(const CompiledCatalog& catalog, const TogetherTable& table);

/// The table of the situation for people, at most 80 columns wide: a row for each behavior that
/// names a variable, a column for each value, and a sign where they meet; then the tasks without a
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
