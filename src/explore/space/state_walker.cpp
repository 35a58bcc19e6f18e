#include "explore/space/state_walker.h"

#include <algorithm>

namespace cbc {

StateWalker::StateWalker(StatePart& part) : part_(&part) {
  outcome_.control = part.controls().find(part.system().first_control().data());
  after_ = part.system().first_environment();
  go_on();
}

void StateWalker::go_on() {
  control_ = outcome_.control;
  environment_ = after_;
  load();
  part_->system().set_mark(environment_);
}

std::optional<Controls::Outcome> StateWalker::try_move(std::size_t place) {
  const ControlSystem::StateMove& move = part_->system().moves()[place];
  load();
  after_ = environment_;
  const bool has_move = move.fault != none ? try_fault(move) : try_action(move.action);
  return has_move ? std::optional(outcome_) : std::nullopt;
}

bool StateWalker::try_fault(const ControlSystem::StateMove& move) {
  const FaultSets& faults = part_->system().faults();
  const bool is_repair = move.move.kind == Move::Kind::repair;
  std::uint8_t& is_faulty = after_[faults.bit_of(move.fault)];
  if ((is_faulty != 0) != is_repair) return false;
  const auto count = std::count(environment_.end() - faults.count(), environment_.end(), 1);
  if (!is_repair && static_cast<std::uint32_t>(count) >= faults.most()) return false;
  is_faulty = is_repair ? 0 : 1;
  Controls& controls = part_->controls();
  outcome_ = is_repair ? controls.after_repair(faults.kind_of(move.fault)) : controls.after_fault();
  return true;
}

bool StateWalker::try_action(std::uint32_t action) {
  ControlSystem& system = part_->system();
  const ControlSystem::Action& made = system.actions()[action];
  if (!system.sets().contains(made.condition, environment_) || !system.may_have(action)) {
    return false;
  }
  if (made.changes) system.sets().change(after_, made.values);
  outcome_ = part_->controls().outcome_in(action, environment_);
  return true;
}

}  // namespace cbc
