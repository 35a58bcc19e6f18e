#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/control_stepper.h"
#include "explore/controls/control_system.h"
#include "explore/controls/environments.h"
#include "explore/controls/state_test.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"

namespace cbc {

/// The states of one catalog's model, and what moves do to them: what properties are about, and
/// where the goals of coverage are watched. The model must outlive it.
class CatalogSystem : public ControlSystem {
 public:
  /// A mark that is part of the states; see Property::after.
  struct Mark {
    StateCondition after;
    std::optional<StateCondition> until;
  };

  CatalogSystem(const Model& model, const Stepper::Options& options,
                const std::optional<Mark>& mark);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] Environments& environments() { return side_.environments(); }
  [[nodiscard]] const Environments& environments() const { return side_.environments(); }
  /// Has the loaded control.
  [[nodiscard]] const Stepper& stepper() const { return side_.stepper(); }
  [[nodiscard]] const Model::Choice& choice_of(std::uint32_t action) const {
    return tried_[action].choice;
  }
  /// The action that starts a task with a priority, of which `ranks` is Model::ranks_up_to(), or
  /// tries to. Before any control is loaded.
  [[nodiscard]] std::uint32_t find_start(std::uint32_t task, Model::Rank ranks);
  /// Whether a task runs with a control.
  [[nodiscard]] bool runs_in(const std::uint32_t* control, std::uint32_t task) const {
    return model_.cell_of(control, task) != 0;
  }
  /// The environments with the mark.
  [[nodiscard]] Set marked() const { return marked_; }
  /// A test of the condition, whose sets are kept.
  [[nodiscard]] StateTest make_test(const StateCondition& condition);

  [[nodiscard]] const std::vector<std::uint32_t>& first_control() const override { return first_; }
  [[nodiscard]] std::vector<std::uint8_t> first_environment() const override;
  void load(const std::uint32_t* control) override { side_.stepper().load(control); }
  [[nodiscard]] bool may_have(std::uint32_t action) const override {
    return side_.stepper().may_have(tried_[action].choice);
  }
  [[nodiscard]] MoveResult take(std::uint32_t action, SystemOracle& oracle) override;
  [[nodiscard]] MoveResult take_fault() override;
  [[nodiscard]] MoveResult take_repair(std::uint32_t group) override;
  [[nodiscard]] bool has_mark() const override { return mark_after_.has_value(); }
  [[nodiscard]] Set with_marks(Set set) override;
  [[nodiscard]] Set before_marks(Set set) override;
  void set_mark(std::vector<std::uint8_t>& environment) override;
  void for_each_kept(const std::function<void(Set)>& keep) const override;

 protected:
  /// Lets the stepper record its moves, and tell of their answers.
  void watch(MoveTrace& trace, AnswerListener& listener) {
    side_.stepper().set_trace(&trace);
    side_.stepper().set_listener(&listener);
  }

 private:
  /// What an action tries.
  struct Tried {
    Model::Choice choice;
    Environments::ActionEffect effect;
  };
  /// Where the mark is set, and where it is cleared, in states of the loaded control.
  struct MarkSets {
    Set to_set = Diagrams::empty;
    Set to_clear = Diagrams::empty;
  };

  CatalogSystem(const Model& model, const Stepper::Options& options,
                const std::optional<Mark>& mark, const EnvironmentBits& bits);

  void add_moves();
  void add_mark(const Mark& mark, std::uint32_t bit);
  [[nodiscard]] MarkSets find_marks();
  [[nodiscard]] MoveResult result_after();

  const Model& model_;
  ControlStepper side_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> packed_;  ///< after the move
  std::vector<Tried> tried_;           ///< by action
  std::vector<Set> kept_;
  std::optional<StateTest> mark_after_;  ///< nothing: there is no mark
  std::optional<StateTest> mark_until_;
  std::uint32_t mark_bit_ = none;
  Set marked_ = Diagrams::empty;
  Diagrams::ValuesNumber mark_set_ = 0;
  Diagrams::ValuesNumber mark_cleared_ = 0;
};

}  // namespace cbc
