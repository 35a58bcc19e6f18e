#pragma once

#include <string>
#include <string_view>

#include "runtime/compiled/compiled_file.h"
#include "support/rich_catalog.h"

namespace cbc::test {

/// The file of a catalog.
[[nodiscard]] std::string compiled_bytes(std::string_view yaml);

/// A catalog as if it came from a file of robot.yaml, with made-up numbers whatever the format is
/// today.
[[nodiscard]] CompiledFile compiled_file(CompiledCatalog catalog);

}  // namespace cbc::test
