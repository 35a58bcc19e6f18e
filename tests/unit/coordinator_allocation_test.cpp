#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "runtime/coordinator/coordinator.h"
#include "unit/allocations.h"
#include "unit/random_mission.h"

namespace cbc::coordinator_allocation_test {
namespace {

/// Counts what happens, and takes a fingerprint of all that is reported.
class Witness final : public EventListener {
 public:
  void on_event(const EventRecord& record) override {
    const auto is = [&](ChangeCause cause) {
      return std::any_of(record.changes.begin(), record.changes.end(),
                         [cause](const Change& change) { return change.cause == cause; });
    };
    accepted += record.outcome == Outcome::accepted ? 1U : 0U;
    rejected += record.outcome == Outcome::rejected ? 1U : 0U;
    timeouts += record.origin == Origin::timeout ? 1U : 0U;
    reactive += record.origin == Origin::reactive ? 1U : 0U;
    lost += record.origin == Origin::fault ? 1U : 0U;
    undone += is(ChangeCause::undone) ? 1U : 0U;
    restarted += is(ChangeCause::restarted) ? 1U : 0U;
    stopped += record.stopped_tasks.size();

    const auto add = [this](auto value) { print_.add(static_cast<std::uint64_t>(value)); };
    add(record.time - begin_);
    add(record.origin);
    add(record.verb);
    add(record.task);
    add(record.behavior);
    add(record.outcome);
    for (const Change& change : record.changes) {
      add(change.behavior);
      add(change.cause);
      add(change.priority.value_or(-1));
      add(change.is_activation);
      add(change.success);
      for (const TaskId task : record.tasks_of(change)) add(task);
    }
    for (const StoppedTask& task : record.stopped_tasks) add(task.task);
  }

  void begin_pass(Microseconds time) {
    begin_ = time;
    print_ = {};
  }
  [[nodiscard]] const test::Fingerprint& fingerprint() const { return print_; }

  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t timeouts = 0;
  std::uint64_t reactive = 0;
  std::uint64_t lost = 0;
  std::uint64_t undone = 0;
  std::uint64_t restarted = 0;
  std::uint64_t stopped = 0;

 private:
  Microseconds begin_ = 0;
  test::Fingerprint print_;
};

void go_through(const test::RandomMission& mission, Coordinator& coordinator, Witness& witness) {
  const Microseconds begin = coordinator.now() + second;
  witness.begin_pass(begin);
  for (const test::RandomMission::Step& step : mission.steps()) {
    ASSERT_EQ(coordinator.advance_to(begin + step.time), Coordinator::Status::ok);
    ASSERT_EQ(coordinator.handle(step.event), Coordinator::Status::ok);
  }
  ASSERT_FALSE(coordinator.next_due().has_value());
}

TEST(CoordinatorAllocation, NothingIsAllocatedOnEventsThatWereThereBefore) {
  test::Random random(4);
  Witness witness;
  for (int round = 0; round < 8; ++round) {
    const CompiledCatalog catalog =
        test::restless_catalog(random, static_cast<std::uint32_t>(random.between(3, 40)));
    const test::RandomMission mission(random, catalog, 500);
    CoordinatorOptions options;
    if (round % 3 == 0) options.search.easy_nodes = 0;
    if (round % 4 == 0) options.search.time_limit = std::chrono::hours(1);
    Coordinator coordinator(catalog, options, witness);
    coordinator.begin({});
    go_through(mission, coordinator, witness);
    go_through(mission, coordinator, witness);
    const test::Fingerprint before = witness.fingerprint();
    const std::uint64_t allocations = test::allocations();
    go_through(mission, coordinator, witness);
    EXPECT_EQ(test::allocations() - allocations, 0U) << "round " << round;
    EXPECT_EQ(witness.fingerprint(), before) << "round " << round;
  }
  EXPECT_GT(witness.accepted, 1'000U);
  EXPECT_GT(witness.rejected, 1'000U);
  EXPECT_GT(witness.timeouts, 200U);
  EXPECT_GT(witness.reactive, 200U);
  EXPECT_GT(witness.lost, 10U);
  EXPECT_GT(witness.undone, 100U);
  EXPECT_GT(witness.restarted, 100U);
  EXPECT_GT(witness.stopped, 1'000U);
}

}  // namespace
}  // namespace cbc::coordinator_allocation_test
