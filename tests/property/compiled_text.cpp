#include "compiled_text.h"

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

namespace cbc::oracle {

std::optional<CompiledCatalog> compile_yaml(const std::string& yaml) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
  if (!document) return std::nullopt;
  const auto compiled = lint_catalog(*document, {}, diagnostics).compiled;
  if (compiled == nullptr) return std::nullopt;
  return *compiled;
}

}  // namespace cbc::oracle
