#pragma once

#include <memory>
#include <string>

#include "compiled/compiled_catalog.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"

namespace cbc::cli {

/// Two catalogs, what they do not have in common, and both as one, fit to be drawn.
struct ComparedCatalogs {
  std::shared_ptr<const CompiledCatalog> before;
  std::shared_ptr<const CompiledCatalog> after;
  CatalogDiff diff;
  draw::CatalogGraph graph;
};

/// Reads and compares two catalogs, compiled ones or YAML. Null if one of them cannot be used,
/// which is said.
[[nodiscard]] std::unique_ptr<const ComparedCatalogs> read_and_compare(const std::string& before,
                                                                       const std::string& after);

}  // namespace cbc::cli
