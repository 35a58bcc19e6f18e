// Sensitivity analysis of discrete optima, exactly, by bisection on the grid of a ten-thousandth of
// a percent. Of two assignments with different powers of a number in their products, one is better
// below some value and the other one above it (at 0, where both products are 0, either may be); a
// requirement holds from some value on, or up to some value. So where a number stands for one pair,
// the values for which an answer stays the best are an interval, apart from 0. A minimum
// performance is in no product, and has an interval in any case.
//
// Where a suitability stands for several pairs, another assignment may become possible at some
// value, be the best, and be overtaken by the former answer, which has the number more often: then
// the answer at both ends of an interval says nothing of what is between. Only assignments that
// have the number less often, but not never, can do that. There is none if all of these that are
// possible at the higher end have a lower product at the lower end, which takes a few searches; and
// equal products are decided alike between the suitabilities of other behaviors of the same tasks,
// as the canonical order depends on who suits a task better.
//
// A decision is what the solver was asked, whatever led to it, so each is looked at once for all
// missions, and no mission runs while a bound is searched. To compute bounds from products would
// take all assignments, of which there are far too many.

#include "tune/engine/decision_range.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "tune/engine/changed_solver.h"

namespace cbc {
namespace {

class RangeSearch {
 public:
  RangeSearch(Catalog catalog, const TunableNumber& number, const CompiledCatalog& recorded,
              const std::vector<SolvedProblem>& decisions)
      : catalog_(std::move(catalog)), number_(number), recorded_(recorded) {
    std::set<std::pair<TaskId, std::uint32_t>> pairs;
    for (const TunableNumber::Use& use : number.uses) {
      tasks_.insert(recorded_.task_ids[use.task]);
      pairs.emplace(recorded_.task_ids[use.task], use.behavior);
    }
    for (const SolvedProblem& decision : decisions) {
      if (count_open_tasks(decision.problem) > 0) concerned_.push_back(&decision);
    }
    for (const TaskId task : tasks_) {
      for (const Value& value : recorded_.values[task]) {
        const std::uint32_t behavior = recorded_.behaviors[value.behavior].catalog_index;
        if (!pairs.contains({task, behavior})) others_.insert(value.suitability);
      }
    }
  }

  Millionths run(Millionths value, bool upwards) {
    const bool is_suitability = number_.kind == TunableNumber::Kind::suitability;
    if (is_suitability && upwards && value == 0) {
      if (!all_stay(1)) return 0;
      value = 1;
    }
    Millionths end = upwards ? one_million : is_suitability && value > 0 ? 1 : 0;
    for (const bool proves : {false, true}) {  // a proof over a short way is quick
      proves_ = proves;
      for (const SolvedProblem* const decision : concerned_) {
        if (proves && !needs_proof(*decision)) continue;
        if (end == value || stays_until(*decision, value, end)) continue;
        end = bisect(*decision, value, end);
      }
    }
    return is_suitability && !upwards && end == 1 && all_stay(0) ? 0 : end;
  }

 private:
  /// How many tasks that may run have the number. Where one may not, neither its suitabilities nor
  /// what is required of it matter.
  [[nodiscard]] std::ptrdiff_t count_open_tasks(const Problem& problem) const {
    return std::count_if(tasks_.begin(), tasks_.end(),
                         [&](TaskId task) { return may_run(recorded_, problem, task); });
  }

  [[nodiscard]] bool all_stay(Millionths value) {
    return std::all_of(concerned_.begin(), concerned_.end(),
                       [&](const SolvedProblem* one) { return at(value).keeps(*one); });
  }

  /// Whether the same answer at two values does not tell of those between them.
  [[nodiscard]] bool needs_proof(const SolvedProblem& decision) const {
    const TaskId first = recorded_.group_tasks[decision.problem.group];
    const TaskId end = recorded_.group_tasks[decision.problem.group + 1];
    return number_.kind == TunableNumber::Kind::suitability && decision.answer &&
           count_open_tasks(decision.problem) > 1 &&
           std::any_of(&recorded_.tasks[first], &recorded_.tasks[first] + (end - first),
                       [](const CompiledTask& task) { return task.has_performance_rules != 0; });
  }

  /// Most decisions are asked about the same values.
  [[nodiscard]] ChangedSolver& at(Millionths value) {
    constexpr std::size_t most_kept = 64;
    if (solvers_.size() >= most_kept && !solvers_.contains(value)) solvers_.clear();
    std::unique_ptr<ChangedSolver>& solver = solvers_[value];
    if (solver == nullptr) {
      set_number(catalog_, number_, value);
      solver = std::make_unique<ChangedSolver>(recorded_, catalog_, number_, costs_);
    }
    return *solver;
  }

  /// Whether a decision is known to stay up to `end`, as it does at `value`.
  [[nodiscard]] bool stays_until(const SolvedProblem& decision, Millionths value, Millionths end) {
    if (!at(end).keeps(decision)) return false;
    if (!proves_) return true;
    Millionths low = std::min(value, end);
    const Millionths high = std::max(value, end);
    for (auto other = others_.lower_bound(low); other != others_.end() && *other <= high; ++other) {
      if (*other > low && !stays_between(decision, low, *other - 1)) return false;
      if (!at(*other).keeps(decision)) return false;
      low = *other + 1;
    }
    return low > high || stays_between(decision, low, high);
  }

  /// The same where no other behavior has a suitability from `low` to `high`.
  [[nodiscard]] bool stays_between(const SolvedProblem& decision, Millionths low, Millionths high) {
    return at(low).keeps(decision) && at(high).keeps(decision) &&
           (high - low <= 1 || !at(high).may_be_beaten(decision, low));
  }

  /// How far a decision stays, towards `end`. A proof may fail over a long way although all is
  /// well, so the search goes on until the next step is one too far.
  [[nodiscard]] Millionths bisect(const SolvedProblem& decision, Millionths value, Millionths end) {
    while (value != end) {
      Millionths failed = end;
      while (value + 1 < failed || failed + 1 < value) {
        const Millionths middle = std::midpoint(value, failed);
        (stays_until(decision, value, middle) ? value : failed) = middle;
      }
      if (!stays_until(decision, value, failed)) break;
      value = failed;
    }
    return value;
  }

  Catalog catalog_;
  KnownCosts costs_;
  const TunableNumber& number_;
  const CompiledCatalog& recorded_;
  std::set<TaskId> tasks_;       ///< that have the number
  std::set<Millionths> others_;  ///< suitabilities for these tasks
  std::vector<const SolvedProblem*> concerned_;
  bool proves_ = false;  ///< that nothing is between
  std::map<Millionths, std::unique_ptr<ChangedSolver>> solvers_;
};

}  // namespace

Millionths last_unchanged(const Catalog& catalog, const TunableNumber& number, Millionths value,
                          const CompiledCatalog& recorded,
                          const std::vector<SolvedProblem>& decisions, bool upwards) {
  return RangeSearch(catalog, number, recorded, decisions).run(value, upwards);
}

}  // namespace cbc
