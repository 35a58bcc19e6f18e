#include "runtime/solver/trail.h"

namespace cbc {

void Nogoods::clear(std::size_t variables) {
  if (!nogoods_.empty()) {
    for (std::vector<Watch>& watches : watches_) watches.clear();
  }
  nogoods_.clear();
  literals_.clear();
  if (watches_.size() < 2 * variables) watches_.resize(2 * variables);
  increment_ = 1;
}

std::uint32_t Nogoods::add(std::span<const Literal> literals, std::uint32_t levels) {
  const auto number = static_cast<std::uint32_t>(nogoods_.size());
  nogoods_.push_back({static_cast<std::uint32_t>(literals_.size()),
                      static_cast<std::uint32_t>(literals.size()), levels, increment_});
  literals_.insert(literals_.end(), literals.begin(), literals.end());
  watch(number);
  return number;
}

void Nogoods::watch(std::uint32_t nogood) {
  const std::span<const Literal> clause = literals(nogood);
  watches_[clause[0]].push_back({nogood, clause[1]});
  watches_[clause[1]].push_back({nogood, clause[0]});
}

void Nogoods::note_use(std::uint32_t nogood) {
  constexpr double too_large = 1e100;
  nogoods_[nogood].activity += increment_;
  if (nogoods_[nogood].activity < too_large) return;
  for (Nogood& each : nogoods_) each.activity /= too_large;
  increment_ /= too_large;
}

void Nogoods::forget_half() {
  constexpr std::uint32_t levels_to_keep = 2;
  std::size_t to_forget = nogoods_.size() / 2;
  if (to_forget == 0) return;
  activities_.clear();
  for (const Nogood& nogood : nogoods_) activities_.push_back(nogood.activity);
  const auto last = activities_.begin() + static_cast<std::ptrdiff_t>(to_forget - 1);
  std::nth_element(activities_.begin(), last, activities_.end());
  const double limit = *last;

  for (std::vector<Watch>& watches : watches_) watches.clear();
  std::uint32_t kept = 0;
  std::uint32_t end = 0;
  for (const Nogood nogood : std::span<const Nogood>(nogoods_)) {
    if (to_forget > 0 && nogood.activity <= limit && nogood.levels > levels_to_keep) {
      --to_forget;
      continue;
    }
    const auto first = literals_.begin() + nogood.begin;
    std::copy(first, first + nogood.size, literals_.begin() + end);
    nogoods_[kept] = nogood;
    nogoods_[kept].begin = end;
    end += nogood.size;
    ++kept;
  }
  nogoods_.resize(kept);
  literals_.resize(end);
  for (std::uint32_t nogood = 0; nogood < kept; ++nogood) watch(nogood);
}

Trail::Trail(const CompiledCatalog& catalog, Domains& domains)
    : catalog_(catalog), domains_(domains) {
  const std::size_t variables = domains.most_variables();
  truth_.resize(2 * variables);
  levels_.resize(variables);
  places_.resize(variables);
  causes_.resize(variables);
  literals_.reserve(variables);
  marks_.reserve(variables);
}

void Trail::clear() {
  first_task_ = domains_.first_task();
  task_count_ = domains_.task_count();
  first_value_ = ValueId(catalog_.values.begin[first_task_]);
  variable_count_ = task_count_ + catalog_.values.begin[first_task_ + task_count_] - first_value_;
  nogoods_.clear(variable_count_);
  std::fill_n(truth_.begin(), 2 * variable_count_, std::int8_t{0});
  literals_.clear();
  next_ = 0;
  marks_.clear();
  stored_.clear();
  ++version_;
}

void Trail::decide(Literal literal) {
  marks_.push_back({literals_.size(), stored_.size(), domains_.mark()});
  set(literal, {});
}

bool Trail::imply(Literal literal, Cause cause) {
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

/// Infers that the task does not have any value, apart from `but`.
bool Trail::imply_all_removed(LocalTask task, Literal but, Cause cause) {
  for (Literal value = has_value(task, 0); value < has_value(LocalTask(task + 1), 0); value += 2) {
    if (value != but && !imply(negate(value), cause)) return false;
  }
  return true;
}

/// A domain that becomes empty is found by the propagation of this literal.
void Trail::set(Literal literal, Cause cause) {
  const std::uint32_t variable = variable_of(literal);
  ++version_;
  truth_[literal] = 1;
  truth_[negate(literal)] = -1;
  levels_[variable] = level();
  causes_[variable] = cause;
  places_[variable] = static_cast<std::uint32_t>(literals_.size());
  literals_.push_back(literal);
  const LocalTask task = task_of(variable);
  if (variable < task_count_) {
    if (!is_negated(literal)) static_cast<void>(domains_.need(task));
  } else if (is_negated(literal)) {
    static_cast<void>(domains_.remove(task, variable - variable_of(has_value(task, 0))));
  }
}

Trail::Cause Trail::store(std::span<const Literal> reason) {
  const auto place = static_cast<std::uint32_t>(stored_.size());
  stored_.push_back(static_cast<Literal>(reason.size()));
  stored_.insert(stored_.end(), reason.begin(), reason.end());
  return {Cause::Kind::stored, place};
}

void Trail::set_conflict(std::span<const Literal> literals, Cause cause) {
  conflict_.assign(literals.begin(), literals.end());
  conflict_cause_ = cause;
}

bool Trail::close_limited(std::uint32_t limit, std::uint32_t constraint) {
  const auto members = catalog_.limited[limit];
  const std::uint32_t most = catalog_.limits[limit].most;
  running_.clear();
  for (const TaskId member : members) {
    const Literal literal = runs(member - first_task_);
    if (running_.size() < most && is_true(literal)) running_.push_back(literal);
  }
  if (running_.size() < most) return true;
  Cause cause = store(running_);
  cause.constraint = constraint;
  return std::all_of(members.begin(), members.end(), [&](TaskId member) {
    const Literal literal = runs(member - first_task_);
    const bool is_in_reason =
        std::find(running_.begin(), running_.end(), literal) != running_.end();
    return is_in_reason || imply(negate(literal), cause);
  });
}

bool Trail::learn(std::span<const Literal> clause, std::uint32_t levels) {
  if (clause.size() == 1) return imply(clause.front(), {});
  return imply(clause.front(), {Cause::Kind::nogood, nogoods_.add(clause, levels)});
}

void Trail::backtrack_to(std::uint32_t level) {
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

void Trail::append_reason(Literal literal, const Cause& cause, std::vector<Literal>& result) const {
  const LocalTask task = task_of(variable_of(literal));
  const auto is_other = [&](std::uint32_t index) { return has_value(task, index) != literal; };
  switch (cause.kind) {
    case Cause::Kind::given:
    case Cause::Kind::learned:
      return;
    case Cause::Kind::literal:
      result.push_back(cause.data);
      return;
    case Cause::Kind::nogood:
      for (const Literal other : nogoods_.literals(cause.data)) {
        if (other != literal) result.push_back(negate(other));
      }
      return;
    case Cause::Kind::last_value:
      result.push_back(runs(task));
      [[fallthrough]];
    case Cause::Kind::no_value:
      append_removals(task, is_other, result);
      return;
    case Cause::Kind::requirement: {
      const Arc& arc = catalog_.arcs.items[cause.data];
      const LocalTask source = arc.source - first_task_;
      result.push_back(runs(source));
      const std::uint64_t* const kept = &catalog_.masks[arc.mask];
      append_removals(
          source, [kept](std::uint32_t index) { return !has_bit(kept, index); }, result);
      return;
    }
    case Cause::Kind::lazy:
      lazy_reasons_->append_reason(literal, cause.data, result);
      return;
    case Cause::Kind::stored: {
      const auto first = stored_.begin() + cause.data + 1;
      result.insert(result.end(), first, first + stored_[cause.data]);
      return;
    }
  }
}

/// In the order of inference, which makes short proofs.
bool Trail::propagate() {
  while (next_ < literals_.size()) {
    const Literal literal = literals_[next_++];
    ++propagations_;
    if (!follow(literal)) return false;
    const bool is_consistent =
        nogoods_.follow(literal, truth_, [this](Literal implied, std::uint32_t nogood) {
          return imply(implied, {Cause::Kind::nogood, nogood});
        });
    if (!is_consistent) return false;
  }
  // Changes are followed literal by literal.
  domains_.forget_changes();
  return true;
}

bool Trail::follow(Literal literal) {
  const std::uint32_t variable = variable_of(literal);
  const LocalTask task = task_of(variable);
  if (variable >= task_count_) {
    if (is_negated(literal)) return follow_remaining_values(task);
    const Cause cause{Cause::Kind::literal, literal};
    return imply(runs(task), cause) && imply_all_removed(task, literal, cause) &&
           follow_value(task, value_of(variable));
  }
  if (is_negated(literal)) {
    return imply_all_removed(task, none, {Cause::Kind::literal, literal}) &&
           follow_not_running(task);
  }
  return follow_running(task) && follow_remaining_values(task);
}

bool Trail::follow_remaining_values(LocalTask task) {
  if (domains_.count(task) == 0) return imply(negate(runs(task)), {Cause::Kind::no_value});
  if (!is_true(runs(task))) return true;
  if (domains_.count(task) > 1) return follow_choice(task);
  return imply(has_value(task, domains_.best(task)), {Cause::Kind::last_value});
}

}  // namespace cbc
