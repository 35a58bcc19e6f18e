#include "lint_oracle.h"

#include <algorithm>
#include <stdexcept>

namespace cbc::oracle {
namespace {

constexpr std::size_t most_tasks = 10;
constexpr std::size_t most_constraints = 64;

}  // namespace

LintOracle::LintOracle(const CatalogFacts& facts) : facts_(facts) {
  powers_.emplace_back(1);
  for (std::size_t i = 0; i < most_tasks; ++i) {
    powers_.emplace_back(powers_.back() * static_cast<unsigned>(whole_degree));
  }
  for (const std::vector<std::size_t>& tasks : facts.groups) {
    Group group;
    group.tasks = tasks;
    collect_constraints(group);
    if (tasks.size() > most_tasks || group.constraints.size() > most_constraints) {
      throw std::length_error("a group is too large for the oracle");
    }
    enumerate(group);
    groups_.push_back(std::move(group));
  }
}

ConstraintSet LintOracle::all(std::size_t group) const {
  return those(group, [](const Constraint&) { return true; });
}

ConstraintSet LintOracle::those(std::size_t group,
                                const std::function<bool(const Constraint&)>& holds) const {
  ConstraintSet set = 0;
  const std::vector<Constraint>& constraints = groups_[group].constraints;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (holds(constraints[i])) set |= ConstraintSet{1} << i;
  }
  return set;
}

bool LintOracle::any(std::size_t group, ConstraintSet in_force,
                     const std::function<bool(const Row&)>& holds) const {
  const std::vector<Row>& rows = groups_[group].rows;
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Row& row) { return (row.violated & in_force) == 0 && holds(row); });
}

bool LintOracle::can_run(std::size_t task, ConstraintSet in_force) const {
  return any(facts_.group_of[task], in_force,
             [task](const Row& row) { return row.values[task] != none; });
}

bool LintOracle::can_have(std::size_t task, std::size_t behavior, ConstraintSet in_force) const {
  return any(facts_.group_of[task], in_force,
             [=](const Row& row) { return row.values[task] == behavior; });
}

std::optional<Integer> LintOracle::best_performance(std::size_t task,
                                                    ConstraintSet in_force) const {
  const Group& group = groups_[facts_.group_of[task]];
  std::optional<Product> best;
  for (const Row& row : group.rows) {
    if (row.values[task] == none || (row.violated & in_force) != 0) continue;
    const Product reached = performance(group, row, task);
    if (!best || reached > *best) best = reached;
  }
  if (!best) return std::nullopt;
  return Integer(*best);
}

Integer LintOracle::scale(std::size_t task) const {
  return Integer(powers_[groups_[facts_.group_of[task]].tasks.size()]);
}

void LintOracle::collect_constraints(Group& group) const {
  std::vector<std::size_t> behaviors;
  for (const std::size_t task : group.tasks) {
    for (const std::size_t other : facts_.excludes[task]) {
      if (task < other) {
        group.constraints.push_back({Constraint::Kind::exclusive, task, other, none, 0});
      }
    }
    const Millionths minimum = facts_.catalog.tasks[task].minimum;
    if (minimum > 0) {
      group.constraints.push_back({Constraint::Kind::performance, task, none, none, minimum});
    }
    for (const std::size_t behavior : facts_.behaviors_of[task]) {
      if (std::find(behaviors.begin(), behaviors.end(), behavior) == behaviors.end()) {
        behaviors.push_back(behavior);
      }
    }
  }
  for (const std::size_t behavior : behaviors) {
    std::vector<Millionths> minimums(facts_.catalog.tasks.size(), -1);
    for (const Requirement& requirement : facts_.catalog.behaviors[behavior].requirements) {
      minimums[requirement.task] = std::max(minimums[requirement.task], requirement.minimum);
    }
    for (std::size_t task = 0; task < minimums.size(); ++task) {
      if (minimums[task] < 0) continue;
      group.constraints.push_back({Constraint::Kind::requires_task, task, none, behavior, 0});
      if (minimums[task] == 0) continue;
      group.constraints.push_back(
          {Constraint::Kind::performance, task, none, behavior, minimums[task]});
    }
  }
}

void LintOracle::enumerate(Group& group) const {
  Row row;
  row.values.assign(facts_.catalog.tasks.size(), none);
  std::vector<std::size_t> digits(group.tasks.size(), 0);  // 0: not running
  for (bool more = true; more;) {
    row.violated = 0;
    for (std::size_t i = 0; i < group.constraints.size(); ++i) {
      if (!holds(group, group.constraints[i], row)) row.violated |= ConstraintSet{1} << i;
    }
    group.rows.push_back(row);
    more = false;
    for (std::size_t i = 0; i < digits.size() && !more; ++i) {
      const std::vector<std::size_t>& behaviors = facts_.behaviors_of[group.tasks[i]];
      more = digits[i] < behaviors.size();
      digits[i] = more ? digits[i] + 1 : 0;
      row.values[group.tasks[i]] = more ? behaviors[digits[i] - 1] : none;
    }
  }
}

bool LintOracle::holds(const Group& group, const Constraint& constraint, const Row& row) const {
  const auto is_assigned = [&] {
    return std::find(row.values.begin(), row.values.end(), constraint.behavior) != row.values.end();
  };
  const bool runs = row.values[constraint.task] != none;
  switch (constraint.kind) {
    case Constraint::Kind::exclusive:
      return !runs || row.values[constraint.other_task] == none;
    case Constraint::Kind::requires_task:
      return runs || !is_assigned();
    case Constraint::Kind::performance:
      if (!runs || (constraint.behavior != none && !is_assigned())) return true;
      return performance(group, row, constraint.task) >=
             powers_[group.tasks.size() - 1] * static_cast<unsigned>(constraint.minimum);
  }
  return true;
}

// A required task counts if it runs. Times 10^(6 * tasks of the group).
LintOracle::Product LintOracle::performance(const Group& group, const Row& row,
                                            std::size_t task) const {
  std::vector<std::size_t> counted{task};
  Product product = 1;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const std::size_t behavior = row.values[counted[i]];
    product *= static_cast<unsigned>(facts_.suitability(behavior, counted[i]));
    for (const Requirement& requirement : facts_.catalog.behaviors[behavior].requirements) {
      if (row.values[requirement.task] != none &&
          std::find(counted.begin(), counted.end(), requirement.task) == counted.end()) {
        counted.push_back(requirement.task);
      }
    }
  }
  return product * powers_[group.tasks.size() - counted.size()];
}

}  // namespace cbc::oracle
