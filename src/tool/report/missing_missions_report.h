#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coverage/goals.h"
#include "coverage/missing_missions.h"

namespace cbc {

/// What `cbc verify --write-tests` reports.
struct WrittenTests {
  const CompiledCatalog* catalog = nullptr;
  std::span<const Goal> goals;
  std::uint64_t missions = 0;  ///< that were there
  const MissingMissions* missing = nullptr;
  std::vector<std::string> paths;  ///< by script
};

/// The result for people.
[[nodiscard]] std::string written_tests_to_text(const WrittenTests& tests);

}  // namespace cbc
