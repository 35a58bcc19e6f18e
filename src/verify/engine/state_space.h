#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "verify/engine/breadth_first.h"
#include "verify/engine/controls.h"
#include "verify/engine/environments.h"
#include "verify/engine/model.h"
#include "verify/engine/state_test.h"

namespace cbc {

/// The reachable states of a model, by the least number of moves to them: for each number the
/// controls, and the environments in which each was new. One round is one move, so depths, counts
/// and shortest paths are those of single states (docs/verify.md, "Size"). Not for use by several
/// threads.
class StateSpace {
 public:
  using Set = Environments::Set;
  /// States of one control, in the environments of a set.
  struct States {
    Controls::Number control = 0;
    Set environments = Diagrams::empty;
  };
  using OnProgress = std::function<bool(const ExplorationProgress&)>;
  /// A mark that is part of the states; see Property::after.
  struct Mark {
    StateCondition after;
    std::optional<StateCondition> until;
  };

  StateSpace(const Model& model, const Stepper::Options& options, const ExplorationLimits& limits,
             OnProgress on_progress, const std::optional<Mark>& mark = {});

  [[nodiscard]] Environments& environments() { return environments_; }
  [[nodiscard]] Controls& controls() { return controls_; }

  /// Visits all states; once. The visitor has
  ///   visit(states, depth)   new states, whose control is loaded
  ///   on_refusal(action, states)   some of them, in which a start is rejected
  ///   on_outcome(action, states, outcome)   some of them, and what a move makes of their control
  ///   is_done()   all is known that is looked for, so the run may end
  template <typename Visitor>
  void run(Visitor& visitor);

