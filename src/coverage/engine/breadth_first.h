#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/support/budget.h"
#include "explore/sets/state_store.h"

namespace cbc {

/// Makes the moves of states, of which only the system knows what they mean. Two states are one if
/// their words are the same.
template <typename System>
concept TransitionSystem = requires(System& system, const System& seen, const std::uint32_t* state,
                                    std::uint32_t* successor) {
  system.load(state);    // takes up a state, whose words are read at once
  seen.choices();        // all moves that some state may have, in order
  seen.pack(successor);  // writes the state after the move
  { system.try_move(*std::begin(seen.choices())) } -> std::same_as<bool>;  // if it has the move
};

/// Is told each state, which its system has loaded, and each move.
template <typename Visitor>
concept StateVisitor = requires(Visitor& visitor, StateStore::Number number) {
  requires TransitionSystem<std::remove_reference_t<decltype(visitor.system())>>;
  visitor.visit(number);
  visitor.on_move(number, *std::begin(visitor.system().choices()), number);  // from, to
};

/// Visits states one by one, in the order in which they are found: the nearest first, and of those
/// the first in the order of moves.
class BreadthFirst {
 public:
  using Number = StateStore::Number;
  /// Called for each state, and now and then within one that has many moves, with the number of
  /// states; false ends the search as a limit does. May be empty.
  using OnProgress = std::function<bool(std::uint64_t states)>;

  /// Where the search ends although states are left. 0: no limit.
  struct Limits {
    std::uint64_t max_states = 0;
    std::uint64_t max_memory = 0;  ///< bytes that states take
  };

  /// `first`: the first state; its length is that of all states.
  BreadthFirst(const std::vector<std::uint32_t>& first, const Limits& limits,
               OnProgress on_progress)
      : limits_(limits), on_progress_(std::move(on_progress)), store_(first.size()) {
    store_.insert(first.data(), store_.hash(first.data()));
  }

  /// Expands all states, or ends at a limit, which counts what was found of the state that it came
  /// in.
  template <StateVisitor Visitor>
  void run(Visitor& visitor) {
    while (!is_complete() && expand(visitor)) ++expanded_;
  }

  [[nodiscard]] bool is_complete() const { return expanded_ == store_.size(); }
  /// What ended it, if it is not complete.
  [[nodiscard]] std::optional<Budget::End> end() const { return end_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  [[nodiscard]] const StateStore& store() const { return store_; }

 private:
  /// False: a limit ended it.
  template <StateVisitor Visitor>
  bool expand(Visitor& visitor) {
    auto& system = visitor.system();
    system.load(store_.state(expanded_));
    visitor.visit(expanded_);
    std::vector<std::uint32_t> successor(store_.words());
    std::uint32_t asked = 0;
    for (const auto& choice : system.choices()) {
      if (asked++ % moves_between_looks == 0 && !may_go_on()) return false;
      if (!system.try_move(choice)) continue;
      system.pack(successor.data());
      ++transitions_;
      visitor.on_move(expanded_, choice,
                      store_.insert(successor.data(), store_.hash(successor.data())));
    }
    return true;
  }

  [[nodiscard]] bool may_go_on() {
    if (limits_.max_states > 0 && store_.size() >= limits_.max_states) {
      end_ = Budget::End::max_states;
    } else if (store_.size() >= StateStore::most_states - moves_between_looks) {
      end_ = Budget::End::too_many;
    } else if (limits_.max_memory > 0 && store_.bytes_for(store_.size() + 1) > limits_.max_memory) {
      end_ = Budget::End::max_memory;
    } else if (on_progress_ && !on_progress_(store_.size())) {
      end_ = Budget::End::stopped;
    }
    return !end_;
  }

  static constexpr std::uint32_t moves_between_looks = 64;

  const Limits limits_;
  const OnProgress on_progress_;
  StateStore store_;
  Number expanded_ = 0;
  std::uint64_t transitions_ = 0;
  std::optional<Budget::End> end_;
};

}  // namespace cbc
