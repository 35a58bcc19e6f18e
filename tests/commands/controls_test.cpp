#include "explore/controls/controls.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

/// A start that a property asks about, but no move makes, leads to no state.
TEST(Controls, AreThoseThatMovesLeadTo) {
  const CompiledCatalog catalog = test::compile_text(
      "behaviors:\n- {behavior: A1, task: A}\n- {behavior: B1, task: B}\n"
      "exclusivity_constraints: [{mutually_exclusive: [A, B]}]\n");
  const TaskId a = catalog.task_ids[*catalog.find_task("A")];
  const TaskId b = catalog.task_ids[*catalog.find_task("B")];
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.start = {{b, {1}}};
  assumptions.stop = {b};
  assumptions.faults = 1;
  Property property;
  property.task = a;
  // Which takes all states.
  Property always;
  always.kind = Property::Kind::always;
  const Exploration exploration =
      explore(catalog, {GroupId(0)}, assumptions, {&property, &always}, {});
  EXPECT_TRUE(exploration.complete);
  EXPECT_EQ(exploration.controls, 2U);  // nothing runs, or B
  ASSERT_EQ(exploration.verdicts.size(), 2U);
  // B gives way, but not to a behavior that is faulty.
  EXPECT_EQ(exploration.verdicts.front().result, Verdict::Result::violated);
  EXPECT_EQ(exploration.verdicts.front().script.size(), 2U);
}

/// Asks for the first bit of an environment until it was set, and then no more. The second one is
/// the control after its one move.
class ForgettingSystem final : public ControlSystem {
 public:
  ForgettingSystem() : ControlSystem(2, {}, 0, false) { actions_.emplace_back(); }

  [[nodiscard]] const std::vector<std::uint32_t>& first_control() const override { return first_; }
  [[nodiscard]] std::vector<std::uint8_t> first_environment() const override { return {0, 0}; }
  void load(const std::uint32_t* /*control*/) override {}
  [[nodiscard]] bool may_have(std::uint32_t /*action*/) const override { return true; }
  [[nodiscard]] MoveResult take(std::uint32_t /*action*/, SystemOracle& oracle) override {
    if (!was_set_) was_set_ = oracle.is_in(sets_.with(0, true));
    after_ = oracle.is_in(sets_.with(1, true)) ? 1 : 0;
    return {&after_};
  }
  [[nodiscard]] MoveResult take_fault() override { return {}; }
  [[nodiscard]] MoveResult take_repair(std::uint32_t /*kind*/) override { return {}; }

 private:
  const std::vector<std::uint32_t> first_ = {0};
  std::uint32_t after_ = 0;
  bool was_set_ = false;
};

/// What a move asks may depend on what it asked before: the result is filed under all of that.
TEST(Controls, AreRightAlsoIfAMoveAsksLessThanBefore) {
  using Environment = std::vector<std::uint8_t>;
  const std::vector<Environment> environments = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  ForgettingSystem system;
  Controls controls(system);
  controls.load(controls.find(system.first_control().data()));
  for (int round = 0; round < 2; ++round) {
    for (const Environment& environment : environments) {
      EXPECT_EQ(*controls.packed(controls.result_in(0, environment).control), environment[1]);
    }
  }
}

}  // namespace
}  // namespace cbc