  [[nodiscard]] bool is_complete() const { return is_complete_; }
  /// Whether the visitor ended it.
  [[nodiscard]] bool is_decided() const { return is_decided_; }
  [[nodiscard]] ExplorationEnd end() const { return end_; }
  [[nodiscard]] std::uint64_t states() const { return states_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  /// All states up to this depth were expanded.
  [[nodiscard]] std::uint32_t expanded_depth() const { return expanded_depth_; }
  [[nodiscard]] const std::vector<std::uint64_t>& states_at_depth() const {
    return states_at_depth_;
  }
  [[nodiscard]] std::uint64_t bytes() const;

  // After the run.

  /// Calls `take(states, depth)` for the new states of each depth, whose control is loaded, as long
  /// as it returns true for all states of a depth.
  template <typename Take>
  void for_each_layer(Take&& take);
  /// The moves of the first shortest path to one of these states, which are new at the depth.
  [[nodiscard]] std::vector<Move> path_to(const std::vector<States>& targets, std::uint32_t depth);
  /// Makes moves from the first state. The stepper has loaded the state after them then.
  void follow(const std::vector<Move>& moves, Stepper& stepper) const;
  /// By control, the environments of the states from which one that satisfies the goal can be
  /// reached by moves of some kinds (nothing: all), in so many moves (nothing: any number). Nothing
  /// if a limit ends it; then is_complete() is false.
  [[nodiscard]] std::optional<std::vector<Set>> can_reach(const StateTest& goal,
                                                          const std::optional<MoveKinds>& kinds,
                                                          std::optional<std::uint32_t> within);
  /// Keeps sets from being forgotten while run() goes on.
  void keep(const States& states) { kept_.push_back(states); }

 private:
  using Layer = std::vector<States>;

  [[nodiscard]] bool may_go_on() {
    constexpr std::uint32_t moves_between_looks = 64;
    return ++asked_ % moves_between_looks != 0 || look_at_limits();
  }
  [[nodiscard]] bool look_at_limits();
  [[nodiscard]] bool end_by(ExplorationEnd end) {
    end_ = end;
    return false;
  }
  /// The first state.
  void begin();
  /// All states up to a depth were visited, and no more are asked for.
  void end_with(std::uint32_t depth) {
    expanded_depth_ = depth;
    is_decided_ = true;
  }
  void add(Controls::Number control, Set environments);
  template <typename Visitor>
  bool make_moves(const States& states, Visitor& visitor);
  void add_faults(const States& states);
  [[nodiscard]] static Set environments_in(const Layer& layer, Controls::Number control);
  void end_layer();
  void collect();

  /// Where the mark is set, and where it is cleared, in states of the loaded control.
  struct MarkSets {
    Set to_set = Diagrams::empty;
    Set to_clear = Diagrams::empty;
  };
  [[nodiscard]] MarkSets find_marks(const Stepper& control);
  void find_predecessors();
  [[nodiscard]] std::vector<Controls::Number> sources_of(const Layer& layer);
  [[nodiscard]] Layer before_marks(const Layer& layer);
  [[nodiscard]] Set sources_in(const States& all, const Layer& wanted, const MoveKinds* kinds);
  [[nodiscard]] std::vector<Layer> paths_backward(const Layer& targets, std::uint32_t depth);

  const Model& model_;
  const ExplorationLimits limits_;
  const OnProgress on_progress_;
  Environments environments_;
  Controls controls_;
  std::optional<StateTest> mark_after_;  ///< nothing: there is no mark
  std::optional<StateTest> mark_until_;
  std::vector<Layer> layers_;
  std::vector<Set> visited_;               ///< by control
  std::vector<Set> next_;                  ///< by control: of the next layer
  std::vector<Controls::Number> touched_;  ///< controls with some
  std::vector<States> kept_;
  std::vector<Set> reaching_;  ///< by control: of can_reach()
  /// By control: those that have a move to it; found when it is first asked.
  std::vector<std::vector<Controls::Number>> predecessors_;
  bool is_complete_ = false;
  bool is_decided_ = false;
  ExplorationEnd end_ = ExplorationEnd::stopped;
  std::uint64_t states_ = 0;
  std::uint64_t transitions_ = 0;
  std::uint32_t expanded_depth_ = 0;
  std::vector<std::uint64_t> states_at_depth_;
  std::uint32_t asked_ = 0;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// False if a limit ends it.
template <typename Visitor>
bool StateSpace::make_moves(const States& states, Visitor& visitor) {
  Diagrams& sets = environments_.sets();
  for (std::uint32_t action = 0; action < controls_.actions().size(); ++action) {
    if (!controls_.may_have(action)) continue;
    const Controls::Action& made = controls_.actions()[action];
    const Set set = sets.both(states.environments, made.effect.condition);
    if (set == Diagrams::empty) continue;
    if (made.is_move) transitions_ += sets.count(set);
    const bool is_start = made.choice.move.kind == Move::Kind::start;
    controls_.for_each_outcome(action, set, [&](Controls::Outcome outcome, Set part) {
      const States from{states.control, part};
      if (is_start && !outcome.accepted) visitor.on_refusal(action, from);
      if (!made.is_move) return;
      visitor.on_outcome(action, from, outcome);
      const bool changes = made.effect.changes || outcome.control != states.control;
      if (changes) add(outcome.control, environments_.after(made.effect, part));
    });
    if (!may_go_on()) return false;
  }
  add_faults(states);
  return true;
}

template <typename Visitor>
void StateSpace::run(Visitor& visitor) {
  begin();
  for (std::uint32_t depth = 0; !layers_[depth].empty(); ++depth) {
    if (!look_at_limits()) return;
    // First the states alone: a limit may come before all moves of this depth are made.
    for (const States& states : layers_[depth]) {
      controls_.load(states.control);
      visitor.visit(states, depth);
    }
    if (visitor.is_done()) return end_with(depth);
    for (std::size_t place = 0; place < layers_[depth].size(); ++place) {
      const States states = layers_[depth][place];
      controls_.load(states.control);
      if (!make_moves(states, visitor)) return;
      if (environments_.sets().is_crowded()) collect();
    }
    expanded_depth_ = depth;
    if (visitor.is_done()) return end_with(depth);
    end_layer();
  }
  layers_.pop_back();
  is_complete_ = true;
}

template <typename Take>
void StateSpace::for_each_layer(Take&& take) {
  bool goes_on = true;
  for (std::uint32_t depth = 0; depth < layers_.size() && goes_on; ++depth) {
    for (const States& states : layers_[depth]) {
      controls_.load(states.control);
      goes_on = take(states, depth) && goes_on;
    }
  }
}

}  // namespace cbc
