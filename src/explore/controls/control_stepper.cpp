#include "explore/controls/control_stepper.h"

#include <utility>

namespace cbc {

namespace {

/// Asks for sets of environments before the move.
class EffectOracle final : public EnvironmentOracle {
 public:
  EffectOracle(Environments& environments, const Environments::ActionEffect& effect,
               SystemOracle& oracle)
      : environments_(environments), effect_(effect), oracle_(oracle) {}

  [[nodiscard]] bool holds(EnvironmentQuery query) override {
    return oracle_.is_in(environments_.query(effect_, query));
  }

 private:
  Environments& environments_;
  const Environments::ActionEffect& effect_;
  SystemOracle& oracle_;
};

/// For moves that ask nothing.
class NoOracle final : public SystemOracle {
 public:
  [[nodiscard]] bool is_in(Diagrams::Set /*set*/) override { return false; }
};

}  // namespace

ControlStepper::ControlStepper(const Model& model, const Stepper::Options& options,
                               EnvironmentBits bits, Diagrams& sets)
    : model_(model), environments_(model, std::move(bits), sets), stepper_(model, options) {}

void ControlStepper::take(const Model::Choice& choice, const Environments::ActionEffect& effect,
                          SystemOracle& oracle) {
  EffectOracle asked(environments_, effect, oracle);
  stepper_.take(choice, environments_.possible_after(effect), asked);
}

void ControlStepper::take_repair(std::uint32_t behavior) {
  Model::Choice repair;
  repair.move.kind = Move::Kind::repair;
  repair.subject = behavior;
  NoOracle nothing;  // only the queue may change
  take(repair, {}, nothing);
}

void ControlStepper::pack(const std::uint16_t* cells, std::uint32_t* packed) {
  cells_.assign(cells, cells + model_.layout().variables);
  cells_.resize(model_.layout().cells, 0);
  model_.pack(cells_.data(), packed);
}

}  // namespace cbc
