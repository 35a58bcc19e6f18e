#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// The constraint problem of one event in one group. Tasks are counted within the group. A value
/// index is the position of a behavior among those of its task: 0 is the most suitable one.
///
/// Where behaviors are active before, each task that starts only on request has a request, must
/// run, or has an empty domain: the bound on f4 relies on it that no task runs for nothing.
struct Problem {
  GroupId group;
  std::vector<std::uint64_t> domains;  ///< bit sets of value indices, task by task as in words
  std::vector<std::uint8_t> may_stop;  ///< by task: whether "not running" is in the domain
  std::vector<std::uint32_t> present;  ///< by task: value index before the event, or none
  /// Tasks that are asked to run. First those with an active request of priority 1 or more, which
  /// f1 counts, the most important one first; then those whose request is suspended, in the same
  /// order; last those with an active request of priority 0, the most recent one first.
  std::vector<LocalTask> requests;
  std::uint32_t suspended = 0;     ///< number of suspended ones
  std::uint32_t unasked = 0;       ///< number of those with priority 0: nobody asked for them
  std::vector<BehaviorId> active;  ///< active behaviors just before the event
  /// Where this is a subproblem: the problem whose domains fix the canonical order. Null: this one.
  const Problem* subproblem_of = nullptr;

  [[nodiscard]] std::span<const LocalTask> counted_requests() const {
    return std::span(requests).first(requests.size() - suspended - unasked);
  }
  /// All but those of priority 0.
  [[nodiscard]] std::span<const LocalTask> asked_requests() const {
    return std::span(requests).first(requests.size() - unasked);
  }
  [[nodiscard]] std::span<const LocalTask> unasked_requests() const {
    return std::span(requests).last(unasked);
  }
};

/// A value for every task of a group: a value index, or none.
using Assignment = std::vector<std::uint32_t>;

/// Limits of decisions and time, of one search or of several in a row.
struct SearchBudget {
  std::uint64_t max_nodes = 0;     ///< 0: no limit
  std::uint64_t nodes_before = 0;  ///< of earlier searches
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::function<bool()>* is_stopped = nullptr;  ///< true: out of time; null: none

  /// `nodes`: of the present search.
  [[nodiscard]] bool has_nodes_left(std::uint64_t nodes) const {
    return max_nodes == 0 || nodes_before + nodes < max_nodes;
  }
  [[nodiscard]] bool is_out_of_time() const {
    if (is_stopped != nullptr && (*is_stopped)()) return true;
    return deadline && std::chrono::steady_clock::now() >= *deadline;
  }
  [[nodiscard]] bool is_spent(std::uint64_t nodes) const {
    return !has_nodes_left(nodes) || is_out_of_time();
  }
};

enum class SearchStatus : std::uint8_t {
  optimal,     ///< proven best
  feasible,    ///< best so far when a limit stopped the search
  infeasible,  ///< proven that there is no solution
  unknown      ///< a limit stopped the search before the first solution
};

[[nodiscard]] constexpr bool has_solution(SearchStatus status) {
  return status == SearchStatus::optimal || status == SearchStatus::feasible;
}

/// No limit stopped the search.
[[nodiscard]] constexpr bool is_proven(SearchStatus status) {
  return status == SearchStatus::optimal || status == SearchStatus::infeasible;
}

/// How good the best solution of a problem may be at most, where a limit ended the search before
/// the proof (docs/semantics.md, "Search limits").
struct SearchBound {
  std::uint32_t more_requests = 0;  ///< that it may serve beyond as many as the answer serves
  /// Whether it serves the same requests as the answer, so that f2 is the first to be better.
  bool same_requests = false;
  /// Of its f2 within the group; by rounding and by the search, that of the answer may be higher.
  double suitability = 1;
};

struct SearchResult {
  SearchStatus status = SearchStatus::infeasible;
  std::uint64_t solutions =
      0;  ///< each better than the one before; all that were met with max_solutions
  std::uint64_t nodes = 0;  ///< decisions taken
  /// How often the constraints of a task with a changed domain were applied to the other tasks.
  std::uint64_t propagations = 0;
  /// The tasks that were looked at for bounds of performances.
  std::uint64_t performance_effort = 0;
  SearchBound bound;  ///< of a feasible answer
};

}  // namespace cbc
