#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/domains.h"
#include "solver/problem.h"
#include "solver/propagator.h"

namespace cbc {

/// Repairs the present configuration: finds a solution near it in few steps, without a proof of
/// anything. What must run comes first, then the requests, the most important one first; each keeps
/// its behavior, and those of what it requires, as far as propagation allows. A request that finds
/// no place is dropped.
///
/// It fails only if what must run finds no place within a few steps back. Allocates in the
/// constructor only.
class Repair {
 public:
  Repair(const CompiledCatalog& catalog, Domains& domains, Propagator& propagator);

  /// The domains must be loaded and propagated. True: they hold a solution; each needed task has
  /// one behavior left.
  [[nodiscard]] bool find_solution(const Problem& problem);

 private:
  struct Choice {
    std::uint32_t task = 0;
    std::uint32_t index = 0;
    Domains::Mark before;
  };

  [[nodiscard]] bool find_solution_with(std::size_t together);
  [[nodiscard]] bool serve(std::uint32_t task);
  [[nodiscard]] bool drop(std::uint32_t task, const Domains::Mark& before);
  [[nodiscard]] bool assign_needed_tasks();
  [[nodiscard]] std::uint32_t choose_task() const;
  [[nodiscard]] std::uint32_t choose_value(std::uint32_t task);
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::int64_t>> try_value(
      std::uint32_t task, std::uint32_t index);
  [[nodiscard]] bool assign(std::uint32_t task, std::uint32_t index);
  [[nodiscard]] std::uint32_t count_lost_requests() const;
  [[nodiscard]] bool has_present_value(std::uint32_t task) const {
    const std::uint32_t index = problem_->present[task];
    return index != none && domains_.has(task, index);
  }

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Propagator& propagator_;
  const Problem* problem_ = nullptr;
  std::vector<Choice> choices_;
};

}  // namespace cbc
