#pragma once

#include <string_view>

#include "cbc/loaded_catalog.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::test {

/// A catalog written to a file and loaded from it, by the public interface. Whatever goes wrong
/// fails the test.
[[nodiscard]] LoadedCatalog load(const CompiledCatalog& catalog);
/// The same, from the text of the catalog.
[[nodiscard]] LoadedCatalog load_text(std::string_view yaml);

}  // namespace cbc::test
