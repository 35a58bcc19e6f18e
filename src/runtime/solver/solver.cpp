// Depth-first branch and bound (A. H. Land and A. G. Doig, "An automatic method of solving discrete
// programming problems", Econometrica 28 (1960)) that propagates after each decision (D. Sabin and
// E. C. Freuder, "Contradicting conventional wisdom in constraint satisfaction", ECAI 1994). It
// comes in stages, each of which costs more per decision: first the objective of the needed tasks
// alone bounds the subtree; a search that takes longer restarts with the cost bound and splits into
// components; one that is still stuck is left to LearningSearch.
//
// To learn from the start would be simpler. But most events take a few decisions, if any, and then
// reasons, no-goods and strong bounds cost more than the whole search; a model of each event for a
// general solver costs even more. What is here also allocates nothing, on which a robot relies.
#include "runtime/solver/solver.h"

#include <algorithm>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/derive.h"

namespace cbc {

Solver::Solver(const CompiledCatalog& catalog, const SearchOptions& options)
    : catalog_(catalog),
      options_(options),
      domains_(catalog),
      propagator_(catalog, domains_),
      components_(catalog, domains_),
      objective_(catalog, domains_, components_),
      cost_bound_(catalog, domains_, components_),
      learning_(catalog, domains_, objective_),
      repair_(catalog, domains_, propagator_) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  frames_.reserve(tasks + most_values_in_a_group(catalog));
  for (ComponentSearch& search : searches_) {
    search.best.assignment.reserve(tasks);
    search.best.running.reserve(tasks);
    search.best.asked.degrees.reserve(tasks);
  }
}

SearchResult Solver::solve(const Problem& problem, Assignment& solution) {
  budget_.max_nodes = options_.max_nodes;
  budget_.nodes_before = 0;
  budget_.is_stopped = options_.is_stopped ? &options_.is_stopped : nullptr;
  budget_.deadline.reset();
  if (options_.time_limit.count() > 0) {
    budget_.deadline = std::chrono::steady_clock::now() + options_.time_limit;
  }
  return solve_again(problem, solution);
}

SearchResult Solver::solve_again(const Problem& problem, Assignment& solution) {
  load(problem);
  const Incumbent& best = searches_.front().best;
  bool is_complete = search();
  if (!is_complete && !best.exists && !options_.any_solution) repair();
  result_.propagations = propagator_.propagations();
  result_.performance_effort = propagator_.performance_effort();
  if (is_hopeless_) is_complete = search_learning();
  budget_.nodes_before += result_.nodes;
  if (best.exists) {
    result_.status = is_complete ? SearchStatus::optimal : SearchStatus::feasible;
    solution = best.assignment;
    if (!is_complete && !options_.any_solution) {
      if (is_hopeless_) {
        learning_.return_to_root();
      } else {
        return_to_root();
        static_cast<void>(begin());
      }
      result_.bound = bound_of_best(solution);
    }
  } else {
    result_.status = is_complete ? SearchStatus::infeasible : SearchStatus::unknown;
  }
  return result_;
}

SearchBound Solver::bound(const Problem& problem, const Assignment& answer) {
  problem_ = &problem;
  return_to_root();
  propagator_.load(problem);
  static_cast<void>(begin());  // `answer` is left
  SearchBound bound = compare_requests(answer);
  bound.same_requests = false;
  bound.suitability = bound_suitability();
  return bound;
}

/// Bounds the best solution. The domains have what holds in every solution, or in every one better
/// than the answer.
SearchBound Solver::bound_of_best(const Assignment& answer) {
  SearchBound bound = compare_requests(answer);
  // Without a better solution any bound holds.
  const bool may_improve = !bound.same_requests || serve_requests_of(answer);
  bound.suitability = may_improve ? bound_suitability() : 0;
  return bound;
}

SearchBound Solver::compare_requests(const Assignment& answer) const {
  SearchBound bound;
  bound.same_requests = true;
  std::uint32_t possible = 0;
  std::uint32_t served = 0;
  for (const LocalTask task : problem_->requests) {
    if (domains_.count(task) > 0 && answer[task] == none) bound.same_requests = false;
  }
  for (const LocalTask task : problem_->counted_requests()) {
    if (answer[task] != none) ++served;
    if (domains_.count(task) > 0) ++possible;
  }
  bound.more_requests = possible > served ? possible - served : 0;
  return bound;
}

bool Solver::serve_requests_of(const Assignment& answer) {
  for (const LocalTask task : problem_->counted_requests()) {
    if (answer[task] != none && !domains_.need(task)) return false;
  }
  return propagator_.propagate();
}

double Solver::bound_suitability() {
  if (is_hopeless_) return highest_product(learning_.bound_cost(), domains_.task_count());
  const CostBound::Cost bound =
      cost_bound_.bound({INT64_MAX, INT64_MAX}, CostBound::Roots::in_component);
  return highest_product(bound.log, domains_.task_count());
}

