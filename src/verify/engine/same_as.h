#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/explore.h"

namespace cbc {

// Whether two catalogs decide every reachable event alike (docs/verify.md, "Two catalogs"). Tasks,
// behaviors, variables and their values are the same if they have the same name.

/// What only one of two catalogs has, each in words: "task LAND", "value dark of LIGHT".
struct CatalogNames {
  std::vector<std::string> only_old;
  std::vector<std::string> only_new;
};

struct CatalogComparison {
  CatalogNames names;
  Verdict::Result result = Verdict::Result::undecided;
  std::uint64_t states = 0;           ///< pairs of states
  std::uint64_t transitions = 0;      ///< pairs of transitions
  std::uint32_t depth = 0;            ///< see Exploration, of the deepest one
  std::optional<ExplorationEnd> end;  ///< undecided: what ended the first search that was ended
  /// Violated: the shortest moves of which the last is decided differently, and their script, which
  /// expects at its end what the new catalog does.
  std::vector<Move> moves;
  std::optional<Witness> witness;
  Script old_script;  ///< the same events for the old catalog, without the expectation
  std::optional<std::string> error;  ///< see Exploration
};

/// What a comparison is about.
struct ComparisonScope {
  /// What counts as a difference after a move.
  enum class Differences : std::uint8_t {
    all,  ///< see CatalogComparison
    /// What an expectation can see: the outcome of a start, stop or finish of a script, and the
    /// tasks that run with their behaviors.
    expectable
  };
  Differences differences = Differences::all;
  /// Only the groups that are explored together with this one of the new catalog.
  std::optional<std::uint32_t> group;
};

/// Assumptions about the new catalog for a comparison without a property file: what either catalog
/// lets happen by default, as far as both know its name.
[[nodiscard]] Assumptions common_assumptions(const CompiledCatalog& old_catalog,
                                             const CompiledCatalog& new_catalog);

/// Visits the pairs of states that the same moves lead to in both catalogs. `assumptions` are about
/// the new one; what the old one has no name for is left out.
[[nodiscard]] CatalogComparison compare_catalogs(const CompiledCatalog& old_catalog,
                                                 const CompiledCatalog& new_catalog,
                                                 const Assumptions& assumptions,
                                                 const ExplorationOptions& options,
                                                 const ComparisonScope& scope = {});

}  // namespace cbc
