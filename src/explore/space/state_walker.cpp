#include "explore/space/state_walker.h"

namespace cbc {

StateWalker::StateWalker(StatePart& part) : part_(&part) {
  result_.control = part.controls().find(part.system().first_control().data());
  after_ = part.system().first_environment();
  go_on();
}

void StateWalker::go_on() {
  control_ = result_.control;
  environment_ = after_;
  load();
  part_->system().set_mark(environment_);
}

void StateWalker::go_to(Controls::Number control, const std::vector<std::uint8_t>& environment) {
  control_ = control;
  environment_ = environment;
  load();
}

std::optional<Controls::NumberedResult> StateWalker::try_move(std::size_t place) {
  ControlSystem& system = part_->system();
  const ControlSystem::StateMove& move = system.moves()[place];
  load();
  if (!system.has(move, environment_)) return std::nullopt;
  Controls& controls = part_->controls();
  if (move.fault == none) {
    result_ = controls.result_in(move.action, environment_);
  } else if (move.move.kind == Move::Kind::repair) {
    result_ = controls.after_repair(system.faults().kind_of(move.fault));
  } else {
    result_ = controls.after_fault();
  }
  if (!result_.exists) return std::nullopt;
  after_ = environment_;
  system.change(move, result_.values, after_);
  return result_;
}

}  // namespace cbc
