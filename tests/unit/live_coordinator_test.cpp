#include "cbc/live_coordinator.h"

#include <array>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "unit/allocations.h"
#include "unit/compiled_fixture.h"
#include "unit/loaded_fixture.h"
#include "unit/random_mission.h"

namespace cbc::live_coordinator_test {
namespace {

using test::RandomMission;

std::string to_text(std::optional<std::int32_t> number) {
  return number ? " " + std::to_string(*number) : "";
}

bool is_about(VerbForm::SubjectKind kind, Verb verb) { return form_of(verb).subject == kind; }

/// "4080000 reactive start HOVER 0 accepted: +hover(HOVER) reactive 0, …; BLINK interrupted".
std::string show(const LoadedCatalog& catalog, const HandledEvent& event) {
  std::string text = std::to_string(event.time) + " " + std::string(name_of(event.origin)) + " " +
                     std::string(name_of(event.verb));
  if (is_about(VerbForm::SubjectKind::task, event.verb)) {
    text += " " + std::string(catalog.task_name(event.subject)) + to_text(event.priority);
  }
  if (is_about(VerbForm::SubjectKind::behavior, event.verb)) {
    text += " " + std::string(catalog.behavior_name(event.subject));
  }
  if (event.verb == Verb::finish) text += " " + std::string(name_of(event.cause));
  text += " " + std::string(name_of(event.outcome));
  for (const BehaviorChange& change : event.changes) {
    text += (change.is_activation ? " +" : " -") +
            std::string(catalog.behavior_name(change.behavior)) + "(";
    for (const std::uint32_t task : change.tasks)
      text += std::string(catalog.task_name(task)) + " ";
    text += ") " + std::string(name_of(change.cause)) + to_text(change.priority) +
            (change.success ? "" : " failed") + ",";
  }
  for (const TaskStop& stop : event.stopped_tasks) {
    text +=
        "; " + std::string(catalog.task_name(stop.task)) + " " + std::string(name_of(stop.cause));
  }
  return text + (event.is_proven ? "" : " not proven");
}

std::string show(const LoadedCatalog& catalog, std::span<const HandledEvent> events) {
  std::string text;
  for (const HandledEvent& event : events) text += show(catalog, event) + "\n";
  return text;
}

std::string running(const LoadedCatalog& catalog, const LiveCoordinator& coordinator) {
  std::string text;
  for (std::uint32_t task = 0; task < catalog.task_count(); ++task) {
    const std::optional<std::uint32_t> behavior = coordinator.behavior_of(task);
    if (!behavior) continue;
    text += std::string(catalog.task_name(task)) + "=" +
            std::string(catalog.behavior_name(*behavior)) + " ";
  }
  return text;
}

Event start(std::uint32_t task, std::int32_t priority = 1) {
  Event event;
  event.verb = Verb::start;
  event.subject = task;
  event.priority = priority;
  return event;
}

// In groups the tasks stand as MOVE, HOVER, LOCALIZE | BLINK.
constexpr const char* robot = R"(
tasks:
- {task: MOVE, timeout: 5}
- {task: BLINK}
- {task: HOVER, reactive_start: true, start_on_request: false}
- {task: LOCALIZE, start_on_request: false}
behaviors:
- {behavior: lamp, task: BLINK}
- {behavior: move, task: MOVE, requires: [{task: LOCALIZE}]}
- {behavior: hover, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: gps, task: LOCALIZE}
- {behavior: camera, task: LOCALIZE, suitability: 80}
exclusivity_constraints:
- mutually_exclusive: [MOVE, HOVER]
)";
enum Task : std::uint32_t { moving, blinking, hovering, localizing };
enum Behavior : std::uint32_t { lamp, move, hover, gps, camera };

class LiveCoordinatorTest : public testing::Test {
 protected:
  [[nodiscard]] std::string happened() const { return show(catalog, coordinator.events()); }

