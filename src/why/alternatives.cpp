// The k best solutions by partition (E. L. Lawler, "A procedure for computing the K best solutions
// to discrete optimization problems and its application to the shortest path problem", Management
// Science 18 (1972)). The best solution of all subproblems is the next one. The rest of its
// subproblem is split into one for each task: the tasks before it have the values of that solution,
// and it has another. A subproblem differs from a problem in its domains alone, so the solver needs
// nothing new for it.
//
// To rule out the solutions that are known, one by one, would need constraints of another kind,
// which propagate nothing until almost all tasks have values; and a search that collects the k best
// cannot prune before it has k of them.
#include "why/alternatives.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>
#include <utility>

#include "ask/conflict/reasons.h"
#include "why/conflict.h"

namespace cbc {
namespace {

SearchOptions search_options() {
  SearchOptions options;
  options.max_nodes = 100'000;
  return options;
}

/// The domain words of a task among those of its group.
template <typename Words>
auto words_of(const CompiledCatalog& catalog, GroupId group, Words& words, TaskId task) {
  const std::uint32_t first = catalog.words[catalog.group_tasks[group]];
  return std::span(words).subspan(catalog.words[task] - first,
                                  catalog.words[task + 1] - catalog.words[task]);
}

/// Removes the values from the domain of a task of the group that a demand rules out.
void apply_demand(const CompiledCatalog& catalog, const Demand& demand, Problem& problem) {
  const auto words = words_of(catalog, problem.group, problem.domains, demand.task);
  std::uint8_t& may_stop = problem.may_stop[demand.task - catalog.group_tasks[problem.group]];
  const auto bit = [&] { return std::uint64_t{1} << (demand.value_index % 64); };
  switch (demand.kind) {
    case Demand::Kind::run:
      may_stop = 0;
      return;
    case Demand::Kind::stop:
      std::fill(words.begin(), words.end(), 0);
      return;
    case Demand::Kind::has: {
      may_stop = 0;
      const std::uint64_t kept = words[demand.value_index / 64] & bit();
      std::fill(words.begin(), words.end(), 0);
      words[demand.value_index / 64] = kept;
      return;
    }
    case Demand::Kind::has_not:
      words[demand.value_index / 64] &= ~bit();
      return;
  }
}

bool requires_task(const CompiledCatalog& catalog, BehaviorId behavior, TaskId task) {
  const auto requirements = catalog.requirements[behavior];
  return std::any_of(
      requirements.begin(), requirements.end(),
      [task](const CompiledRequirement& requirement) { return requirement.task == task; });
}

/// Whether the domain of a task of the group has more than one value.
bool has_choice(const CompiledCatalog& catalog, const Problem& problem, TaskId task) {
  std::uint32_t values = problem.may_stop[task - catalog.group_tasks[problem.group]];
  for (const std::uint64_t word : words_of(catalog, problem.group, problem.domains, task)) {
    values += static_cast<std::uint32_t>(std::popcount(word));
  }
  return values > 1;
}

}  // namespace

ConfigurationSearch::ConfigurationSearch(const CompiledCatalog& catalog)
    : catalog_(catalog), solver_(catalog, search_options()), comparison_(catalog) {}

void ConfigurationSearch::load(const Problem& problem, const ObjectiveValues& elsewhere) {
  whole_ = &problem;
  comparison_.load(problem, elsewhere);
}

void ConfigurationSearch::begin() {
  effort_ = 0;
  is_cut_ = false;
}

std::optional<Configuration> ConfigurationSearch::solve(const Problem& problem) {
  Assignment assignment;
  const SearchResult result = solver_.solve(problem, assignment);
  effort_ += (1 + result.nodes) * problem.may_stop.size();
  if (result.status == SearchStatus::infeasible) return std::nullopt;
  if (result.status != SearchStatus::optimal || effort_ > most_effort_of_answer) {
    is_cut_ = true;
    return std::nullopt;
  }
  return comparison_.evaluate(std::move(assignment));
}

std::optional<Configuration> ConfigurationSearch::find_best(std::span<const Demands> ways) {
  begin();
  std::optional<Configuration> best;
  for (const Demands& demands : ways) {
    Problem problem = *whole_;
    problem.subproblem_of = whole_;
    for (const Demand& demand : demands) apply_demand(catalog_, demand, problem);
    std::optional<Configuration> found = solve(problem);
    if (is_cut_) return std::nullopt;
    if (!found) continue;
    // Two ways may have the same best solution.
    const bool is_better = !best || (found->assignment != best->assignment &&
                                     comparison_.compare(*found, *best).first_is_better);
    if (is_better) best = std::move(found);
  }
  return best;
}

std::vector<Configuration> ConfigurationSearch::list_best(const Assignment& best,
                                                          std::size_t count) {
  begin();
  std::vector<Configuration> list;
  std::vector<Subproblem> open;  // the best comes last
  open.push_back({*whole_, comparison_.evaluate(best)});
  open.back().problem.subproblem_of = whole_;
  while (list.size() < count && !open.empty()) {
    Subproblem subproblem = std::move(open.back());
    open.pop_back();
    list.push_back(subproblem.best);
    if (list.size() < count) split(std::move(subproblem), count - list.size(), open);
    if (is_cut_) break;
  }
  return list;
}

void ConfigurationSearch::split(Subproblem subproblem, std::size_t most,
                                std::vector<Subproblem>& open) {
  const TaskId first = catalog_.group_tasks[subproblem.problem.group];
  for (LocalTask task(0); task < subproblem.best.assignment.size(); ++task) {
    if (!has_choice(catalog_, subproblem.problem, first + task)) continue;
    const std::uint32_t index = subproblem.best.assignment[task];
    Problem other = subproblem.problem;
    const bool runs = index != none;
    apply_demand(catalog_, {runs ? Demand::Kind::has_not : Demand::Kind::run, first + task, index},
                 other);
    add(std::move(other), most, open);
    if (is_cut_) return;
    apply_demand(catalog_, {runs ? Demand::Kind::has : Demand::Kind::stop, first + task, index},
                 subproblem.problem);
  }
}

/// Adds a subproblem, if it has a solution. Where a task runs for nothing in the best one, as its
/// domain says that it runs, those solutions are left in which something requires it: one
/// subproblem for each behavior that does, without the behaviors before.
void ConfigurationSearch::add(Problem problem, std::size_t most, std::vector<Subproblem>& open) {
  std::optional<Configuration> found = solve(problem);
  if (is_cut_ || !found) return;
  const TaskId needless = find_needless(found->assignment);
  if (needless == none) return insert({std::move(problem), std::move(*found)}, most, open);
  const TaskId first = catalog_.group_tasks[problem.group];
  for (LocalTask task(0); task < found->assignment.size(); ++task) {
    const auto values = catalog_.values[first + task];
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      if (!requires_task(catalog_, values[index].behavior, needless)) continue;
      Problem other = problem;
      apply_demand(catalog_, {Demand::Kind::has, first + task, index}, other);
      add(std::move(other), most, open);
      if (is_cut_) return;
      apply_demand(catalog_, {Demand::Kind::has_not, first + task, index}, problem);
    }
  }
}

