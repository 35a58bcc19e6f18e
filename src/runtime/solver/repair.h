#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/propagation.h"

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
    LocalTask task;
    std::uint32_t index = 0;
    Domains::Mark before;
  };

  /// A needed task with a choice. Those that cannot keep their behavior come first, so that the
  /// others can make way; then the highest level, so that a task comes after those that require
  /// it; then the one that was needed first.
  struct Candidate {
    bool lost_present_value = false;
    std::uint32_t level = 0;
    std::uint32_t place = 0;  ///< among the needed tasks
    bool operator<(const Candidate& other) const {
      return std::tie(lost_present_value, level, other.place) <
             std::tie(other.lost_present_value, other.level, place);
    }
  };
  struct Listing {
    std::uint32_t place = 0;
    bool lost_present_value = false;
  };

  [[nodiscard]] bool find_solution_with(std::size_t together);
  [[nodiscard]] bool serve(LocalTask task);
  [[nodiscard]] bool drop(LocalTask task, const Domains::Mark& before);
  [[nodiscard]] bool assign_needed_tasks();
  void list_candidates();
  void list_new_candidates();
  void list_candidate(LocalTask task);
  [[nodiscard]] LocalTask take_next_task();
  [[nodiscard]] std::uint32_t choose_value(LocalTask task);
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::int64_t>> try_value(
      LocalTask task, std::uint32_t index);
  [[nodiscard]] bool assign(LocalTask task, std::uint32_t index);
  [[nodiscard]] std::uint32_t count_lost_requests() const;
  [[nodiscard]] bool has_present_value(LocalTask task) const {
    const std::uint32_t index = problem_->present[task];
    return index != none && domains_.has(task, index);
  }

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Propagator& propagator_;
  const Problem* problem_ = nullptr;
  std::vector<Choice> choices_;
  /// A heap. A task that loses its present value is listed again; what is left of tasks that have
  /// one value by then is passed over.
  std::vector<Candidate> candidates_;
  std::vector<Listing> listings_;  ///< by task; of needed ones
  Domains::Mark listed_;           ///< up to where the changes of the domains are in the heap
};

}  // namespace cbc