void Solver::load(const Problem& problem) {
  problem_ = &problem;
  domains_.load(problem);
  propagator_.load(problem);
  components_.load(problem);
  objective_.load(problem, options_.max_solutions > 0);
  result_ = {};
  is_hard_ = false;
  is_hopeless_ = false;
  has_split_ = false;
  frames_.clear();
  current().best.exists = false;
  current().base = 0;
  current().best_cost_outside = 0;
  current().cost_bound_outside = 0;
}

void Solver::return_to_root() {
  while (components_.depth() > 0) components_.leave();
  domains_.load(*problem_);
}

/// Takes "not running" out of the domains of the tasks that must run.
bool Solver::begin() {
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
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
        if (budget_.is_spent(result_.nodes)) return false;
        if (should_learn()) {
          is_hopeless_ = true;
          return false;
        }
        if (should_restart()) {
          restart();
        } else if (!enter_component(*decision)) {
          is_consistent = branch(*decision);
        }
        continue;
      }
      if (!accept()) return false;
    }
    const bool is_component_solved = frames_.size() == current().base;
    if (is_component_solved && components_.depth() == 0) return true;
    // A hard search may refute many subtrees in a row without a decision.
    if (budget_.is_out_of_time()) return false;
    is_consistent = is_component_solved ? leave_component() : backtrack();
  }
}

/// Whether the present subtree may hold a better solution than the incumbents of the present
/// component and of those around it.
bool Solver::may_improve() {
  if (options_.max_solutions > 0) return true;
  for (std::uint32_t depth = 0; depth <= components_.depth(); ++depth) {
    const Incumbent& best = searches_[depth].best;
    if (best.exists && !objective_.may_beat(best, depth)) return false;
  }
  if (!is_hard_) return true;

  const ComponentSearch& component = current();
  const auto threshold_of = [this](const Incumbent& best) -> CostBound::Cost {
    if (!best.exists || !objective_.ties_before_suitability(best)) {
      return {INT64_MAX, INT64_MAX};
    }
    return pruning_threshold(best, domains_.task_count());
  };
  CostBound::Cost threshold = threshold_of(component.best);
  threshold.log -= component.best_cost_outside;
  CostBound::Cost threshold_of_all = threshold_of(searches_.front().best);
  threshold_of_all.log -= component.cost_bound_outside;
  threshold = std::min(threshold, threshold_of_all);
  return cost_bound_.bound(threshold, CostBound::Roots::in_component) <= threshold;
}

/// Takes the solution of the present component. False if it is one too many, or if
/// any solution will do.
bool Solver::accept() {
  if (options_.max_solutions > 0 && result_.solutions == options_.max_solutions) return false;
  if (components_.depth() == 0) ++result_.solutions;
  Incumbent& best = current().best;
  if (!best.exists || objective_.may_beat(best, components_.depth())) objective_.record(best);
  return !options_.any_solution || components_.depth() > 0;
}

/// Whether the search turns out to be hard. The enumeration of the first m solutions never
/// restarts.
bool Solver::should_restart() const {
  return !is_hard_ && options_.max_solutions == 0 && result_.nodes >= options_.easy_nodes;
}

/// Whether the search turns out to be too hard for branch and bound: it has no solution yet, or it
/// does not fall into components. Where something runs that nobody asked for, the searches that
/// learn have no reasons for its objectives.
bool Solver::should_learn() const {
  if (problem_->unasked > 0) return false;
  if (options_.max_solutions > 0 || options_.bounded_nodes == UINT64_MAX) return false;
  if (result_.nodes < options_.easy_nodes) return false;
  if (!searches_.front().best.exists) return true;
  constexpr std::uint64_t nodes_before_split = 50;
  const std::uint64_t bounded = options_.easy_nodes + nodes_before_split;
  return result_.nodes >=
         (has_split_ ? options_.bounded_nodes : std::min(bounded, options_.bounded_nodes));
}

/// Looks for an incumbent near the present configuration.
void Solver::repair() {
  return_to_root();
  if (!begin() || !repair_.find_solution(*problem_)) return;
  ++result_.solutions;
  objective_.record(searches_.front().best);
}

/// Starts again with the incumbent. False if a limit ended the search.
bool Solver::search_learning() {
  return_to_root();
  return learning_.search(*problem_, searches_.front().best, options_.any_solution, budget_,
                          result_);
}

/// Restarts at the root, and keeps the incumbent.
void Solver::restart() {
  is_hard_ = true;
  if (frames_.empty()) return;
  domains_.undo_to(frames_.front().mark);
  frames_.clear();
}