/// A task that runs although nobody requested it and nothing that runs requires it, or none.
TaskId ConfigurationSearch::find_needless(const Assignment& assignment) const {
  const TaskId first = catalog_.group_tasks[whole_->group];
  std::vector<std::uint8_t> is_needed(assignment.size(), 0);
  for (const LocalTask task : whole_->requests) is_needed[task] = 1;
  for (LocalTask task(0); task < assignment.size(); ++task) {
    if (assignment[task] == none) continue;
    const BehaviorId behavior = catalog_.values[first + task][assignment[task]].behavior;
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      is_needed[requirement.task - first] = 1;
    }
  }
  for (LocalTask task(0); task < assignment.size(); ++task) {
    if (assignment[task] != none && is_needed[task] == 0) return first + task;
  }
  return none;
}

/// Keeps the `most` best subproblems: no other can yield one of the solutions still to be listed.
void ConfigurationSearch::insert(Subproblem subproblem, std::size_t most,
                                 std::vector<Subproblem>& open) {
  const auto position = std::lower_bound(
      open.begin(), open.end(), subproblem, [&](const Subproblem& a, const Subproblem& b) {
        return comparison_.compare(b.best, a.best).first_is_better;
      });
  open.insert(position, std::move(subproblem));
  if (open.size() > most) open.erase(open.begin());
}

std::string_view name_of(Criterion criterion) {
  static constexpr std::array<std::string_view, 7> names{
      "requests", "request_order", "asked", "suitability", "idle", "changes", "canonical"};
  return names[static_cast<std::size_t>(criterion)];
}

void Comparison::load(const Problem& problem, const ObjectiveValues& elsewhere) {
  problem_ = &problem;
  elsewhere_ = elsewhere;
  first_task_ = catalog_.group_tasks[problem.group];
  order_.load(problem);
}

