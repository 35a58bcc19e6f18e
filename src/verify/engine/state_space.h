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

  StateSpace(const Model& model, const Stepper::Options& options, const ExplorationLimits& limits,
             OnProgress on_progress);

  [[nodiscard]] Environments& environments() { return environments_; }
  [[nodiscard]] Controls& controls() { return controls_; }

  /// Visits all states. The visitor has
  ///   visit(states, depth)   new states, whose control is loaded
  ///   on_refusal(action, states)   some of them, in which a start is rejected
  template <typename Visitor>
  void run(Visitor& visitor);

  [[nodiscard]] bool is_complete() const { return is_complete_; }
  [[nodiscard]] ExplorationEnd end() const { return end_; }
  [[nodiscard]] std::uint64_t states() const { return states_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  /// All states up to this depth were expanded.
  [[nodiscard]] std::uint32_t expanded_depth() const { return expanded_depth_; }
  [[nodiscard]] const std::vector<std::uint64_t>& states_at_depth() const {
    return states_at_depth_;
  }
  [[nodiscard]] std::uint64_t bytes() const;

  /// The moves of the first shortest path to one of these states, which are new at the depth.
  [[nodiscard]] std::vector<Move> path_to(const std::vector<States>& targets, std::uint32_t depth);
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
  void add(Controls::Number control, Set environments);
  template <typename OnRefusal>
  bool make_moves(const States& states, OnRefusal&& on_refusal);
  void add_faults(const States& states);
  [[nodiscard]] static Set environments_in(const Layer& layer, Controls::Number control);
  void end_layer();
  void collect();
  void find_predecessors();
  [[nodiscard]] std::vector<Layer> paths_backward(const Layer& targets, std::uint32_t depth);

  const Model& model_;
  const ExplorationLimits limits_;
  const OnProgress on_progress_;
  Environments environments_;
  Controls controls_;
  std::vector<Layer> layers_;
  std::vector<Set> visited_;               ///< by control
  std::vector<Set> next_;                  ///< by control: of the next layer
  std::vector<Controls::Number> touched_;  ///< controls with some
  std::vector<States> kept_;
  /// By control: those that have a move to it; found when it is first asked.
  std::vector<std::vector<Controls::Number>> predecessors_;
  bool is_complete_ = false;
  ExplorationEnd end_ = ExplorationEnd::stopped;
  std::uint64_t states_ = 0;
  std::uint64_t transitions_ = 0;
  std::uint32_t expanded_depth_ = 0;
  std::vector<std::uint64_t> states_at_depth_;
  std::uint32_t asked_ = 0;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// False if a limit ends it.
template <typename OnRefusal>
bool StateSpace::make_moves(const States& states, OnRefusal&& on_refusal) {
  Diagrams& sets = environments_.sets();
  for (std::uint32_t action = 0; action < controls_.actions().size(); ++action) {
    if (!controls_.may_have(action)) continue;
    const Controls::Action& made = controls_.actions()[action];
    const Set set = sets.both(states.environments, made.effect.condition);
    if (set == Diagrams::empty) continue;
    if (made.is_move) transitions_ += sets.count(set);
    const bool is_start = made.choice.move.kind == Move::Kind::start;
    controls_.for_each_outcome(action, set, [&](Controls::Outcome outcome, Set part) {
      if (is_start && !outcome.accepted) on_refusal(action, part);
      const bool changes = made.effect.changes || outcome.control != states.control;
      if (made.is_move && changes) add(outcome.control, environments_.after(made.effect, part));
    });
    if (!may_go_on()) return false;
  }
  add_faults(states);
  return true;
}

template <typename Visitor>
void StateSpace::run(Visitor& visitor) {
  for (std::uint32_t depth = 0; !layers_[depth].empty(); ++depth) {
    if (!look_at_limits()) return;
    // First the states alone: a limit may come before all moves of this depth are made.
    for (const States& states : layers_[depth]) {
      controls_.load(states.control);
      visitor.visit(states, depth);
    }
    for (std::size_t place = 0; place < layers_[depth].size(); ++place) {
      const States states = layers_[depth][place];
      controls_.load(states.control);
      const bool goes_on = make_moves(states, [&](std::uint32_t action, Set refused) {
        visitor.on_refusal(action, States{states.control, refused});
      });
      if (!goes_on) return;
      if (environments_.sets().is_crowded()) collect();
    }
    expanded_depth_ = depth;
    end_layer();
  }
  layers_.pop_back();
  is_complete_ = true;
}

}  // namespace cbc