  LoadedCatalog catalog = test::load_text(robot);
  LiveCoordinator coordinator{catalog};
};

TEST_F(LiveCoordinatorTest, BeginsWithNothing) {
  EXPECT_EQ(coordinator.now(), 0);
  EXPECT_EQ(coordinator.next_due(), 80'000) << "HOVER could start";
  EXPECT_TRUE(coordinator.events().empty());
  EXPECT_EQ(running(catalog, coordinator), "");
  EXPECT_EQ(coordinator.internal_error(), "");
}

TEST_F(LiveCoordinatorTest, TellsWhatChangesInOrder) {
  EXPECT_EQ(coordinator.handle(1000, start(moving, 3)), LiveStatus::ok);
  EXPECT_EQ(happened(),
            "1000 script start MOVE 3 accepted +gps(LOCALIZE ) required, "
            "+move(MOVE ) requested 3,\n");
  EXPECT_EQ(running(catalog, coordinator), "MOVE=move LOCALIZE=gps ");
  EXPECT_EQ(coordinator.now(), 1000);
  EXPECT_EQ(coordinator.next_due(), 5'001'000) << "the timeout of MOVE; HOVER left the queue";
  EXPECT_EQ(coordinator.behavior_of(moving), move);
  EXPECT_EQ(coordinator.behavior_of(localizing), gps);
  EXPECT_EQ(coordinator.behavior_of(hovering), std::nullopt);
  EXPECT_EQ(coordinator.behavior_of(4), std::nullopt);
  EXPECT_EQ(coordinator.behavior_of(UINT32_MAX), std::nullopt);
}

TEST_F(LiveCoordinatorTest, ParametersAreNotReferredToAfterTheCall) {
  std::string parameters(100, 'p');
  Event event = start(moving);
  event.parameters = parameters;
  ASSERT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  parameters.assign(100, 'q');
  ASSERT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  EXPECT_EQ(happened(),
            "0 script start MOVE 1 accepted -move(MOVE ) restarted 1, +move(MOVE ) restarted 1,\n");
  ASSERT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  EXPECT_TRUE(coordinator.events().front().changes.empty()) << "the same parameters";
}

TEST_F(LiveCoordinatorTest, OutlivesTheCatalogItWasMadeWith) {
  std::optional<LoadedCatalog> other = test::load_text(robot);
  LiveCoordinator last(*other);
  other.reset();
  EXPECT_EQ(last.handle(0, start(moving)), LiveStatus::ok);
  EXPECT_EQ(last.behavior_of(moving), move);
}

// Events that are refused ------------------------------------------------------------------------

TEST_F(LiveCoordinatorTest, TimeIsRefusedThatGoesBackOrTooFar) {
  const Event wait;
  ASSERT_EQ(coordinator.handle(second, wait), LiveStatus::ok);
  for (const Microseconds time :
       {second - 1, Microseconds{0}, Microseconds{-1}, INT64_MIN, longest_time + 1, INT64_MAX}) {
    EXPECT_EQ(coordinator.handle(time, wait), LiveStatus::invalid_time) << time;
    EXPECT_EQ(coordinator.advance_to(time), LiveStatus::invalid_time) << time;
    EXPECT_EQ(coordinator.now(), second);
  }
  EXPECT_EQ(coordinator.advance_to(second), LiveStatus::ok);
  EXPECT_EQ(coordinator.advance_to(longest_time), LiveStatus::ok);
  EXPECT_EQ(coordinator.handle(longest_time, start(moving)), LiveStatus::ok);
  EXPECT_EQ(coordinator.next_due(), longest_time + 5 * second) << "it never comes";
}

TEST_F(LiveCoordinatorTest, SubjectsAreRefusedThatTheCatalogDoesNotHave) {
  for (const Verb verb : {Verb::start, Verb::stop}) {
    Event event;
    event.verb = verb;
    for (const std::uint32_t subject : {4U, 5U, UINT32_MAX}) {
      event.subject = subject;
      EXPECT_EQ(coordinator.handle(0, event), LiveStatus::unknown_task);
    }
    event.subject = 3;
    EXPECT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  }
  for (const Verb verb : {Verb::finish, Verb::fault, Verb::repair}) {
    Event event;
    event.verb = verb;
    for (const std::uint32_t subject : {5U, UINT32_MAX}) {
      event.subject = subject;
      EXPECT_EQ(coordinator.handle(0, event), LiveStatus::unknown_behavior);
    }
    event.subject = 4;
    EXPECT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  }
}

TEST_F(LiveCoordinatorTest, PrioritiesAreRefusedBelowTheLeast) {
  for (const std::int32_t priority : {0, -1, INT32_MIN}) {
    EXPECT_EQ(coordinator.handle(0, start(moving, priority)), LiveStatus::invalid_priority);
  }
  EXPECT_EQ(coordinator.handle(0, start(moving, INT32_MAX)), LiveStatus::ok);
  Event stop;
  stop.verb = Verb::stop;
  stop.subject = moving;
  stop.priority = -1;
  EXPECT_EQ(coordinator.handle(0, stop), LiveStatus::invalid_priority);
  stop.priority = 0;
  EXPECT_EQ(coordinator.handle(0, stop), LiveStatus::ok);
  EXPECT_EQ(coordinator.events().front().outcome, Outcome::rejected);
  stop.priority = INT32_MAX;
  EXPECT_EQ(coordinator.handle(0, stop), LiveStatus::ok);
  EXPECT_EQ(coordinator.events().front().outcome, Outcome::accepted);
}

TEST_F(LiveCoordinatorTest, EnumeratorsAreRefusedThatAreNone) {
  Event event;
  for (const std::size_t verb : {verb_forms.size(), std::size_t{255}}) {
    event.verb = static_cast<Verb>(verb);
    EXPECT_EQ(coordinator.handle(0, event), LiveStatus::invalid_verb) << verb;
  }
  event.verb = Verb::finish;
  for (const int cause : {6, 255}) {
    event.cause = static_cast<FinishCause>(cause);
    EXPECT_EQ(coordinator.handle(0, event), LiveStatus::invalid_cause) << cause;
  }
  event.verb = Verb::stop;
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::ok) << "a stop has no cause";
}

TEST_F(LiveCoordinatorTest, LengthsWithoutAContentAreRefused) {
  Event event = start(moving);
  event.parameters = std::string_view(nullptr, 3);
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::invalid_parameters);
  event.parameters = std::string_view();
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::ok) << "an empty text needs no content";
  event = {};
  event.verb = Verb::situation;
  event.situation = {static_cast<const Availability*>(nullptr), 2};
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::invalid_situation);
}

