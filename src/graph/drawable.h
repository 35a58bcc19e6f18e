#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/check/check.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"

namespace cbc::cli {

/// The drawable part of a catalog, and its source.
struct Drawable {
  std::shared_ptr<const CheckedCatalog> catalog;  ///< not compiled if it has errors
  draw::CatalogGraph graph;
  std::optional<draw::Moment> moment;  ///< of a state
};

/// Reads a catalog, compiled or YAML, which may have errors, and prints the findings. Null if
/// nothing can be drawn.
[[nodiscard]] std::unique_ptr<Drawable> read_drawable(const std::string& path);

}  // namespace cbc::cli
