#include "runtime/solver/learning_search.h"

namespace cbc {
namespace {

constexpr std::size_t first_most_nogoods = 2000;

}  // namespace

LearningSearch::LearningSearch(const CompiledCatalog& catalog, Domains& domains,
                               Objective& objective)
    : catalog_(catalog),
      domains_(domains),
      objective_(objective),
      trail_(catalog, domains),
      bound_(catalog, domains, trail_),
      performance_(catalog, domains, trail_),
      objectives_(catalog, domains, objective, bound_, trail_) {
  trail_.set_lazy_reasons(objectives_);
}

void LearningSearch::load(const Problem& problem) {
  problem_ = &problem;
  performance_.load();
  objectives_.load(problem);
  saved_.assign(problem.present.begin(), problem.present.end());
  activities_.clear(domains_.task_count());
  restarts_.clear();
  most_nogoods_ = first_most_nogoods;
}

bool LearningSearch::search(const Problem& problem, Incumbent& best, bool any_solution,
                            SearchBudget& budget, SearchResult& result) {
  load(problem);
  const std::uint64_t propagations_before = result.propagations;
  bool is_consistent = trail_.load(problem);
  bound_.load();
  analysis_.resize(trail_.variable_count());
  for (;;) {
    is_consistent = is_consistent && propagate(best, budget);
    result.propagations = propagations_before + trail_.propagations();
    if (budget.is_out_of_time()) return false;
    if (!is_consistent) {
      if (!learn()) return true;
      is_consistent = true;
      if (budget.is_spent(result.nodes)) return false;
      continue;
    }
    if (restarts_.is_due()) {
      restart();
      continue;
    }
    const Literal decision = decide(best, budget);
    if (decision == none) {
      ++result.solutions;
      objective_.record(best);
      save_values();
      if (any_solution) return true;
      continue;
    }
    if (budget.is_spent(result.nodes)) return false;
    ++result.nodes;
    bound_.begin_level();
    trail_.decide(decision);
  }
}

/// False if there is a conflict. Without time left there may be more to propagate.
bool LearningSearch::propagate(const Incumbent& best, const SearchBudget& budget) {
  for (;;) {
    if (budget.is_out_of_time()) return true;
    if (!trail_.propagate()) return false;
    const std::size_t before = trail_.literals().size();
    if (!performance_.propagate(budget)) return false;
    if (trail_.literals().size() > before) continue;
    if (best.exists && !objectives_.propagate(best, budget)) return false;
    if (trail_.literals().size() == before) return true;
  }
}

/// Learns from the conflict and goes back. False if the conflict rests on no decision: nothing
/// better is left.
bool LearningSearch::learn() {
  restarts_.note_conflict();
  const std::uint32_t level = ConflictAnalysis::level_of(trail_.conflict(), trail_);
  if (level == 0) return false;
  save_values();
  backtrack_to(level);
  analysis_.analyze(trail_.conflict(), trail_);
  for (const Literal literal : analysis_.resolved()) trail_.note_use_of_reason(literal);
  for (const std::uint32_t variable : analysis_.variables()) {
    activities_.note(trail_.task_of(variable));
  }
  activities_.age();
  trail_.nogoods().age();
  backtrack_to(analysis_.back_level());
  return trail_.learn(analysis_.learned(), analysis_.level_count());
}

void LearningSearch::backtrack_to(std::uint32_t level) {
  trail_.backtrack_to(level);
  bound_.backtrack_to(level);
}

void LearningSearch::restart() {
  backtrack_to(0);
  restarts_.restart();
  if (trail_.nogoods().size() <= most_nogoods_) return;
  trail_.nogoods().forget_half();
  most_nogoods_ += most_nogoods_ / 8;
}

/// The next literal to decide; none if all is decided that a best solution may contain. Requests
/// come first, the most important one first.
Literal LearningSearch::decide(const Incumbent& best, const SearchBudget& budget) {
  for (const std::uint32_t task : problem_->requests) {
    const Literal runs = ReasonTrail::runs(task);
    if (!trail_.is_true(runs) && !trail_.is_false(runs)) return runs;
  }
  const std::uint32_t task = choose_task(best);
  return task == none ? none : trail_.has_value(task, choose_value(task, best, budget));
}

/// Before the first solution: the undecided needed task that has taken part in most of the recent
/// conflicts. After it: one of the highest level, since what a task requires hardly costs anything
/// in the bound until it is known.
std::uint32_t LearningSearch::choose_task(const Incumbent& best) const {
  std::uint32_t chosen = none;
  const auto level_of = [this](std::uint32_t task) {
    return catalog_.tasks[domains_.first_task() + task].level;
  };
  const auto is_better = [&](std::uint32_t task) {
    const bool is_more_active = activities_[task] > activities_[chosen];
    if (level_of(task) == level_of(chosen)) return is_more_active;
    const bool is_higher = level_of(task) > level_of(chosen);
    if (best.exists || activities_[task] == activities_[chosen]) return is_higher;
    return is_more_active;
  };
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (domains_.count(task) > 1 && (chosen == none || is_better(task))) chosen = task;
  }
  return chosen;
}

/// The value of the least estimated cost; before the first solution rather the one saved.
std::uint32_t LearningSearch::choose_value(std::uint32_t task, const Incumbent& best,
                                           const SearchBudget& budget) {
  const std::uint32_t saved = saved_[task];
  if (!best.exists && saved != none && domains_.has(task, saved)) return saved;
  if (bound_.level() == none) static_cast<void>(bound_.raise(INT64_MAX, budget));
  std::uint32_t chosen = none;
  std::int64_t least = 0;
  const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
  for (std::uint32_t index = 0; index < values; ++index) {
    if (!domains_.has(task, index)) continue;
    const std::int64_t cost = bound_.estimate(task, index);
    if (chosen == none || cost < least || (cost == least && index == saved)) {
      chosen = index;
      least = cost;
    }
  }
  return chosen;
}

/// Saves the values of the tasks that have one, to try them first next time.
void LearningSearch::save_values() {
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (domains_.count(task) == 1) saved_[task] = domains_.best(task);
  }
}

}  // namespace cbc
