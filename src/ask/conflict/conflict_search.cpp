// A search that learns, as LearningSearch does, but decides only whether there is a solution, and
// with only some constraints in force. Each no-good comes with the constraints that it was derived
// from. Where there is no solution, those of the last conflict are the core of a proof (L. Zhang
// and S. Malik, "Validating SAT solvers using an independent resolution-based checker: practical
// implementations and other applications", DATE 2003): what is not in the core has no part in the
// failure.
//
// To solve a problem again and again, with one constraint less each time, would need no proofs. But
// a task may have hundreds of rivals and requirements. The core leaves a few of them after one
// search, and only from these a minimal conflict set is made (reasons.cpp).
#include "ask/conflict/conflict_search.h"

#include <algorithm>
#include <utility>

namespace cbc {

RelaxedTrail::RelaxedTrail(const CompiledCatalog& catalog, GroupId group, Domains& domains)
    : Trail(catalog, domains),
      first_behavior_(catalog.group_behaviors[group]),
      behavior_count_(catalog.group_behaviors[group + 1] - first_behavior_) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  std::vector<std::uint64_t> words;
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    const std::size_t values = catalog.values[task].size();
    words.insert(words.end(), values / 64, all);
    if (values % 64 != 0) words.push_back(~(all << (values % 64)));
  }
  domains.load(group, words);
}

void RelaxedTrail::load(std::span<const Reason> reasons) {
  domains_.undo_to({});
  clear();
  constraints_ = reasons;
  index_constraints();
  nogood_origins_.clear();
  origin_begins_.assign(1, 0);
  origin_reasons_.clear();
  for (LocalTask task(0); task < task_count_; ++task) {
    if (domains_.count(task) > 0) continue;
    static_cast<void>(imply(negate(runs(task)), {Cause::Kind::no_value}));
  }
  effort_ += reasons.size() + variable_count() / 8;  // most of the latter is cleared word by word
}

void RelaxedTrail::index_constraints() {
  exclusions_.begin(task_count_);
  limits_.begin(catalog_.limits.empty() ? 0 : task_count_);
  required_by_.begin(task_count_);
  requirements_.begin(behavior_count_);
  for (const auto put : {&Lists::count, &Lists::add}) {
    for (std::uint32_t index = 0; index < constraints_.size(); ++index) {
      const Reason& reason = constraints_[index];
      if (reason.kind == Reason::Kind::exclusive) {
        (exclusions_.*put)(reason.task - first_task_, index);
        (exclusions_.*put)(reason.other_task - first_task_, index);
      } else if (reason.kind == Reason::Kind::limited) {
        for (const TaskId member : catalog_.limited[reason.limit]) {
          (limits_.*put)(member - first_task_, index);
        }
      } else if (reason.kind == Reason::Kind::requires_task) {
        (required_by_.*put)(reason.task - first_task_, index);
        (requirements_.*put)(reason.behavior - first_behavior_, index);
      }
    }
    if (put == &Lists::count) {
      exclusions_.end_count();
      limits_.end_count();
      required_by_.end_count();
      requirements_.end_count();
    }
  }
}

bool RelaxedTrail::learn(std::span<const Literal> clause, std::uint32_t levels,
                         std::span<const std::uint32_t> reasons) {
  const auto origin = static_cast<std::uint32_t>(origin_begins_.size() - 1);
  origin_reasons_.insert(origin_reasons_.end(), reasons.begin(), reasons.end());
  origin_begins_.push_back(static_cast<std::uint32_t>(origin_reasons_.size()));
  if (clause.size() == 1) return imply(clause.front(), {Cause::Kind::learned, origin});
  nogood_origins_.push_back(origin);
  return Trail::learn(clause, levels);
}

std::span<const std::uint32_t> RelaxedTrail::reasons_of(const Cause& cause) const {
  if (cause.kind != Cause::Kind::learned && cause.kind != Cause::Kind::nogood) return {};
  const std::uint32_t origin =
      cause.kind == Cause::Kind::nogood ? nogood_origins_[cause.data] : cause.data;
  const std::uint32_t begin = origin_begins_[origin];
  return {origin_reasons_.data() + begin, origin_begins_[origin + 1] - begin};
}

bool RelaxedTrail::follow_running(LocalTask task) {
  const std::span<const std::uint32_t> exclusions = exclusions_[task];
  effort_ += exclusions.size();
  for (const std::uint32_t index : exclusions) {
    const Reason& reason = constraints_[index];
    const TaskId rival = reason.task == first_task_ + task ? reason.other_task : reason.task;
    const Cause cause{Cause::Kind::literal, runs(task), index};
    if (!imply(negate(runs(rival - first_task_)), cause)) return false;
  }
  if (catalog_.limits.empty()) return true;
  const std::span<const std::uint32_t> limits = limits_[task];
  return std::all_of(limits.begin(), limits.end(), [this](std::uint32_t index) {
    const std::uint32_t limit = constraints_[index].limit;
    effort_ += catalog_.limited[limit].size();
    return close_limited(limit, index);
  });
}

