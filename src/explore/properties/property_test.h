#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/catalog_system.h"
#include "explore/controls/state_test.h"
#include "explore/model/model.h"
#include "explore/space/first_states.h"
#include "explore/space/state_space.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What was found out about one property.
struct Verdict {
  enum class Result : std::uint8_t { proved, violated, undecided };
  Result result = Result::undecided;
  /// The shortest counterexample; of a reachable that is proved, the shortest witness; empty if the
  /// first state is one, or there is none. Of can_start the refused start is its last move.
  std::vector<Move> script;
  bool has_script = false;
  /// Proved, but only since no state counts: `when` never holds, or nothing is marked.
  bool is_vacuous = false;
  bool by_constraints = false;  ///< proved by the constraints alone (constraint_proof.h)
};

/// Looks in a part of the states for the first ones that decide a property, while a StateSpace
/// runs. The property, the part and its system must outlive it.
class PropertyTest {
 public:
  using States = StatePart::States;
  using Layer = StatePart::Layer;

  PropertyTest(const Property& property, CatalogSystem& system, StatePart& part);
  PropertyTest(const PropertyTest&) = delete;
  PropertyTest& operator=(const PropertyTest&) = delete;
  virtual ~PropertyTest() = default;

  // What StateSpace::run() tells; the control of the states is loaded.

  virtual void visit(const States& states, std::uint32_t depth);
  /// A start of a task that does not run is rejected.
  virtual void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth);
  virtual void on_result(std::uint32_t action, const States& states,
                         Controls::NumberedResult result, std::uint32_t depth);
  /// Whether on_result() is to be called.
  [[nodiscard]] virtual bool looks_at_moves() const { return false; }

  /// The states that decide it. All of a depth in the part are known once its layer was visited,
  /// and, of can_start and keeps_running, all moves of the layer were made.
  [[nodiscard]] const FirstStates& met() const { return met_; }
  /// Whether some state counts.
  [[nodiscard]] bool has_counted() const { return has_counted_; }
  [[nodiscard]] CatalogSystem& system() const { return system_; }

  /// Of always_possible, after the run: the states of the part that satisfy the condition.
  [[nodiscard]] virtual Layer goals() { return {}; }
  /// Takes note of the states of a depth that count, but are not among those from which these goals
  /// can be reached, by control. Their control is loaded.
  void note_stuck(const States& states, const std::vector<StatePart::Set>& can_reach,
                  std::uint32_t depth);

 protected:
  using Set = StatePart::Set;

  /// Of these states, those that count by `when`, `settled` and the mark.
  [[nodiscard]] Set counted(const States& states);
  /// Takes note of states that decide the property.
  void note(const States& states, std::uint32_t depth) { met_.add(states, depth); }
  [[nodiscard]] Diagrams& sets() { return system_.sets(); }
  [[nodiscard]] const Stepper& control() const { return system_.stepper(); }

  const Property& property_;
  CatalogSystem& system_;
  const Model& model_;
  StatePart& part_;

 private:
  std::optional<StateTest> when_;
  bool has_counted_ = false;  ///< some state
  FirstStates met_;
};

/// The test for a kind of property.
[[nodiscard]] std::unique_ptr<PropertyTest> make_property_test(const Property& property,
                                                               CatalogSystem& system,
                                                               StatePart& part);

/// The tests of all parts for one property, after the run.
[[nodiscard]] Verdict find_verdict(const Property& property, StateSpace& space,
                                   const std::vector<PropertyTest*>& tests);

}  // namespace cbc
