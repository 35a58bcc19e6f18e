#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/diagram.h"

// Pictures of catalogs, and the differences of two.

namespace cbc {

/// A picture for Graphviz's program `dot`.
[[nodiscard]] std::string graph_dot(const draw::Diagram& diagram);

/// A picture for Mermaid, which draws it where the text stands: in a README file, a pull request.
[[nodiscard]] std::string graph_mermaid(const draw::Diagram& diagram);

/// A picture as JSON, for programs. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string graph_json(const draw::Diagram& diagram);
[[nodiscard]] std::string graph_schema();

/// A format of `cbc graph`.
struct GraphFormat {
  std::string_view name;
  std::array<std::string_view, 2> suffixes;    ///< of files in it; the second one may be empty
  std::string (*write)(const draw::Diagram&);  ///< of one by Graphviz: the input of `dot`
  bool is_by_graphviz = false;                 ///< `dot -T<name>` makes it
  bool is_binary = false;
};

/// The first one is the default.
[[nodiscard]] std::span<const GraphFormat> graph_formats();

/// The differences for a person to read, a line for each: `-` removed, `+` added, `~` changed.
/// Empty if there are none.
[[nodiscard]] std::string diff_text(const CatalogDiff& diff, const Style& style);

/// The differences as JSON; `before` and `after` name the catalogs.
[[nodiscard]] std::string diff_json(const CatalogDiff& diff, std::string_view before,
                                    std::string_view after);
[[nodiscard]] std::string diff_schema();

}  // namespace cbc
