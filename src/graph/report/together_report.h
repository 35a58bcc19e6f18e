#pragma once

#include <span>
#include <string>
#include <string_view>

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

/// The table as JSON. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string together_json(const CompiledCatalog& catalog, const TogetherTable& table);
[[nodiscard]] std::string together_schema();

/// The matrix as a table for Graphviz's program `dot`, with its signs, and the reasons below.
[[nodiscard]] std::string together_dot(const CompiledCatalog& catalog, const TogetherTable& table);

/// A format of the table.
struct TogetherFormat {
  std::string_view name;  ///< that of a format of graph_formats(), or "text"
  std::string (*write)(const CompiledCatalog& catalog, const TogetherTable& table,
                       const Style& style);
};

[[nodiscard]] std::span<const TogetherFormat> together_formats();

}  // namespace cbc