bool RelaxedTrail::follow_not_running(LocalTask task) {
  for (const std::uint32_t index : required_by_[task]) {
    const auto values = catalog_.performs[constraints_[index].behavior];
    effort_ += values.size();
    for (const ValueId value : values) {
      const Cause cause{Cause::Kind::literal, negate(runs(task)), index};
      if (!imply(negate(has_value(value)), cause)) return false;
    }
  }
  return true;
}

bool RelaxedTrail::follow_value(LocalTask /*task*/, ValueId value) {
  const BehaviorId behavior = catalog_.values.items[value].behavior;
  const std::span<const std::uint32_t> requirements = requirements_[behavior - first_behavior_];
  effort_ += requirements.size();
  for (const std::uint32_t index : requirements) {
    const Cause cause{Cause::Kind::literal, has_value(value), index};
    if (!imply(runs(constraints_[index].task - first_task_), cause)) return false;
  }
  return true;
}

ConflictSearch::ConflictSearch(const CompiledCatalog& catalog, GroupId group,
                               std::span<const std::uint32_t> present, Demands demands)
    : catalog_(catalog),
      present_(present),
      demands_(std::move(demands)),
      first_task_(catalog.group_tasks[group]),
      task_count_(catalog.group_tasks[group + 1] - first_task_),
      domains_(std::make_unique<Domains>(catalog, group)),
      trail_(catalog, group, *domains_),
      saved_(task_count_, none),
      in_closure_(task_count_, 0) {
  activities_.clear(task_count_);
}

/// As in Domains, tasks that nothing needs can be left out, so a problem is solved when each needed
/// task has one value; only to keep a performance low, a task that nothing needs may have to run.
Feasibility ConflictSearch::solve(std::span<const Reason> reasons, Effort& left) {
  if (left.is_over()) return Feasibility::unknown;
  std::uint64_t spent = effort();
  restarts_.clear();
  is_used_.assign(reasons.size(), 0);
  used_.clear();
  sort(reasons);
  trail_.load(reasons);
  analysis_.resize(trail_.variable_count());
  is_known_fact_.resize(trail_.variable_count(), 0);
  bool is_consistent = begin(reasons);
  for (;;) {
    is_consistent = is_consistent && propagate(reasons);
    left.spend(effort() - spent);
    spent = effort();
    if (left.is_over()) return Feasibility::unknown;
    if (!is_consistent) {
      if (!learn()) return Feasibility::no;
      is_consistent = true;
      continue;
    }
    if (restarts_.is_due()) {
      trail_.backtrack_to(0);
      restarts_.restart();
      continue;
    }
    const LocalTask task = choose_task();
    effort_ += task_count_ / 8;
    if (task != none) {
      trail_.decide(trail_.has_value(task, choose_value(task)));
      continue;
    }
    // All needed tasks are decided, so the performance is exact.
    if (low_task_ == none || !may_reach(low_task_, low_minimum_)) return Feasibility::yes;
    const LocalTask optional = optional_factor();
    if (optional != none) {
      trail_.decide(Trail::runs(optional));
    } else if (!leave_dead_end()) {
      return Feasibility::no;
    }
  }
}

std::vector<ValueId> ConflictSearch::values_of(TaskId task) {
  std::vector<ValueId> values;
  if (!domains_->needed(task - first_task_)) return values;
  static_cast<void>(may_reach(task - first_task_, 0));
  for (const LocalTask each : closure_) {
    values.emplace_back(catalog_.values.begin[first_task_ + each] + domains_->best(each));
  }
  return values;
}

/// The demands come first: where they and the catalog alone, or with protected tasks, leave no
/// solution, the other reasons of the state are no part of the proof.
bool ConflictSearch::begin(std::span<const Reason> reasons) {
  for (const Demand& each : demands_) {
    if (!demand(each)) return false;
  }
  if (low_task_ != none && !trail_.imply(Trail::runs(low_task_), {})) return false;
  if (!trail_.propagate()) return false;
  return std::all_of(state_.begin(), state_.end(), [&](std::uint32_t index) {
    return apply(reasons[index], index) && trail_.propagate();
  });
}

bool ConflictSearch::demand(const Demand& demand) {
  using Kind = Demand::Kind;
  const LocalTask task = demand.task - first_task_;
  const bool is_about_running = demand.kind == Kind::run || demand.kind == Kind::stop;
  const bool is_ruled_out = demand.kind == Kind::stop || demand.kind == Kind::has_not;
  const Literal literal =
      is_about_running ? Trail::runs(task) : trail_.has_value(task, demand.value_index);
  return trail_.imply(is_ruled_out ? negate(literal) : literal, {});
}

