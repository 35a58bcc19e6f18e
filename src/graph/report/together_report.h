#pragma once

#include <string>

#include "core/check/together.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

/// How the table of tasks that can run together looks (`cbc graph --view together`).
namespace cbc {

/// The table for people, at most 80 columns wide unless a reason is longer: a triangular matrix
/// with a sign for each pair, then the reasons of pairs that no exclusivity list has. Colors are
/// those of the signs.
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

}  // namespace cbc
