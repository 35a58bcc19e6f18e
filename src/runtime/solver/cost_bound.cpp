#include "solver/cost_bound.h"

#include <algorithm>

namespace cbc {
namespace {

/// More than any sum of costs: a suitability of 0 spoils the whole product.
constexpr std::int64_t prohibitive = std::int64_t{1} << 61;

}  // namespace

Lookahead::Cost& Lookahead::Cost::operator+=(const Cost& other) {
  log = std::min(prohibitive, log + other.log);
  idle += other.idle;
  return *this;
}

Lookahead::Cost& Lookahead::Cost::operator-=(const Cost& other) {
  log -= other.log;
  idle -= other.idle;
  return *this;
}

Lookahead::Lookahead(const CompiledCatalog& catalog, const Domains& domains, const Parts& parts)
    : catalog_(catalog), domains_(domains), parts_(parts) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  left_.resize(most_values_in_a_group(catalog));
  opened_.resize(most_tasks, 0);
  settled_.resize(most_tasks, 0);
  in_cut_.resize(most_tasks, 0);
  cut_.reserve(most_tasks);
  visits_.reserve(most_tasks);
}

Lookahead::Cost Lookahead::bound(const Cost& enough, Roots roots) {
  ++bound_number_;
  Cost total;
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (!is_root(task, roots)) continue;
    while (collect_cut(task)) {
      total += lower_cut();
      if (total > enough) return total;
    }
  }
  return total;
}

Lookahead::Cost& Lookahead::left(std::uint32_t task, std::uint32_t place) {
  const TaskId first = domains_.first_task();
  return left_[catalog_.values.begin[first + task] - catalog_.values.begin[first] + place];
}

Lookahead::Cost Lookahead::reduced_cost(std::uint32_t task, std::uint32_t place) {
  Cost cost = left(task, place);
  for (const CompiledRequirement& requirement :
       catalog_.requirements[domains_.value(task, place).behavior]) {
    const std::uint32_t target = requirement.task - domains_.first_task();
    if (domains_.needed(target) || is_settled(target)) continue;
    open(target);
    cost += cheapest_left(target);
  }
  return cost;
}

bool Lookahead::is_root(std::uint32_t task, Roots roots) const {
  const std::uint32_t depth = parts_.depth();
  if (roots == Roots::in_part) return parts_.contains(task, depth);
  return parts_.contains(task, depth - 1) && !parts_.contains(task, depth);
}

Lookahead::Cost Lookahead::cheapest_left(std::uint32_t task) {
  Cost cheapest{prohibitive, 0};
  for (std::uint32_t place = 0; place < domains_.values(task).size(); ++place) {
    if (domains_.has(task, place)) cheapest = std::min(cheapest, left(task, place));
  }
  return cheapest;
}

void Lookahead::open(std::uint32_t task) {
  if (opened_[task] == bound_number_) return;
  opened_[task] = bound_number_;
  const std::int64_t idle = catalog_.tasks[domains_.first_task() + task].start_on_request ? 0 : 1;
  const auto values = domains_.values(task);
  for (std::uint32_t place = 0; place < values.size(); ++place) {
    left(task, place) = {values[place].suitability == 0 ? prohibitive : values[place].cost, idle};
  }
}

bool Lookahead::is_settled(std::uint32_t task) const { return settled_[task] == bound_number_; }

/// The tasks on which the root still hangs: of each of their values that costs nothing any more,
/// one requirement that is not settled. False, and no cut, if the root itself runs at no cost.
bool Lookahead::collect_cut(std::uint32_t root) {
  if (is_settled(root)) return false;
  ++cut_number_;
  cut_.clear();
  visits_.clear();
  begin_visit(root);
  while (!visits_.empty()) {
    const std::uint32_t task = visits_.back().task;
    std::uint32_t target = none;
    switch (go_on(visits_.back(), target)) {
      case Step::descend:
        begin_visit(target);
        break;
      case Step::settled:
        settled_[task] = bound_number_;
        in_cut_[task] = 0;
        visits_.pop_back();
        break;
      case Step::cut:
        cut_.push_back(task);
        visits_.pop_back();
        break;
    }
  }
  return !is_settled(root);
}

void Lookahead::begin_visit(std::uint32_t task) {
  open(task);
  in_cut_[task] = cut_number_;
  visits_.push_back({task, 0, 0});
}

/// Looks for a value that costs nothing and whose requirements are all settled. On the way it stops
/// at a requirement that has not been visited in this cut: the `target`.
Lookahead::Step Lookahead::go_on(Visit& visit, std::uint32_t& target) {
  const auto values = domains_.values(visit.task);
  for (; visit.place < values.size(); ++visit.place, visit.requirement = 0) {
    if (!domains_.has(visit.task, visit.place) || left(visit.task, visit.place) > Cost{}) continue;
    const auto requirements = catalog_.requirements[values[visit.place].behavior];
    for (; visit.requirement < requirements.size(); ++visit.requirement) {
      target = requirements[visit.requirement].task - domains_.first_task();
      if (domains_.needed(target) || is_settled(target)) continue;
      if (in_cut_[target] != cut_number_) return Step::descend;
      break;
    }
    if (visit.requirement == requirements.size()) return Step::settled;
  }
  return Step::cut;
}

bool Lookahead::requires_cut(const Value& value) const {
  for (const CompiledRequirement& requirement : catalog_.requirements[value.behavior]) {
    if (in_cut_[requirement.task - domains_.first_task()] == cut_number_) return true;
  }
  return false;
}

/// Takes the cheapest way out of the cut off all ways out of it.
Lookahead::Cost Lookahead::lower_cut() {
  Cost cheapest{INT64_MAX, 0};
  for (const std::uint32_t task : cut_) {
    const auto values = domains_.values(task);
    for (std::uint32_t place = 0; place < values.size(); ++place) {
      if (domains_.has(task, place) && left(task, place) < cheapest &&
          !requires_cut(values[place])) {
        cheapest = left(task, place);
      }
    }
  }
  for (const std::uint32_t task : cut_) {
    const auto values = domains_.values(task);
    for (std::uint32_t place = 0; place < values.size(); ++place) {
      if (domains_.has(task, place) && !requires_cut(values[place])) left(task, place) -= cheapest;
    }
  }
  return cheapest;
}

}  // namespace cbc