/// Sorts out the reasons that the trail does not propagate.
void ConflictSearch::sort(std::span<const Reason> reasons) {
  performances_.clear();
  state_.clear();
  for (std::uint32_t index = 0; index < reasons.size(); ++index) {
    const Reason::Kind kind = reasons[index].kind;
    if (kind == Reason::Kind::performance) {
      performances_.push_back(index);
    } else if (kind != Reason::Kind::exclusive && kind != Reason::Kind::limited &&
               kind != Reason::Kind::requires_task) {
      state_.push_back(index);
    }
  }
  std::stable_sort(state_.begin(), state_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return reasons[a].kind < reasons[b].kind;  // as they are declared
  });
}

/// A reason that follows from the state.
bool ConflictSearch::apply(const Reason& reason, std::uint32_t index) {
  const Trail::Cause cause{Trail::Cause::Kind::given, 0, index};
  const Literal runs = reason.task == none ? 0 : Trail::runs(reason.task - first_task_);
  if (reason.kind == Reason::Kind::is_protected) return trail_.imply(runs, cause);
  if (reason.kind == Reason::Kind::on_request) return trail_.imply(negate(runs), cause);
  if (reason.kind == Reason::Kind::not_improved) {
    const auto values = catalog_.values[reason.task];
    const auto present = std::find_if(values.begin(), values.end(), [&reason](const Value& one) {
      return one.behavior == reason.behavior;
    });
    for (std::uint32_t place = 0; values[place].suitability > present->suitability; ++place) {
      const Literal value = trail_.has_value(reason.task - first_task_, place);
      if (!trail_.imply(negate(value), cause)) return false;
    }
    return true;
  }
  const auto values = catalog_.performs[reason.behavior];
  return std::all_of(values.begin(), values.end(), [&](ValueId value) {
    const TaskId task = catalog_.task_of(value);
    const bool is_kept =
        (reason.kind == Reason::Kind::unavailable || reason.kind == Reason::Kind::not_retried) &&
        present_[task - first_task_] == value - catalog_.values.begin[task];
    return is_kept || trail_.imply(negate(trail_.has_value(value)), cause);
  });
}

bool ConflictSearch::propagate(std::span<const Reason> reasons) {
  if (!trail_.propagate()) return false;
  effort_ += performances_.size();
  return std::all_of(performances_.begin(), performances_.end(),
                     [&](std::uint32_t index) { return may_perform(reasons[index], index); });
}

/// Whether the performance can still reach the minimum. Exact where all that it depends on is
/// fixed. A required task counts only if it is needed.
bool ConflictSearch::may_perform(const Reason& reason, std::uint32_t index) {
  const LocalTask task = reason.task - first_task_;
  if (!domains_->needed(task)) return true;
  literals_.clear();
  if (reason.behavior != none) {
    const auto values = catalog_.performs[reason.behavior];
    const auto found = std::find_if(values.begin(), values.end(), [this](ValueId value) {
      return trail_.is_true(trail_.has_value(value));
    });
    if (found == values.end()) return true;
    literals_.push_back(trail_.has_value(*found));
  }
  if (may_reach(task, reason.minimum_performance)) return true;
  explain_performance({Trail::Cause::Kind::given, 0, index});
  return false;
}

/// Whether the performance of a needed task may be at least `minimum`.
bool ConflictSearch::may_reach(LocalTask reached, Millionths minimum) {
  closure_.assign(1, reached);
  std::fill(in_closure_.begin(), in_closure_.end(), 0);
  in_closure_[reached] = 1;
  product_.clear();
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const LocalTask task = closure_[next];
    const Value& best = domains_->value(task, domains_->best(task));
    product_.multiply(best.suitability);
    if (domains_->count(task) > 1) continue;
    effort_ += catalog_.requirements[best.behavior].size();
    for (const CompiledRequirement& requirement : catalog_.requirements[best.behavior]) {
      const LocalTask target = requirement.task - first_task_;
      if (!domains_->needed(target) || std::exchange(in_closure_[target], 1) != 0) continue;
      closure_.push_back(target);
    }
  }
  // The cost of a multiplication grows with the number of factors.
  effort_ += in_closure_.size() / 8 + closure_.size() * closure_.size();
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) >= 0;
}

