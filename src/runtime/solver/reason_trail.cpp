#include "runtime/solver/reason_trail.h"

#include <algorithm>

namespace cbc {

ReasonTrail::ReasonTrail(const CompiledCatalog& catalog, Domains& domains)
    : catalog_(catalog), domains_(domains) {
  const std::size_t variables =
      most_in_a_group(catalog.group_tasks) + most_values_in_a_group(catalog);
  truth_.resize(2 * variables);
  levels_.resize(variables);
  literal_places_.resize(variables);
  reasons_.resize(variables);
  literals_.reserve(variables);
  marks_.reserve(variables);
}

bool ReasonTrail::load(const Problem& problem) {
  first_task_ = domains_.first_task();
  task_count_ = domains_.task_count();
  first_value_ = catalog_.values.begin[first_task_];
  variable_count_ = task_count_ + catalog_.values.begin[first_task_ + task_count_] - first_value_;
  requests_ = problem.requests;
  nogoods_.clear(variable_count_);
  std::fill_n(truth_.begin(), 2 * variable_count_, std::int8_t{0});
  literals_.clear();
  next_ = 0;
  marks_.clear();
  stored_.clear();
  propagations_ = 0;
  ++version_;
  for (std::uint32_t task = 0; task < task_count_; ++task) {
    const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      if (!domains_.has(task, index)) set(negate(has_value(task, index)), {});
    }
    if (values == 0 && !imply(negate(runs(task)), {})) return false;
    if (problem.may_stop[task] == 0 && !imply(runs(task), {})) return false;
  }
  return propagate();
}

void ReasonTrail::decide(Literal literal) {
  marks_.push_back({literals_.size(), stored_.size(), domains_.mark()});
  set(literal, {});
}

bool ReasonTrail::imply(Literal literal, Reason reason) {
  if (is_true(literal)) return true;
  if (!is_false(literal)) {
    set(literal, reason);
    return true;
  }
  conflict_.clear();
  append_reason(literal, reason, conflict_);
  conflict_.push_back(negate(literal));
  return false;
}

/// A domain that becomes empty is found by the propagation of this literal.
void ReasonTrail::set(Literal literal, Reason reason) {
  const std::uint32_t variable = variable_of(literal);
  ++version_;
  truth_[literal] = 1;
  truth_[negate(literal)] = -1;
  levels_[variable] = level();
  reasons_[variable] = reason;
  literal_places_[variable] = static_cast<std::uint32_t>(literals_.size());
  literals_.push_back(literal);
  const std::uint32_t task = task_of(variable);
  if (variable < task_count_) {
    if (!is_negated(literal)) static_cast<void>(domains_.need(task));
  } else if (is_negated(literal)) {
    static_cast<void>(domains_.remove(task, variable - task_count_ - first_value(task)));
  }
}

ReasonTrail::Reason ReasonTrail::store(std::span<const Literal> reason) {
  const auto place = static_cast<std::uint32_t>(stored_.size());
  stored_.push_back(static_cast<Literal>(reason.size()));
  stored_.insert(stored_.end(), reason.begin(), reason.end());
  return {Reason::Kind::stored, place};
}

void ReasonTrail::set_conflict(std::span<const Literal> literals) {
  conflict_.assign(literals.begin(), literals.end());
}

bool ReasonTrail::learn(std::span<const Literal> clause, std::uint32_t levels) {
  if (clause.size() == 1) return imply(clause.front(), {});
  return imply(clause.front(), {Reason::Kind::nogood, nogoods_.add(clause, levels)});
}

void ReasonTrail::backtrack_to(std::uint32_t level) {
  if (level >= marks_.size()) return;
  ++version_;
  const LevelMark& mark = marks_[level];
  while (literals_.size() > mark.literals) {
    truth_[literals_.back()] = 0;
    truth_[negate(literals_.back())] = 0;
    literals_.pop_back();
  }
  stored_.resize(mark.stored);
  domains_.undo_to(mark.domains);
  next_ = literals_.size();
  marks_.resize(level);
}

void ReasonTrail::append_reason(Literal literal, const Reason& reason,
                                std::vector<Literal>& result) const {
  const std::uint32_t task = task_of(variable_of(literal));
  switch (reason.kind) {
    case Reason::Kind::given:
      return;
    case Reason::Kind::literal:
      result.push_back(reason.data);
      return;
    case Reason::Kind::nogood:
      for (const Literal other : nogoods_.literals(reason.data)) {
        if (other != literal) result.push_back(negate(other));
      }
      return;
    case Reason::Kind::last_value:
      result.push_back(runs(task));
      for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
        if (value != literal) result.push_back(negate(value));
      }
      return;
    case Reason::Kind::no_value:
      for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
        result.push_back(negate(value));
      }
      return;
    case Reason::Kind::requirement: {
      const Arc& arc = catalog_.arcs.items[reason.data];
      const std::uint32_t source = arc.source - first_task_;
      result.push_back(runs(source));
      append_removals(source, &catalog_.masks[arc.mask], result);
      return;
    }
    case Reason::Kind::lazy:
      lazy_reasons_->append_reason(literal, reason.data, result);
      return;
    case Reason::Kind::stored: {
      const auto first = stored_.begin() + reason.data + 1;
      result.insert(result.end(), first, first + stored_[reason.data]);
      return;
    }
  }
}

