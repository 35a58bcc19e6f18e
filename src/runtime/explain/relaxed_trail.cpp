#include "runtime/explain/relaxed_trail.h"

#include <algorithm>

namespace cbc {

RelaxedTrail::RelaxedTrail(const CompiledCatalog& catalog, std::uint32_t group)
    : catalog_(catalog),
      first_task_(catalog.group_tasks[group]),
      task_count_(catalog.group_tasks[group + 1] - first_task_),
      first_value_(catalog.values.begin[first_task_]),
      first_behavior_(catalog.group_behaviors[group]),
      behavior_count_(catalog.group_behaviors[group + 1] - first_behavior_) {
  const std::size_t variables =
      task_count_ + catalog.values.begin[first_task_ + task_count_] - first_value_;
  levels_.resize(variables);
  causes_.resize(variables);
}

void RelaxedTrail::load(std::span<const Reason> reasons) {
  constraints_ = reasons;
  index_constraints();
  truth_.assign(2 * variable_count(), 0);
  literals_.clear();
  next_ = 0;
  marks_.clear();
  nogoods_.clear(variable_count());
  nogood_origins_.clear();
  origin_begins_.assign(1, 0);
  origin_reasons_.clear();
  counts_.clear();
  for (TaskId task = first_task_; task < first_task_ + task_count_; ++task) {
    counts_.push_back(static_cast<std::uint32_t>(catalog_.values[task].size()));
    if (counts_.back() == 0) set(negate(runs(task)), {Cause::Kind::no_value});
  }
  effort_ += reasons.size() + variable_count() / 8;  // most of the latter is cleared word by word
}

void RelaxedTrail::index_constraints() {
  index_.exclusions.begin(task_count_);
  index_.required_by.begin(task_count_);
  index_.requirements.begin(behavior_count_);
  for (const auto put : {&Lists::count, &Lists::add}) {
    for (std::uint32_t index = 0; index < constraints_.size(); ++index) {
      const Reason& reason = constraints_[index];
      if (reason.kind == Reason::Kind::exclusive) {
        (index_.exclusions.*put)(reason.task - first_task_, index);
        (index_.exclusions.*put)(reason.other_task - first_task_, index);
      } else if (reason.kind == Reason::Kind::requires_task) {
        (index_.required_by.*put)(reason.task - first_task_, index);
        (index_.requirements.*put)(reason.behavior - first_behavior_, index);
      }
    }
    if (put == &Lists::count) {
      index_.exclusions.end_count();
      index_.required_by.end_count();
      index_.requirements.end_count();
    }
  }
}

std::uint32_t RelaxedTrail::best(TaskId task) const {
  std::uint32_t index = 0;
  while (is_false(has_value(task, index))) ++index;
  return index;
}

BehaviorId RelaxedTrail::fixed_behavior(TaskId task) const {
  if (!is_true(runs(task)) || count(task) != 1) return none;
  return catalog_.values[task][best(task)].behavior;
}

void RelaxedTrail::decide(Literal literal) {
  marks_.push_back(literals_.size());
  set(literal, {});
}

bool RelaxedTrail::imply(Literal literal, const Cause& cause) {
  if (is_true(literal)) return true;
  if (!is_false(literal)) {
    set(literal, cause);
    return true;
  }
  conflict_.clear();
  append_reason(literal, cause, conflict_);
  conflict_.push_back(negate(literal));
  conflict_cause_ = cause;
  return false;
}

void RelaxedTrail::set_conflict(std::span<const Literal> literals, const Cause& cause) {
  conflict_.assign(literals.begin(), literals.end());
  conflict_cause_ = cause;
}

void RelaxedTrail::set(Literal literal, const Cause& cause) {
  const std::uint32_t variable = variable_of(literal);
  truth_[literal] = 1;
  truth_[negate(literal)] = -1;
  levels_[variable] = level();
  causes_[variable] = cause;
  literals_.push_back(literal);
  if (variable >= task_count_ && is_negated(literal)) --counts_[task_of(variable) - first_task_];
}

void RelaxedTrail::backtrack_to(std::uint32_t level) {
  if (level >= marks_.size()) return;
  while (literals_.size() > marks_[level]) {
    const Literal literal = literals_.back();
    const std::uint32_t variable = variable_of(literal);
    truth_[literal] = 0;
    truth_[negate(literal)] = 0;
    if (variable >= task_count_ && is_negated(literal)) ++counts_[task_of(variable) - first_task_];
    literals_.pop_back();
  }
  next_ = literals_.size();
  marks_.resize(level);
}

bool RelaxedTrail::learn(std::span<const Literal> clause, std::uint32_t levels,
                         std::span<const std::uint32_t> reasons) {
  const auto origin = static_cast<std::uint32_t>(origin_begins_.size() - 1);
  origin_reasons_.insert(origin_reasons_.end(), reasons.begin(), reasons.end());
  origin_begins_.push_back(static_cast<std::uint32_t>(origin_reasons_.size()));
  if (clause.size() == 1) return imply(clause.front(), {Cause::Kind::given, 0, none, origin});
  const std::uint32_t nogood = nogoods_.add(clause, levels);
  nogood_origins_.push_back(origin);
  return imply(clause.front(), {Cause::Kind::nogood, nogood, none, origin});
}

void RelaxedTrail::append_reason(Literal literal, const Cause& cause,
                                 std::vector<Literal>& result) const {
  const TaskId task = task_of(variable_of(literal));
  switch (cause.kind) {
    case Cause::Kind::given:
      return;
    case Cause::Kind::literal:
      result.push_back(cause.data);
      return;
    case Cause::Kind::last_value:
      result.push_back(runs(task));
      break;
    case Cause::Kind::no_value:
      break;
    case Cause::Kind::nogood:
      for (const Literal other : nogoods_.literals(cause.data)) {
        if (other != literal) result.push_back(negate(other));
      }
      return;
  }
  for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
    if (value != literal) result.push_back(negate(value));
  }
}

