#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/objective.h"

namespace cbc {

/// An upper bound on the performance of a task in the present subtree: the product of the best
/// suitabilities of the task and of all that it requires with every behavior it has left (its
/// closure).
class PerformanceBound {
 public:
  struct Bound {
    bool reachable = true;  ///< false: a task of the closure cannot run
    bool zero = false;
    std::int64_t cost = 0;
    std::uint32_t factors = 0;
  };

  PerformanceBound(const CompiledCatalog& catalog, const Domains& domains);

  [[nodiscard]] Bound bound(std::uint32_t task);
  /// The tasks of the closures of all bounds so far: what they took.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

  /// The tasks of the last bound; the last of them is the one that cannot run, if any.
  [[nodiscard]] const std::vector<std::uint32_t>& closure() const { return closure_; }
  [[nodiscard]] bool in_closure(std::uint32_t task) const {
    return in_closure_[task] == closure_number_;
  }

  /// Whether the last bound is below a minimum, exactly.
  [[nodiscard]] bool is_below(const Bound& bound, Millionths minimum, std::int64_t minimum_cost);

 private:
  const CompiledCatalog& catalog_;
  const Domains& domains_;
  std::vector<std::uint32_t> closure_;
  std::vector<std::uint64_t> in_closure_;  ///< by task: number of the last closure it was in
  std::uint64_t closure_number_ = 0;
  std::uint64_t effort_ = 0;
  ExactProduct product_;
  ExactProduct minimum_;
};

}  // namespace cbc
