#pragma once

#include <string>

#include "coordinator/coordinator.h"
#include "script/runner.h"

/// How runs end, whatever their events come from.
namespace cbc::cli {

/// Why a run ended early, or empty.
[[nodiscard]] std::string describe_end(const RunResult& result, const CoordinatorOptions& options);

/// The exit status that a run gives.
[[nodiscard]] int status_of(const RunResult& result);

}  // namespace cbc::cli
