#include <bit>

#include <gtest/gtest.h>

#include "catalog_generated.h"
#include "runtime/compiled/compiled_catalog.h"

/// The structs of the schema are used as those of the solver: each field must lie in its place.
namespace cbc::file_layout_test {
namespace {

TEST(FileLayout, OfTasks) {
  const auto task = std::bit_cast<CompiledTask>(flat::Task(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
  EXPECT_EQ(task.catalog_index, 1U);
  EXPECT_EQ(task.group, 2U);
  EXPECT_EQ(task.level, 3U);
  EXPECT_EQ(task.minimum_performance, 4U);
  EXPECT_EQ(task.minimum_cost, 5);
  EXPECT_EQ(task.timeout, 6);
  EXPECT_EQ(task.minimum_line, 7U);
  EXPECT_EQ(task.start_on_request, 8);
  EXPECT_EQ(task.reactive_start, 9);
  EXPECT_EQ(task.keep_running, 10);
  EXPECT_EQ(task.has_performance_rules, 11);
}

TEST(FileLayout, OfBehaviors) {
  const auto behavior = std::bit_cast<CompiledBehavior>(flat::Behavior(1, 2, 3));
  EXPECT_EQ(behavior.catalog_index, 1U);
  EXPECT_EQ(behavior.level, 2U);
  EXPECT_EQ(behavior.timeout, 3);
}

TEST(FileLayout, OfValues) {
  const auto value = std::bit_cast<Value>(flat::Value(1, 2, 3));
  EXPECT_EQ(value.behavior, 1U);
  EXPECT_EQ(value.suitability, 2U);
  EXPECT_EQ(value.cost, 3);
}

TEST(FileLayout, OfRequirements) {
  const auto requirement = std::bit_cast<CompiledRequirement>(flat::Requirement(1, 2, 3));
  EXPECT_EQ(requirement.task, 1U);
  EXPECT_EQ(requirement.minimum_performance, 2U);
  EXPECT_EQ(requirement.minimum_cost, 3);
}

TEST(FileLayout, OfArcs) {
  const auto arc = std::bit_cast<Arc>(flat::Arc(1, 2, 3));
  EXPECT_EQ(arc.source, 1U);
  EXPECT_EQ(arc.target, 2U);
  EXPECT_EQ(arc.mask, 3U);
}

TEST(FileLayout, OfParameters) {
  const auto parameter = std::bit_cast<CompiledParameter>(flat::Parameter(1, 2, 3, 4));
  EXPECT_EQ(parameter.name, 1U);
  EXPECT_EQ(parameter.allowed_is_list, 2U);
  EXPECT_EQ(parameter.first_allowed, 3U);
  EXPECT_EQ(parameter.allowed_count, 4U);
}

}  // namespace
}  // namespace cbc::file_layout_test