/// In the order of inference, which makes short proofs.
bool RelaxedTrail::propagate() {
  while (next_ < literals_.size()) {
    const Literal literal = literals_[next_++];
    ++effort_;
    if (!follow(literal) || !follow_nogoods(literal)) return false;
  }
  return true;
}

bool RelaxedTrail::follow(Literal literal) {
  const std::uint32_t variable = variable_of(literal);
  const TaskId task = task_of(variable);
  if (variable < task_count_) {
    return is_negated(literal) ? follow_not_running(task) : follow_running(task);
  }
  if (!is_negated(literal)) return follow_value(first_value_ + variable - task_count_);
  return count(task) > 1 || follow_remaining_values(task);
}

bool RelaxedTrail::follow_running(TaskId task) {
  const std::span<const std::uint32_t> exclusions = index_.exclusions[task - first_task_];
  effort_ += exclusions.size();
  for (const std::uint32_t index : exclusions) {
    const Reason& reason = constraints_[index];
    const TaskId rival = reason.task == task ? reason.other_task : reason.task;
    if (!imply(negate(runs(rival)), {Cause::Kind::literal, runs(task), index})) return false;
  }
  return count(task) > 1 || follow_remaining_values(task);
}

bool RelaxedTrail::follow_not_running(TaskId task) {
  Cause cause{Cause::Kind::literal, negate(runs(task))};
  for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
    if (!imply(negate(value), cause)) return false;
  }
  for (const std::uint32_t index : index_.required_by[task - first_task_]) {
    cause.reason = index;
    const auto values = catalog_.performs[constraints_[index].behavior];
    effort_ += values.size();
    for (const ValueId value : values) {
      if (!imply(negate(has_value(value)), cause)) return false;
    }
  }
  return true;
}

bool RelaxedTrail::follow_value(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  const Literal chosen = has_value(value);
  Cause cause{Cause::Kind::literal, chosen};
  if (!imply(runs(task), cause)) return false;
  for (Literal other = has_value(task, 0); other < has_value(task + 1, 0); other += 2) {
    if (other != chosen && !imply(negate(other), cause)) return false;
  }
  const BehaviorId behavior = catalog_.values.items[value].behavior;
  const std::span<const std::uint32_t> requirements =
      index_.requirements[behavior - first_behavior_];
  effort_ += requirements.size();
  for (const std::uint32_t index : requirements) {
    cause.reason = index;
    if (!imply(runs(constraints_[index].task), cause)) return false;
  }
  return true;
}

/// What follows from the one or no value that a task may still have.
bool RelaxedTrail::follow_remaining_values(TaskId task) {
  if (count(task) == 0) return imply(negate(runs(task)), {Cause::Kind::no_value});
  if (!is_true(runs(task))) return true;
  return imply(has_value(task, best(task)), {Cause::Kind::last_value});
}

bool RelaxedTrail::follow_nogoods(Literal literal) {
  return nogoods_.follow(
      literal,
      [this](Literal one) {
        ++effort_;
        return truth_[one];
      },
      [this](Literal implied, std::uint32_t nogood) {
        return imply(implied, {Cause::Kind::nogood, nogood, none, nogood_origins_[nogood]});
      });
}

}  // namespace cbc
