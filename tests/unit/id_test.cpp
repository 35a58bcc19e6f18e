#include "runtime/base/id.h"

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <unordered_set>

#include <gtest/gtest.h>

#include "runtime/compiled/compiled_catalog.h"

namespace cbc::id_test {
namespace {

template <typename A, typename B>
concept Comparable = requires(A a, B b) {
  a == b;
  a < b;
};

static_assert(sizeof(TaskId) == sizeof(std::uint32_t));
static_assert(std::is_trivially_copyable_v<TaskId>);

static_assert(std::constructible_from<TaskId, std::uint32_t>);
static_assert(!std::convertible_to<std::uint32_t, TaskId>);
static_assert(std::convertible_to<TaskId, std::uint32_t>);
static_assert(std::convertible_to<None, TaskId>);
static_assert(!std::constructible_from<TaskId, BehaviorId>);
static_assert(!std::constructible_from<TaskId, LocalTask>);
static_assert(!std::assignable_from<TaskId&, BehaviorId>);

static_assert(Comparable<TaskId, TaskId>);
static_assert(Comparable<TaskId, std::uint32_t>);
static_assert(!Comparable<TaskId, BehaviorId>);
static_assert(!Comparable<TaskId, LocalTask>);

TEST(Id, BeginsAtZero) {
  TaskId task;
  EXPECT_EQ(task, 0U);
  ++task;
  EXPECT_EQ(task, TaskId(1));
  EXPECT_LT(TaskId(), task);
}

TEST(Id, MayBeNone) {
  const TaskId task = none;
  EXPECT_EQ(task, none);
  EXPECT_EQ(task, UINT32_MAX);
  EXPECT_NE(TaskId(0), none);
}

TEST(Id, CanBeKeptInSets) {
  const std::unordered_set<TaskId> tasks{TaskId(3), TaskId(5), TaskId(3)};
  EXPECT_EQ(tasks.size(), 2U);
  EXPECT_TRUE(tasks.contains(TaskId(5)));
}

TEST(Id, OfATaskIsThatOfTheFirstInItsGroupAndItsPlaceThere) {
  const TaskId first(7);
  const LocalTask task = TaskId(9) - first;
  EXPECT_EQ(task, 2U);
  EXPECT_EQ(first + task, TaskId(9));
}

}  // namespace
}  // namespace cbc::id_test
