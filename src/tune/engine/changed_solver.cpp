#include "tune/engine/changed_solver.h"

#include <algorithm>

#include "core/compile/compile.h"

namespace cbc {

ChangedSolver::ChangedSolver(const CompiledCatalog& recorded, const Catalog& catalog,
                             const TunableNumber& number, KnownCosts& costs)
    : recorded_(recorded),
      catalog_(compile(catalog, costs)),
      solver_(catalog_, {}),
      has_number_(catalog_.values.items.size(), 0) {
  const auto find = [&](TaskId task, BehaviorId behavior) {
    const auto values = catalog_.values[task];
    const auto found = std::find_if(values.begin(), values.end(),
                                    [&](const Value& value) { return value.behavior == behavior; });
    return static_cast<std::uint32_t>(found - values.begin());
  };
  for (TaskId task(0); task < recorded.tasks.size(); ++task) {
    for (const Value& value : recorded.values[task]) places_.push_back(find(task, value.behavior));
  }
  if (number.kind != TunableNumber::Kind::suitability) return;
  for (const TunableNumber::Use& use : number.uses) {
    const TaskId task = catalog_.task_ids[use.task];
    const std::uint32_t value =
        catalog_.values.begin[task] + find(task, catalog_.behavior_ids[use.behavior]);
    has_number_[value] = 1;
    value_ = catalog_.values.items[value].suitability;
  }
}

bool ChangedSolver::keeps(const SolvedProblem& decision) {
  translate(decision);
  if (!has_solution(solver_.solve(problem_, solution_).status)) return !decision.answer;
  return decision.answer && solution_ == answer_;
}

void ChangedSolver::translate(const SolvedProblem& decision) {
  const Problem& from = decision.problem;
  problem_ = from;
  first_ = catalog_.group_tasks[from.group];
  std::fill(problem_.domains.begin(), problem_.domains.end(), 0);
  for (LocalTask task(0); task < from.present.size(); ++task) {
    problem_.present[task] = place(first_ + task, from.present[task]);
    const std::uint32_t word = catalog_.words[first_ + task] - catalog_.words[first_];
    for (std::uint32_t index = 0; index < catalog_.values[first_ + task].size(); ++index) {
      if ((from.domains[word + index / 64] >> (index % 64) & 1U) == 0) continue;
      const std::uint32_t there = place(first_ + task, index);
      problem_.domains[word + there / 64] |= std::uint64_t{1} << (there % 64);
    }
  }
  if (!decision.answer) return;
  answer_ = *decision.answer;
  for (LocalTask task(0); task < answer_.size(); ++task) {
    answer_[task] = place(first_ + task, answer_[task]);
  }
}

bool ChangedSolver::may_be_beaten(const SolvedProblem& decision, Millionths lower) {
  translate(decision);
  tasks_.clear();
  searches_ = 0;
  for (LocalTask task(0); task < answer_.size(); ++task) {
    const auto values = catalog_.values[first_ + task];
    // Where a product is 0 in any case, no suitability matters.
    if (answer_[task] != none && !has_number(first_ + task, answer_[task]) &&
        values[answer_[task]].suitability == 0) {
      return false;
    }
    const std::uint32_t word = catalog_.words[first_ + task] - catalog_.words[first_];
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      if ((problem_.domains[word + index / 64] >> (index % 64) & 1U) == 0) continue;
      if (!has_number(first_ + task, index)) continue;
      tasks_.push_back(task);
      break;
    }
  }
  // An assignment that has the number less often lacks it for one of the tasks of the answer.
  const auto has_it = [&](LocalTask task) { return has_number(first_ + task, answer_[task]); };
  count_ = static_cast<std::size_t>(std::stable_partition(tasks_.begin(), tasks_.end(), has_it) -
                                    tasks_.begin());
  return may_be_beaten(lower, 0, 0);
}

/// Of those that have the number for `chosen` of the tasks before `next`, as the domains say.
bool ChangedSolver::may_be_beaten(Millionths lower, std::size_t next, std::size_t chosen) {
  constexpr std::size_t most_searches = 200;
  const bool has_answer = chosen == next && next < count_;  // which is the best of them
  if (!has_answer) {
    if (++searches_ > most_searches) return true;
    if (!has_solution(solver_.solve(problem_, solution_).status)) return false;
    if (is_worse(lower, chosen)) return false;
    if (next == tasks_.size()) return chosen > 0;
  }
  const LocalTask task = tasks_[next];
  const std::uint32_t first_word = catalog_.words[first_ + task] - catalog_.words[first_];
  const std::uint32_t end_word = catalog_.words[first_ + task + 1] - catalog_.words[first_];
  const std::vector<std::uint64_t> domain(problem_.domains.begin() + first_word,
                                          problem_.domains.begin() + end_word);
  const std::uint8_t may_stop = problem_.may_stop[task];
  for (const bool has_it : {true, false}) {
    if (has_it && chosen + 1 >= count_) continue;
    if (has_it) problem_.may_stop[task] = 0;
    for (std::uint32_t index = 0; index < catalog_.values[first_ + task].size(); ++index) {
      if (has_number(first_ + task, index) == has_it) continue;
      problem_.domains[first_word + index / 64] &= ~(std::uint64_t{1} << (index % 64));
    }
    const bool may_be = may_be_beaten(lower, next + 1, chosen + (has_it ? 1 : 0));
    std::copy(domain.begin(), domain.end(), problem_.domains.begin() + first_word);
    problem_.may_stop[task] = may_stop;
    if (may_be) return true;
  }
  return false;
}

/// Whether the answer serves more important requests than the solution, or its product with the
/// lower suitability is higher than that of any assignment that the solution is the best of.
bool ChangedSolver::is_worse(Millionths lower, std::size_t chosen) {
  for (const LocalTask task : problem_.requests) {
    if ((solution_[task] == none) != (answer_[task] == none)) return true;
  }
  ours_.clear();
  theirs_.clear();
  for (LocalTask task(0); task < answer_.size(); ++task) {
    const auto values = catalog_.values[first_ + task];
    if (answer_[task] != none) {
      ours_.multiply(has_number(first_ + task, answer_[task]) ? lower
                                                              : values[answer_[task]].suitability);
    }
    if (solution_[task] == none) continue;
    if (values[solution_[task]].suitability == 0) return true;
    theirs_.multiply(values[solution_[task]].suitability);
  }
  for (std::size_t times = 0; times < chosen; ++times) {
    ours_.multiply(value_);
    theirs_.multiply(lower);
  }
  return ExactProduct::compare(theirs_, ours_) < 0;
}

}  // namespace cbc
