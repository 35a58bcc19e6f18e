#include "solver/solver.h"

#include <algorithm>

#include "compiled/compiled_catalog.h"

namespace cbc {

Solver::Solver(const CompiledCatalog& catalog, const SearchOptions& options,
               const std::vector<std::uint32_t>& ranks)
    : catalog_(catalog),
      options_(options),
      domains_(catalog),
      propagator_(catalog, domains_),
      parts_(catalog, domains_),
      objective_(catalog, domains_, parts_, ranks),
      lookahead_(catalog, domains_, parts_) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  frames_.reserve(tasks + most_values_in_a_group(catalog));
  for (Scope& scope : scopes_) {
    scope.best.places.reserve(tasks);
    scope.best.running.reserve(tasks);
  }
}

SearchResult Solver::solve(const Problem& problem, Assignment& solution) {
  load(problem);
  const bool is_complete = search();
  result_.propagations = propagator_.propagations();
  const Incumbent& best = scopes_.front().best;
  if (best.exists) {
    result_.status = is_complete ? SearchStatus::optimal : SearchStatus::feasible;
    solution = best.places;
  } else {
    result_.status = is_complete ? SearchStatus::infeasible : SearchStatus::unknown;
  }
  return result_;
}

void Solver::load(const Problem& problem) {
  problem_ = &problem;
  domains_.load(problem);
  propagator_.load(problem);
  parts_.load(problem);
  objective_.load(problem);
  result_ = {};
  looks_ahead_ = false;
  frames_.clear();
  scope().best.exists = false;
  scope().base = 0;
  scope().floor_elsewhere = 0;
  scope().bound_elsewhere = 0;
  if (options_.time_limit.count() > 0) {
    deadline_ = std::chrono::steady_clock::now() + options_.time_limit;
  }
}

/// Takes "not running" out of the domains of the tasks that must run.
bool Solver::begin() {
  for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
    if (problem_->may_stop[task] == 0 && !domains_.need(task)) return false;
  }
  return propagator_.propagate();
}

/// False if a limit ended the search.
bool Solver::search() {
  bool is_consistent = begin();
  for (;;) {
    if (is_consistent && may_improve()) {
      if (const std::optional<Decision> decision = decide()) {
        if (is_out_of_budget()) return false;
        if (is_to_look_ahead()) {
          start_to_look_ahead();
        } else if (!enter_part(*decision)) {
          is_consistent = branch(*decision);
        }
        continue;
      }
      if (!accept()) return false;
    }
    if (frames_.size() > scope().base) {
      is_consistent = backtrack();
    } else if (parts_.depth() > 0) {
      is_consistent = leave_part();
    } else {
      return true;
    }
  }
}

/// Whether the present subtree may hold a solution better than the best so far, of the present part
/// and of those around it.
bool Solver::may_improve() {
  if (options_.max_solutions > 0) return true;
  for (std::uint32_t depth = 0; depth <= parts_.depth(); ++depth) {
    const Incumbent& best = scopes_[depth].best;
    if (best.exists && !objective_.may_beat(best, depth)) return false;
  }
  if (!looks_ahead_) return true;

  const Scope& part = scope();
  Lookahead::Cost enough = enough_to_prune(part.best);
  enough.log -= part.floor_elsewhere;
  Lookahead::Cost enough_for_all = enough_to_prune(scopes_.front().best);
  enough_for_all.log -= part.bound_elsewhere;
  enough = std::min(enough, enough_for_all);
  return lookahead_.bound(enough, Lookahead::Roots::in_part) <= enough;
}

/// What the lookahead has to exceed to prove that nothing better than `best` is left.
Lookahead::Cost Solver::enough_to_prune(const Incumbent& best) const {
  constexpr Lookahead::Cost unbounded{INT64_MAX, INT64_MAX};
  if (!best.exists || best.sums.zeros > 0 || !objective_.ties_on_requests(best)) return unbounded;
  // Only costs of nothing but zeros are exact enough to go on to f3.
  if (best.sums.factors == 0) return {0, best.sums.idle};
  const std::int64_t factors = std::int64_t{best.sums.factors} + domains_.task_count();
  return {best.sums.cost + log_cost_error * factors, INT64_MAX};
}

/// Takes the solution of the present part. False if it is one too many.
bool Solver::accept() {
  if (options_.max_solutions > 0 && result_.solutions == options_.max_solutions) return false;
  if (parts_.depth() == 0) ++result_.solutions;
  Incumbent& best = scope().best;
  if (!best.exists || objective_.may_beat(best, parts_.depth())) objective_.record(best);
  return !options_.any_solution || parts_.depth() > 0;
}

bool Solver::is_out_of_budget() const {
  if (options_.max_nodes > 0 && result_.nodes >= options_.max_nodes) return true;
  constexpr std::uint64_t nodes_between_looks = 64;
  return options_.time_limit.count() > 0 && result_.nodes % nodes_between_looks == 0 &&
         std::chrono::steady_clock::now() >= deadline_;
}

/// Whether the search turns out to be a hard one. The enumeration of the first m solutions stays as
/// it is.
bool Solver::is_to_look_ahead() const {
  return !looks_ahead_ && options_.max_solutions == 0 && result_.nodes >= options_.easy_nodes;
}

/// Begins anew at the root, with the best solution so far.
void Solver::start_to_look_ahead() {
  looks_ahead_ = true;
  if (frames_.empty()) return;
  domains_.undo_to(frames_.front().mark);
  frames_.clear();
}

