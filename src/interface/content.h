#pragma once

#include "cbc/loaded_catalog.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

struct LoadedCatalog::Content {
  CompiledCatalog catalog;
};

}  // namespace cbc
