#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "happening.h"
#include "runtime/compiled/compiled_catalog.h"

// What compare_catalogs() is held against: two plain models in lockstep.

namespace cbc::plain {

/// Old names and new ones.
struct PlainRenames {
  std::map<std::string, std::string> tasks;
  std::map<std::string, std::string> behaviors;
  std::map<std::string, std::string> variables;
};

struct PlainComparison {
  bool has_error = false;    ///< the first state is excluded
  bool is_complete = false;  ///< false: there were too many pairs, and the rest means nothing
  bool differs = false;
  std::vector<Move> moves;  ///< the first of the shortest whose last event differs; new numbers
  /// By task, by its name in the new catalog if that has it: the first move after which it runs
  /// with another behavior.
  std::map<std::string, std::vector<Move>> running;
  bool is_compared = false;  ///< a start, stop or finish came in both
  // If the search did not end at a difference.
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::uint32_t depth = 0;
};

/// What counts as a difference: see ComparisonScope::Differences. The first one that is expectable
/// ends the search.
enum class PlainDifferences : std::uint8_t { all, expectable };

struct PlainScope {
  PlainDifferences differences = PlainDifferences::all;
  PlainRenames renames = {};
  bool allow_missing = false;
};

/// Visits the pairs of states breadth first, for each set of groups that names join, as long as
/// what both have is decided alike. `assumptions` are about the new catalog. `max_states`: of each
/// set of groups.
[[nodiscard]] PlainComparison compare_plainly(const CompiledCatalog& old_catalog,
                                              const CompiledCatalog& new_catalog,
                                              const Assumptions& assumptions,
                                              std::uint64_t max_states,
                                              const PlainScope& scope = {});

/// The same for equal happenings of catalogs with other numbers: tasks and behaviors by name.
[[nodiscard]] std::string named(const CompiledCatalog& catalog, const Happening& happening);

}  // namespace cbc::plain
