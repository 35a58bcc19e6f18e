#include "compiled_text.h"

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

namespace cbc::oracle {

std::optional<CompiledCatalog> compile_yaml(const std::string& yaml) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
  if (!document) return std::nullopt;
  return lint_catalog(*document, {}, diagnostics).compiled;
}

}  // namespace cbc::oracle
