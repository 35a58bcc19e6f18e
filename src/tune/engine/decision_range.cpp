// Sensitivity analysis of discrete optima, exactly, by bisection on the grid of a ten-thousandth of
// a percent. Of two assignments with different powers of a number in their products, one is better
// below some value and the other one above it (at 0, where both products are 0, either may be); a
// requirement holds from some value on, or up to some value. So where a number stands for one pair,
// the values for which an answer stays the best are an interval, apart from 0. A minimum
// performance is in no product, and has an interval in any case.
//
// Where a suitability stands for several pairs, an assignment may become possible at some value, be
// the best, and be overtaken by the former answer, which has the number more often. Then the answer
// at both ends of an interval says nothing of what is between. It does if the answer is also the
// best with the suitability of the lower end among all assignments that are possible at the higher
// one: what beats it in between would beat it at one of the ends. With minimum performances that
// are lowered in proportion, all of these are possible at the lower end, so that is one more
// search.
//
// A decision is what the solver was asked, whatever led to it, so each is looked at once for all
// missions, and no mission runs while a bound is searched. To compute bounds from products would
// take all assignments, of which there are far too many.

#include "tune/engine/decision_range.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "runtime/solver/solver.h"

namespace cbc {
namespace {

const std::vector<std::uint32_t> no_ranks;

/// The solver of a catalog that differs in numbers from the recorded one, so that the values of a
/// task may be in another order.
class Variant {
 public:
  Variant(const CompiledCatalog& recorded, const Catalog& catalog)
      : recorded_(recorded), catalog_(compile(catalog)), solver_(catalog_, {}, no_ranks) {
    for (TaskId task(0); task < recorded.tasks.size(); ++task) {
      const auto values = catalog_.values[task];
      for (const Value& value : recorded.values[task]) {
        const auto found = std::find_if(values.begin(), values.end(), [&](const Value& one) {
          return one.behavior == value.behavior;
        });
        places_.push_back(static_cast<std::uint32_t>(found - values.begin()));
      }
    }
  }

  /// Whether the answer is the recorded one.
  [[nodiscard]] bool keeps(const SolvedProblem& decision) {
    const TaskId first = catalog_.group_tasks[decision.problem.group];
    translate(decision.problem, first);
    if (!has_solution(solver_.solve(problem_, solution_).status)) return !decision.answer;
    if (!decision.answer) return false;
    for (LocalTask task(0); task < solution_.size(); ++task) {
      if (solution_[task] != place(first + task, (*decision.answer)[task])) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] std::uint32_t place(TaskId task, std::uint32_t recorded) const {
    return recorded == none ? none : places_[recorded_.values.begin[task] + recorded];
  }
  void translate(const Problem& from, TaskId first) {
    problem_ = from;
    std::fill(problem_.domains.begin(), problem_.domains.end(), 0);
    for (LocalTask task(0); task < from.present.size(); ++task) {
      problem_.present[task] = place(first + task, from.present[task]);
      const std::uint32_t word = catalog_.words[first + task] - catalog_.words[first];
      for (std::uint32_t index = 0; index < catalog_.values[first + task].size(); ++index) {
        if ((from.domains[word + index / 64] >> (index % 64) & 1U) == 0) continue;
        const std::uint32_t there = place(first + task, index);
        problem_.domains[word + there / 64] |= std::uint64_t{1} << (there % 64);
      }
    }
  }

  const CompiledCatalog& recorded_;
  const CompiledCatalog catalog_;
  Solver solver_;
  std::vector<std::uint32_t> places_;  ///< by value of the recorded catalog: its place in the task
  Problem problem_;
  Assignment solution_;
};

class RangeSearch {
 public:
  RangeSearch(const Catalog& catalog, const TunableNumber& number, const Recording& recording)
      : catalog_(catalog), number_(number), recorded_(recording.catalog) {
    for (const TunableNumber::Use& use : number.uses) tasks_.insert(recorded_.task_ids[use.task]);
    for (const SolvedProblem& decision : recording.decisions) {
      if (count_open_tasks(decision.problem) > 0) concerned_.push_back(&decision);
    }
  }

