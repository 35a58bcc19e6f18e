// Saved states that no coordinator can be in: each refusal, and what lies just within its limit.
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "cbc/units.h"
#include "runtime/coordinator/state.h"
#include "unit/compiled_fixture.h"

namespace cbc::inconsistency_test {
namespace {

constexpr std::string_view catalog_text = R"(tasks:
- {task: FLY, timeout: 10}
- {task: LAND}
- {task: LIGHT, reactive_start: true}
- {task: BLINK, reactive_start: true}
- {task: ROLL}
- {task: SIT}
behaviors:
- {behavior: fly, task: FLY, requires: [{task: LIGHT}], situation: {wind: low}}
- {behavior: glide, task: FLY}
- {behavior: land, task: LAND}
- {behavior: light, task: LIGHT}
- {behavior: blink, task: BLINK}
- {behavior: roll, task: ROLL}
- {behavior: sit, task: SIT}
exclusivity_constraints:
- mutually_exclusive: [FLY, LAND]
- mutually_exclusive: [ROLL, SIT]
situation:
- {variable: wind, values: [low, high]}
)";

/// Nothing runs.
Snapshot idle_at(Microseconds now) {
  Snapshot snapshot;
  snapshot.now = now;
  snapshot.reactive_delay = 1;
  snapshot.variables = {1};
  return snapshot;
}

class Inconsistency : public testing::Test {
 protected:
  Inconsistency() {
    snapshot.now = 100 * second;
    snapshot.events = 5;
    snapshot.reactive_delay = 2 * second;
    snapshot.variables = {0};
    run("FLY", "fly", 95 * second);
    snapshot.running.back().waits_for_timeout = true;
    request(3);
    run("LIGHT", "light", 90 * second);
    snapshot.queue.emplace_back(task("BLINK"), 101 * second);
  }

  [[nodiscard]] TaskId task(std::string_view name) const { return test::task_id(catalog, name); }
  [[nodiscard]] BehaviorId behavior(std::string_view name) const {
    return test::behavior_id(catalog, name);
  }
  void run(std::string_view name, std::string_view with, Microseconds since) {
    Snapshot::RunningTask& entry = snapshot.running.emplace_back();
    entry.task = task(name);
    entry.value_index = test::value_index(catalog, name, with);
    entry.since = since;
    snapshot.active.emplace_back(behavior(with), since);
  }

  /// The task that was made to run last has a request since this event.
  void request(std::uint64_t event) { snapshot.running.back().request = Request{1, event, {}}; }

  /// What is said of the snapshot with a change.
  [[nodiscard]] std::string with(const std::function<void(Snapshot&)>& change) const {
    Snapshot changed = snapshot;
    change(changed);
    return find_inconsistency(catalog, changed).value_or("");
  }

