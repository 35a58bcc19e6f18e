#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/report/blocks.h"
#include "coverage/engine/coverage.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/missing_missions.h"
#include "coverage/engine/mutants/mutants.h"
#include "runtime/compiled/compiled_catalog.h"

// The reports of `cbc coverage`.

namespace cbc {

[[nodiscard]] std::string coverage_to_json(const Coverage& coverage);
[[nodiscard]] std::string coverage_schema();

/// Adds what the missions of a catalog cover, in numbers.
void add_counts(const CatalogCoverage& coverage, Blocks& report);

/// A page with the lines of the catalogs, marked as covered, partly covered or not.
[[nodiscard]] std::string coverage_to_html(const Coverage& coverage);

/// The first one is the default.
[[nodiscard]] std::span<const ReportFormat<Coverage>> coverage_formats();

/// What `cbc coverage --write-missing` reports.
struct WrittenMissions {
  const CompiledCatalog* catalog = nullptr;
  StatedAssumptions assumptions;
  std::span<const Goal> goals;
  std::optional<std::uint64_t> missions;  ///< that were there; empty: none were named
  const MissingMissions* missing = nullptr;
  std::string incomplete;          ///< what ended the work, and where; empty: nothing did
  std::vector<std::string> paths;  ///< by script; empty if they were not written
  std::string next;  ///< the command that looks at what the scripts leave; may be empty
};

/// The result for people. `columns`: of the terminal, see wrap_line.
[[nodiscard]] std::string written_missions_to_text(const WrittenMissions& tests,
                                                   std::size_t columns = 0);

// The reports of `cbc coverage --mutants`.

/// How many mutants there are of each result.
struct MutantCount {
  std::uint64_t noticed = 0;
  std::uint64_t survived = 0;
  std::uint64_t equivalent = 0;
  std::uint64_t undecided = 0;
  std::uint64_t without_script = 0;  ///< of these: see MutantVerdict::Doubt
  std::uint64_t unjudged = 0;

  /// How many are noticed, of all but those that no mission can notice.
  [[nodiscard]] GoalCount score() const {
    return {noticed + survived + undecided + unjudged, noticed, 0};
  }
  /// Whether it is known of all whether a mission can notice them.
  [[nodiscard]] bool is_complete() const { return undecided + unjudged == 0; }
};

/// The mutants of a catalog, and what its missions make of them.
struct MutantsResult {
  const Catalog* catalog = nullptr;
  const CompiledCatalog* compiled = nullptr;  ///< of the same
  StatedAssumptions assumptions;
  std::vector<std::string> missions;    ///< their files
  std::vector<Mutant> mutants;          ///< by line
  std::vector<MutantVerdict> verdicts;  ///< by mutant
  bool writes_scripts = false;          ///< the missions are written to files, too

  [[nodiscard]] MutantCount count() const;
};

[[nodiscard]] std::string mutants_to_json(const MutantsResult& result);
[[nodiscard]] std::string mutants_schema();

/// The first one is the default.
[[nodiscard]] std::span<const ReportFormat<MutantsResult>> mutants_formats();

}  // namespace cbc