TEST_F(LiveCoordinatorTest, ASituationIsRefusedAsAWhole) {
  const std::array situation{Availability{gps, false}, Availability{5, true}};
  Event event;
  event.verb = Verb::situation;
  event.situation = situation;
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::unknown_behavior);
  EXPECT_EQ(coordinator.handle(0, start(moving)), LiveStatus::ok);
  EXPECT_EQ(coordinator.behavior_of(localizing), gps) << "it is still available";
}

constexpr const char* lit_by_day = R"(behaviors:
- {behavior: camera, task: SEE, situation: {LIGHT: [day, dusk]}}
- {behavior: lidar, task: SEE, suitability: 60, situation: {DRY: true}}
situation:
- {variable: LIGHT, values: [day, dusk, night]}
- {variable: DRY}
)";

TEST(LiveSituation, VariablesHaveNamesAndValues) {
  const LoadedCatalog catalog = test::load(test::compile_text(lit_by_day));
  EXPECT_EQ(catalog.variable_count(), 2U);
  EXPECT_EQ(catalog.variable_name(0), "LIGHT");
  EXPECT_EQ(catalog.value_count(0), 3U);
  EXPECT_EQ(catalog.value_name({0, 2}), "night");
  EXPECT_EQ(catalog.value_name({1, 0}), "true");
  EXPECT_EQ(catalog.find_variable("DRY"), 1U);
  EXPECT_EQ(catalog.find_value(0, "dusk"), 1U);
  // Of what there is not.
  EXPECT_EQ(catalog.variable_name(2), "");
  EXPECT_EQ(catalog.value_count(2), 0U);
  EXPECT_EQ(catalog.value_name({0, 3}), "");
  EXPECT_EQ(catalog.value_name({2, 0}), "");
  EXPECT_EQ(catalog.find_variable("WET"), std::nullopt);
  EXPECT_EQ(catalog.find_value(0, "true"), std::nullopt);
  EXPECT_EQ(catalog.find_value(2, "day"), std::nullopt);
}

