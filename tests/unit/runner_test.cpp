#include "core/script/runner.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/script/reader.h"
#include "core/script/state_json.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::runner_test {
namespace {

constexpr const char* catalog_text = R"(
tasks:
- {task: A, timeout: 5}
- {task: H, reactive_start: true}
behaviors:
- {behavior: a, task: A}
- {behavior: h, task: H}
exclusivity_constraints:
- mutually_exclusive: [A, H]
)";

Script read(const CompiledCatalog& catalog, std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  EXPECT_TRUE(script.has_value()) << show(diagnostics);
  return script.value_or(Script{});
}

/// Keeps the failures only.
struct Silent final : RunListener {
  void on_event(const ExplainedRecord& /*record*/, const Step* /*step*/,
                const State& /*state*/) override {}
  void on_failure(const Failure& failure) override { failed_after.push_back(failure.index); }
  void on_end(const State& /*state*/) override {}
  std::vector<std::uint64_t> failed_after;
};

TEST(Runner, OutcomesAreThoseOfTheLastScriptedStartStopOrFinish) {
  const CompiledCatalog catalog = test::compile_text(catalog_text);
  const Script script = read(catalog, R"(
- expect: {outcome: accepted}
- start: A
  priority: 2
- fault: a
- wait: 1
- expect: {outcome: accepted}
- stop: A
  priority: 1
- situation: {h: false}
- expect: {outcome: rejected}
- at: 5.5
- expect: {outcome: rejected}
- finish: h
- repair: a
- expect: {outcome: unchanged}
)");
  Silent listener;
  EXPECT_EQ(run_script(catalog, script, {}, listener).passed, 4U);
  EXPECT_EQ(listener.failed_after, std::vector<std::uint64_t>{0});
}

TEST(Runner, GoesOnWithTheOutcomeOfTheLastEvent) {
  const CompiledCatalog catalog = test::compile_text(catalog_text);
  Silent listener;
  Step start;
  start.verb = Verb::start;
  Step expectation;
  expectation.expect.emplace().outcome = Outcome::accepted;
  Step wrong;
  wrong.expect.emplace().outcome = Outcome::rejected;

  Runner first(catalog, {}, listener);
  first.begin({});
  EXPECT_EQ(first.snapshot().outcome, std::nullopt);
  EXPECT_TRUE(first.take(start));
  Runner second(catalog, {}, listener);
  second.resume(first.snapshot());
  EXPECT_TRUE(second.take(expectation));
  EXPECT_EQ(second.result().passed, 1U);
  EXPECT_TRUE(second.take(wrong));
  EXPECT_EQ(listener.failed_after, std::vector<std::uint64_t>{1});
}

TEST(Runner, ResumesAnyStateWhateverCameBefore) {
  const CompiledCatalog catalog = test::compile_text(R"(
situation: [{variable: LIGHT, values: [day, night]}]
tasks:
- {task: A, timeout: 5}
- {task: B}
- {task: H, reactive_start: true}
- {task: I, reactive_start: true}
behaviors:
- {behavior: a, task: A, situation: {LIGHT: day}}
- {behavior: b, task: B}
- {behavior: h, task: H}
- {behavior: i, task: I}
exclusivity_constraints:
- mutually_exclusive: [A, H]
- mutually_exclusive: [B, I]
)");
  const Script script = read(catalog, R"(
- start: A
  priority: 3
- fault: b
- situation: {i: false}
- wait: 1
- finish: a
- situation: {LIGHT: night}
- situation: {i: true, h: false, LIGHT: day}
- repair: b
- start: B
- start: A
)");
  Silent listener;
  Runner runner(catalog, {}, listener);
  runner.begin({});
  std::vector<Snapshot> snapshots{runner.snapshot()};
  for (const Step& step : script.steps) {
    EXPECT_TRUE(runner.take(step));
    snapshots.push_back(runner.snapshot());
  }
  Runner other(catalog, {}, listener);
  for (const Snapshot& before : snapshots) {
    for (const Snapshot& snapshot : snapshots) {
      other.resume(before);
      other.resume(snapshot);
      EXPECT_EQ(write_state(catalog, other.snapshot()), write_state(catalog, snapshot));
    }
  }
}

