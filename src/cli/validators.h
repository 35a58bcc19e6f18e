#pragma once

#include <cstdint>
#include <limits>

#include <CLI/CLI.hpp>

/// Checks of option values that CLI11 lacks, with messages that say what was expected.
namespace cbc::cli {

/// Accepts a whole number from `least` to `most`.
[[nodiscard]] CLI::Validator whole_number(
    std::int64_t least, std::int64_t most = std::numeric_limits<std::int64_t>::max());

/// Accepts a time in seconds, over 0.
[[nodiscard]] CLI::Validator seconds();

}  // namespace cbc::cli
