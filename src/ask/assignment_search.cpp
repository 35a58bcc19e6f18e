#include "ask/assignment_search.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cbc {
namespace {

/// A decision takes about as long as looking at this many values.
constexpr std::uint64_t effort_of_a_node = 50;
/// So many tasks in a bound of a performance take about as long as one value.
constexpr std::uint64_t performance_tasks_in_effort = 4;
/// A long search asks now and then whether it may go on.
constexpr std::uint32_t decisions_between_questions = 10'000;

}  // namespace

BehaviorSet behaviors_of(const CompiledCatalog& catalog, TaskId task,
                         const Assignment& assignment) {
  const TaskId first = catalog.group_tasks[catalog.tasks[task].group];
  BehaviorSet active;
  for (LocalTask local(0); local < assignment.size(); ++local) {
    if (assignment[local] == none) continue;
    active.push_back(catalog.values[first + local][assignment[local]].behavior);
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  return active;
}

AssignmentSearch::AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes, Effort effort)
    : catalog_(std::move(catalog)),
      tasks_(catalog_.tasks.begin(), catalog_.tasks.end()),
      max_nodes_(max_nodes),
      domains_(catalog_.words.back(), 0),
      effort_(std::move(effort)) {
  catalog_.tasks = tasks_;
  for (ValueId value(0); value < catalog_.values.items.size(); ++value) {
    const Bit bit = bit_of(value);
    domains_[bit.word] |= bit.mask;
    const auto fitting = catalog_.fitting_values_of(catalog_.values.items[value].behavior);
    if (!fitting.empty()) conditions_.push_back({value, fitting});
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

Feasibility AssignmentSearch::find(GroupId group, std::span<const Demand> demands,
                                   Assignment& solution, const Situations& where, Wanted wanted) {
  open_group(group);
  if (where.space != nullptr) close_misfits(*where.space, *where.sets);
  for (const Demand& each : demands) demand(each);
  return solve(wanted, solution);
}

/// The assignments with the best product of all suitabilities run nothing that lowers it beside the
/// task and what it requires, so their product is the best performance.
AssignmentSearch::Best AssignmentSearch::best_performance(TaskId task, bool ignore_minimum) {
  open_group(catalog_.tasks[task].group);
  demand({Demand::Kind::run, task, none});
  CompiledTask& compiled = tasks_[task];
  const CompiledTask before = compiled;
  if (ignore_minimum) {
    compiled.minimum_performance = 0;
    compiled.minimum_cost = 0;
    // Its values may have been ruled out by the minimum.
    for (const Value& value : catalog_.values[task]) {
      const Bit bit = bit_of(static_cast<ValueId>(&value - catalog_.values.items.data()));
      word_of(bit) |= bit.mask;
    }
  }
  Best best;
  Assignment solution;
  best.exists = solve(Wanted::best, solution);
  compiled = before;
  if (best.exists == Feasibility::yes) best.factors = factors_of(task, solution);
  return best;
}

/// The problem of a group with all values that are not ruled out.
void AssignmentSearch::open_group(GroupId group) {
  const TaskId first = catalog_.group_tasks[group];
  const TaskId end = catalog_.group_tasks[group + 1];
  problem_.group = group;
  problem_.domains.assign(domains_.begin() + catalog_.words[first],
                          domains_.begin() + catalog_.words[end]);
  problem_.may_stop.assign(end - first, 1);
  problem_.present.assign(end - first, none);
  problem_.requests.clear();
}

void AssignmentSearch::demand(const Demand& demand) {
  const LocalTask local(demand.task - catalog_.group_tasks[problem_.group]);
  const ValueId value(catalog_.values.begin[demand.task] + demand.value_index);
  if (demand.kind == Demand::Kind::has_not) {
    const Bit bit = bit_of(value);
    word_of(bit) &= ~bit.mask;
    return;
  }
  if (demand.kind != Demand::Kind::run) {
    const bool has = demand.kind == Demand::Kind::has;
    const Bit bit = has ? bit_of(value) : Bit{};
    for (std::uint32_t word = catalog_.words[demand.task]; word < catalog_.words[demand.task + 1];
         ++word) {
      word_of({word, 0}) &= has && word == bit.word ? bit.mask : 0;
    }
  }
  if (demand.kind == Demand::Kind::stop || problem_.may_stop[local] == 0) return;
  problem_.may_stop[local] = 0;
  problem_.requests.push_back(local);
}

void AssignmentSearch::close_misfits(const SituationSpace& space, const ValueSets& sets) {
  const ValueId end(catalog_.values.begin[catalog_.group_tasks[problem_.group + 1]]);
  const ValueId begin(catalog_.values.begin[catalog_.group_tasks[problem_.group]]);
  const auto close = [this](ValueId value) {
    const Bit bit = bit_of(value);
    word_of(bit) &= ~bit.mask;
  };
  std::uint64_t effort = 0;
  const auto is_before = [](const Condition& one, ValueId value) { return one.value < value; };
  auto condition = std::lower_bound(conditions_.begin(), conditions_.end(), begin, is_before);
  for (; condition != conditions_.end() && condition->value < end; ++condition) {
    effort += condition->fitting.size();
    if (!space.may_fit(condition->fitting, sets)) close(condition->value);
  }
  for (const BehaviorId behavior : space.denied()) {
    if (catalog_.group_of(behavior) != problem_.group) continue;
    for (const ValueId value : catalog_.performs[behavior]) close(value);
  }
  effort_.spend(effort);
}

/// A solution that a limit left unproven is no answer where the best one is sought.
Feasibility AssignmentSearch::solve(Wanted wanted, Assignment& solution) {
  if (effort_.is_over()) return Feasibility::unknown;
  std::optional<Solver>& solver = wanted == Wanted::any ? any_ : best_;
  if (!solver) {
    SearchOptions options;
    options.max_nodes = max_nodes_;
    options.any_solution = wanted == Wanted::any;
    // The cost bound is about the objective, which does not matter for any solution.
    if (options.any_solution) options.easy_nodes = UINT64_MAX;
    options.is_stopped = [this, asked = 0U]() mutable {
      return ++asked % decisions_between_questions == 0 && effort_.is_over();
    };
    solver.emplace(catalog_, options);
  }
  const SearchResult result = solver->solve(problem_, solution);
  effort_.spend(result.nodes * effort_of_a_node + problem_.may_stop.size() +
                result.performance_effort / performance_tasks_in_effort);
  switch (result.status) {
    case SearchStatus::optimal:
      return Feasibility::yes;
    case SearchStatus::feasible:
      return wanted == Wanted::any ? Feasibility::yes : Feasibility::unknown;
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
