#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/environments.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"
#include "explore/sets/diagrams.h"

namespace cbc {

/// A condition on the states of a model. It is asked once for all states of a control, and answers
/// in which environments it holds.
class StateTest {
 public:
  using Set = Environments::Set;

  /// The condition is about tasks, behaviors and variables of the model only.
  StateTest(const Model& model, const StateCondition& condition, Environments& environments);

  /// Calls `keep` with each set that must survive Diagrams::collect().
  template <typename Keep>
  void for_each_kept(Keep&& keep) const {
    keep(in_environment_);
    for (const StateTest& part : negated_) part.for_each_kept(keep);
    for (const std::vector<StateTest>& alternatives : any_) {
      for (const StateTest& part : alternatives) part.for_each_kept(keep);
    }
  }

  /// The environments in which it holds, with the control that the stepper has loaded; among them
  /// may be some that no state has. The set is not kept.
  [[nodiscard]] Set holds_in(const Stepper& control, Diagrams& sets) const;

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
  void add(const Model& model, const StateCondition& condition, Environments& environments);
  void add_running(const Model& model, const StateCondition& running);
  void add_others(const Model& model, const StateCondition& only_active);
  void demand(Set set, Diagrams& sets) { in_environment_ = sets.both(in_environment_, set); }

  std::vector<Test> tests_;                         ///< of the control: all of them hold
  std::vector<std::vector<std::uint32_t>> values_;  ///< of the control: it has one of each list
  Set in_environment_ = Diagrams::all;              ///< parts of the environment
  std::vector<StateTest> negated_;
  std::vector<std::vector<StateTest>> any_;  ///< one of each list holds
};

}  // namespace cbc