  const CompiledCatalog catalog = test::compile_text(catalog_text);
  Snapshot snapshot;
};

TEST_F(Inconsistency, IsNotFoundInAPossibleState) {
  EXPECT_EQ(find_inconsistency(catalog, snapshot), std::nullopt);
  EXPECT_EQ(find_inconsistency(catalog, idle_at(0)), std::nullopt);
}

TEST_F(Inconsistency, OfTheClock) {
  const std::string time = "its time is not between 0 and 1000000000 s";
  const std::string delay = "its reactive delay is not above 0 and at most 1000000000 s";
  const auto now = [](Microseconds value) {
    return [value](Snapshot& state) { state = idle_at(value); };
  };
  EXPECT_EQ(with(now(-1)), time);
  EXPECT_EQ(with(now(0)), "");
  EXPECT_EQ(with(now(longest_time)), "");
  EXPECT_EQ(with(now(longest_time + 1)), time);
  const auto of_delay = [](Microseconds value) {
    return [value](Snapshot& state) {
      state.queue.clear();
      state.reactive_delay = value;
    };
  };
  EXPECT_EQ(with(of_delay(0)), delay);
  EXPECT_EQ(with(of_delay(1)), "");
  EXPECT_EQ(with(of_delay(longest_time)), "");
  EXPECT_EQ(with(of_delay(longest_time + 1)), delay);
  EXPECT_EQ(with([](Snapshot& state) { state.events = UINT64_MAX / 2; }), "");
  EXPECT_EQ(with([](Snapshot& state) { state.events = UINT64_MAX / 2 + 1; }),
            "its number of events is too large");
}

TEST_F(Inconsistency, OfVariables) {
  EXPECT_EQ(with([](Snapshot& state) { state.variables = {2}; }),
            "variable 'wind' has no such value");
  EXPECT_EQ(with([](Snapshot& state) { state.variables = {1}; }),
            "behavior 'fly' is active, but does not fit the value of 'wind'");
}

TEST_F(Inconsistency, OfActiveBehaviors) {
  const auto since = [](Microseconds time) {
    return [time](Snapshot& state) { state.active.back().second = time; };
  };
  EXPECT_EQ(with([](Snapshot& state) { state.active.push_back(state.active.front()); }),
            "behavior 'fly' is active twice");
  const std::string early =
      "behavior 'light' became active after the time of the state, or before 0";
  EXPECT_EQ(with(since(-1)), early);
  EXPECT_EQ(with(since(0)), "");
  EXPECT_EQ(with(since(100 * second)), "");
  EXPECT_EQ(with(since(100 * second + 1)), early);
  EXPECT_EQ(with([this](Snapshot& state) { state.active.emplace_back(behavior("glide"), 0); }),
            "behavior 'glide' is active, but performs no task");
}

TEST_F(Inconsistency, OfRunningTasks) {
  EXPECT_EQ(with([](Snapshot& state) { state.running.push_back(state.running.back()); }),
            "task 'LIGHT' runs twice");
  const auto since = [](Microseconds time) {
    return [time](Snapshot& state) { state.running.back().since = time; };
  };
  const std::string early = "task 'LIGHT' runs since a time after that of the state, or before 0";
  EXPECT_EQ(with(since(-1)), early);
  EXPECT_EQ(with(since(0)), "");
  EXPECT_EQ(with(since(100 * second)), "");
  EXPECT_EQ(with(since(100 * second + 1)), early);
  EXPECT_EQ(with([](Snapshot& state) { state.active.pop_back(); }),
            "task 'LIGHT' runs with 'light', which is not active");
}

TEST_F(Inconsistency, OfRequests) {
  const auto with_request = [](std::int32_t priority, std::uint64_t event) {
    return [=](Snapshot& state) { state.running.back().request = Request{priority, event, {}}; };
  };
  EXPECT_EQ(with(with_request(-1, 1)), "the request of 'LIGHT' has no priority");
  EXPECT_EQ(with(with_request(0, 1)), "");
  const std::string never = "the request of 'LIGHT' is from an event that never happened";
  EXPECT_EQ(with(with_request(1, 0)), never);
  EXPECT_EQ(with(with_request(1, 5)), "");
  EXPECT_EQ(with(with_request(1, 6)), never);
  EXPECT_EQ(with(with_request(1, 3)),
            "the request of 'LIGHT' is from the same event as another one");
  EXPECT_EQ(with([](Snapshot& state) { state.running.front().request.reset(); }),
            "task 'FLY' starts only on request, but runs without one");
}

TEST_F(Inconsistency, OfTimeouts) {
  const auto fly = [](bool waits, Microseconds task_since, Microseconds active_since) {
    return [=](Snapshot& state) {
      state.running.front().waits_for_timeout = waits;
      state.running.front().since = task_since;
      state.active.front().second = active_since;
    };
  };
  const std::string cannot = "task 'FLY' cannot wait for a timeout";
  const std::string does_not = "task 'FLY' does not wait for a timeout";
  EXPECT_EQ(with(fly(false, 95 * second, 95 * second)), does_not);
  EXPECT_EQ(with(fly(true, 90 * second, 0)), "") << "due now";
  EXPECT_EQ(with(fly(true, 90 * second - 1, 0)), cannot) << "was due before";
  EXPECT_EQ(with(fly(true, 0, 90 * second)), "") << "the later of the two counts";
  EXPECT_EQ(with(fly(false, 90 * second, 90 * second)), "") << "handled already";
  EXPECT_EQ(with(fly(false, 90 * second + 1, 0)), does_not);
  EXPECT_EQ(with([](Snapshot& state) { state.timeouts = false; }), cannot);
  EXPECT_EQ(with([](Snapshot& state) { state.running.back().waits_for_timeout = true; }),
            "task 'LIGHT' cannot wait for a timeout");
}

TEST_F(Inconsistency, OfBehaviorsThatCannotBeChosen) {
  const BehaviorId glide = behavior("glide");
  EXPECT_EQ(with([=](Snapshot& state) { state.denied = {glide}; }), "");
  EXPECT_EQ(with([=](Snapshot& state) {
              state.denied = {glide, glide};
            }),
            "behavior 'glide' is unavailable twice");
  EXPECT_EQ(with([=](Snapshot& state) {
              state.faulty = {glide, glide};
            }),
            "behavior 'glide' is faulty twice");
}

TEST_F(Inconsistency, OfTheQueue) {
  const auto queue = [this](std::string_view name, Microseconds due) {
    return [this, name, due](Snapshot& state) { state.queue.emplace_back(task(name), due); };
  };
  EXPECT_EQ(with(queue("LAND", 100 * second)),
            "task 'LAND' is in the queue, but does not start reactively");
  EXPECT_EQ(with(queue("LIGHT", 100 * second)), "task 'LIGHT' is in the queue, but runs");
  EXPECT_EQ(with(queue("BLINK", 100 * second)), "task 'BLINK' is in the queue twice");
  const auto due = [](Microseconds time) {
    return [time](Snapshot& state) { state.queue.front().second = time; };
  };
  const std::string impossible = "task 'BLINK' is in the queue for an impossible time";
  EXPECT_EQ(with(due(100 * second - 1)), impossible);
  EXPECT_EQ(with(due(100 * second)), "");
  EXPECT_EQ(with(due(102 * second)), "");
  EXPECT_EQ(with(due(102 * second + 1)), impossible);
}

TEST_F(Inconsistency, OfWaitingTasks) {
  const auto waiting = [this](std::initializer_list<std::string_view> names) {
    return [this, names](Snapshot& state) {
      for (const std::string_view name : names) state.waiting.push_back(task(name));
    };
  };
  EXPECT_EQ(with(waiting({"BLINK"})), "");
  EXPECT_EQ(with(waiting({"BLINK", "BLINK"})), "task 'BLINK' waits twice");
  EXPECT_EQ(with(waiting({"LAND"})), "task 'LAND' waits, but does not start reactively");
  EXPECT_EQ(with(waiting({"LIGHT"})), "task 'LIGHT' waits, but runs");
}

TEST_F(Inconsistency, OfConstraints) {
  run("LAND", "land", 99 * second);
  request(4);
  EXPECT_NE(find_inconsistency(catalog, snapshot), std::nullopt) << "FLY excludes LAND";
  snapshot.running.pop_back();
  snapshot.active.pop_back();
  snapshot.running.pop_back();
  snapshot.active.pop_back();
  EXPECT_NE(find_inconsistency(catalog, snapshot), std::nullopt) << "fly requires LIGHT";
}

TEST_F(Inconsistency, OfConstraintsInEachGroup) {
  run("ROLL", "roll", 99 * second);
  request(4);
  EXPECT_EQ(find_inconsistency(catalog, snapshot), std::nullopt);
  run("SIT", "sit", 99 * second);
  request(5);
  EXPECT_NE(find_inconsistency(catalog, snapshot), std::nullopt);
}

TEST_F(Inconsistency, TheFirstOneIsTold) {
  EXPECT_EQ(with([](Snapshot& state) {
              state.now = -1;
              state.events = UINT64_MAX;
            }),
            "its time is not between 0 and 1000000000 s");
}

}  // namespace
}  // namespace cbc::inconsistency_test
