// Compiled catalogs, without the headers that read them.
#pragma once

#include <optional>
#include <string>

#include "runtime/compiled/compiled_catalog.h"

namespace cbc::oracle {

// Nothing if the catalog was not understood. Requirements that exclude each other are allowed.
std::optional<CompiledCatalog> compile_yaml(const std::string& yaml);

}  // namespace cbc::oracle
