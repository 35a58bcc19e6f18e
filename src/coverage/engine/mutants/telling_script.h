#pragma once

#include <optional>
#include <span>
#include <string>

#include "cbc/units.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A script that tells a mutant from the original, as text: these events, with timeouts if these
/// are not in the way, then an expectation that holds on the original, and of which no part holds
/// on the mutant. Empty if no expectation at one of the times tells them apart; the first one that
/// does counts. `script` is one for the original, without expectations; both catalogs have the same
/// tasks.
[[nodiscard]] std::optional<std::string> find_telling_script(const CompiledCatalog& original,
                                                             const CompiledCatalog& mutant,
                                                             const Script& script,
                                                             std::span<const Microseconds> times);

}  // namespace cbc
