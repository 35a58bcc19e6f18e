#pragma once

#include <cstdint>

#include "core/catalog/catalog.h"
#include "property/random.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

namespace cbc::test {

using oracle::Random;

/// What random catalogs are like. Chances are in percent.
struct Shape {
  std::uint32_t tasks = 5;
  std::uint32_t most_behaviors = 3;     ///< of a task
  std::uint32_t most_requirements = 2;  ///< of a behavior
  std::uint32_t exclusivity_lists = 1;
  std::uint32_t most_exclusive = 3;  ///< tasks of a list
  std::uint32_t several_tasks = 15;  ///< chance that a behavior performs a second task
  std::uint32_t minimum = 25;        ///< chance of a minimum performance
  std::uint32_t on_request = 30;     ///< chance that a task starts on request only
  std::uint32_t zero = 2;            ///< chance of a suitability of 0
  std::uint32_t any_percent = 0;     ///< chance of a suitability of any whole percent over 50
  bool is_deep = false;              ///< behaviors have all their requirements, nearby
};

/// An acyclic catalog. Suitabilities are such that equal products, products that are very close,
/// and exact performance boundaries are frequent.
[[nodiscard]] Catalog random_catalog(Random& random, const Shape& shape);

/// Gives all behaviors a suitability of 1.
void make_perfect(Catalog& catalog);

/// A tree of tasks: each requires one or both of its two children, which have nothing to do with
/// each other but for some lists of exclusive leaves. So components are within components. The
/// root is T0.
[[nodiscard]] CompiledCatalog random_nested_components(Random& random);

/// A group with the most tasks.
[[nodiscard]] GroupId largest_group(const CompiledCatalog& catalog);

/// A problem as an event (a start, a stop or a finish) in a state that may be reached poses it:
/// what starts on request only either has a request or stays at "not running".
[[nodiscard]] Problem random_problem(Random& random, const CompiledCatalog& catalog, GroupId group);

/// Lets some tasks of the problem's group run before the event, with any of their behaviors.
void run_some(Random& random, const CompiledCatalog& catalog, Problem& problem);

/// Much is open in its largest group: several tasks are requested, some of them have to run, and
/// nearly every behavior is available.
[[nodiscard]] Problem random_open_problem(Random& random, const CompiledCatalog& catalog);

}  // namespace cbc::test
