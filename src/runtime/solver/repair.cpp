// Greedy construction with propagation: tasks get their behaviors one after the other, each the
// present one where it is left, and propagation at once takes away what no longer fits. What a
// change brings along, such as tasks that are newly required and rivals that stop, is known before
// the next choice, and a choice that leads nowhere is undone a few times at most. Branch and bound
// looks for good solutions, and where it has found none so far, one that is merely near is worth
// more than none: as an answer at a limit, and as an incumbent for LearningSearch.
//
// The better known way to repair is local search, which changes one value after the other of an
// assignment that violates constraints (S. Minton, M. D. Johnston, A. B. Philips and P. Laird,
// "Minimizing conflicts: a heuristic repair method for constraint satisfaction and scheduling
// problems", Artificial Intelligence 58 (1992)). But here one change needs several others, down a
// chain of requirements, and until all are made nothing says that the first was a good one.
#include "runtime/solver/repair.h"

#include <algorithm>

namespace cbc {

Repair::Repair(const CompiledCatalog& catalog, Domains& domains, Propagator& propagator)
    : catalog_(catalog), domains_(domains), propagator_(propagator) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  choices_.reserve(most_tasks);
  candidates_.reserve(2 * most_tasks);  // each task is needed once, and loses its value once
  listings_.resize(most_tasks);
}

/// With all requests in view, propagation keeps the first choices from taking the place of later
/// ones; but one request without a place then hinders all others.
bool Repair::find_solution(const Problem& problem) {
  problem_ = &problem;
  const Domains::Mark root = domains_.mark();
  if (find_solution_with(problem.requests.size())) return true;
  domains_.undo_to(root);
  return find_solution_with(0);
}

/// Looks for places for what must run together with the first requests, and then for the others
/// one by one.
bool Repair::find_solution_with(std::size_t together) {
  const std::vector<LocalTask>& requests = problem_->requests;
  for (std::size_t place = 0; place < together; ++place) {
    const Domains::Mark before = domains_.mark();
    const LocalTask task = requests[place];
    if (!serve(task) && !drop(task, before)) return false;
  }
  if (!assign_needed_tasks()) return false;
  for (std::size_t place = together; place < requests.size(); ++place) {
    const Domains::Mark before = domains_.mark();
    const LocalTask task = requests[place];
    if (!(serve(task) && assign_needed_tasks()) && !drop(task, before)) return false;
  }
  return true;
}

bool Repair::serve(LocalTask task) { return domains_.need(task) && propagator_.propagate(); }

bool Repair::drop(LocalTask task, const Domains::Mark& before) {
  domains_.undo_to(before);
  return domains_.close(task) && propagator_.propagate();
}

/// Gives each needed task one behavior. False after too many dead ends.
bool Repair::assign_needed_tasks() {
  choices_.clear();
  list_candidates();
  constexpr std::uint32_t most_dead_ends = 20;
  std::uint32_t dead_ends = 0;
  for (;;) {
    const LocalTask task = take_next_task();
    if (task == none) return true;
    const std::uint32_t index = choose_value(task);
    if (index != none) {
      choices_.push_back({task, index, domains_.mark()});
      if (assign(task, index)) {
        list_new_candidates();
        continue;
      }
    }
    bool is_consistent = false;
    while (!is_consistent) {
      if (choices_.empty() || ++dead_ends > most_dead_ends) return false;
      const Choice last = choices_.back();
      choices_.pop_back();
      domains_.undo_to(last.before);
      is_consistent = domains_.remove(last.task, last.index) && propagator_.propagate();
    }
    list_candidates();
  }
}

void Repair::list_candidates() {
  candidates_.clear();
  listed_ = domains_.mark();
  listed_.needed = 0;
  list_new_candidates();
}

void Repair::list_new_candidates() {
  const std::vector<LocalTask>& needed = domains_.needed_tasks();
  for (std::size_t place = listed_.needed; place < needed.size(); ++place) {
    const LocalTask task = needed[place];
    if (domains_.count(task) == 1) continue;
    listings_[task] = {static_cast<std::uint32_t>(place), !has_present_value(task)};
    list_candidate(task);
  }
  const Domains::Mark now = domains_.mark();
  for (std::size_t change = listed_.trail; change < now.trail; ++change) {
    const LocalTask task = domains_.changed_task(change);
    if (domains_.count(task) == 1 || !domains_.needed(task) || has_present_value(task)) continue;
    if (std::exchange(listings_[task].lost_present_value, true)) continue;
    list_candidate(task);
  }
  listed_ = now;
}

void Repair::list_candidate(LocalTask task) {
  const Listing& listing = listings_[task];
  candidates_.push_back({listing.lost_present_value,
                         catalog_.tasks[domains_.first_task() + task].level, listing.place});
  std::push_heap(candidates_.begin(), candidates_.end());
}

LocalTask Repair::take_next_task() {
  while (!candidates_.empty()) {
    const LocalTask task = domains_.needed_tasks()[candidates_.front().place];
    std::pop_heap(candidates_.begin(), candidates_.end());
    candidates_.pop_back();
    if (domains_.count(task) != 1) return task;
  }
  return none;
}

/// The present value, or the one that leaves most: of the requests, and then of f2. None if
/// propagation refutes all.
std::uint32_t Repair::choose_value(LocalTask task) {
  if (has_present_value(task)) return problem_->present[task];
  std::uint32_t chosen = none;
  std::pair<std::uint32_t, std::int64_t> least;
  for (const std::uint32_t index : domains_.indices(task)) {
    const auto loss = try_value(task, index);
    if (!loss || (chosen != none && *loss >= least)) continue;
    chosen = index;
    least = *loss;
  }
  return chosen;
}

/// What a value costs: requests, and -log of f2; nothing if propagation refutes it.
std::optional<std::pair<std::uint32_t, std::int64_t>> Repair::try_value(LocalTask task,
                                                                        std::uint32_t index) {
  const Domains::Mark before = domains_.mark();
  std::optional<std::pair<std::uint32_t, std::int64_t>> loss;
  if (assign(task, index)) loss.emplace(count_lost_requests(), domains_.sums().cost);
  domains_.undo_to(before);
  return loss;
}

bool Repair::assign(LocalTask task, std::uint32_t index) {
  return domains_.assign(task, index) && propagator_.propagate();
}

std::uint32_t Repair::count_lost_requests() const {
  return static_cast<std::uint32_t>(
      std::count_if(problem_->requests.begin(), problem_->requests.end(),
                    [this](LocalTask task) { return domains_.count(task) == 0; }));
}

}  // namespace cbc
