#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/support/budget.h"
#include "core/support/system.h"
#include "explore/controls/control_system.h"
#include "explore/model/model.h"
#include "explore/space/first_states.h"
#include "explore/space/state_part.h"
#include "explore/space/state_walker.h"

namespace cbc {

/// The reachable states of a system, by the least number of moves to them: for each number the
/// controls, and the environments in which each was new. One round is one move, so depths, counts
/// and shortest paths are those of single states (docs/verify.md, "Size"). The states are shared
/// out to parts, each with a thread of its own; what is found does not depend on their number.
class StateSpace {
 public:
  using Set = StatePart::Set;
  using States = StatePart::States;
  using Layer = StatePart::Layer;
  /// One for each part, and all alike.
  using Systems = std::vector<std::unique_ptr<ControlSystem>>;

  /// `systems`: at least one. The time of the budget begins now; it is told of `what`.
  StateSpace(Systems systems, const Budget& budget, std::string what);

  [[nodiscard]] std::vector<std::unique_ptr<StatePart>>& parts() { return parts_; }

  /// Visits all states; once. There is a visitor for each part, which has
  ///   visit(states, depth)   new states, whose control is loaded
  ///   on_refusal(action, states)   some of them, in which a start is rejected
  ///   on_result(action, states, result)   some of them, and what a move makes of their control;
  ///     not of faults and repairs
  ///   on_note(note, states)   some of them, and what the system says of a move
  /// `is_done()` returns whether all is known that is looked for, so that the run may end.
  template <typename Visitor, typename IsDone>
  void run(std::vector<Visitor>& visitors, IsDone&& is_done);

  /// For what is done between depths, and takes so many bytes: whether the budget allows to go on;
  /// otherwise the run ends.
  [[nodiscard]] bool may_go_on_beside(std::uint64_t bytes) {
    bytes_beside_ = bytes;
    return look_at_limits();
  }

  [[nodiscard]] bool is_complete() const { return is_complete_; }
  /// Whether the visitors ended it.
  [[nodiscard]] bool is_decided() const { return is_decided_; }
  [[nodiscard]] Budget::End end() const { return end_; }
  [[nodiscard]] std::uint64_t states() const { return states_; }
  [[nodiscard]] std::uint64_t transitions() const;
  /// All states up to this depth were expanded, or, if the visitors ended it, visited. 0 also if
  /// none was.
  [[nodiscard]] std::uint32_t expanded_depth() const {
    return expanded_layers_ == 0 ? 0 : expanded_layers_ - 1;
  }
  [[nodiscard]] bool is_expanded(std::uint32_t depth) const { return depth < expanded_layers_; }
  [[nodiscard]] const std::vector<std::uint64_t>& states_at_depth() const {
    return states_at_depth_;
  }
  [[nodiscard]] std::uint64_t bytes() const;

  // After the run.

  /// A path from the first state.
  struct Path {
    std::vector<Move> moves;
    std::vector<std::size_t> places;  ///< of the moves, in ControlSystem::moves()
    StateWalker end;                  ///< has gone there, in the first part
  };
  /// The first shortest path to one of the states that were noted, by part; there must be one.
  [[nodiscard]] Path path_to(const std::vector<const FirstStates*>& noted);
  /// See FirstStates::depth(), of all parts.
  [[nodiscard]] static std::uint32_t least_depth(const std::vector<const FirstStates*>& noted);
  /// By part and control, the environments of the states from which one of the goals, by part, can
  /// be reached by moves of a selection (null: all), in so many moves (nothing: any number).
  /// Nothing if a limit ends it; then is_complete() is false.
  [[nodiscard]] std::optional<std::vector<std::vector<Set>>> can_reach(
      const std::vector<Layer>& goals, const MoveSelection* selection,
      std::optional<std::uint32_t> within);

 private:
  /// Does something with each part, at the same time if there is much to do.
  void for_each_part(std::uint64_t size, const std::function<void(std::size_t)>& work) const;
  /// Asked by a part, now and then.
  [[nodiscard]] bool may_go_on(std::size_t part);
  [[nodiscard]] bool look_at_limits();
  void end_with(std::uint32_t depth);
  void end_layer();
  [[nodiscard]] std::uint64_t size_of_layer(std::uint32_t depth) const;
  [[nodiscard]] std::vector<Layer> share(const std::vector<Layer>& layers);
  [[nodiscard]] std::vector<std::vector<Layer>> layers_before(const std::vector<Layer>& targets,
                                                              std::uint32_t depth);
  [[nodiscard]] bool leads_to(const StateWalker& walker, const std::vector<Layer>& wanted) const;

  const Budget budget_;
  const std::string what_;
  const Budget::Clock::time_point begin_ = Budget::Clock::now();
  std::vector<std::unique_ptr<StatePart>> parts_;
  bool is_complete_ = false;
  bool is_decided_ = false;
  Budget::End end_ = Budget::End::stopped;
  std::uint64_t states_ = 0;
  std::uint64_t bytes_beside_ = 0;
  std::uint32_t expanded_layers_ = 0;
  std::vector<std::uint64_t> states_at_depth_;
  /// What a part says of itself, while others may ask.
  struct Told {
    std::atomic<std::uint64_t> bytes{0};
    std::atomic<std::uint64_t> transitions{0};
    std::atomic<std::uint64_t> controls{0};
    std::uint32_t asked = 0;  ///< only its own thread counts
  };
  void tell(std::size_t part);
  std::vector<Told> told_;
  std::atomic<bool> is_stopped_{false};
  std::mutex looking_;
};

template <typename Visitor, typename IsDone>
void StateSpace::run(std::vector<Visitor>& visitors, IsDone&& is_done) {
  for (const auto& part : parts_) part->begin();
  end_layer();
  for (std::uint32_t depth = 0; size_of_layer(depth) > 0; ++depth) {
    if (!look_at_limits()) return;
    const std::uint64_t size = size_of_layer(depth);
    // First the states alone: a limit may come before all moves of this depth are made.
    for_each_part(size, [&](std::size_t part) { parts_[part]->visit(depth, visitors[part]); });
    if (is_done()) return end_with(depth);
    for_each_part(size, [&](std::size_t part) {
      parts_[part]->make_moves(depth, visitors[part], [&] { return may_go_on(part); });
    });
    if (is_stopped_) return;
    expanded_layers_ = depth + 1;
    if (is_done()) return end_with(depth);
    end_layer();
  }
  is_complete_ = true;
}

/// Adds systems that are made alike. Returns them as what they are.
template <typename System, typename... Arguments>
std::vector<System*> add_systems(std::size_t count, StateSpace::Systems& systems,
                                 const Arguments&... arguments) {
  std::vector<System*> added;
  while (added.size() < count) {
    auto system = std::make_unique<System>(arguments...);
    added.push_back(system.get());
    systems.push_back(std::move(system));
  }
  return added;
}

}  // namespace cbc
