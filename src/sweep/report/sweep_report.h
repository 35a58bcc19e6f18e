#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "sweep/engine/sweep.h"

// The reports of `cbc sweep`.

namespace cbc {

/// The result of a sweep as JSON; "stats" is there if the result has times.
[[nodiscard]] std::string sweep_to_json(const SweepResult& result);
[[nodiscard]] std::string sweep_schema();

/// The result of a sweep for people. Of one against an older version only the comparison.
[[nodiscard]] std::string sweep_to_text(const SweepResult& result, const Style& style);
[[nodiscard]] std::string against_to_text(const SweepResult& result, const Style& style);

/// "1000 sequences of 100 events, seed 1"
[[nodiscard]] std::string describe(const SweepSettings& settings);

/// A format of `cbc sweep`.
struct SweepFormat {
  std::string_view name;
  std::string (*write)(const SweepResult& result, const Style& style);
};

/// The first one is the default.
[[nodiscard]] std::span<const SweepFormat> sweep_formats();

}  // namespace cbc
