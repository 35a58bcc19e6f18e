#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/components.h"
#include "runtime/solver/cost_bound.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/learning_search.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/propagation.h"
#include "runtime/solver/repair.h"

namespace cbc {

/// How to search. Without limits every answer is proven.
struct SearchOptions {
  // The limits of Solver::solve, together with the calls of solve_again after it.
  std::uint64_t max_nodes = 0;              ///< decisions; 0: no limit
  std::chrono::microseconds time_limit{0};  ///< 0: no limit
  /// Asked again and again, at least as often as the clock is looked at; true ends the search as if
  /// its time were over. It may be empty. For programs in which somebody may press Ctrl-C.
  std::function<bool()> is_stopped;
  /// The paper's m: take the best of the first m solutions, found depth first, with tasks in
  /// catalog order and values by rank. 0: branch and bound to the proven optimum.
  std::uint64_t max_solutions = 0;
  /// Take the first solution instead of the best.
  bool any_solution = false;
  /// A search that takes more decisions than this is hard: it restarts with cost bounds and
  /// component decomposition, which cost too much for the many easy ones. No answer depends on it.
  std::uint64_t easy_nodes = 100;
  /// A hard search learns no-goods: from the start if it has no incumbent by then, else after this
  /// many decisions. UINT64_MAX: never. No answer depends on it, either.
  std::uint64_t bounded_nodes = 1000;
};

/// Finds the best solution of a problem (docs/semantics.md, "Objectives"): by branch and bound,
/// which allocates in the constructor only, or else by a search that learns, whose memory grows to
/// what the problems need.
class Solver {
 public:
  /// The catalog must outlive the solver.
  Solver(const CompiledCatalog& catalog, const SearchOptions& options);

  /// If the status has a solution, `solution` is set.
  SearchResult solve(const Problem& problem, Assignment& solution);
  /// The same, within what the last call of solve, and those of this function since then, have left
  /// of the limits.
  SearchResult solve_again(const Problem& problem, Assignment& solution);

  /// When the last call of solve, with those of solve_again after it, has to end.
  [[nodiscard]] const std::optional<std::chrono::steady_clock::time_point>& deadline() const {
    return budget_.deadline;
  }

  /// What no solution of the problem exceeds. `answer`: a solution, to count the requests beyond
  /// its own; the best may also serve others.
  [[nodiscard]] SearchBound bound(const Problem& problem, const Assignment& answer);

 private:
  struct Decision {
    enum class Kind : std::uint8_t {
      assign,  ///< the task runs with the value, or else not with that value
      run,     ///< the task runs, or else it does not
      stop     ///< the task does not run, or else it does
    };
    Kind kind = Kind::run;
    LocalTask task;
    std::uint32_t value_index = none;
  };
  struct Frame {
    Decision decision;
    Domains::Mark mark;
  };
  /// The search in one component: its frames lie above `base`.
  struct ComponentSearch {
    Incumbent best;
    std::size_t base = 0;
    Domains::Mark mark;
    std::int64_t best_cost_outside = 0;   ///< of the needed tasks outside, each at its best
    std::int64_t cost_bound_outside = 0;  ///< of all that is outside
  };

  void load(const Problem& problem);
  void return_to_root();
  [[nodiscard]] bool begin();
  [[nodiscard]] bool search();
  [[nodiscard]] ComponentSearch& current() { return searches_[components_.depth()]; }

  [[nodiscard]] bool may_improve();
  [[nodiscard]] bool accept();
  [[nodiscard]] bool should_learn() const;
  void repair();
  [[nodiscard]] bool search_learning();
  [[nodiscard]] SearchBound bound_of_best(const Assignment& answer);
  [[nodiscard]] SearchBound compare_requests(const Assignment& answer) const;
  [[nodiscard]] bool serve_requests_of(const Assignment& answer);
  [[nodiscard]] double bound_suitability();
  [[nodiscard]] bool should_restart() const;
  void restart();
  [[nodiscard]] bool enter_component(const Decision& decision);
  [[nodiscard]] bool leave_component();

  [[nodiscard]] bool branch(const Decision& decision);
  [[nodiscard]] bool backtrack();
  [[nodiscard]] bool take(const Decision& decision);
  [[nodiscard]] bool refuse(const Decision& decision);

  [[nodiscard]] std::optional<Decision> decide();
  [[nodiscard]] std::optional<Decision> decide_in_catalog_order() const;
  [[nodiscard]] LocalTask choose_task() const;
  [[nodiscard]] std::uint32_t choose_value(LocalTask task);
  [[nodiscard]] CostBound::Cost estimate(LocalTask task, std::uint32_t index);

  const CompiledCatalog& catalog_;
  const SearchOptions options_;
  Domains domains_;
  Propagator propagator_;
  Components components_;
  Objective objective_;
  CostBound cost_bound_;
  LearningSearch learning_;
  Repair repair_;

  const Problem* problem_ = nullptr;
  SearchResult result_;
  bool is_hard_ = false;
  bool is_hopeless_ = false;  ///< learning takes over
  bool has_split_ = false;    ///< into components
  std::vector<Frame> frames_;
  std::array<ComponentSearch, Components::deepest + 1> searches_;
  SearchBudget budget_;
};

}  // namespace cbc