/// If the undecided tasks fall into components: begins to solve the one of the decision's task.
bool Solver::enter_component(const Decision& decision) {
  if (!is_hard_ || decision.kind != Decision::Kind::assign ||
      !components_.enter_component_of(decision.task)) {
    return false;
  }
  has_split_ = true;
  const ComponentSearch& around = searches_[components_.depth() - 1];
  ComponentSearch& component = current();
  component.best.exists = false;
  component.base = frames_.size();
  component.mark = domains_.mark();
  component.best_cost_outside = 0;
  for (const LocalTask task : domains_.needed_tasks()) {
    if (!components_.contains(task, components_.depth())) {
      component.best_cost_outside += domains_.value(task, domains_.best(task)).cost;
    }
  }
  component.cost_bound_outside =
      around.cost_bound_outside +
      cost_bound_.bound({INT64_MAX, INT64_MAX}, CostBound::Roots::around_component).log;
  return true;
}

/// The present component is solved: fixes its best values, and continues with what is around it.
/// False if it has no solution that could improve an incumbent.
bool Solver::leave_component() {
  const ComponentSearch& component = current();
  const std::uint32_t depth = components_.depth();
  domains_.undo_to(component.mark);
  bool is_consistent = component.best.exists;
  for (LocalTask task(0); is_consistent && task < domains_.task_count(); ++task) {
    if (!components_.contains(task, depth)) continue;
    const std::uint32_t index = component.best.assignment[task];
    is_consistent = index == none ? domains_.close(task) : domains_.assign(task, index);
  }
  components_.leave();
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
      return domains_.assign(decision.task, decision.value_index);
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
      return domains_.remove(decision.task, decision.value_index);
    case Decision::Kind::run:
      return domains_.close(decision.task);
    case Decision::Kind::stop:
      return domains_.need(decision.task);
  }
  return false;
}

/// The next decision; none if the present component is decided. Requests come first: they decide
/// f1.
std::optional<Solver::Decision> Solver::decide() {
  if (options_.max_solutions > 0) return decide_in_catalog_order();
  for (const LocalTask task : problem_->requests) {
    if (domains_.may_stop(task) && domains_.count(task) > 0) {
      return Decision{Decision::Kind::run, task, none};
    }
  }
  const LocalTask task = choose_task();
  if (task == none) return std::nullopt;
  return Decision{Decision::Kind::assign, task, choose_value(task)};
}

/// The undecided needed task of the highest level, so that a task is decided after those that may
/// require it.
LocalTask Solver::choose_task() const {
  LocalTask chosen = none;
  std::uint32_t highest_level = 0;
  for (const LocalTask task : domains_.needed_tasks()) {
    if (domains_.count(task) == 1 || !components_.contains(task, components_.depth())) continue;
    const std::uint32_t level = catalog_.tasks[domains_.first_task() + task].level;
    if (chosen == none || level > highest_level) {
      chosen = task;
      highest_level = level;
    }
  }
  return chosen;
}

/// The value of the least estimated cost; of equal ones the first in the canonical order.
std::uint32_t Solver::choose_value(LocalTask task) {
  std::uint32_t chosen = none;
  CostBound::Cost least;
  for (const std::uint32_t index : domains_.indices(task)) {
    const CostBound::Cost cost = estimate(task, index);
    if (chosen == none || cost < least ||
        (cost == least && objective_.key(task, index) < objective_.key(task, chosen))) {
      chosen = index;
      least = cost;
    }
  }
  return chosen;
}

/// Estimates the cost of a value with what it newly requires.
CostBound::Cost Solver::estimate(LocalTask task, std::uint32_t index) {
  if (is_hard_) return cost_bound_.reduced_cost(task, index);
  const Value& value = domains_.value(task, index);
  CostBound::Cost cost{value.cost, 0};
  for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
    const LocalTask required = rule.task - domains_.first_task();
    if (domains_.needed(required) || domains_.count(required) == 0) continue;
    cost.log += domains_.value(required, domains_.best(required)).cost;
  }
  return cost;
}

/// The paper's order: tasks in catalog order, values ("not running" too) by rank.
std::optional<Solver::Decision> Solver::decide_in_catalog_order() const {
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    const std::uint32_t count = domains_.count(task);
    if (count == 0 || (count == 1 && domains_.needed(task))) continue;
    std::uint32_t first = none;
    std::uint32_t first_key = domains_.may_stop(task) ? objective_.key(task, none) : none;
    for (const std::uint32_t index : domains_.indices(task)) {
      if (objective_.key(task, index) >= first_key) continue;
      first = index;
      first_key = objective_.key(task, index);
    }
    if (first == none) return Decision{Decision::Kind::stop, task, none};
    return Decision{Decision::Kind::assign, task, first};
  }
  return std::nullopt;
}

}  // namespace cbc