Configuration Comparison::evaluate(Assignment assignment) {
  Configuration configuration;
  ObjectiveValues& objective = configuration.objective;
  objective = elsewhere_;
  objective.requests += static_cast<std::uint32_t>(problem_->counted_requests().size());
  for (const LocalTask task : problem_->counted_requests()) {
    if (assignment[task] != none) ++objective.satisfied;
  }
  for (LocalTask task(0); task < assignment.size(); ++task) {
    if (assignment[task] != none && catalog_.tasks[first_task_ + task].start_on_request == 0) {
      ++objective.idle_running;
    }
  }
  objective.changes = count_changes(assignment);
  if (problem_->unasked > 0) {
    configuration.asked = asked_.of(first_task_, assignment, problem_->asked_requests());
  }
  configuration.assignment = std::move(assignment);
  return configuration;
}

std::uint32_t Comparison::count_changes(const Assignment& assignment) const {
  std::vector<BehaviorId> active;
  for (LocalTask task(0); task < assignment.size(); ++task) {
    if (assignment[task] != none) {
      active.push_back(catalog_.values[first_task_ + task][assignment[task]].behavior);
    }
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  std::vector<BehaviorId> changed;
  std::set_symmetric_difference(active.begin(), active.end(), problem_->active.begin(),
                                problem_->active.end(), std::back_inserter(changed));
  return static_cast<std::uint32_t>(changed.size());
}

Difference Comparison::compare(const Configuration& a, const Configuration& b) {
  Difference difference;
  const auto decide = [&](Criterion criterion, bool first_is_better) {
    difference.criterion = criterion;
    difference.first_is_better = first_is_better;
    return difference;
  };
  if (a.objective.satisfied != b.objective.satisfied) {
    return decide(Criterion::requests, a.objective.satisfied > b.objective.satisfied);
  }
  if (decide_by_order(a, b, problem_->asked_requests(), difference)) return difference;
  if (problem_->unasked > 0) {
    if (const auto order = asked_.compare(a.asked, b.asked); order != 0) {
      return decide(Criterion::asked, order < 0);
    }
    if (decide_by_order(a, b, problem_->unasked_requests(), difference)) return difference;
  }
  if (const auto order = compare_suitability(a.assignment, b.assignment); order != 0) {
    return decide(Criterion::suitability, order > 0);
  }
  if (a.objective.idle_running != b.objective.idle_running) {
    return decide(Criterion::idle, a.objective.idle_running < b.objective.idle_running);
  }
  if (a.objective.changes != b.objective.changes) {
    return decide(Criterion::changes, a.objective.changes < b.objective.changes);
  }
  LocalTask task;
  while (a.assignment[task] == b.assignment[task]) ++task;
  difference.task = first_task_ + task;
  return decide(Criterion::canonical,
                order_.key(task, a.assignment[task]) < order_.key(task, b.assignment[task]));
}

/// By the most important request that only one of the two satisfies, if there is one.
bool Comparison::decide_by_order(const Configuration& a, const Configuration& b,
                                 std::span<const LocalTask> requests, Difference& difference) {
  TaskId only_first = none;
  TaskId only_second = none;
  for (const LocalTask task : requests) {
    const bool first_runs = a.assignment[task] != none;
    const bool second_runs = b.assignment[task] != none;
    if (first_runs && !second_runs && only_first == none) only_first = first_task_ + task;
    if (second_runs && !first_runs && only_second == none) only_second = first_task_ + task;
    if (difference.task == none && first_runs != second_runs) difference.task = first_task_ + task;
  }
  if (difference.task == none) return false;
  difference.criterion = Criterion::request_order;
  difference.first_is_better = difference.task == only_first;
  difference.other_task = difference.first_is_better ? only_second : only_first;
  return true;
}

std::strong_ordering Comparison::compare_suitability(const Assignment& a, const Assignment& b) {
  const auto suitability = [&](LocalTask task, std::uint32_t index) {
    const auto values = catalog_.values[first_task_ + task];
    return index == none ? one_million : values[index].suitability;
  };
  // Equal factors may be left out unless they are 0.
  first_.clear();
  second_.clear();
  for (LocalTask task(0); task < a.size(); ++task) {
    const Millionths ours = suitability(task, a[task]);
    const Millionths theirs = suitability(task, b[task]);
    if (ours == theirs && ours != 0) continue;
    first_.multiply(ours);
    second_.multiply(theirs);
  }
  return ExactProduct::compare(first_, second_);
}

}  // namespace cbc
