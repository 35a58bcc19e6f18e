#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/model.h"
#include "verify/engine/state_space.h"
#include "verify/engine/state_test.h"

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
};

/// Looks for the first states that decide a property, while a StateSpace runs. The property and the
/// model must outlive it.
class PropertyTest {
 public:
  using States = StateSpace::States;
  static constexpr std::uint32_t never_seen = UINT32_MAX;

  PropertyTest(const Property& property, const Model& model, StateSpace& space);
  PropertyTest(const PropertyTest&) = delete;
  PropertyTest& operator=(const PropertyTest&) = delete;
  virtual ~PropertyTest() = default;

  // What StateSpace::run() tells; the control of the states is loaded.

  virtual void visit(const States& states, std::uint32_t depth);
  /// A start of a task that does not run is rejected.
  virtual void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth);
  virtual void on_outcome(std::uint32_t action, const States& states, Controls::Outcome outcome,
                          std::uint32_t depth);
  /// Whether on_outcome() is to be called.
  [[nodiscard]] virtual bool looks_at_moves() const { return false; }

  /// Whether the states that decide it are known, once all states of their depth were visited.
  [[nodiscard]] bool is_decided() const { return first_ != never_seen; }
  /// After the run.
  [[nodiscard]] virtual Verdict verdict();

 protected:
  using Set = Environments::Set;

  /// Of these states, those that count by `when`, `settled` and the mark.
  [[nodiscard]] Set counted(const States& states);
  /// Takes note of states that decide the property.
  void note(const States& states, std::uint32_t depth);
  [[nodiscard]] Verdict undecided_or(Verdict::Result result) const;
  [[nodiscard]] Diagrams& sets() { return space_.environments().sets(); }
  [[nodiscard]] const Stepper& control() const { return space_.controls().stepper(); }
  /// The first shortest path to the states of which note was taken.
  void write_script(Verdict& verdict);

  const Property& property_;
  const Model& model_;
  StateSpace& space_;

 private:
  std::optional<StateTest> when_;
  bool has_counted_ = false;          ///< some state
  std::uint32_t first_ = never_seen;  ///< the depth
  std::vector<States> met_;           ///< of that depth, one after the other by control
};

/// The test for a kind of property.
[[nodiscard]] std::unique_ptr<PropertyTest> make_property_test(const Property& property,
                                                               const Model& model,
                                                               StateSpace& space);

}  // namespace cbc
