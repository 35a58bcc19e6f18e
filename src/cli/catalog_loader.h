#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "catalog/catalog.h"
#include "cli/input_files.h"
#include "compiled/compiled_catalog.h"
#include "yaml/document.h"

namespace cbc::cli {

/// Loads catalogs, compiled ones or YAML.
class CatalogLoader {
 public:
  /// `files` must outlive this object.
  explicit CatalogLoader(InputFiles& files) : files_(files) {}

  /// Null if it cannot be used: then it has findings that are errors, or was complained of.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const InputFile& file);
  /// The same for a path, which is read the first time only.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const std::string& path);

  /// A catalog in YAML, fit to be compiled; empty if there are errors.
  [[nodiscard]] std::optional<Catalog> understand(const std::string& path,
                                                  const yaml::Document& document);

 private:
  InputFiles& files_;
  std::map<std::string, std::shared_ptr<const CompiledCatalog>> known_;  ///< by path
};

/// The one catalog of a command line. Null if it cannot be used, which is said.
[[nodiscard]] std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path);

}  // namespace cbc::cli
