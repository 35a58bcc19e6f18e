#pragma once

#include <cstdint>

#include <CLI/CLI.hpp>

/// Checks of option values that CLI11 lacks, with messages that say what was expected.
namespace cbc::cli {

/// Accepts a whole number from `least` to 2^63 - 1.
[[nodiscard]] CLI::Validator whole_number(std::int64_t least);

/// Accepts a time in seconds, over 0.
[[nodiscard]] CLI::Validator seconds();

}  // namespace cbc::cli