/// If what is undecided falls into parts: begins to solve the part of the decision's task apart.
bool Solver::enter_part(const Decision& decision) {
  if (!looks_ahead_ || decision.kind != Decision::Kind::assign ||
      !parts_.enter_part_of(decision.task)) {
    return false;
  }
  const Scope& around = scopes_[parts_.depth() - 1];
  Scope& part = scope();
  part.best.exists = false;
  part.base = frames_.size();
  part.mark = domains_.mark();
  part.floor_elsewhere = 0;
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (!parts_.contains(task, parts_.depth())) {
      part.floor_elsewhere += domains_.value(task, domains_.best(task)).cost;
    }
  }
  part.bound_elsewhere =
      around.bound_elsewhere +
      lookahead_.bound({INT64_MAX, INT64_MAX}, Lookahead::Roots::around_part).log;
  return true;
}

/// The present part is solved: fixes its best values, and goes on with what is around it. False if
/// it has no solution that could be of use.
bool Solver::leave_part() {
  const Scope& part = scope();
  const std::uint32_t depth = parts_.depth();
  domains_.undo_to(part.mark);
  bool is_consistent = part.best.exists;
  for (std::uint32_t task = 0; is_consistent && task < domains_.task_count(); ++task) {
    if (!parts_.contains(task, depth)) continue;
    const std::uint32_t place = part.best.places[task];
    is_consistent = place == none ? domains_.close(task)
                                  : domains_.keep_only(task, place) && domains_.need(task);
  }
  parts_.leave();
  return is_consistent && propagator_.propagate();
}

bool Solver::branch(const Decision& decision) {
  ++result_.nodes;
  frames_.push_back({decision, domains_.mark()});
  return take(decision) && propagator_.propagate();
}

bool Solver::backtrack() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  domains_.undo_to(frame.mark);
  return refuse(frame.decision) && propagator_.propagate();
}

bool Solver::take(const Decision& decision) {
  switch (decision.kind) {
    case Decision::Kind::assign:
      return domains_.keep_only(decision.task, decision.place) && domains_.need(decision.task);
    case Decision::Kind::run:
      return domains_.need(decision.task);
    case Decision::Kind::stop:
      return domains_.close(decision.task);
  }
  return false;
}

bool Solver::refuse(const Decision& decision) {
  switch (decision.kind) {
    case Decision::Kind::assign:
      return domains_.remove(decision.task, decision.place);
    case Decision::Kind::run:
      return domains_.close(decision.task);
    case Decision::Kind::stop:
      return domains_.need(decision.task);
  }
  return false;
}

/// The next decision; none if the present part is decided. Requests come first, as they decide f1.
std::optional<Solver::Decision> Solver::decide() {
  if (options_.max_solutions > 0) return decide_in_catalog_order();
  for (const std::uint32_t task : problem_->requests) {
    if (domains_.may_stop(task) && domains_.count(task) > 0) {
      return Decision{Decision::Kind::run, task, none};
    }
  }
  const std::uint32_t task = choose_task();
  if (task == none) return std::nullopt;
  return Decision{Decision::Kind::assign, task, choose_place(task)};
}

/// The needed task of the highest level that still has a choice, so that what it requires is known
/// before the choice among that.
std::uint32_t Solver::choose_task() const {
  std::uint32_t chosen = none;
  std::uint32_t highest_level = 0;
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (domains_.count(task) == 1 || !parts_.contains(task, parts_.depth())) continue;
    const std::uint32_t level = catalog_.tasks[domains_.first_task() + task].level;
    if (chosen == none || level > highest_level) {
      chosen = task;
      highest_level = level;
    }
  }
  return chosen;
}

/// The place that seems to cost least; of equal ones the first in the canonical order.
std::uint32_t Solver::choose_place(std::uint32_t task) {
  std::uint32_t chosen = none;
  Lookahead::Cost least;
  const auto places = static_cast<std::uint32_t>(domains_.values(task).size());
  for (std::uint32_t place = 0; place < places; ++place) {
    if (!domains_.has(task, place)) continue;
    const Lookahead::Cost cost = estimate(task, place);
    if (chosen == none || cost < least ||
        (cost == least && objective_.key(task, place) < objective_.key(task, chosen))) {
      chosen = place;
      least = cost;
    }
  }
  return chosen;
}

/// What a value costs, with what it newly requires.
Lookahead::Cost Solver::estimate(std::uint32_t task, std::uint32_t place) {
  if (looks_ahead_) return lookahead_.reduced_cost(task, place);
  const Value& value = domains_.value(task, place);
  Lookahead::Cost cost{value.cost, 0};
  for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
    const std::uint32_t required = rule.task - domains_.first_task();
    if (domains_.needed(required) || domains_.count(required) == 0) continue;
    cost.log += domains_.value(required, domains_.best(required)).cost;
  }
  return cost;
}

/// The paper's order: tasks in catalog order, values ("not running" too) by rank.
std::optional<Solver::Decision> Solver::decide_in_catalog_order() const {
  for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
    const std::uint32_t count = domains_.count(task);
    if (count == 0 || (count == 1 && domains_.needed(task))) continue;
    std::uint32_t first = none;
    std::uint32_t first_key = domains_.may_stop(task) ? objective_.key(task, none) : none;
    const auto places = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t place = 0; place < places; ++place) {
      if (!domains_.has(task, place) || objective_.key(task, place) >= first_key) continue;
      first = place;
      first_key = objective_.key(task, place);
    }
    if (first == none) return Decision{Decision::Kind::stop, task, none};
    return Decision{Decision::Kind::assign, task, first};
  }
  return std::nullopt;
}

}  // namespace cbc
