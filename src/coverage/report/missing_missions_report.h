#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/missing_missions.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What `cbc coverage --write-missing` reports.
struct WrittenMissions {
  const CompiledCatalog* catalog = nullptr;
  StatedAssumptions assumptions;
  std::span<const Goal> goals;
  std::optional<std::uint64_t> missions;  ///< that were there; empty: none were named
  const MissingMissions* missing = nullptr;
  std::vector<std::string> paths;  ///< by script
  std::string next;  ///< the command that looks at what the scripts leave; may be empty
};

/// The result for people. `columns`: of the terminal, see wrap_line.
[[nodiscard]] std::string written_missions_to_text(const WrittenMissions& tests,
                                                   std::size_t columns = 0);

}  // namespace cbc
