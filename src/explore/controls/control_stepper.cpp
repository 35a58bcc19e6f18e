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

/// For repairs, which ask only whether they are some.
class YesOracle final : public SystemOracle {
 public:
  [[nodiscard]] bool is_in(Diagrams::Set /*set*/) override { return true; }
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
  YesOracle yes;  // only the queue may change
  take(repair, {}, yes);
}

Diagrams::ValuesNumber ControlStepper::changes_of_x() {
  const auto& changes = stepper_.changes_of_x();
  if (changes.empty()) return 0;
  const auto [entry, is_new] = changes_.try_emplace(changes, 0);
  if (!is_new) return entry->second;
  Diagrams::Values values;
  for (const auto& [failed, is_in] : changes) {
    const std::uint32_t bit = environments_.bits().failed[failed];
    if (bit != none) values.bits.emplace_back(bit, is_in);
  }
  if (!values.bits.empty()) entry->second = environments_.sets().keep(std::move(values));
  return entry->second;
}

void ControlStepper::pack(const std::uint16_t* cells, std::uint32_t* packed) {
  cells_.assign(cells, cells + model_.layout().variables);
  cells_.resize(model_.layout().cells, 0);
  model_.pack(cells_.data(), packed);
}

}  // namespace cbc
