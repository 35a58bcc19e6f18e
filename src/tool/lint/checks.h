#pragma once

#include <span>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "catalog/reader.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/diagnostic.h"
#include "explain/reasons.h"
#include "lint/lint.h"
#include "lint/proofs.h"

namespace cbc {

/// Reports what is odd about behaviors, each by itself.
void check_behaviors(const Catalog& catalog, bool is_complete, Reporter& reporter);

/// Reports what is odd about tasks and their parameters, each by itself.
void check_tasks(const CatalogReading& reading, Reporter& reporter);

/// Reports exclusivity lists that exclude nothing, or nothing new.
void check_exclusivity(const Catalog& catalog, Reporter& reporter);

/// Reports behaviors that require two tasks which exclude one another. Returns, by behavior,
/// whether it can never be active because of that, or because it requires a task that excludes its
/// own (which has been reported).
[[nodiscard]] std::vector<bool> check_conflicting_requirements(const Catalog& catalog,
                                                               Reporter& reporter);

/// Whether a percentage is over 0 and at most 1: probably a fraction where percent is meant.
[[nodiscard]] bool looks_like_fraction(Millionths degree);

/// A product of degrees, rounded down to four places.
[[nodiscard]] std::string show_product(const std::vector<Millionths>& factors);

/// Reports a minimum performance that looks like a fraction.
void check_suspicious_minimum(Millionths minimum, const Range& range, Reporter& reporter);

/// The requirement of a task by a behavior that has one; of several the strongest, or the first.
[[nodiscard]] const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task);

/// Notes that say, for each of a set of constraints, what it is and where it stands.
[[nodiscard]] std::vector<Note> constraint_notes(std::span<const Reason> constraints,
                                                 const Catalog& catalog,
                                                 const CompiledCatalog& compiled,
                                                 const Reporter& reporter);

/// Reports tasks and behaviors that no assignment has, with a minimal set of constraints as the
/// reason; each fault where it is, and not again where it shows.
void check_dead(Semantics& semantics);

/// Reports minimum performances that no choice of behaviors reaches, with the best that is reached.
void check_minimum_performances(Semantics& semantics);

/// Reports requirements of tasks that start on request only, and what has to be requested first.
void check_on_request_requirements(Semantics& semantics);

/// The same for a catalog that was not understood as a whole: only the required task itself is
/// known to be requested first. `conflicts`: by behavior, whether it can never be active.
void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter);

/// Reports requirements that are satisfied wherever the behavior and all other constraints are.
void check_redundant_requirements(Semantics& semantics);

/// Reports what the constraints of a catalog make impossible, or say in vain: exactly, by search.
/// All names of the catalog were understood, and its requirements have no cycle.
/// `conflicts`: of check_conflicting_requirements.
void check_semantics(const CatalogReading& reading, const CompiledCatalog& compiled,
                     const std::vector<bool>& conflicts, const LintOptions& options,
                     Reporter& reporter);

}  // namespace cbc
