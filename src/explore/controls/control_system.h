#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "explore/model/model.h"
#include "explore/sets/diagrams.h"
#include "explore/sets/fault_sets.h"

namespace cbc {

/// Answers questions about the environment in which a move is made.
class SystemOracle {
 public:
  virtual ~SystemOracle() = default;
  /// Whether the environment before the move is in a set.
  [[nodiscard]] virtual bool is_in(Diagrams::Set set) = 0;
};

/// What moves do to controls and environments: all that an exploration asks about states, so that
/// StateSpace explores a catalog, two of them in lockstep, or a catalog whose goals are watched,
/// without knowing which. A control is some 32-bit words, an environment a string of bits. Its sets
/// mean something in it only. Not for use by several threads.
class ControlSystem {
 public:
  using Set = Diagrams::Set;

  /// What can be tried with a control, but for what FaultSets do.
  struct Action {
    Set condition = Diagrams::all;  ///< the environments in which it exists
    bool changes = false;           ///< false: the environment stays as it is
    Diagrams::ValuesNumber values = 0;
    bool is_start = false;  ///< of which StateSpace::run() tells when it is rejected
    bool is_move = true;    ///< false: nothing comes of it
  };
  /// A move of a single state.
  struct StateMove {
    Move move;
    std::uint32_t action = none;
    std::uint32_t fault = none;  ///< of a fault or a repair that is no action
  };
  /// What comes of a move.
  struct MoveResult {
    const std::uint32_t* control = nullptr;  ///< valid until the next call; null: it leads nowhere
    bool accepted = false;                   ///< of a start
    std::uint32_t note = 0;                  ///< what the system says of it; 0: nothing
    /// What it makes of the environment, besides what the action does; 0: nothing.
    Diagrams::ValuesNumber values = 0;
    bool exists = true;  ///< false: there is no such move (suspended in `assume`)
  };

  virtual ~ControlSystem() = default;
  ControlSystem(const ControlSystem&) = delete;
  ControlSystem& operator=(const ControlSystem&) = delete;

  [[nodiscard]] Diagrams& sets() { return sets_; }
  [[nodiscard]] const Diagrams& sets() const { return sets_; }
  [[nodiscard]] FaultSets& faults() { return faults_; }
  [[nodiscard]] const std::vector<Action>& actions() const { return actions_; }
  /// The moves that some state may have, in order. One may stand twice, for environments that
  /// differ.
  [[nodiscard]] const std::vector<StateMove>& moves() const { return moves_; }

  /// The environments that come of some in which the action exists, and has a result with these
  /// values.
  [[nodiscard]] Set after(const Action& action, Diagrams::ValuesNumber values, Set set) {
    const Set changed = action.changes ? sets_.changed(set, action.values) : set;
    return values == 0 ? changed : sets_.changed(changed, values);
  }
  /// The environments that become one of the set, if the action exists in them, and has a result
  /// with these values.
  [[nodiscard]] Set before(const Action& action, Diagrams::ValuesNumber values, Set set) {
    const Set changed = values == 0 ? set : sets_.before_change(set, values);
    const Set reached = action.changes ? sets_.before_change(changed, action.values) : changed;
    return sets_.both(reached, action.condition);
  }

  // The first state.

  [[nodiscard]] virtual const std::vector<std::uint32_t>& first_control() const = 0;
  [[nodiscard]] virtual std::vector<std::uint8_t> first_environment() const = 0;

  // A control.

  /// Takes it up.
  virtual void load(const std::uint32_t* control) = 0;
  /// Whether it has an action in some environment.
  [[nodiscard]] virtual bool may_have(std::uint32_t action) const = 0;
  /// What comes of an action in one environment: the same in all in which the oracle would answer
  /// the same.
  [[nodiscard]] virtual MoveResult take(std::uint32_t action, SystemOracle& oracle) = 0;
  /// What comes of a fault, and of a repair of a kind, which does not depend on the environment.
  [[nodiscard]] virtual MoveResult take_fault() = 0;
  [[nodiscard]] virtual MoveResult take_repair(std::uint32_t kind) = 0;

  // A state of the loaded control.

  /// Whether it has the move.
  [[nodiscard]] bool has(const StateMove& move, const std::vector<std::uint8_t>& environment);
  /// What the move, with a result with these values, does to its environment.
  void change(const StateMove& move, Diagrams::ValuesNumber values,
              std::vector<std::uint8_t>& environment) const;
  /// What the move makes of its control.
  [[nodiscard]] MoveResult make(const StateMove& move,
                                const std::vector<std::uint8_t>& environment);

  // A mark, which is a part of environments that states get as they are entered.

  [[nodiscard]] virtual bool has_mark() const { return false; }
  /// The states of the loaded control once their marks are set and cleared; and as they were
  /// before.
  [[nodiscard]] virtual Set with_marks(Set set) { return set; }
  [[nodiscard]] virtual Set before_marks(Set set) { return set; }
  virtual void set_mark(std::vector<std::uint8_t>& /*environment*/) {}

  /// Calls `keep` with each set that must survive Diagrams::collect().
  virtual void for_each_kept(const std::function<void(Set)>& keep) const;

 protected:
  /// `bits`: of an environment. `kinds` and so on: see FaultSets. The number 0 of values is
  /// one that nothing has.
  ControlSystem(std::uint32_t bits, const std::vector<std::uint32_t>& kinds,
                std::uint32_t most_faults, bool has_repairs);

  Diagrams sets_;
  FaultSets faults_;
  std::vector<Action> actions_;
  std::vector<StateMove> moves_;
};

}  // namespace cbc
