#pragma once

#include <string>

#include "runtime/compiled/compiled_file.h"

namespace cbc {

/// What a compiled catalog holds, as JSON, one task, behavior or exclusivity list on a line. Bytes
/// that are no valid UTF-8 are replaced.
[[nodiscard]] std::string catalog_json(const CompiledFile& file);
[[nodiscard]] std::string catalog_schema();

}  // namespace cbc
