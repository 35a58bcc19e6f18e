#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/command_line/limits.h"

namespace cbc::cli {

/// The options of `cbc tune`.
struct TuneOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::optional<std::string> html;
  std::vector<std::string> only;  ///< BEHAVIOR:TASK; empty: all numbers
  std::string fail_under;         ///< percent; empty: whatever they are
  std::string margin = "0";       ///< percent
  bool write = false;
  std::optional<std::uint64_t> jobs;
  bool all_states = false;
  StateLimits limits;  ///< of each exploration
};

/// Tunes a catalog, and writes the report. Returns the exit status.
[[nodiscard]] int tune(const TuneOptions& options);
/// The same over all states.
[[nodiscard]] int tune_states(const TuneOptions& options);

}  // namespace cbc::cli
