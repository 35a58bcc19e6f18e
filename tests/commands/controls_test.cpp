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

}  // namespace
}  // namespace cbc
