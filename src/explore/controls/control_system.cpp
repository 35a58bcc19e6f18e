#include "explore/controls/control_system.h"

namespace cbc {

ControlSystem::ControlSystem(std::uint32_t bits, const std::vector<std::uint32_t>& kinds,
                             std::uint32_t most_faults)
    : sets_(bits, Diagrams::tail_for(static_cast<std::uint32_t>(kinds.size()), most_faults),
            most_faults),
      faults_(sets_, kinds, most_faults) {}

void ControlSystem::for_each_kept(const std::function<void(Set)>& keep) const {
  for (const Action& action : actions_) keep(action.condition);
  faults_.for_each_kept(keep);
}

}  // namespace cbc
