#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/propagation.h"

namespace cbc {

/// A lower bound on the cost of the needed tasks and all that they require, for a search that
/// learns: a bound with its reasons. As in CostBound, it is the sum of what is subtracted from the
/// arcs of one cut after the other, until each needed task can run at no residual cost. The needed
/// task of a cut is its root, and all these steps are an ascent. For heights and supporters see
/// landmark_bound.cpp.
class LandmarkBound {
 public:
  LandmarkBound(const CompiledCatalog& catalog, const Domains& domains, const CatalogTrail& trail);

  /// What is bounded: -log of f2, or, where f2 is 1, the number of idle tasks that run (f3); then a
  /// value with another suitability is prohibitive.
  enum class Measure : std::uint8_t { log, idle };

  /// Begins with the group of the trail, at level 0. The needed tasks, and those with a request,
  /// must be known.
  void load();
  /// To be called before each decision.
  void begin_level();
  void backtrack_to(std::uint32_t level);

  /// The level of the last ascent on the present branch, or none.
  [[nodiscard]] std::uint32_t level() const { return level_; }

  void set_measure(Measure measure);

  /// Raises the bound of the present subtree until it exceeds `threshold`, or no cut is left. In a
  /// group of n tasks that may take n^2 steps: a limit of the budget ends it, when no time is left
  /// or, so that the result is always the same, after a number of steps. To be called at a fixpoint
  /// of the trail.
  std::int64_t raise(std::int64_t threshold, const SearchBudget& budget = {}) {
    return ascend(threshold, budget, budget.max_nodes > 0 ? most_steps : UINT64_MAX);
  }
  /// At level 0: a bound on -log of f2 in the present domains, the highest one for most groups.
  std::int64_t bound_again();

  // After raise(), which did not exceed its threshold:

  /// By how much the bound would grow at least if the task had this value.
  [[nodiscard]] std::int64_t residual(LocalTask task, std::uint32_t index) const {
    return residuals_[value_begin_[task] + index];
  }
  /// An estimate of what a value of the domain costs beyond the bound.
  [[nodiscard]] std::int64_t estimate(LocalTask task, std::uint32_t index) const;
  /// The tasks that needed ones may require.
  [[nodiscard]] const std::vector<LocalTask>& relevant_tasks() const { return relevant_; }
  /// The highest initial cost of a value.
  [[nodiscard]] std::int64_t highest_cost() const { return highest_cost_; }

  /// Appends literals from which the bound follows, if it may be lower by `slack`.
  void append_grounds(std::int64_t slack, std::vector<Literal>& reason) const {
    append_grounds(present_grounds(slack), reason);
  }
  /// The same for later, while the present level lasts: for append_saved_grounds.
  [[nodiscard]] std::uint32_t save_grounds(std::int64_t slack);
  void append_saved_grounds(std::uint32_t number, std::vector<Literal>& reason) const {
    append_grounds(saved_[number], reason);
  }

 private:
  struct Cut {
    std::int64_t amount = 0;
    LocalTask root;
    std::uint32_t level = 0;       ///< highest of its root and grounds
    std::size_t first_ground = 0;  ///< in grounds_, up to that of the next cut
  };
  /// The cuts that a bound is made of, and by how much it may be lower.
  struct Grounds {
    std::uint32_t first_cut = 0;
    std::uint32_t end_cut = 0;
    std::int64_t slack = 0;
  };
  /// A value of a task that needed ones may require: only these can be arcs.
  struct Candidate {
    std::uint32_t value = 0;
    LocalTask task;
    std::uint32_t first_target = 0;  ///< in targets_: the required tasks with a height
    std::uint32_t end_target = 0;
    LocalTask supporter = none;  ///< the highest of them; none if none has a height any more
    std::uint32_t next = none;   ///< the next candidate with the same supporter
    bool is_removed = false;     ///< from the domain; then it has no supporter
  };
  struct LevelMark {
    std::size_t cuts = 0;
    std::size_t grounds = 0;
    std::size_t saved = 0;
  };

