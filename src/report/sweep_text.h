#pragma once

#include <string>

#include "sweep/result.h"
#include "text/style.h"

namespace cbc {

/// The result of a sweep for people.
[[nodiscard]] std::string sweep_to_text(const SweepResult& result, const Style& style);

}  // namespace cbc
