#pragma once

#include <string>
#include <string_view>

#include "compiled/compiled_file.h"

namespace cbc::test {

/// A small catalog with something of everything: several groups, tasks and behaviors of all kinds,
/// requirements and minimums, exclusivity, parameters, packages, timeouts.
extern const std::string_view rich_catalog;

/// The file of a catalog.
[[nodiscard]] std::string compiled_bytes(std::string_view yaml);

/// A catalog as if it came from a file of robot.yaml, with made-up numbers whatever the format is
/// today.
[[nodiscard]] CompiledFile compiled_file(CompiledCatalog catalog);

}  // namespace cbc::test
