#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "verify/engine/environments.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

/// A condition on the states of a model.
class StateTest {
 public:
  using Set = Environments::Set;

  StateTest(const Model& model, Environments& environments, const StateCondition& condition);

  /// The environments in which it holds, with the control that the stepper has loaded.
  [[nodiscard]] Set holds_in(const Stepper& control) const;
  [[nodiscard]] Set in_environment() const { return in_environment_; }

 private:
  struct Part {
    std::uint32_t subject = 0;
    std::uint32_t wanted = 0;
  };
  struct Test {
    bool (*holds)(const Stepper& state, Part part);
    Part part;
  };

  void add(bool (*test)(const Stepper&, Part), std::uint32_t subject, std::uint32_t wanted = 0) {
    tests_.push_back({test, {subject, wanted}});
  }
  void add(Set environments) {
    in_environment_ = environments_.sets().both(in_environment_, environments);
  }
  void add_others(const Model& model, const std::vector<BehaviorId>& listed);

  Environments& environments_;
  std::vector<Test> tests_;  ///< of the control
  Set in_environment_ = Diagrams::all;
};

}  // namespace cbc