/// Appends that the task has none of its values apart from those of the mask.
void ReasonTrail::append_removals(std::uint32_t task, const std::uint64_t* kept,
                                  std::vector<Literal>& result) const {
  const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
  for (std::uint32_t index = 0; index < values; ++index) {
    if (((kept[index / 64] >> (index % 64)) & 1) == 0) {
      result.push_back(negate(has_value(task, index)));
    }
  }
}

bool ReasonTrail::propagate() {
  while (next_ < literals_.size()) {
    const Literal literal = literals_[next_++];
    ++propagations_;
    if (!follow_catalog(literal) || !follow_nogoods(literal)) return false;
  }
  // Changes are followed literal by literal.
  domains_.forget_changes();
  return true;
}

bool ReasonTrail::follow_catalog(Literal literal) {
  const std::uint32_t variable = variable_of(literal);
  const std::uint32_t task = task_of(variable);
  if (variable < task_count_) {
    return is_negated(literal) ? follow_not_running(task) : follow_running(task);
  }
  if (is_negated(literal)) return follow_removal(task);
  return follow_value(task, variable - task_count_ - first_value(task));
}

bool ReasonTrail::follow_running(std::uint32_t task) {
  const Reason reason{Reason::Kind::literal, runs(task)};
  for (const std::uint32_t clique : catalog_.task_cliques[first_task_ + task]) {
    for (const TaskId member : catalog_.cliques[clique]) {
      const std::uint32_t rival = member - first_task_;
      if (rival != task && !imply(negate(runs(rival)), reason)) return false;
    }
  }
  return follow_remaining_values(task);
}

bool ReasonTrail::follow_not_running(std::uint32_t task) {
  const Reason reason{Reason::Kind::literal, negate(runs(task))};
  for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
    if (!imply(negate(value), reason)) return false;
  }
  for (const std::uint32_t number : catalog_.incoming[first_task_ + task]) {
    const Arc& arc = catalog_.arcs.items[number];
    const std::uint32_t source = arc.source - first_task_;
    const std::uint64_t* const mask = &catalog_.masks[arc.mask];
    const auto values = static_cast<std::uint32_t>(domains_.values(source).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      if (((mask[index / 64] >> (index % 64)) & 1) != 0 &&
          !imply(negate(has_value(source, index)), reason)) {
        return false;
      }
    }
  }
  return true;
}

bool ReasonTrail::follow_value(std::uint32_t task, std::uint32_t index) {
  const Literal chosen = has_value(task, index);
  const Reason reason{Reason::Kind::literal, chosen};
  if (!imply(runs(task), reason)) return false;
  for (Literal value = has_value(task, 0); value < has_value(task + 1, 0); value += 2) {
    if (value != chosen && !imply(negate(value), reason)) return false;
  }
  const BehaviorId behavior = domains_.value(task, index).behavior;
  for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
    if (!imply(runs(requirement.task - first_task_), reason)) return false;
  }
  return true;
}

bool ReasonTrail::follow_removal(std::uint32_t task) {
  if (domains_.count(task) == 0) {
    return imply(negate(runs(task)), {Reason::Kind::no_value, 0});
  }
  return !is_true(runs(task)) || follow_remaining_values(task);
}

/// What follows from the values that a task that runs has left.
bool ReasonTrail::follow_remaining_values(std::uint32_t task) {
  if (domains_.count(task) == 0) {
    return imply(negate(runs(task)), {Reason::Kind::no_value, 0});
  }
  if (domains_.count(task) == 1) {
    return imply(has_value(task, domains_.best(task)), {Reason::Kind::last_value, 0});
  }
  const auto arcs = catalog_.arcs[first_task_ + task];
  for (const Arc& arc : arcs) {
    if (!domains_.all_within(task, &catalog_.masks[arc.mask])) continue;
    const auto number = static_cast<std::uint32_t>(&arc - catalog_.arcs.items.data());
    if (!imply(runs(arc.target - first_task_), {Reason::Kind::requirement, number})) return false;
  }
  return true;
}

bool ReasonTrail::follow_nogoods(Literal literal) {
  return nogoods_.follow(
      literal, [this](Literal one) { return truth_[one]; },
      [this](Literal implied, std::uint32_t nogood) {
        return imply(implied, {Reason::Kind::nogood, nogood});
      });
}

}  // namespace cbc
