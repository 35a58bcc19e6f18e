#include "cli/catalog_loader.h"

#include <utility>

#include "catalog/reader.h"
#include "compiled/compile.h"

namespace cbc::cli {

std::shared_ptr<const CompiledCatalog> CatalogLoader::load(const InputFile& file) {
  if (file.document == nullptr) {
    std::optional<CompiledFile> compiled = cli::load(file.compiled);
    if (!compiled) return nullptr;
    return std::make_shared<const CompiledCatalog>(std::move(compiled->catalog));
  }
  const std::optional<Catalog> catalog = understand(file.path, *file.document);
  if (!catalog) return nullptr;
  return std::make_shared<const CompiledCatalog>(compile(*catalog));
}

std::shared_ptr<const CompiledCatalog> CatalogLoader::load(const std::string& path) {
  const auto [entry, is_new] = known_.try_emplace(path, nullptr);
  if (is_new) {
    if (const std::optional<InputFile> file = files_.read_catalog(path))
      entry->second = load(*file);
  }
  return entry->second;
}

std::optional<Catalog> CatalogLoader::understand(const std::string& path,
                                                 const yaml::Document& document) {
  Diagnostics diagnostics;
  CatalogReading reading = understand_catalog(document, diagnostics);
  if (!files_.take_findings(path, document, std::move(diagnostics))) return std::nullopt;
  return std::move(reading.catalog);
}

std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path) {
  InputFiles files;
  auto catalog = CatalogLoader(files).load(path);
  files.print_findings();
  return catalog;
}

}  // namespace cbc::cli
