// Whether a constraint decides an event: the same problem is solved with a catalog that lacks this
// one constraint, and the answers are compared. As in MC/DC (J. J. Chilenski and S. P. Miller,
// "Applicability of modified condition/decision coverage to software testing", Software Engineering
// Journal 9 (1994)), it has to make a difference alone. An answer that differs must violate the
// constraint, so where the domains do not allow that, nothing is solved.
//
// A conflict set, or the reasons of a propagation, would name constraints without a search of their
// own. But they say which constraints were used, and there may be another way to the same answer
// without them; and of an accepted event there is no conflict set.

#include "coverage/engine/constraint_relaxation.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/compiled/derive.h"

namespace cbc {
namespace {

/// Rows of views as rows that may grow.
template <typename T>
GrowingRows<T> copy(const Rows<T>& rows) {
  return {{rows.begin.begin(), rows.begin.end()}, {rows.items.begin(), rows.items.end()}};
}

template <typename T>
std::vector<T> copy(std::span<const T> items) {
  return {items.begin(), items.end()};
}

/// What does not follow from other arrays; see derive_rest.
GrowingCatalog copy_given(const CompiledCatalog& from) {
  GrowingCatalog to;
  to.texts = copy(from.texts);
  to.task_ids = copy(from.task_ids);
  to.behavior_ids = copy(from.behavior_ids);
  to.behavior_packages = copy(from.behavior_packages);
  to.parameters = copy(from.parameters);
  to.allowed_values = copy(from.allowed_values);
  to.tasks_by_name = copy(from.tasks_by_name);
  to.behaviors_by_name = copy(from.behaviors_by_name);
  to.group_tasks = copy(from.group_tasks);
  to.group_behaviors = copy(from.group_behaviors);
  to.tasks = copy(from.tasks);
  to.values = copy(from.values);
  to.behaviors = copy(from.behaviors);
  to.requirements = copy(from.requirements);
  to.requirement_lines = copy(from.requirement_lines);
  to.cliques = copy(from.cliques);
  to.clique_lines = copy(from.clique_lines);
  to.variables = copy(from.variables);
  to.variable_values = copy(from.variable_values);
  to.fitting_values = copy(from.fitting_values);
  to.task_rules = copy(from.task_rules);
  to.retries = copy(from.retries);
  to.improve_lines = copy(from.improve_lines);
  to.retry_lines = copy(from.retry_lines);
  to.limits = copy(from.limits);
  to.limited = copy(from.limited);
  return to;
}

/// The place of a requirement among all.
std::size_t find_requirement(const GrowingCatalog& catalog, const Goal& goal) {
  std::size_t place = catalog.requirements.begin[goal.behavior];
  while (catalog.requirements.items[place].task != goal.task) ++place;
  return place;
}

void remove_requirement(GrowingCatalog& catalog, const Goal& goal) {
  const auto place = static_cast<std::ptrdiff_t>(find_requirement(catalog, goal));
  catalog.requirements.items.erase(catalog.requirements.items.begin() + place);
  catalog.requirement_lines.erase(catalog.requirement_lines.begin() + place);
  for (std::size_t row = goal.behavior + 1; row < catalog.requirements.begin.size(); ++row) {
    --catalog.requirements.begin[row];
  }
}

void remove_minimum(GrowingCatalog& catalog, const Goal& goal) {
  if (goal.behavior == none) {
    catalog.tasks[goal.task].minimum_performance = 0;
    catalog.tasks[goal.task].minimum_cost = 0;
    return;
  }
  CompiledRequirement& requirement = catalog.requirements.items[find_requirement(catalog, goal)];
  requirement.minimum_performance = 0;
  requirement.minimum_cost = 0;
}

/// A list with both tasks becomes two, each without one of them.
void remove_exclusion(GrowingCatalog& catalog, const Goal& goal) {
  const GrowingRows<TaskId> lists = std::exchange(catalog.cliques, {});
  const std::vector<std::uint32_t> lines = std::exchange(catalog.clique_lines, {});
  for (std::size_t list = 0; list < lists.size(); ++list) {
    const std::vector<TaskId> tasks(lists[list].begin(), lists[list].end());
    const auto has = [&](TaskId task) {
      return std::find(tasks.begin(), tasks.end(), task) != tasks.end();
    };
    const auto add = [&](const std::vector<TaskId>& row) {
      if (row.size() < 2) return;
      catalog.cliques.add_row(row);
      catalog.clique_lines.push_back(lines[list]);
    };
    if (!has(goal.task) || !has(goal.other_task)) {
      add(tasks);
      continue;
    }
    for (const TaskId left_out : {goal.task, goal.other_task}) {
      std::vector<TaskId> rest = tasks;
      std::erase(rest, left_out);
      add(rest);
    }
  }
}

}  // namespace

CompiledCatalog without_constraint(const CompiledCatalog& catalog, const Goal& goal) {
  GrowingCatalog without = copy_given(catalog);
  switch (goal.kind) {
    case Goal::Kind::requirement_decided:
      remove_requirement(without, goal);
      break;
    case Goal::Kind::minimum_decided:
      remove_minimum(without, goal);
      break;
    default:
      remove_exclusion(without, goal);
      break;
  }
  derive_rest(without);
  return to_catalog(std::move(without));
}

std::size_t most_variants_of(const CompiledCatalog& catalog) {
  constexpr std::size_t most_values = 2'000'000;
  const std::size_t size = 1 + catalog.values.items.size() + catalog.requirements.items.size() +
                           catalog.cliques.items.size() + catalog.masks.size();
  return std::clamp<std::size_t>(most_values / size, 1, 1000);
}

ConstraintRelaxation::ConstraintRelaxation(const CompiledCatalog& catalog,
                                           const CoordinatorOptions& options)
    : catalog_(catalog),
      options_(options.search),
      most_variants_(most_variants_of(catalog)),
      solver_(catalog, options_) {}

bool ConstraintRelaxation::load(const EventRecord& record, const Circumstances& circumstances,
                                const Assignment* solution) {
  if (record.search == nullptr || !is_proven(record.search->result.status)) return false;
  solution_ = solution;
  is_unasked_ = circumstances.trigger.is_unasked();
  ProblemBuilder builder(catalog_, circumstances.state);
  builder.load(circumstances.trigger, record.index);
  for (const BehaviorId behavior : circumstances.failed) builder.exclude(behavior);
  problems_.clear();
  std::int32_t protection = builder.first_protection();
  problems_.push_back(builder.build(protection));
  while (protection < circumstances.protection) {
    const auto next = builder.next_protection(protection);
    if (!next) break;
    protection = *next;
    problems_.push_back(builder.build(protection));
  }
  unprotected_.reset();
  if (solution == nullptr && circumstances.trigger.kind == Trigger::Kind::start) {
    unprotected_ = builder.build(std::numeric_limits<std::int32_t>::max());
  }
  return true;
}

bool ConstraintRelaxation::was_protection_alone() {
  if (!unprotected_) return false;
  return has_solution(solver_.solve(*unprotected_, relaxed_).status);
}

bool ConstraintRelaxation::decided(const Goal& goal, std::size_t number) {
  if (!may_matter(goal)) return false;
  Variant& variant = variant_of(goal, number);
  for (const Problem& problem : problems_) {
    const SearchStatus status = variant.solver.solve(problem, relaxed_).status;
    if (status == SearchStatus::infeasible) continue;
    if (status != SearchStatus::optimal) return false;  // nothing is proven
    if (is_unasked_ &&
        variant.asked.is_worse(catalog_.group_tasks[problem.group], problem, relaxed_)) {
      return solution_ != nullptr;
    }
    return solution_ == nullptr || &problem != &problems_.back() || relaxed_ != *solution_;
  }
  return false;
}

/// The answer without a constraint is another one only if it violates the constraint; otherwise the
/// one would be the best with it, too. So both tasks of a pair have to run in it, and the behavior
/// of a requirement has to be active.
bool ConstraintRelaxation::may_matter(const Goal& goal) const {
  if (goal.kind == Goal::Kind::exclusion_decided) {
    return may_run(goal.task) && may_run(goal.other_task);
  }
  return goal.behavior == none ? may_run(goal.task) : may_be_active(goal.behavior);
}

bool ConstraintRelaxation::may_run(TaskId task) const {
  const Problem& problem = problems_.back();
  const std::uint32_t first = catalog_.words[catalog_.group_tasks[problem.group]];
  const auto words = problem.domains.begin();
  return std::any_of(words + (catalog_.words[task] - first),
                     words + (catalog_.words[task + 1] - first),
                     [](std::uint64_t word) { return word != 0; });
}

bool ConstraintRelaxation::may_be_active(BehaviorId behavior) const {
  const Problem& problem = problems_.back();
  const std::uint32_t first = catalog_.words[catalog_.group_tasks[problem.group]];
  const auto values = catalog_.performs[behavior];
  return std::any_of(values.begin(), values.end(), [&](ValueId value) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t index = value - catalog_.values.begin[task];
    const std::uint64_t word = problem.domains[catalog_.words[task] - first + index / 64];
    return ((word >> (index % 64)) & 1U) != 0;
  });
}

ConstraintRelaxation::Variant& ConstraintRelaxation::variant_of(const Goal& goal,
                                                                std::size_t number) {
  const auto known = variants_.find(number);
  if (known != variants_.end()) return *known->second;
  if (variants_.size() >= most_variants_) variants_.clear();
  return *variants_
              .emplace(number,
                       std::make_unique<Variant>(without_constraint(catalog_, goal), options_))
              .first->second;
}

}  // namespace cbc