TEST(LiveSituation, VariablesAreSetAndBehaviorsFinish) {
  const LoadedCatalog catalog = test::load(test::compile_text(lit_by_day));
  LiveCoordinator coordinator(catalog);
  EXPECT_EQ(coordinator.value_of(0), 0U);
  EXPECT_EQ(coordinator.value_of(2), std::nullopt);
  Event event;
  event.verb = Verb::start;
  EXPECT_EQ(coordinator.handle(0, event), LiveStatus::ok);
  EXPECT_EQ(coordinator.behavior_of(0), 0U);

  std::vector<VariableValue> values{{0, 3}};
  event = {};
  event.verb = Verb::situation;
  event.variables = values;
  EXPECT_EQ(coordinator.handle(1, event), LiveStatus::unknown_value);
  values = {{0, 2}, {2, 0}};
  event.variables = values;
  EXPECT_EQ(coordinator.handle(1, event), LiveStatus::unknown_variable);
  EXPECT_EQ(coordinator.value_of(0), 0U) << "a refused event changes nothing";
  event.variables = {static_cast<const VariableValue*>(nullptr), 1};
  EXPECT_EQ(coordinator.handle(1, event), LiveStatus::invalid_situation);

  values = {{0, 2}};
  event.variables = values;
  EXPECT_EQ(coordinator.handle(1, event), LiveStatus::ok);
  EXPECT_EQ(coordinator.value_of(0), 2U);
  EXPECT_EQ(show(catalog, coordinator.events()),
            "1 script situation unchanged\n"
            "1 situation finish camera situation_change accepted +lidar(SEE ) requested 1,\n");
}

TEST(LiveSituation, AFinishMayNameATask) {
  const LoadedCatalog catalog = test::load(test::compile_text(lit_by_day));
  LiveCoordinator coordinator(catalog);
  Event finish;
  finish.verb = Verb::finish;
  finish.is_by_task = true;
  EXPECT_EQ(coordinator.handle(0, finish), LiveStatus::ok);
  ASSERT_EQ(coordinator.events().size(), 1U);
  EXPECT_EQ(coordinator.events()[0].subject, no_subject);
  EXPECT_EQ(coordinator.events()[0].outcome, Outcome::unchanged);
  Event start;
  start.verb = Verb::start;
  EXPECT_EQ(coordinator.handle(1, start), LiveStatus::ok);
  EXPECT_EQ(coordinator.handle(2, finish), LiveStatus::ok);
  EXPECT_EQ(show(catalog, coordinator.events()),
            "2 script finish camera goal_achieved accepted; SEE goal_achieved\n");
  finish.subject = 1;
  EXPECT_EQ(coordinator.handle(3, finish), LiveStatus::unknown_task);
}

TEST(LiveStatusNames, AreThoseOfTheEnumerators) {
  EXPECT_EQ(name_of(LiveStatus::ok), "ok");
  EXPECT_EQ(name_of(LiveStatus::invalid_situation), "invalid_situation");
  EXPECT_EQ(name_of(LiveStatus::unknown_task), "unknown_task");
  EXPECT_EQ(name_of(LiveStatus::unknown_behavior), "unknown_behavior");
  EXPECT_EQ(name_of(LiveStatus::unknown_variable), "unknown_variable");
  EXPECT_EQ(name_of(LiveStatus::unknown_value), "unknown_value");
  EXPECT_EQ(name_of(LiveStatus::too_many_events), "too_many_events");
  EXPECT_EQ(name_of(LiveStatus::internal_error), "internal_error");
}

