#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

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

/// The table as JSON. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string situation_json(const CompiledCatalog& catalog);
[[nodiscard]] std::string situation_schema();

/// The table for Graphviz's program `dot`.
[[nodiscard]] std::string situation_dot(const CompiledCatalog& catalog);

/// A format of the table.
struct SituationFormat {
  std::string_view name;  ///< that of a format of graph_formats(), or "text"
  std::string (*write)(const CompiledCatalog& catalog, const Style& style);
};

[[nodiscard]] std::span<const SituationFormat> situation_formats();

}  // namespace cbc
