#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "coverage/engine/coverage.h"
#include "coverage/engine/mutants/judge.h"
#include "coverage/engine/mutants/mutants.h"
#include "runtime/compiled/compiled_catalog.h"

// The reports of `cbc coverage --mutants`.

namespace cbc {

/// How many mutants there are of each result.
struct MutantCount {
  std::uint64_t noticed = 0;
  std::uint64_t survived = 0;
  std::uint64_t equivalent = 0;
  std::uint64_t undecided = 0;
  std::uint64_t without_script = 0;  ///< of these: see MutantVerdict::Doubt
  std::uint64_t unjudged = 0;

  /// Of those that a mission could notice, how many one does.
  [[nodiscard]] GoalCount score() const { return {noticed + survived, noticed, 0}; }
  /// Whether the score says anything: some count, or it is known that none does.
  [[nodiscard]] bool is_score_known() const { return score().goals > 0 || is_complete(); }
  /// Whether it is known of all whether they count.
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

/// A table by line, then the survivors with a mission that would notice each. `columns`: of the
/// terminal, see wrap_line.
[[nodiscard]] std::string mutants_to_text(const MutantsResult& result, const Style& style,
                                          std::size_t columns = 0);

[[nodiscard]] std::string mutants_to_json(const MutantsResult& result);
[[nodiscard]] std::string mutants_schema();

/// Workflow commands of GitHub Actions: one for each line with survivors.
[[nodiscard]] std::string mutants_to_github(const MutantsResult& result);

/// A format of `cbc coverage --mutants`.
struct MutantsFormat {
  std::string_view name;
  std::string (*write)(const MutantsResult& result, const Style& style, std::size_t columns);
};

/// The first one is the default.
[[nodiscard]] std::span<const MutantsFormat> mutants_formats();

}  // namespace cbc
