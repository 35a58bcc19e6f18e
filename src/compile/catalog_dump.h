#pragma once

#include <string>

#include "runtime/compiled/compiled_file.h"

namespace cbc {

/// Lists what a compiled catalog holds, for a person and for comparisons: one fact on a line, the
/// terms of catalogs, and no numbers that a change elsewhere would shift (lines of the source are
/// in the JSON only). First the file, then the totals, then each group: its numbers, its tasks
/// (with their behaviors, best first), its behaviors (with what they require) and its exclusivity
/// lists.
[[nodiscard]] std::string catalog_text(const CompiledFile& file);

/// What a compiled catalog holds, as JSON, one task, behavior or exclusivity list on a line. Bytes
/// that are no valid UTF-8 are replaced.
[[nodiscard]] std::string catalog_json(const CompiledFile& file);
[[nodiscard]] std::string catalog_schema();

}  // namespace cbc
