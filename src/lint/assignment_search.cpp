#include "lint/assignment_search.h"

#include <algorithm>
#include <utility>

namespace cbc {
namespace {

/// A decision takes about as long as looking at this many values.
constexpr std::uint64_t effort_of_a_node = 50;
constexpr std::uint64_t most_effort = 100'000'000;

SearchOptions search_options(std::uint64_t max_nodes, bool any_solution) {
  SearchOptions options;
  options.max_nodes = max_nodes;
  options.any_solution = any_solution;
  // Looking ahead bounds the objective, which does not matter for any solution.
  if (any_solution) options.easy_nodes = UINT64_MAX;
  return options;
}

}  // namespace

AssignmentSearch::AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes)
    : catalog_(std::move(catalog)),
      tasks_(catalog_.tasks.begin(), catalog_.tasks.end()),
      any_(catalog_, search_options(max_nodes, true), no_ranks_),
      best_(catalog_, search_options(max_nodes, false), no_ranks_),
      domains_(catalog_.words.back(), 0),
      effort_left_(most_effort) {
  catalog_.tasks = tasks_;
  for (ValueId value = 0; value < catalog_.values.items.size(); ++value) {
    const Bit bit = bit_of(value);
    domains_[bit.word] |= bit.mask;
  }
}

AssignmentSearch::Bit AssignmentSearch::bit_of(ValueId value) const {
  const TaskId task = catalog_.task_of(value);
  const std::uint32_t place = value - catalog_.values.begin[task];
  return {catalog_.words[task] + place / 64, std::uint64_t{1} << (place % 64)};
}

void AssignmentSearch::rule_out(ValueId value) {
  const Bit bit = bit_of(value);
  domains_[bit.word] &= ~bit.mask;
}

Feasibility AssignmentSearch::find(ValueId value, std::span<const TaskId> closed,
                                   Assignment& solution) {
  const TaskId task = catalog_.task_of(value);
  open_group(catalog_.tasks[task].group);
  for (const TaskId other : closed) close(other);
  close(task);
  allow(value);
  must_run(task);
  return solve(any_, solution);
}

/// The assignments with the best product of all suitabilities run nothing that lowers it beside the
/// task and what it requires, so their product is the best performance.
AssignmentSearch::Best AssignmentSearch::best_performance(TaskId task, bool ignore_minimum) {
  open_group(catalog_.tasks[task].group);
  must_run(task);
  CompiledTask& compiled = tasks_[task];
  const CompiledTask before = compiled;
  if (ignore_minimum) {
    compiled.minimum_performance = 0;
    compiled.minimum_cost = 0;
    // Its values may have been ruled out by the minimum.
    for (const Value& value : catalog_.values[task]) {
      allow(static_cast<ValueId>(&value - catalog_.values.items.data()));
    }
  }
  Best best;
  Assignment solution;
  best.exists = solve(best_, solution);
  compiled = before;
  if (best.exists == Feasibility::yes) best.factors = factors_of(task, solution);
  return best;
}

/// The problem of a group with all that is not ruled out.
void AssignmentSearch::open_group(std::uint32_t group) {
  const TaskId first = catalog_.group_tasks[group];
  const TaskId end = catalog_.group_tasks[group + 1];
  problem_.group = group;
  problem_.domains.assign(domains_.begin() + catalog_.words[first],
                          domains_.begin() + catalog_.words[end]);
  problem_.may_stop.assign(end - first, 1);
  problem_.present.assign(end - first, none);
}

std::uint32_t AssignmentSearch::first_word() const {
  return catalog_.words[catalog_.group_tasks[problem_.group]];
}

void AssignmentSearch::allow(ValueId value) {
  const Bit bit = bit_of(value);
  problem_.domains[bit.word - first_word()] |= bit.mask;
}

void AssignmentSearch::must_run(TaskId task) {
  problem_.may_stop[task - catalog_.group_tasks[problem_.group]] = 0;
}

void AssignmentSearch::close(TaskId task) {
  const std::uint32_t first = first_word();
  std::fill(problem_.domains.begin() + (catalog_.words[task] - first),
            problem_.domains.begin() + (catalog_.words[task + 1] - first), 0);
}

/// A solution that a limit left unproven is no answer: the best one may be another.
Feasibility AssignmentSearch::solve(Solver& solver, Assignment& solution) {
  if (effort_left_ == 0) return Feasibility::unknown;
  const SearchResult result = solver.solve(problem_, solution);
  const std::uint64_t effort = result.nodes * effort_of_a_node + problem_.may_stop.size();
  effort_left_ -= std::min(effort, effort_left_);
  switch (result.status) {
    case SearchStatus::optimal:
      return Feasibility::yes;
    case SearchStatus::feasible:
      return &solver == &any_ ? Feasibility::yes : Feasibility::unknown;
    case SearchStatus::infeasible:
      return Feasibility::no;
    case SearchStatus::unknown:
      break;
  }
  return Feasibility::unknown;
}

std::vector<Millionths> AssignmentSearch::factors_of(TaskId task,
                                                     const Assignment& solution) const {
  const TaskId first = catalog_.group_tasks[problem_.group];
  std::vector<TaskId> closure{task};
  std::vector<Millionths> factors;
  for (std::size_t next = 0; next < closure.size(); ++next) {
    const Value& value = catalog_.values[closure[next]][solution[closure[next] - first]];
    factors.push_back(value.suitability);
    for (const CompiledRequirement& requirement : catalog_.requirements[value.behavior]) {
      if (std::find(closure.begin(), closure.end(), requirement.task) == closure.end()) {
        closure.push_back(requirement.task);
      }
    }
  }
  return factors;
}

}  // namespace cbc
