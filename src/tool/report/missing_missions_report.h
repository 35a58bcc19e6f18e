#pragma once

#include <cstdint>
#include <optional>
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
  std::string assumptions;  ///< in words: see describe_assumptions
  std::span<const Goal> goals;
  std::optional<std::uint64_t> missions;  ///< that were there; empty: none were named
  const MissingMissions* missing = nullptr;
  std::vector<std::string> paths;  ///< by script
  std::string next;  ///< the command that looks at what the scripts leave; may be empty
};

/// The result for people.
[[nodiscard]] std::string written_tests_to_text(const WrittenTests& tests);

}  // namespace cbc
