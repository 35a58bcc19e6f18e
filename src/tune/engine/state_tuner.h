#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "runtime/compiled/compiled_catalog.h"
#include "tune/engine/numbers.h"
#include "tune/engine/solved_problems.h"
#include "tune/engine/tuner.h"
#include "versions/lockstep/same_as.h"

namespace cbc {

/// The decisions of all reachable states of some groups.
struct StateSurvey {
  std::vector<SolvedProblem> decisions;
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::optional<Budget::End> end;    ///< the limit that ended it before all states were visited
  std::optional<std::string> error;  ///< see Exploration
};

/// Tolerances over every decision in every reachable state of a catalog. May be asked by several
/// threads at once.
class StateTuner {
 public:
  /// `file`: what is assumed, and promises that may break. `options`: of the first exploration;
  /// further ones have one thread each, and their part of the memory. The
  /// catalog, which has no errors, the numbers and the file must outlive the tuner.
  StateTuner(const Catalog& catalog, const std::vector<TunableNumber>& numbers,
             const PropertyFile& file, const ExplorationOptions& options);

  /// With the numbers as they are. Nothing else may be asked if a limit ended it.
  [[nodiscard]] const StateSurvey& present() const { return present_; }

  struct StateTolerance {
    Tolerance tolerance;
    std::optional<Budget::End> end;  ///< the limit that ended the search; then it is not known
  };
  [[nodiscard]] StateTolerance tolerance(std::size_t number) const;
  /// Whether some decision uses the number.
  [[nodiscard]] bool is_used(std::size_t number) const;

 private:
  [[nodiscard]] std::vector<GroupId> groups_of(const TunableNumber& number) const;
  [[nodiscard]] StateSurvey survey(const CompiledCatalog& catalog,
                                   const std::vector<GroupId>& groups,
                                   const ExplorationOptions& options) const;
  [[nodiscard]] CatalogComparison compare(const CompiledCatalog& changed,
                                          const std::vector<GroupId>& groups) const;
  [[nodiscard]] RunDifference describe(const EventDifference& difference,
                                       const CompiledCatalog& changed) const;
  void find_broken(const CompiledCatalog& changed, RunDifference& difference,
                   std::optional<Budget::End>& end) const;
  void find_end(std::size_t number, bool upwards, StateTolerance& found) const;

  const Catalog& catalog_;
  const CompiledCatalog compiled_;
  const std::vector<TunableNumber>& numbers_;
  const PropertyFile& file_;
  const ExplorationOptions options_;  ///< of further explorations
  StateSurvey present_;
  std::vector<Verdict::Result> results_;  ///< by property, with the numbers as they are
};

}  // namespace cbc