/// Numbers at the edges of all ranges, and small ones.
std::int64_t any_number(test::Random& random) {
  static const std::vector<std::int64_t> edges{INT64_MIN,    INT32_MIN,  -1,
                                               INT32_MAX,    UINT32_MAX, INT64_MAX,
                                               longest_time, 255,        longest_time + 1};
  return random.percent(15) ? random.pick(edges) : random.between(0, 12);
}

TEST(LiveCoordinator, StandsAnyEvent) {
  test::Random random(12);
  std::uint64_t handled = 0;
  std::uint64_t refused = 0;
  for (int round = 0; round < 30; ++round) {
    const CompiledCatalog compiled = test::restless_catalog(random, 10);
    const LoadedCatalog catalog = test::load(compiled);
    LiveCoordinator coordinator(catalog);
    Microseconds time = 0;
    for (int i = 0; i < 300; ++i) {
      std::vector<Availability> situation(random.below(3));
      for (Availability& entry : situation) {
        entry.behavior = static_cast<std::uint32_t>(any_number(random));
        entry.available = random.percent(50);
      }
      Event event;
      event.verb = static_cast<Verb>(any_number(random));
      event.subject = static_cast<std::uint32_t>(any_number(random));
      if (random.percent(50)) event.priority = static_cast<std::int32_t>(any_number(random));
      if (random.percent(50)) event.parameters = std::string_view("parameters", random.below(10));
      event.cause = static_cast<FinishCause>(any_number(random));
      event.situation = situation;
      const bool is_timely = random.percent(95);
      const Microseconds before = coordinator.now();
      const std::string state = running(catalog, coordinator);
      time = before + random.between(0, second / 10);
      const LiveStatus status =
          coordinator.handle(is_timely ? time : -1 - random.between(0, second), event);
      if (status == LiveStatus::ok) {
        ++handled;
        ASSERT_EQ(coordinator.now(), time);
        ASSERT_FALSE(coordinator.events().empty());
      } else {
        ++refused;
        ASSERT_EQ(coordinator.now(), before) << name_of(status);
        ASSERT_TRUE(coordinator.events().empty()) << name_of(status);
        ASSERT_EQ(running(catalog, coordinator), state) << name_of(status);
      }
    }
  }
  EXPECT_GT(handled, 1'000U);
  EXPECT_GT(refused, 1'000U);
}

// Options and limits -----------------------------------------------------------------------------

TEST(LiveOptions, OutOfRangeCountAsTheNearestValue) {
  const LoadedCatalog catalog = test::load_text(robot);
  const auto due = [&](Microseconds delay) {
    LiveOptions options;
    options.reactive_delay = delay;
    return LiveCoordinator(catalog, options).next_due();
  };
  EXPECT_EQ(due(250), 250);
  EXPECT_EQ(due(0), 1);
  EXPECT_EQ(due(INT64_MIN), 1);
  EXPECT_EQ(due(INT64_MAX), longest_time);
  for (const Microseconds limit : {INT64_MIN, Microseconds{-1}, longest_time, INT64_MAX}) {
    LiveOptions options;
    options.time_limit = limit;
    LiveCoordinator coordinator(catalog, options);
    EXPECT_EQ(coordinator.handle(0, start(moving)), LiveStatus::ok);
    ASSERT_EQ(coordinator.events().front().outcome, Outcome::accepted) << limit;
    EXPECT_TRUE(coordinator.events().front().is_proven) << limit;
  }
}

TEST(LiveOptions, WhatALimitStopsIsNotProven) {
  // Two decisions are needed, one for each way to localize.
  const LoadedCatalog catalog = test::load_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b1, task: B, suitability: 90}
- {behavior: b2, task: B, suitability: 80}
- {behavior: c1, task: C, suitability: 90}
- {behavior: c2, task: C, suitability: 80}
)");
  LiveOptions options;
  options.max_nodes = 1;
  LiveCoordinator limited(catalog, options);
  EXPECT_EQ(limited.handle(0, start(0)), LiveStatus::ok);
  EXPECT_FALSE(limited.events().front().is_proven);
  LiveCoordinator unlimited(catalog);
  EXPECT_EQ(unlimited.handle(0, start(0)), LiveStatus::ok);
  EXPECT_TRUE(unlimited.events().front().is_proven);
  EXPECT_EQ(unlimited.events().front().outcome, Outcome::accepted);
}

