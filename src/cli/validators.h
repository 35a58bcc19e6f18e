#pragma once

#include <cstdint>
#include <limits>

#include <CLI/CLI.hpp>

#include "cbc/units.h"

/// Checks of option values that CLI11 lacks, with messages that say what was expected.
namespace cbc::cli {

/// Accepts a whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(
    std::int64_t least, std::int64_t most = std::numeric_limits<std::int64_t>::max());

/// Accepts a time in seconds, of so many microseconds at least.
[[nodiscard]] CLI::Validator seconds(Microseconds least = 1);

}  // namespace cbc::cli
