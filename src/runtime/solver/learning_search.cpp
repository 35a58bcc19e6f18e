#include "solver/learning_search.h"

#include <algorithm>

#include "solver/luby.h"

namespace cbc {
namespace {

constexpr std::uint64_t conflicts_of_a_restart = 64;
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
      objectives_(domains, objective, bound_, trail_) {
  trail_.set_lazy_reasons(bound_);
}

void LearningSearch::load(const Problem& problem) {
  problem_ = &problem;
  performance_.load();
  objectives_.load(problem);
  saved_.assign(problem.present.begin(), problem.present.end());
  activities_.assign(domains_.task_count(), 0);
  increment_ = 1;
  conflicts_ = 0;
  restarts_ = 0;
  next_restart_ = conflicts_of_a_restart;
  most_nogoods_ = first_most_nogoods;
}

bool LearningSearch::search(const Problem& problem, Incumbent& best, bool any_solution,
                            SearchBudget& budget, SearchResult& result) {
  load(problem);
  const std::uint64_t propagations_before = result.propagations;
  bool is_consistent = trail_.load(problem);
  bound_.load();
  is_noted_.assign(trail_.variable_count(), 0);
  counted_.assign(trail_.variable_count() + 1, 0);
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
    if (conflicts_ >= next_restart_) {
      restart();
      continue;
    }
    const Literal decision = decide(best);
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
    if (!performance_.propagate()) return false;
    if (trail_.literals().size() > before) continue;
    if (best.exists && !objectives_.propagate(best)) return false;
    if (trail_.literals().size() == before) return true;
  }
}

/// Learns from the conflict and goes back. False if the conflict rests on no decision: nothing
/// better is left.
bool LearningSearch::learn() {
  ++conflicts_;
  conflict_level_ = 0;
  for (const Literal literal : trail_.conflict()) {
    conflict_level_ = std::max(conflict_level_, trail_.level_of(literal));
  }
  if (conflict_level_ == 0) return false;
  save_values();
  backtrack_to(conflict_level_);
  trace_conflict();
  drop_implied_literals();
  for (const std::uint32_t variable : noted_) is_noted_[variable] = 0;
  noted_.clear();

  constexpr double growth = 1.05;
  increment_ *= growth;
  trail_.nogoods().age();
  if (learned_.size() == 1) {
    backtrack_to(0);
    return trail_.imply(learned_.front(), {});
  }
  // The second literal watched is one of the highest level, to which the search goes back.
  const auto next_highest = std::max_element(
      learned_.begin() + 1, learned_.end(),
      [this](Literal a, Literal b) { return trail_.level_of(a) < trail_.level_of(b); });
  std::swap(learned_[1], *next_highest);
  const std::uint32_t levels = count_levels();
  backtrack_to(trail_.level_of(learned_[1]));
  const std::uint32_t nogood = trail_.nogoods().add(learned_, levels);
  return trail_.imply(learned_.front(), {ReasonTrail::Reason::Kind::nogood, nogood});
}

/// Resolves the conflict with the reasons of its literals, last inference first, until one literal
/// of the conflict level is left (the first unique implication point).
void LearningSearch::trace_conflict() {
  learned_.assign(1, 0);
  open_ = 0;
  for (const Literal literal : trail_.conflict()) note(literal);
  std::size_t place = trail_.literals().size();
  for (;;) {
    do --place;
    while (is_noted_[variable_of(trail_.literals()[place])] == 0);
    const Literal literal = trail_.literals()[place];
    if (--open_ == 0) {
      learned_.front() = negate(literal);
      return;
    }
    const ReasonTrail::Reason& reason = trail_.reason_of(literal);
    if (reason.kind == ReasonTrail::Reason::Kind::nogood) trail_.nogoods().note_use(reason.data);
    reason_.clear();
    trail_.append_reason(literal, reason_);
    for (const Literal other : reason_) note(other);
  }
}

void LearningSearch::note(Literal literal) {
  const std::uint32_t variable = variable_of(literal);
  const std::uint32_t level = trail_.level_of(literal);
  if (level == 0 || is_noted_[variable] != 0) return;
  is_noted_[variable] = 1;
  noted_.push_back(variable);
  if (level == conflict_level_) {
    ++open_;
  } else {
    learned_.push_back(negate(literal));
  }
  constexpr double too_large = 1e100;
  double& activity = activities_[trail_.task_of(variable)];
  activity += increment_;
  if (activity < too_large) return;
  for (double& each : activities_) each /= too_large;
  increment_ /= too_large;
}

/// Drops the literals that follow from the others of the no-good.
void LearningSearch::drop_implied_literals() {
  const auto is_implied = [this](Literal literal) {
    if (trail_.reason_of(literal).kind == ReasonTrail::Reason::Kind::given) return false;
    reason_.clear();
    trail_.append_reason(negate(literal), reason_);
    return std::all_of(reason_.begin(), reason_.end(), [this](Literal other) {
      return trail_.level_of(other) == 0 || is_noted_[variable_of(other)] != 0;
    });
  };
  learned_.erase(std::remove_if(learned_.begin() + 1, learned_.end(), is_implied), learned_.end());
}

std::uint32_t LearningSearch::count_levels() {
  ++count_number_;
  std::uint32_t levels = 0;
  for (const Literal literal : learned_) {
    std::uint64_t& counted = counted_[trail_.level_of(literal)];
    if (counted == count_number_) continue;
    counted = count_number_;
    ++levels;
  }
  return levels;
}

void LearningSearch::backtrack_to(std::uint32_t level) {
  trail_.backtrack_to(level);
  bound_.backtrack_to(level);
}

void LearningSearch::restart() {
  backtrack_to(0);
  ++restarts_;
  next_restart_ = conflicts_ + conflicts_of_a_restart * luby(restarts_);
  if (trail_.nogoods().size() <= most_nogoods_) return;
  trail_.nogoods().forget_half();
  most_nogoods_ += most_nogoods_ / 8;
}

/// The next literal to decide; none if all is decided that a best solution may contain. Requests
/// come first, the most important one first.
Literal LearningSearch::decide(const Incumbent& best) {
  for (const std::uint32_t task : problem_->requests) {
    const Literal runs = ReasonTrail::runs(task);
    if (!trail_.is_true(runs) && !trail_.is_false(runs)) return runs;
  }
  const std::uint32_t task = choose_task(best);
  return task == none ? none : trail_.has_value(task, choose_value(task, best));
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
std::uint32_t LearningSearch::choose_value(std::uint32_t task, const Incumbent& best) {
  const std::uint32_t saved = saved_[task];
  if (!best.exists && saved != none && domains_.has(task, saved)) return saved;
  if (bound_.level() == none) static_cast<void>(bound_.raise(INT64_MAX));
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
