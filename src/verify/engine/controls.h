#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "verify/engine/breadth_first.h"
#include "verify/engine/environments.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

/// The controls of a model: all of a state but its environment. And what moves make of them, in
/// which environments, as far as that was asked. Not for use by several threads.
class Controls {
 public:
  using Number = std::uint32_t;
  using Set = Environments::Set;

  /// What can be tried with a control: the moves but for faults, as Environments::effects() has
  /// them, and starts that are no moves.
  struct Action {
    Model::Choice choice;
    Environments::Effect effect;
    bool is_move = true;
  };
  struct Outcome {
    Number control = 0;
    bool accepted = false;  ///< of a start
  };

  Controls(const Model& model, Environments& environments, const Stepper::Options& options);

  [[nodiscard]] Number size() const { return store_.size(); }
  [[nodiscard]] const std::vector<Action>& actions() const { return actions_; }
  /// The action that starts a task with a priority, of which `ranks` is Model::ranks_up_to(), or
  /// tries to. Before any control is loaded.
  [[nodiscard]] std::uint32_t find_start(std::uint32_t task, Model::Rank ranks);

  /// The number of the control of a state.
  [[nodiscard]] Number find(const std::uint16_t* cells) { return find_packed(pack(cells)); }
  [[nodiscard]] Number find_packed(const std::uint32_t* packed) {
    return store_.insert(packed, store_.hash(packed), 0);
  }
  /// The same, but nothing if the control is new.
  [[nodiscard]] std::optional<Number> known(const std::uint32_t* packed) const {
    return store_.find(packed, store_.hash(packed));
  }
  /// The control of a state; valid until the next call.
  [[nodiscard]] const std::uint32_t* pack(const std::uint16_t* cells);
  [[nodiscard]] const std::uint32_t* packed(Number control) const { return store_.state(control); }
  /// The same for one control in all objects of this class.
  [[nodiscard]] std::uint64_t hash(const std::uint32_t* packed) const {
    return store_.hash(packed);
  }
  /// Takes up a control.
  void load(Number control);
  /// Of its state, what it says of the control counts.
  [[nodiscard]] const Stepper& stepper() const { return stepper_; }
  [[nodiscard]] bool may_have(std::uint32_t action) const {
    return stepper_.may_have_move(actions_[action].choice);
  }

  /// What an action makes of the loaded control in the environments of a set, in which it exists:
  /// calls `take` with each outcome and the part of the set where it is the one.
  template <typename Take>
  void for_each_outcome(std::uint32_t action, Set set, Take&& take) {
    walk(root_of(action), action, set, take);
  }
  /// Whether a task runs with a control.
  [[nodiscard]] bool runs_in(Number control, std::uint32_t task) const {
    return model_.cell_of(store_.state(control), task) != 0;
  }
  /// The controls that moves make of one, in some environment that was asked about.
  [[nodiscard]] std::vector<Number> successors_of(Number control) const;
  /// The loaded control after a repair of a behavior of the group.
  [[nodiscard]] Number after_repair(std::uint32_t group);

  /// How often an outcome was found; those that lead to the same control are several.
  [[nodiscard]] std::uint64_t regions() const { return regions_; }
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] const Stepper::Options& options() const { return options_; }

 private:
  /// A question, or an outcome; 0: it is not known yet.
  using Tree = std::uint32_t;
  struct Question {
    EnvironmentQuery query;
    Tree answers[2] = {0, 0};  ///< no, yes
  };
  /// Of a tree: that of an action, or the answer to a question.
  struct Place {
    std::size_t number = 0;  ///< of a root, of a question
    std::uint32_t answer = 0;
    bool is_root = false;
  };
  class Asked;

  static constexpr Tree is_outcome = Tree{1} << 31U;
  static constexpr Tree is_accepted = Tree{1} << 30U;

  [[nodiscard]] Place root_of(std::uint32_t action) const {
    return {static_cast<std::size_t>(loaded_) * actions_.size() + action, 0, true};
  }
  [[nodiscard]] Tree& at(const Place& place) {
    return place.is_root ? roots_[place.number] : questions_[place.number].answers[place.answer];
  }
  void explore(std::uint32_t action, Set set);

  template <typename Take>
  void walk(const Place& place, std::uint32_t action, Set set, Take& take) {
    if (at(place) == 0) explore(action, set);
    const Tree tree = at(place);
    if ((tree & is_outcome) != 0) {
      take(Outcome{tree & (is_accepted - 1), (tree & is_accepted) != 0}, set);
      return;
    }
    Diagrams& sets = environments_.sets();
    const Set asked = environments_.query(actions_[action].effect, questions_[tree].query);
    const Set yes = sets.both(set, asked);
    if (yes != Diagrams::empty) walk({tree, 1, false}, action, yes, take);
    if (yes == set) return;
    const Set no = yes == Diagrams::empty ? set : sets.without(set, asked);
    walk({tree, 0, false}, action, no, take);
  }

  const Model& model_;
  Environments& environments_;
  const Stepper::Options options_;
  std::vector<Action> actions_;
  Stepper stepper_;
  StateStore store_;
  Number loaded_ = UINT32_MAX;
  std::vector<Tree> roots_;  ///< by control and action
  std::vector<Question> questions_;
  std::uint64_t regions_ = 0;
  std::vector<std::uint16_t> cells_;
  std::vector<std::uint32_t> packed_;
  std::vector<std::uint8_t> string_;
};

}  // namespace cbc
