#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::python {

/// A catalog that can be used, with what it was made of. It never changes, and is shared by all
/// that needs it.
struct Catalog {
  std::string name;  ///< in messages
  std::string path;  ///< absolute; empty: made of a text
  std::string text;  ///< YAML or compiled
  std::shared_ptr<const CompiledCatalog> compiled;
  std::vector<Diagnostic> findings;  ///< warnings and notes
};

/// A catalog, or why there is none.
struct CatalogLoading {
  std::shared_ptr<const Catalog> catalog;
  std::vector<Diagnostic> findings;
  std::string error;  ///< if there are no findings that say it
};

/// Checks a catalog as `cbc solve` does, under the settings (.cbc.yaml) of the folder that the name
/// says. Needs no GIL.
[[nodiscard]] CatalogLoading load_catalog(std::string name, std::string path, std::string text);

}  // namespace cbc::python