  static constexpr std::uint64_t most_steps = 10'000'000;  ///< where a number of steps is a limit

  void find_relevant_tasks();
  void start_ascent();
  std::int64_t ascend(std::int64_t threshold, const SearchBudget& budget, std::uint64_t steps);
  [[nodiscard]] bool has_to_end(const SearchBudget& budget, std::uint64_t last_step);
  void find_reached_tasks();
  void add_candidates(LocalTask task);
  void mark(LocalTask task);
  void update_heights();
  void lower(const Candidate& candidate);
  void find_supporter(std::uint32_t number);
  [[nodiscard]] std::int64_t height_of(const Candidate& candidate) const {
    const LocalTask supporter = candidate.supporter;
    return residuals_[candidate.value] + (supporter == none ? 0 : seen_heights_[supporter]);
  }
  [[nodiscard]] bool sort_unsettled();
  [[nodiscard]] bool find_cut(LocalTask root);
  void subtract_cut(LocalTask root);
  [[nodiscard]] bool requires_cut(const Candidate& candidate) const;
  [[nodiscard]] Grounds present_grounds(std::int64_t slack) const {
    return {first_cut_, static_cast<std::uint32_t>(cuts_.size()), slack};
  }
  void append_grounds(const Grounds& grounds, std::vector<Literal>& reason) const;

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  const CatalogTrail& trail_;

  // The group. Values are counted within it.
  std::vector<std::uint32_t> value_begin_;        ///< by task, and the end
  std::vector<std::uint32_t> requirement_begin_;  ///< by value, and the end
  std::vector<LocalTask> requirements_;           ///< tasks
  std::vector<LocalTask> relevant_;
  std::vector<LocalTask> order_;       ///< relevant tasks in topological order
  std::vector<std::uint32_t> places_;  ///< by task: its place in order_
  std::vector<std::int64_t> costs_;    ///< by value
  std::int64_t highest_cost_ = 0;
  Measure measure_ = Measure::log;

  // The last ascent.
  std::uint64_t version_ = 0;             ///< of the trail
  std::uint32_t level_ = none;            ///< none: it is of another branch
  std::vector<std::uint8_t> is_reached_;  ///< by task: whether needed ones may require it
  std::vector<std::int64_t> residuals_;   ///< by value: cost that no cut has charged
  std::vector<Candidate> candidates_;
  std::vector<LocalTask> targets_;
  std::vector<std::uint32_t> candidates_begin_;  ///< by task that is reached, in candidates_
  std::vector<std::uint32_t> candidates_end_;
  std::vector<std::uint32_t> first_supported_;  ///< by task: the first candidate it supports
  std::vector<std::int64_t> heights_;           ///< by task
  std::vector<std::int64_t> seen_heights_;      ///< by task: as those see it that require it
  std::vector<LocalTask> unsettled_;            ///< needed tasks that had a height before the round
  std::vector<std::uint64_t> marked_;           ///< bit set of places: tasks whose height has sunk
  std::size_t first_marked_ = SIZE_MAX;         ///< no word of marked_ before this one is set
  std::int64_t bound_ = 0;
  std::uint64_t steps_ = 0;       ///< of all ascents: tasks of cuts, and roots that were sorted
  std::uint64_t next_check_ = 0;  ///< the step to look at the clock

  // The last cut.
  std::vector<LocalTask> cut_;
  std::vector<std::uint64_t> in_cut_;  ///< by task: number of the last cut it was in
  std::uint64_t cut_number_ = 0;
  std::vector<std::uint32_t> arcs_;  ///< candidates that require no task of the cut

  // Reasons. Those of level 0 are not needed.
  std::vector<Cut> cuts_;        ///< of all ascents on the present branch
  std::uint32_t first_cut_ = 0;  ///< of the last ascent
  std::vector<Literal> grounds_;
  std::vector<Grounds> saved_;
  std::vector<LevelMark> marks_;
  mutable std::vector<std::uint32_t> sorted_cuts_;  ///< scratch of append_grounds
};

}  // namespace cbc
