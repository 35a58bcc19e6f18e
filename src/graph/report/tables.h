#pragma once

#include <string>

#include "ask/together.h"
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

/// The table as JSON. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string together_json(const CompiledCatalog& catalog, const TogetherTable& table);
[[nodiscard]] std::string together_schema();

/// The table of the situation for people, at most 80 columns wide: a row for each behavior that
/// names a variable, a column for each value, and a sign where they meet; then the tasks without a
/// behavior that fits. Colors are those of the signs.
[[nodiscard]] std::string situation_text(const CompiledCatalog& catalog, const Style& style);

/// The table as JSON. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string situation_json(const CompiledCatalog& catalog);
[[nodiscard]] std::string situation_schema();

}  // namespace cbc
