#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "explore/controls/control_system.h"
#include "explore/controls/environments.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"

namespace cbc {

/// Makes moves of the controls of a model: all of a state but its environment. It joins a Stepper,
/// which asks about the environment after a move, with Environments, which know the sets before the
/// move that this depends on. A system has one for each catalog. The model and the diagrams must
/// outlive it. Not for use by several threads.
class ControlStepper {
 public:
  ControlStepper(const Model& model, const Stepper::Options& options, EnvironmentBits bits,
                 Diagrams& sets);

  [[nodiscard]] Environments& environments() { return environments_; }
  [[nodiscard]] const Environments& environments() const { return environments_; }
  /// Only what its state says of the control counts.
  [[nodiscard]] Stepper& stepper() { return stepper_; }
  [[nodiscard]] const Stepper& stepper() const { return stepper_; }

  /// Makes a move that has an effect from the control that the stepper has loaded.
  void take(const Model::Choice& choice, const Environments::ActionEffect& effect,
            SystemOracle& oracle);
  /// What repairs of a behavior do to the control.
  void take_repair(std::uint32_t behavior);

  /// What the move has made of X, besides what its effect is; 0: nothing.
  [[nodiscard]] Diagrams::ValuesNumber changes_of_x();

  /// Writes the control of the first state, and that after the move.
  void pack_first(std::uint32_t* packed) { pack(model_.first_state().data(), packed); }
  void pack_after(std::uint32_t* packed) { pack(stepper_.cells_after(), packed); }

 private:
  void pack(const std::uint16_t* cells, std::uint32_t* packed);

  const Model& model_;
  Environments environments_;
  Stepper stepper_;
  std::vector<std::uint16_t> cells_;
  std::map<std::vector<std::pair<std::uint32_t, bool>>, Diagrams::ValuesNumber> changes_;
};

}  // namespace cbc
