#include "explore/controls/control_system.h"

#include <algorithm>

namespace cbc {

namespace {

/// Knows the environment.
class KnownEnvironment final : public SystemOracle {
 public:
  KnownEnvironment(const Diagrams& sets, const std::vector<std::uint8_t>& environment)
      : sets_(sets), environment_(environment) {}

  [[nodiscard]] bool is_in(Diagrams::Set set) override { return sets_.contains(set, environment_); }

 private:
  const Diagrams& sets_;
  const std::vector<std::uint8_t>& environment_;
};

}  // namespace

ControlSystem::ControlSystem(std::uint32_t bits, const std::vector<std::uint32_t>& kinds,
                             std::uint32_t most_faults, bool has_repairs)
    : sets_(bits, Diagrams::tail_for(static_cast<std::uint32_t>(kinds.size()), most_faults),
            most_faults),
      faults_(sets_, kinds, most_faults, has_repairs) {
  static_cast<void>(sets_.keep({}));
}

bool ControlSystem::has(const StateMove& move, const std::vector<std::uint8_t>& environment) {
  if (move.fault == none) {
    return sets_.contains(actions_[move.action].condition, environment) && may_have(move.action);
  }
  const bool is_faulty = environment[faults_.bit_of(move.fault)] != 0;
  if (move.move.kind == Move::Kind::repair) return is_faulty;
  const auto count = std::count(environment.end() - faults_.count(), environment.end(), 1);
  return !is_faulty && static_cast<std::uint32_t>(count) < faults_.most();
}

void ControlSystem::change(const StateMove& move, Diagrams::ValuesNumber values,
                           std::vector<std::uint8_t>& environment) const {
  if (move.fault != none) {
    environment[faults_.bit_of(move.fault)] = move.move.kind == Move::Kind::repair ? 0 : 1;
  } else if (const Action& action = actions_[move.action]; action.changes) {
    sets_.change(environment, action.values);
  }
  if (values != 0) sets_.change(environment, values);
}

ControlSystem::MoveResult ControlSystem::make(const StateMove& move,
                                              const std::vector<std::uint8_t>& environment) {
  if (move.fault != none) {
    return move.move.kind == Move::Kind::repair ? take_repair(faults_.kind_of(move.fault))
                                                : take_fault();
  }
  KnownEnvironment known(sets_, environment);
  return take(move.action, known);
}

void ControlSystem::for_each_kept(const std::function<void(Set)>& keep) const {
  for (const Action& action : actions_) keep(action.condition);
  faults_.for_each_kept(keep);
}

}  // namespace cbc
