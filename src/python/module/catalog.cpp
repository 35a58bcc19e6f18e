#include "python/module/catalog.h"

#include <utility>

#include "core/files/file_set.h"
#include "core/files/recognition.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::python {
namespace {

std::shared_ptr<const Catalog> make_catalog(std::string name, std::string path, std::string text,
                                            std::shared_ptr<const CompiledCatalog> compiled,
                                            std::vector<Diagnostic> findings) {
  return std::make_shared<const Catalog>(Catalog{std::move(name), std::move(path), std::move(text),
                                                 std::move(compiled), std::move(findings)});
}

CatalogLoading load_compiled_text(std::string name, std::string path, std::string text) {
  CompiledFileResult result = read_compiled(text);
  if (!result.file) return {nullptr, {}, concat("cannot read ", quote(name), ": ", result.error)};
  auto compiled = std::make_shared<const CompiledCatalog>(std::move(result.file->catalog));
  return {make_catalog(std::move(name), std::move(path), std::move(text), std::move(compiled), {}),
          {},
          {}};
}

/// What else than a catalog the file is; empty: nothing else.
std::string find_other_kind(const cli::InputFile& file) {
  if (file.is(cli::FileKind::script)) return "script";
  if (file.is(cli::FileKind::properties)) return "property file";
  if (file.is(cli::FileKind::log)) return "log of a stream";
  return {};
}

}  // namespace

CatalogLoading load_catalog(std::string name, std::string path, std::string text) {
  if (is_compiled(text)) {
    return load_compiled_text(std::move(name), std::move(path), std::move(text));
  }
  cli::FileSet files;
  const auto file = files.parse(name, text);
  if (const std::string kind = find_other_kind(*file); !kind.empty()) {
    return {nullptr, {}, concat(quote(name), " is a ", kind, "; expected a catalog")};
  }
  std::vector<Diagnostic> findings = file->diagnostics.all();
  if (file->document == nullptr) return {nullptr, std::move(findings), {}};
  const auto checked = files.load(*file);
  findings.insert(findings.end(), files.findings().begin(), files.findings().end());
  if (checked == nullptr || checked->compiled == nullptr) {
    return {nullptr, std::move(findings), concat("the catalog ", quote(name), " cannot be used")};
  }
  return {make_catalog(std::move(name), std::move(path), std::move(text), checked->compiled,
                       std::move(findings)),
          {},
          {}};
}

}  // namespace cbc::python
