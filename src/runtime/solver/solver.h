#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/components.h"
#include "solver/cost_bound.h"
#include "solver/domains.h"
#include "solver/objective.h"
#include "solver/problem.h"
#include "solver/propagator.h"

namespace cbc {

/// How to search. Without limits every answer is proven.
struct SearchOptions {
  std::uint64_t max_nodes = 0;              ///< decisions of one search; 0: no limit
  std::chrono::microseconds time_limit{0};  ///< for one search; 0: no limit
  /// The paper's m: depth first, tasks in catalog order, values by rank, take the best of the first
  /// m solutions. 0: branch and bound to the proven optimum.
  std::uint64_t max_solutions = 0;
  /// Take the first solution instead of the best.
  bool any_solution = false;
  /// A search that takes more decisions than this is hard: it begins anew, with what costs too much
  /// on the many easy ones, looking ahead and splitting into parts. No answer depends on it.
  std::uint64_t easy_nodes = 100;
};

/// Finds the best solution of a problem: the paper's objectives f1 to f4 in order, then the
/// canonical order. Allocates in its constructor only.
class Solver {
 public:
  /// `ranks`: by value, its place in the order of its task; empty: as the values stand. Both
  /// references must outlive the solver.
  Solver(const CompiledCatalog& catalog, const SearchOptions& options,
         const std::vector<std::uint32_t>& ranks);

  /// If the status has a solution, `solution` is set.
  SearchResult solve(const Problem& problem, Assignment& solution);

 private:
  struct Decision {
    enum class Kind : std::uint8_t {
      assign,  ///< the task runs with the place, or else not with that place
      run,     ///< the task runs, or else it does not
      stop     ///< the task does not run, or else it does
    };
    Kind kind = Kind::run;
    std::uint32_t task = 0;
    std::uint32_t place = none;
  };
  struct Frame {
    Decision decision;
    Domains::Mark mark;
  };
  /// The search of one part: its frames lie above `base`.
  struct Scope {
    Incumbent best;
    std::size_t base = 0;
    Domains::Mark mark;
    std::int64_t floor_elsewhere = 0;  ///< cost of the needed tasks outside, at their best
    std::int64_t bound_elsewhere = 0;  ///< least cost of all that is outside
  };

  void load(const Problem& problem);
  [[nodiscard]] bool begin();
  [[nodiscard]] bool search();
  [[nodiscard]] Scope& scope() { return scopes_[parts_.depth()]; }

  [[nodiscard]] bool may_improve();
  [[nodiscard]] Lookahead::Cost enough_to_prune(const Incumbent& best) const;
  [[nodiscard]] bool accept();
  [[nodiscard]] bool is_out_of_budget() const;
  [[nodiscard]] bool is_to_look_ahead() const;
  void start_to_look_ahead();
  [[nodiscard]] bool enter_part(const Decision& decision);
  [[nodiscard]] bool leave_part();

  [[nodiscard]] bool branch(const Decision& decision);
  [[nodiscard]] bool backtrack();
  [[nodiscard]] bool take(const Decision& decision);
  [[nodiscard]] bool refuse(const Decision& decision);

  [[nodiscard]] std::optional<Decision> decide();
  [[nodiscard]] std::optional<Decision> decide_in_catalog_order() const;
  [[nodiscard]] std::uint32_t choose_task() const;
  [[nodiscard]] std::uint32_t choose_place(std::uint32_t task);
  [[nodiscard]] Lookahead::Cost estimate(std::uint32_t task, std::uint32_t place);

  const CompiledCatalog& catalog_;
  const SearchOptions options_;
  Domains domains_;
  Propagator propagator_;
  Parts parts_;
  Objective objective_;
  Lookahead lookahead_;

  const Problem* problem_ = nullptr;
  SearchResult result_;
  bool looks_ahead_ = false;
  std::vector<Frame> frames_;
  std::array<Scope, Parts::deepest + 1> scopes_;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace cbc