/// Makes the conflict out of what keeps the performance tested last too low: the behavior that
/// requires it, if there is one, runs (already in literals_), and all tasks of the closure run with
/// nothing more suitable.
void ConflictSearch::explain_performance(const Trail::Cause& cause) {
  for (const LocalTask task : closure_) {
    literals_.push_back(Trail::runs(task));
    const std::uint32_t best = domains_->best(task);
    // Its requirements are in the closure only because no other behavior is left.
    const bool is_fixed = domains_->count(task) == 1;
    trail_.append_removals(
        task, [&](std::uint32_t index) { return is_fixed || index < best; }, literals_);
  }
  trail_.set_conflict(literals_, cause);
}

/// Learns from the conflict and goes back. False if the conflict rests on no decision: there is no
/// solution. is_used_ then says what that follows from.
bool ConflictSearch::learn() {
  const bool is_final = ConflictAnalysis::level_of(trail_.conflict(), trail_) == 0;
  begin_derivation();
  add_cause(trail_.conflict_cause());
  if (is_final) {
    trace_facts(trail_.conflict());
    return false;
  }
  analysis_.analyze(trail_.conflict(), trail_);
  for (const Literal literal : analysis_.resolved()) add_cause(trail_.cause_of(literal));
  trace_facts(analysis_.facts());
  effort_ += trail_.conflict().size() + analysis_.variables().size() + used_.size();
  activities_.note_conflict(analysis_.variables(), trail_);
  restarts_.note_conflict();
  trail_.backtrack_to(analysis_.back_level());
  // The literal is undecided at that level.
  static_cast<void>(trail_.learn(analysis_.learned(), analysis_.level_count(), used_));
  return true;
}

/// Learns that not all decisions can hold, where a performance is not low enough. Any reason may
/// have removed what could lower it.
bool ConflictSearch::leave_dead_end() {
  begin_derivation();
  for (std::uint32_t reason = 0; reason < is_used_.size(); ++reason) add_reason(reason);
  if (trail_.level() == 0) return false;
  literals_.clear();
  for (std::uint32_t level = trail_.level(); level > 0; --level) {
    literals_.push_back(negate(trail_.decision(level)));
  }
  effort_ += literals_.size() + used_.size();
  restarts_.note_conflict();
  trail_.backtrack_to(trail_.level() - 1);
  static_cast<void>(trail_.learn(literals_, static_cast<std::uint32_t>(literals_.size()), used_));
  return true;
}

void ConflictSearch::begin_derivation() {
  for (const std::uint32_t reason : used_) is_used_[reason] = 0;
  used_.clear();
}

void ConflictSearch::add_cause(const Trail::Cause& cause) {
  if (cause.constraint != none) add_reason(cause.constraint);
  const std::span<const std::uint32_t> reasons = trail_.reasons_of(cause);
  effort_ += reasons.size();
  for (const std::uint32_t reason : reasons) add_reason(reason);
}

void ConflictSearch::add_reason(std::uint32_t reason) {
  if (std::exchange(is_used_[reason], 1) == 0) used_.push_back(reason);
}

/// Adds the reasons that literals of level 0 follow from.
void ConflictSearch::trace_facts(std::span<const Literal> facts) {
  facts_.assign(facts.begin(), facts.end());
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < facts_.size(); ++next) {
    const Literal fact = facts_[next];
    if (std::exchange(is_known_fact_[variable_of(fact)], 1) != 0) continue;
    known_facts_.push_back(variable_of(fact));
    add_cause(trail_.cause_of(fact));
    trail_.append_reason(fact, facts_);
  }
  effort_ += facts_.size();
  for (const std::uint32_t variable : known_facts_) is_known_fact_[variable] = 0;
  known_facts_.clear();
}

/// The undecided needed task that has taken part in most of the recent conflicts; of several the
/// one with the fewest values.
LocalTask ConflictSearch::choose_task() const {
  LocalTask chosen = none;
  const auto is_better = [this](LocalTask a, LocalTask b) {
    if (activities_[a] != activities_[b]) return activities_[a] > activities_[b];
    return domains_->count(a) < domains_->count(b);
  };
  for (LocalTask task(0); task < task_count_; ++task) {
    if (!domains_->needed(task) || domains_->count(task) < 2) continue;
    if (chosen == none || is_better(task, chosen)) chosen = task;
  }
  return chosen;
}

/// The value chosen last, or else the most suitable one.
std::uint32_t ConflictSearch::choose_value(LocalTask task) {
  std::uint32_t& saved = saved_[task];
  if (saved == none || !domains_->has(task, saved)) saved = domains_->best(task);
  return saved;
}

/// A task that is not needed, may run, and would count in the performance tested last.
LocalTask ConflictSearch::optional_factor() const {
  for (const LocalTask task : closure_) {
    const BehaviorId behavior = domains_->value(task, domains_->best(task)).behavior;
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      const LocalTask target = requirement.task - first_task_;
      if (!domains_->needed(target) && domains_->count(target) > 0) return target;
    }
  }
  return none;
}

}  // namespace cbc