TEST(SavedStates, ListTheQueueInCatalogOrder) {
  const CompiledCatalog catalog = test::compile_text(R"(
tasks: [{task: X}, {task: Y}, {task: A, reactive_start: true}, {task: B, reactive_start: true}]
behaviors: [{behavior: x, task: X}, {behavior: y, task: Y}, {behavior: a, task: A},
            {behavior: b, task: B}]
exclusivity_constraints: [mutually_exclusive: [X, A], mutually_exclusive: [Y, B]]
)");
  // B joins the queue first.
  const Script script = read(catalog, "[start: X, start: Y, stop: Y, {stop: X, at: 0.05}]");
  Silent listener;
  Runner runner(catalog, {}, listener);
  runner.begin({});
  for (const Step& step : script.steps) EXPECT_TRUE(runner.take(step));
  using Entry = std::pair<TaskId, Microseconds>;
  EXPECT_EQ(runner.snapshot().queue,
            (std::vector<Entry>{{catalog.task_ids[*catalog.find_task("A")], 130'000},
                                {catalog.task_ids[*catalog.find_task("B")], 80'000}}));
}

TEST(Runner, NothingTimesOutAfterAStateWithoutTimeouts) {
  const CompiledCatalog catalog = test::compile_text(catalog_text);
  CoordinatorOptions options;
  options.timeouts = false;
  Silent listener;
  Runner first(catalog, options, listener);
  first.begin({});
  Step start;
  start.verb = Verb::start;
  start.subject = catalog.find_task("A").value();
  EXPECT_TRUE(first.take(start));
  Step wait;
  wait.time = 50'000'000;
  EXPECT_TRUE(first.take(wait));
  Snapshot snapshot = first.snapshot();
  EXPECT_FALSE(snapshot.timeouts);
  EXPECT_FALSE(snapshot.running.at(0).waits_for_timeout);
  EXPECT_EQ(find_inconsistency(catalog, snapshot), std::nullopt);

  const StateReading reading = read_state(write_state(catalog, snapshot), catalog);
  ASSERT_TRUE(reading.snapshot) << reading.error;
  EXPECT_FALSE(reading.snapshot->timeouts);
  Runner second(catalog, options, listener);
  second.resume(*reading.snapshot);
  wait.time = 100'000'000;
  EXPECT_TRUE(second.take(wait));
  EXPECT_TRUE(second.settle());
  EXPECT_EQ(second.snapshot().running.size(), 1U);

  snapshot.running.at(0).waits_for_timeout = true;
  EXPECT_EQ(find_inconsistency(catalog, snapshot), "task 'A' cannot wait for a timeout");
}

/// What a state lists are sets: a repetition was not written by a coordinator.
TEST(Runner, RefusesRepetitionsInASavedState) {
  const CompiledCatalog catalog = test::compile_text(R"(
behaviors:
- {behavior: a, task: A, situation: {DARK: false}}
situation:
- {variable: DARK}
)");
  class : public RunListener {
    void on_event(const ExplainedRecord&, const Step*, const State&) override {}
  } nobody;
  Runner runner(catalog, {}, nobody);
  runner.begin({});
  const std::string state = write_state(catalog, runner.snapshot());
  ASSERT_EQ(read_state(state, catalog).error, "");
  const auto error_with = [&](std::string_view place, std::string_view added) {
    std::string damaged = state;
    const std::size_t at = damaged.find(place);
    if (at == std::string::npos) return "there is no " + std::string(place) + " in " + state;
    damaged.insert(at + place.size(), added);
    return read_state(damaged, catalog).error;
  };
  EXPECT_EQ(error_with(R"("unavailable": [)", R"("a")"), "");
  EXPECT_EQ(error_with(R"("unavailable": [)", R"("a", "a")"), "behavior 'a' is unavailable twice");
  EXPECT_EQ(error_with(R"("faulty": [)", R"("a", "a")"), "behavior 'a' is faulty twice");
  EXPECT_EQ(error_with(R"("variables": {)", R"("DARK": true,)"),
            "situation variable 'DARK' has two values");
}

}  // namespace
}  // namespace cbc::runner_test
