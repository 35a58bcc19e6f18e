#pragma once

#include <span>
#include <string>
#include <vector>

#include "cbc/units.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Runs a script in which each step is a move. `due`: when the queue comes due, which is a move,
/// too, and no step. `moves`: takes what the moves do, in words.
RunResult describe_moves(const CompiledCatalog& catalog, const Script& script,
                         std::span<const Microseconds> due, std::vector<std::string>& moves);

}  // namespace cbc
