#include "graph/drawable.h"

#include <utility>

#include "core/files/file_set.h"

namespace cbc::cli {

std::unique_ptr<Drawable> read_drawable(const std::string& path) {
  FileSet files;
  auto drawable = std::make_unique<Drawable>();
  if (const auto file = files.read_catalog(path)) {
    drawable->catalog = files.load(*file, FileSet::Purpose::drawing);
  }
  files.print_findings();
  if (drawable->catalog == nullptr) return nullptr;
  const CheckedCatalog& catalog = *drawable->catalog;
  draw::CatalogGraph& graph = drawable->graph;
  graph = catalog.compiled != nullptr ? draw::to_graph(*catalog.compiled)
                                      : draw::to_graph(catalog.reading, files.findings());
  const bool is_empty = graph.tasks.empty() && graph.behaviors.empty();
  return catalog.compiled == nullptr && is_empty ? nullptr : std::move(drawable);
}

}  // namespace cbc::cli
