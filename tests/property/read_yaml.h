#pragma once

#include <string>

#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "demand.h"

namespace cbc::oracle {

/// What `read_document` makes of a text that must have no errors.
template <typename Read>
auto read_yaml(const std::string& text, const Read& read_document) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "text", diagnostics);
  demand(document != nullptr, "no YAML");
  auto result = read_document(*document, diagnostics);
  demand(diagnostics.count(Severity::error) == 0, "errors");
  return result;
}

}  // namespace cbc::oracle
