#include "versions/lockstep/pair_system.h"

#include <algorithm>

namespace cbc {

PairSystem::Side::Side(const Model& model, const Stepper::Options& options,
                       const EnvironmentBits& bits, Diagrams& sets)
    : controls(model, options, bits, sets) {}

void PairSystem::Side::take(const Model::Choice* choice, const Environments::ActionEffect& effect,
                            SystemOracle& oracle) {
  if (choice != nullptr) {
    controls.take(*choice, effect, oracle);
  } else {
    controls.stepper().stay();
  }
}

PairSystem::PairSystem(const ModelPair& models, const PairedBits& bits,
                       const ComparisonScope& scope, const Stepper::Options& options)
    : ControlSystem(bits.of_new.count, bits.kinds, models.new_model.assumptions().faults,
                    !models.new_model.has_repairs_that_decide() &&
                        !models.old_model.has_repairs_that_decide()),
      models_(models),
      bits_(bits),
      new_(models.new_model, options, bits.of_new, sets_),
      old_(models.old_model, options, bits.of_old, sets_),
      answers_(models, scope.differences, scope.allow_missing),
      first_(models.new_model.packed_words() + models.old_model.packed_words()),
      packed_(first_.size()) {
  new_.controls.stepper().set_trace(&new_.trace);
  old_.controls.stepper().set_trace(&old_.trace);
  new_.controls.pack_first(first_.data());
  old_.controls.pack_first(first_.data() + models.new_model.packed_words());
  add_moves();
}

void PairSystem::add_moves() {
  for (const ModelPair::PairedMove& move : models_.moves) {
    const bool is_of_all_faults = move.move.kind == Move::Kind::fault ||
                                  (move.move.kind == Move::Kind::repair && faults_.has_repairs());
    if (!is_of_all_faults) {
      add_actions(move);
      continue;
    }
    const std::uint32_t fault = models_.new_model.behaviors()[move.of_new->subject].fault;
    moves_.push_back({move.move, none, bits_.of_new.fault[fault] - faults_.bit_of(0)});
  }
}

void PairSystem::add_actions(const ModelPair::PairedMove& move) {
  using Effects = std::vector<Environments::ActionEffect>;
  Effects of_new;
  Effects of_old;
  if (move.of_new != nullptr) of_new = new_.controls.environments().effects_of(*move.of_new);
  if (move.of_old != nullptr) of_old = old_.controls.environments().effects_of(*move.of_old);
  // One that only one side has does nothing to the environment, but for repairs.
  if (of_new.empty()) of_new.resize(of_old.size());
  if (of_old.empty()) of_old.resize(of_new.size());
  if (move.move.kind == Move::Kind::repair) {
    if (move.of_new == nullptr) of_new.front().condition = Diagrams::empty;
    if (move.of_old == nullptr) of_old.front().condition = Diagrams::empty;
  }
  for (std::size_t place = 0; place < of_new.size(); ++place) {
    const Environments::ActionEffect& new_effect = of_new[place];
    const Environments::ActionEffect& old_effect = of_old[place];
    // It exists if either side has it, and neither comes to where `never` excludes.
    const Set condition = sets_.without(sets_.either(new_effect.condition, old_effect.condition),
                                        sets_.either(new_effect.excluded, old_effect.excluded));
    if (condition == Diagrams::empty) continue;
    moves_.push_back({move.of_new != nullptr ? new_effect.move : old_effect.move,
                      static_cast<std::uint32_t>(actions_.size()), none});
    Action& action = actions_.emplace_back();
    action.condition = condition;
    action.changes = new_effect.changes || old_effect.changes;
    action.values = new_effect.values;
    if (move.move.kind == Move::Kind::repair) {
      action.values = both_values(new_effect.values, old_effect.values);
    }
    paired_.push_back({move.of_new, move.of_old, new_effect, old_effect});
  }
}

std::vector<std::uint8_t> PairSystem::first_environment() const {
  std::vector<std::uint8_t> environment(sets_.bits(), 0);
  new_.controls.environments().write_first(environment);
  return environment;
}

void PairSystem::load(const std::uint32_t* control) {
  new_.controls.stepper().load(control);
  old_.controls.stepper().load(control + models_.new_model.packed_words());
}

bool PairSystem::may_have(std::uint32_t action) const {
  const auto has = [](const Side& side, const Model::Choice* choice) {
    return choice != nullptr && side.controls.stepper().may_have(*choice);
  };
  const PairedAction& paired = paired_[action];
  return has(new_, paired.of_new) || has(old_, paired.of_old);
}

// Moves.

ControlSystem::MoveResult PairSystem::take(std::uint32_t action, SystemOracle& oracle) {
  const PairedAction& paired = paired_[action];
  new_.take(paired.of_new, paired.new_effect, oracle);
  old_.take(paired.of_old, paired.old_effect, oracle);
  return compare();
}

ControlSystem::MoveResult PairSystem::take_fault() {
  new_.controls.stepper().stay();
  old_.controls.stepper().stay();
  return compare();
}

ControlSystem::MoveResult PairSystem::take_repair(std::uint32_t kind) {
  new_.controls.take_repair(bits_.repaired[kind].first);
  old_.controls.take_repair(bits_.repaired[kind].second);
  return compare();
}

ControlSystem::MoveResult PairSystem::compare() {
  answers_.compare(new_.trace, old_.trace, new_.controls.stepper().cells_after(),
                   old_.controls.stepper().cells_after());
  new_.trace.events.clear();
  old_.trace.events.clear();
  is_compared_ = is_compared_ || answers_.is_compared();
  MoveResult result;
  if (has_too_many_suspended()) {
    result.exists = false;
    return result;
  }
  result.note = note_of(answers_.notes());
  if (!answers_.is_alike()) return result;
  result.values = both_values(new_.controls.changes_of_x(), old_.controls.changes_of_x());
  new_.controls.pack_after(packed_.data());
  old_.controls.pack_after(packed_.data() + models_.new_model.packed_words());
  result.control = packed_.data();
  return result;
}

Diagrams::ValuesNumber PairSystem::both_values(Diagrams::ValuesNumber a, Diagrams::ValuesNumber b) {
  if (a == 0 || b == 0) return std::max(a, b);
  const auto [entry, is_new] = both_values_.try_emplace({a, b}, 0);
  if (is_new) entry->second = sets_.keep_both(a, b);
  return entry->second;
}

bool PairSystem::has_too_many_suspended() const {
  const auto has = [](const Model& model, const Side& side) {
    const auto most = model.assumptions().most_suspended;
    return most && side.controls.stepper().suspended_after() > *most;
  };
  return has(models_.new_model, new_) || has(models_.old_model, old_);
}

std::uint32_t PairSystem::note_of(const std::vector<AnswerComparison::Note>& notes) {
  if (notes.empty()) return 0;
  std::vector<std::uint32_t> tasks;
  tasks.reserve(notes.size());
  for (const AnswerComparison::Note& note : notes) tasks.push_back(note.task);
  std::sort(tasks.begin(), tasks.end());
  tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
  const auto number = static_cast<std::uint32_t>(tasks_of_notes_.size());
  const auto [entry, is_new] = notes_.try_emplace(tasks, number);
  if (is_new) tasks_of_notes_.push_back(std::move(tasks));
  return entry->second;
}

void PairSystem::describe(const StateMove& move, const std::vector<std::uint8_t>& environment) {
  answers_.set_with_lines(true);
  static_cast<void>(make(move, environment));
  answers_.set_with_lines(false);
}

void PairSystem::for_each_kept(const std::function<void(Set)>& keep) const {
  ControlSystem::for_each_kept(keep);
  new_.controls.environments().for_each_kept(keep);
  old_.controls.environments().for_each_kept(keep);
}

}  // namespace cbc