TEST(LiveCoordinator, ACallReportsSoManyEventsAndTheNextGoesOn) {
  // H and G take turns, each for as long as its timeout.
  const LoadedCatalog catalog = test::load_text(R"(
tasks:
- {task: H, reactive_start: true, timeout: 1}
- {task: G, reactive_start: true, timeout: 1}
- {task: X}
behaviors:
- {behavior: h, task: H}
- {behavior: g, task: G}
- {behavior: x, task: X}
exclusivity_constraints:
- mutually_exclusive: [G, H]
)");
  // An event and its timeout take 1.08 s.
  constexpr Microseconds of_two = 1'080'000;
  constexpr Microseconds most = of_two * (LiveCoordinator::most_events / 2);
  LiveCoordinator coordinator(catalog);
  EXPECT_EQ(coordinator.advance_to(most), LiveStatus::ok);
  EXPECT_EQ(coordinator.events().size(), LiveCoordinator::most_events);

  EXPECT_EQ(coordinator.handle(3 * most + 1, start(2)), LiveStatus::too_many_events);
  EXPECT_EQ(coordinator.events().size(), LiveCoordinator::most_events);
  EXPECT_EQ(coordinator.behavior_of(2), std::nullopt) << "the event was not handled";
  EXPECT_EQ(coordinator.now(), 2 * most) << "the last event";
  EXPECT_EQ(coordinator.next_due(), 2 * most + 80'000);
  EXPECT_EQ(coordinator.handle(3 * most + 1, start(2)), LiveStatus::ok);
  EXPECT_EQ(coordinator.events().size(), LiveCoordinator::most_events + 1);
  EXPECT_EQ(coordinator.behavior_of(2), 2U);
}

// Random missions --------------------------------------------------------------------------------

/// Shows the records of a coordinator as the public interface should.
class Transcript final : public EventListener {
 public:
  Transcript(const CompiledCatalog& catalog, std::string& text) : catalog_(catalog), text_(text) {}

  void on_event(const EventRecord& record) override {
    text_ += std::to_string(record.time) + " " + std::string(name_of(record.origin)) + " " +
             std::string(name_of(record.verb));
    if (record.task != none) text_ += " " + task(record.task) + to_text(record.priority);
    if (record.behavior != none) text_ += " " + behavior(record.behavior);
    if (record.verb == Verb::finish) text_ += " " + std::string(name_of(record.cause));
    text_ += " " + std::string(name_of(record.outcome));
    for (const Change& change : record.changes) {
      text_ += (change.is_activation ? " +" : " -") + behavior(change.behavior) + "(";
      for (const TaskId id : record.tasks_of(change)) text_ += task(id) + " ";
      text_ += ") " + std::string(name_of(change.cause)) + to_text(change.priority) +
               (change.success ? "" : " failed") + ",";
    }
    for (const StoppedTask& stopped : record.stopped_tasks) {
      text_ += "; " + task(stopped.task) + " " + std::string(name_of(stopped.cause));
    }
    text_ += "\n";
  }

 private:
  [[nodiscard]] std::string task(TaskId id) const { return std::string(catalog_.name_of_task(id)); }
  [[nodiscard]] std::string behavior(BehaviorId id) const {
    return std::string(catalog_.name_of_behavior(id));
  }

  const CompiledCatalog& catalog_;
  std::string& text_;
};

TEST(LiveCoordinator, TellsAllThatTheCoordinatorDoes) {
  test::Random random(7);
  std::size_t events = 0;
  for (int round = 0; round < 20; ++round) {
    const CompiledCatalog compiled =
        test::restless_catalog(random, static_cast<std::uint32_t>(random.between(2, 20)));
    const RandomMission mission(random, compiled, 200);
    std::string expected;
    Transcript transcript(compiled, expected);
    Coordinator internal(compiled, {}, transcript);
    internal.begin({});

    const LoadedCatalog catalog = test::load(compiled);
    LiveCoordinator coordinator(catalog);
    for (const RandomMission::Step& step : mission.steps()) {
      expected.clear();
      ASSERT_EQ(internal.advance_to(step.time), Coordinator::Status::ok);
      ASSERT_EQ(internal.handle(step.event), Coordinator::Status::ok);
      ASSERT_EQ(coordinator.handle(step.time, step.event), LiveStatus::ok);
      ASSERT_EQ(show(catalog, coordinator.events()), expected);
      events += coordinator.events().size();
    }
  }
  EXPECT_GT(events, 20U * 200U + 1'000U) << "the clock has its own";
}

TEST(LiveCoordinator, AllocatesNothingOnEventsThatWereThereBefore) {
  test::Random random(9);
  for (int round = 0; round < 8; ++round) {
    const CompiledCatalog compiled =
        test::restless_catalog(random, static_cast<std::uint32_t>(random.between(3, 30)));
    const RandomMission mission(random, compiled, 1'000);
    LiveCoordinator coordinator(test::load(compiled));
    std::size_t changes = 0;
    std::uint64_t allocated = 0;
    for (int pass = 0; pass < 3; ++pass) {
      const Microseconds begin = coordinator.now() + second;
      changes = 0;
      const std::uint64_t before = test::allocations();
      for (const RandomMission::Step& step : mission.steps()) {
        ASSERT_EQ(coordinator.handle(begin + step.time, step.event), LiveStatus::ok);
        for (const HandledEvent& event : coordinator.events()) changes += event.changes.size();
      }
      allocated = test::allocations() - before;
      ASSERT_EQ(coordinator.next_due(), std::nullopt);
    }
    EXPECT_EQ(allocated, 0U) << "round " << round;
    EXPECT_GT(changes, 100U);
  }
}

TEST(LiveCoordinator, SeveralShareACatalogInSeveralThreads) {
  test::Random random(3);
  const CompiledCatalog compiled = test::restless_catalog(random, 20);
  const RandomMission mission(random, compiled, 300);
  const LoadedCatalog catalog = test::load(compiled);
  std::array<std::string, 4> told;
  std::vector<std::thread> threads;
  threads.reserve(told.size());
  for (std::string& mine : told) {
    threads.emplace_back([&mine, &mission, catalog] {
      LiveCoordinator coordinator(catalog);
      for (const RandomMission::Step& step : mission.steps()) {
        mine += name_of(coordinator.handle(step.time, step.event));
        mine += show(catalog, coordinator.events());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(told.front().size(), 10'000U);
  for (const std::string& other : told) EXPECT_EQ(other, told.front());
}

TEST(LiveCoordinator, OfAnEmptyCatalogRefusesAllButWaiting) {
  LiveCoordinator coordinator(test::load_text("behaviors: []"));
  EXPECT_EQ(coordinator.handle(0, start(0)), LiveStatus::unknown_task);
  EXPECT_EQ(coordinator.handle(second, Event{}), LiveStatus::ok);
  EXPECT_EQ(coordinator.advance_to(longest_time), LiveStatus::ok);
  EXPECT_EQ(coordinator.next_due(), std::nullopt);
  EXPECT_EQ(coordinator.behavior_of(0), std::nullopt);
}

}  // namespace
}  // namespace cbc::live_coordinator_test
