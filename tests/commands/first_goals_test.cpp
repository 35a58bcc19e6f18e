// Which missed goals a long list begins with.
#include "coverage/engine/first_goals.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "coverage/engine/coverage.h"
#include "coverage/engine/goals.h"
#include "unit/compiled_fixture.h"

namespace cbc::first_goals_test {
namespace {

/// Nothing is met of it. BASE carries ARM and, through it, GRIP; LAMP is alone.
CatalogCoverage unmet() {
  const auto catalog = std::make_shared<const CompiledCatalog>(test::compile_text(R"(
tasks: [{task: LAMP}, {task: GRIP}, {task: ARM}, {task: BASE}, {task: PARK}]
behaviors:
- {behavior: LAMP_ON, task: LAMP}
- {behavior: GRIP_1, task: GRIP, requires: [{task: ARM}]}
- {behavior: ARM_1, task: ARM, requires: [{task: BASE}]}
- {behavior: BASE_1, task: BASE}
- {behavior: PARK_1, task: PARK}
exclusivity_constraints:
- mutually_exclusive: [PARK, LAMP, GRIP, BASE]
)"));
  return {catalog, "", find_goals(*catalog)};
}

std::vector<std::string> describe_first(const CatalogCoverage& coverage, std::size_t count) {
  std::vector<std::string> goals;
  for (const std::uint32_t goal : first_goals(coverage, count)) {
    goals.push_back(describe(coverage.catalog(), coverage.goals()[goal]));
  }
  return goals;
}

TEST(FirstGoals, BeginWithConstraintsThenWithFailuresOfWhatOthersNeed) {
  const std::vector<std::string> first = describe_first(unmet(), 7);
  ASSERT_EQ(first.size(), 7U);
  // Of six exclusions the three that guard the most; ARM and GRIP hang on BASE.
  EXPECT_NE(first[0].find("BASE"), std::string::npos) << first[0];
  for (std::size_t place = 0; place < 5; ++place) {
    EXPECT_NE(first[place].find("matters"), std::string::npos) << first[place];
  }
  EXPECT_EQ(first[5], "behavior BASE_1 failed");
  EXPECT_EQ(first[6], "behavior ARM_1 failed");
}

TEST(FirstGoals, HaveThreeOfAKindAsLongAsThereAreOthers) {
  const CatalogCoverage coverage = unmet();
  std::map<Goal::Kind, std::size_t> counts;
  for (const std::uint32_t goal : first_goals(coverage, 10)) ++counts[coverage.goals()[goal].kind];
  for (const auto& [kind, count] : counts) EXPECT_LE(count, 3U) << name_of(kind);
  EXPECT_EQ(first_goals(coverage, 1000).size(), coverage.goals().size());
}

TEST(FirstGoals, AreAmongThoseThatAreMissed) {
  CatalogCoverage coverage = unmet();
  std::vector<std::uint8_t> met(coverage.goals().size(), 1);
  met[2] = 0;
  coverage.add("mission.yaml", met);
  EXPECT_EQ(first_goals(coverage, 10), std::vector<std::uint32_t>{2});
}

}  // namespace
}  // namespace cbc::first_goals_test