  Millionths run(Millionths value, bool upwards) {
    const bool is_suitability = number_.kind == TunableNumber::Kind::suitability;
    if (is_suitability && upwards && value == 0) {
      if (!all_stay(1)) return 0;
      value = 1;
    }
    Millionths end = upwards ? one_million : is_suitability && value > 0 ? 1 : 0;
    for (const SolvedProblem* const decision : concerned_) {
      if (end != value && !stays_until(*decision, value, end)) end = bisect(*decision, value, end);
    }
    return is_suitability && !upwards && end == 1 && all_stay(0) ? 0 : end;
  }

 private:
  /// How many tasks that may run have the number. Where one may not, neither its suitabilities nor
  /// what is required of it matter.
  [[nodiscard]] std::ptrdiff_t count_open_tasks(const Problem& problem) const {
    const std::uint32_t first_word = recorded_.words[recorded_.group_tasks[problem.group]];
    return std::count_if(tasks_.begin(), tasks_.end(), [&](TaskId task) {
      if (recorded_.tasks[task].group != problem.group) return false;
      const auto domain = problem.domains.begin() - first_word;
      return std::any_of(domain + recorded_.words[task], domain + recorded_.words[task + 1],
                         [](std::uint64_t word) { return word != 0; });
    });
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

  [[nodiscard]] Variant& at(Millionths value) {
    if (at_.second == nullptr || at_.first != value) {
      Catalog changed = catalog_;
      set_number(changed, number_, value);
      at_ = {value, std::make_unique<Variant>(recorded_, changed)};
    }
    return *at_.second;
  }

  /// The catalog with the lower value, in which all is possible that is with the higher one: a
  /// performance has the number once for each task at most.
  [[nodiscard]] Variant& relaxed(Millionths low, Millionths high) {
    if (relaxed_.second == nullptr || relaxed_.first != std::pair(low, high)) {
      Catalog changed = catalog_;
      set_number(changed, number_, low);
      const auto lower = [&](Millionths& minimum) {
        for (std::size_t count = 0; count < tasks_.size() && minimum > 0; ++count) {
          minimum = static_cast<Millionths>(std::uint64_t{minimum} * low / high);
        }
      };
      for (Task& task : changed.tasks) lower(task.minimum_performance);
      for (Behavior& behavior : changed.behaviors) {
        for (Requirement& one : behavior.requirements) lower(one.minimum_performance);
      }
      relaxed_ = {{low, high}, std::make_unique<Variant>(recorded_, changed)};
    }
    return *relaxed_.second;
  }

  /// Whether a decision is known to stay up to `end`, as it does at `value`.
  [[nodiscard]] bool stays_until(const SolvedProblem& decision, Millionths value, Millionths end) {
    if (!at(end).keeps(decision)) return false;
    const auto [low, high] = std::minmax(value, end);
    return high - low == 1 || !needs_proof(decision) || relaxed(low, high).keeps(decision);
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

  const Catalog& catalog_;
  const TunableNumber& number_;
  const CompiledCatalog& recorded_;
  std::set<TaskId> tasks_;  ///< that have the number
  std::vector<const SolvedProblem*> concerned_;
  // The last ones, as one decision after the other is asked about the same values.
  std::pair<Millionths, std::unique_ptr<Variant>> at_;
  std::pair<std::pair<Millionths, Millionths>, std::unique_ptr<Variant>> relaxed_;
};

}  // namespace

Millionths last_unchanged(const Catalog& catalog, const TunableNumber& number, Millionths value,
                          const Recording& recording, bool upwards) {
  return RangeSearch(catalog, number, recording).run(value, upwards);
}

}  // namespace cbc
