#pragma once

#include <functional>
#include <span>
#include <vector>

#include "explain/reason.h"

namespace cbc {

/// Whether there is a solution with these reasons in force, and no others.
using HasSolution = std::function<bool(std::span<const Reason>)>;

/// A minimal set of reasons out of `candidates`, which together leave no solution: with any one of
/// the set left out there is one.
[[nodiscard]] std::vector<Reason> minimal_set(std::span<const Reason> candidates,
                                              const HasSolution& has_solution);

}  // namespace cbc
