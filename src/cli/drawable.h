#pragma once

#include <memory>
#include <optional>
#include <string>

#include "catalog/reader.h"
#include "compiled/compiled_catalog.h"
#include "draw/catalog_graph.h"
#include "draw/diagram.h"

namespace cbc::cli {

struct InputFile;
class InputFiles;

/// What can be drawn of a catalog, and what it was made of.
struct Drawable {
  std::shared_ptr<const CompiledCatalog> compiled;  ///< of a catalog without errors
  CatalogReading reading;                           ///< of another one
  draw::CatalogGraph graph;
  std::optional<draw::Moment> moment;        ///< of a state
  std::optional<std::string> named_catalog;  ///< path of the catalog that the script names
};

/// Reads a catalog, a compiled one or YAML, which may have errors, and prints what is wrong with
/// it. Null if nothing can be drawn.
[[nodiscard]] std::unique_ptr<Drawable> read_drawable(const std::string& path);

/// The same of a catalog that was read from one of the files; what is wrong with it is left there.
[[nodiscard]] std::unique_ptr<Drawable> to_drawable(InputFiles& files, const InputFile& file);

}  // namespace cbc::cli
