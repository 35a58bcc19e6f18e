#include "explore/controls/catalog_system.h"

namespace cbc {

namespace {

/// By fault: its group. Repairs of a group put the same reactive tasks into the queue.
std::vector<std::uint32_t> groups_of_faults(const Model& model) {
  std::vector<std::uint32_t> groups(model.layout().faulty_count);
  for (const Model::Behavior& behavior : model.behaviors()) {
    if (behavior.fault != none) groups[behavior.fault] = behavior.group;
  }
  return groups;
}

}  // namespace

CatalogSystem::CatalogSystem(const Model& model, const Stepper::Options& options,
                             const std::optional<Mark>& mark)
    : CatalogSystem(model, options, mark, bits_of(model, mark.has_value())) {}

CatalogSystem::CatalogSystem(const Model& model, const Stepper::Options& options,
                             const std::optional<Mark>& mark, const EnvironmentBits& bits)
    : ControlSystem(bits.count, groups_of_faults(model), model.assumptions().faults,
                    !model.has_repairs_that_decide()),
      model_(model),
      side_(model, options, bits, sets_),
      first_(model.packed_words()),
      packed_(model.packed_words()) {
  side_.pack_first(first_.data());
  add_moves();
  if (mark) add_mark(*mark, bits.mark);
}

void CatalogSystem::add_moves() {
  for (const Model::Choice& choice : model_.moves()) {
    const Move::Kind kind = choice.move.kind;
    const bool is_of_all_faults =
        kind == Move::Kind::fault || (kind == Move::Kind::repair && faults_.has_repairs());
    if (is_of_all_faults) {
      moves_.push_back({choice.move, none, model_.behaviors()[choice.subject].fault});
      continue;
    }
    for (const Environments::ActionEffect& effect : environments().effects_of(choice)) {
      const Set condition = sets_.without(effect.condition, effect.excluded);
      if (condition == Diagrams::empty) continue;
      moves_.push_back({effect.move, static_cast<std::uint32_t>(actions_.size()), none});
      actions_.push_back({condition, effect.changes, effect.values, kind == Move::Kind::start});
      tried_.push_back({choice, effect});
    }
  }
}

std::uint32_t CatalogSystem::find_start(std::uint32_t task, Model::Rank ranks) {
  for (std::uint32_t action = 0; action < tried_.size(); ++action) {
    const Model::Choice& choice = tried_[action].choice;
    if (choice.move.kind == Move::Kind::start && choice.subject == task &&
        choice.choice + 1 == ranks) {
      return action;
    }
  }
  Model::Choice trial;
  trial.move.kind = Move::Kind::start;
  trial.subject = task;
  trial.choice = ranks - 1U;
  tried_.push_back({trial, {}});
  Action& added = actions_.emplace_back();
  added.is_start = true;
  added.is_move = false;
  return static_cast<std::uint32_t>(actions_.size() - 1);
}

StateTest CatalogSystem::make_test(const StateCondition& condition) {
  StateTest test(model_, condition, environments());
  test.for_each_kept([this](Set set) { kept_.push_back(set); });
  return test;
}

std::vector<std::uint8_t> CatalogSystem::first_environment() const {
  std::vector<std::uint8_t> environment(sets_.bits(), 0);
  side_.environments().write_first(environment);
  return environment;
}

// Moves.

ControlSystem::MoveResult CatalogSystem::take(std::uint32_t action, SystemOracle& oracle) {
  const Tried& tried = tried_[action];
  side_.take(tried.choice, tried.effect, oracle);
  // A start that is no move may lead to what no state is.
  MoveResult result = actions_[action].is_move ? result_after() : MoveResult();
  result.accepted = stepper().was_accepted();
  if (!actions_[action].is_move) return result;
  const auto most = model_.assumptions().most_suspended;
  if (most && stepper().suspended_after() > *most) {
    result.control = nullptr;
    result.exists = false;
  }
  return result;
}

ControlSystem::MoveResult CatalogSystem::take_fault() {
  side_.stepper().stay();
  return result_after();
}

ControlSystem::MoveResult CatalogSystem::take_repair(std::uint32_t group) {
  side_.take_repair(model_.groups()[group].behaviors.begin);
  return result_after();
}

ControlSystem::MoveResult CatalogSystem::result_after() {
  side_.pack_after(packed_.data());
  MoveResult result;
  result.control = packed_.data();
  result.values = side_.changes_of_x();
  return result;
}

// The mark.

void CatalogSystem::add_mark(const Mark& mark, std::uint32_t bit) {
  mark_bit_ = bit;
  marked_ = sets_.with(bit, true);
  mark_set_ = sets_.keep({{{bit, true}}});
  mark_cleared_ = sets_.keep({{{bit, false}}});
  mark_after_.emplace(make_test(mark.after));
  if (mark.until) mark_until_.emplace(make_test(*mark.until));
}

CatalogSystem::MarkSets CatalogSystem::find_marks() {
  MarkSets marks;
  if (mark_until_) marks.to_clear = mark_until_->holds_in(stepper(), sets_);
  marks.to_set = sets_.without(mark_after_->holds_in(stepper(), sets_), marks.to_clear);
  return marks;
}

ControlSystem::Set CatalogSystem::with_marks(Set set) {
  if (!mark_after_) return set;
  const MarkSets marks = find_marks();
  const Set kept = sets_.without(sets_.without(set, marks.to_set), marks.to_clear);
  const Set newly = sets_.changed(sets_.both(set, marks.to_set), mark_set_);
  const Set cleared = sets_.changed(sets_.both(set, marks.to_clear), mark_cleared_);
  return sets_.either(kept, sets_.either(newly, cleared));
}

ControlSystem::Set CatalogSystem::before_marks(Set set) {
  if (!mark_after_) return set;
  const MarkSets marks = find_marks();
  const Set kept = sets_.without(sets_.without(set, marks.to_set), marks.to_clear);
  const Set newly = sets_.both(sets_.before_change(set, mark_set_), marks.to_set);
  const Set cleared = sets_.both(sets_.before_change(set, mark_cleared_), marks.to_clear);
  return sets_.either(kept, sets_.either(newly, cleared));
}

void CatalogSystem::set_mark(std::vector<std::uint8_t>& environment) {
  if (!mark_after_) return;
  const MarkSets marks = find_marks();
  if (sets_.contains(marks.to_set, environment)) environment[mark_bit_] = 1;
  if (sets_.contains(marks.to_clear, environment)) environment[mark_bit_] = 0;
}

void CatalogSystem::for_each_kept(const std::function<void(Set)>& keep) const {
  ControlSystem::for_each_kept(keep);
  side_.environments().for_each_kept(keep);
  for (const Set set : kept_) keep(set);
  keep(marked_);
}

}  // namespace cbc
