#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/catalog/reader.h"
#include "core/files/input.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::cli {

/// The drawable part of a catalog, and its source.
struct Drawable {
  std::shared_ptr<const CompiledCatalog> compiled;  ///< if the catalog has no errors
  CatalogReading reading;                           ///< if it has errors
  draw::CatalogGraph graph;
  std::optional<draw::Moment> moment;  ///< of a state
};

/// Reads a catalog, compiled or YAML, which may have errors, and prints the findings. Null if
/// nothing can be drawn.
[[nodiscard]] std::unique_ptr<Drawable> read_drawable(const std::string& path);

/// The same for one of the files that were read; the findings are added to theirs.
[[nodiscard]] std::unique_ptr<Drawable> to_drawable(InputFiles& files, const InputFile& file);

}  // namespace cbc::cli
