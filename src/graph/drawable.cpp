#include "graph/drawable.h"

#include <algorithm>
#include <utility>

#include "core/compile/compile.h"

namespace cbc::cli {
namespace {

std::unique_ptr<Drawable> from_compiled(CompiledCatalog catalog) {
  auto drawable = std::make_unique<Drawable>();
  drawable->compiled = std::make_shared<const CompiledCatalog>(std::move(catalog));
  drawable->graph = draw::to_graph(*drawable->compiled);
  return drawable;
}

bool has_errors(const std::vector<Diagnostic>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Diagnostic& finding) { return finding.severity == Severity::error; });
}

/// Null if nothing can be drawn.
std::unique_ptr<Drawable> from_text(InputFiles& files, const InputFile& file) {
  InputFiles::CheckedFile checked =
      files.check_catalog(file.path, *file.document, InputFiles::Purpose::drawing);
  if (checked.is_usable) return from_compiled(compile(checked.reading.catalog));
  // If there is no error, the settings could not be read.
  if (!has_errors(files.findings())) return nullptr;
  auto drawable = std::make_unique<Drawable>();
  drawable->reading = std::move(checked.reading);
  drawable->graph = draw::to_graph(drawable->reading, files.findings());
  const draw::CatalogGraph& graph = drawable->graph;
  if (graph.tasks.empty() && graph.behaviors.empty()) return nullptr;
  return drawable;
}

}  // namespace

std::unique_ptr<Drawable> to_drawable(InputFiles& files, const InputFile& file) {
  if (file.document != nullptr) return from_text(files, file);
  std::optional<CompiledFile> compiled = load(file.compiled);
  return compiled ? from_compiled(std::move(compiled->catalog)) : nullptr;
}

std::unique_ptr<Drawable> read_drawable(const std::string& path) {
  InputFiles files;
  std::unique_ptr<Drawable> drawable;
  if (const std::optional<InputFile> file = files.read_catalog(path)) {
    drawable = to_drawable(files, *file);
  }
  files.print_findings();
  return drawable;
}

}  // namespace cbc::cli
