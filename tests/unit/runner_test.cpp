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

/// A run as text, one line for each event and each failure, and what it comes to.
class Protocol final : public RunListener {
 public:
  explicit Protocol(std::string_view script, const CoordinatorOptions& options = {})
      : catalog_(test::compile_text(catalog_text)) {
    Diagnostics diagnostics;
    const auto document = yaml::parse(script, "s.yaml", diagnostics);
    const auto read = document != nullptr
                          ? read_script(*document, catalog_, Severity::warning, diagnostics)
                          : std::optional<Script>{};
    EXPECT_TRUE(read.has_value()) << show(diagnostics);
    result = run_script(catalog_, read.value_or(Script{}), options, *this);
    text += "end " + std::to_string(result.passed) + " " + std::to_string(result.failed);
  }

  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    text += std::to_string(record.index) + " " + std::to_string(record.time / 1'000) + " " +
            std::string(name_of(record.origin)) + " " + std::string(name_of(record.verb)) + " " +
            (record.verb == Verb::finish ? std::string(name_of(record.cause)) + " " : "") +
            std::string(name_of(record.outcome)) +
            (step != nullptr ? " line " + std::to_string(step->range.begin.line) : "") +
            " running " + std::to_string(state.running().size()) + "\n";
  }
  void on_failure(const Failure& failure) override {
    text += "failure after " + std::to_string(failure.index) + " line " +
            std::to_string(failure.range.begin.line) + ": " + failure.message + "\n";
  }
  void on_end(const State& state) override {
    text += "last running " + std::to_string(state.running().size()) + "\n";
  }

  std::string text;
  RunResult result;

 private:
  CompiledCatalog catalog_;
};

TEST(Runner, AnEmptyScriptEndsAtZero) { EXPECT_EQ(Protocol("[]").text, "last running 0\nend 0 0"); }

TEST(Runner, WhatIsDueAtTheLastInstantIsProcessedAtTheEnd) {
  EXPECT_EQ(Protocol("[{at: 0.08}]").text,
            "1 80 script wait unchanged line 1 running 0\n"
            "2 80 reactive start accepted running 1\n"
            "last running 1\nend 0 0")
      << "scripted events come first";
}

TEST(Runner, WhatIsDueBetweenTwoInstantsComesBetween) {
  EXPECT_EQ(Protocol("[{start: A}, {wait: 6}]").text,
            "1 0 script start accepted line 1 running 1\n"
            "2 5000 timeout finish time_out accepted running 0\n"
            "3 5080 reactive start accepted running 1\n"
            "4 6000 script wait unchanged line 1 running 1\n"
            "last running 1\nend 0 0");
}

TEST(Runner, WhatIsDueLaterNeverHappens) {
  EXPECT_EQ(Protocol("[{start: A}, {at: 4.999999}]").text,
            "1 0 script start accepted line 1 running 1\n"
            "2 4999 script wait unchanged line 1 running 1\n"
            "last running 1\nend 0 0");
}

TEST(Runner, ExpectationsSeeTheStateBeforeWhatIsDueAtTheirInstant) {
  EXPECT_EQ(Protocol(R"(- start: A
- at: 5
  expect: {running: {A: a}}
- at: 5
  expect: {stopped: [A]}
- at: 5.000001
  expect: {stopped: [A]}
)")
                .text,
            "1 0 script start accepted line 1 running 1\n"
            "failure after 1 line 4: expected task 'A' not to run, but it runs with 'a'\n"
            "2 5000 timeout finish time_out accepted running 0\n"
            "last running 0\nend 2 1");
}

TEST(Runner, OutcomesAreThoseOfTheLastScriptedStartStopOrFinish) {
  const Protocol protocol(R"(
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
  EXPECT_EQ(protocol.result.passed, 4U);
  EXPECT_EQ(protocol.result.failed, 1U);
  EXPECT_EQ(protocol.text.substr(0, protocol.text.find('\n')),
            "failure after 0 line 2: expected outcome 'accepted', but there was no start, stop or "
            "finish yet");
}

/// Keeps the failures only.
struct Silent final : RunListener {
  void on_event(const EventRecord& /*record*/, const Step* /*step*/,
                const State& /*state*/) override {}
  void on_failure(const Failure& failure) override { failed_after.push_back(failure.index); }
  void on_end(const State& /*state*/) override {}
  std::vector<std::uint64_t> failed_after;
};

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
  Diagnostics diagnostics;
  const auto document = yaml::parse(R"(
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
)",
                                    "s.yaml", diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  ASSERT_TRUE(script) << show(diagnostics);

  Silent listener;
  Runner runner(catalog, {}, listener);
  runner.begin({});
  std::vector<Snapshot> snapshots{runner.snapshot()};
  for (const Step& step : script->steps) {
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
  Diagnostics diagnostics;
  // B joins the queue first.
  const auto document =
      yaml::parse("[start: X, start: Y, stop: Y, {stop: X, at: 0.05}]", "s.yaml", diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  ASSERT_TRUE(script) << show(diagnostics);
  Silent listener;
  Runner runner(catalog, {}, listener);
  runner.begin({});
  for (const Step& step : script->steps) EXPECT_TRUE(runner.take(step));
  using Entry = std::pair<TaskId, Microseconds>;
  EXPECT_EQ(runner.snapshot().queue,
            (std::vector<Entry>{{catalog.task_ids[*catalog.find_task("A")], 130'000},
                                {catalog.task_ids[*catalog.find_task("B")], 80'000}}));
}

TEST(Runner, TakesSituationAndDelayFromTheScript) {
  EXPECT_EQ(Protocol(R"(
reactive_delay: 2
situation: {a: false}
events:
- start: A
- at: 2
)")
                .text,
            "1 0 script start rejected line 5 running 0\n"
            "2 2000 script wait unchanged line 6 running 0\n"
            "3 2000 reactive start accepted running 1\n"
            "last running 1\nend 0 0");
}

TEST(Runner, NothingTimesOutInAScriptWithoutTimeouts) {
  EXPECT_EQ(Protocol("{timeouts: false, events: [{start: A}, {at: 100}]}").text,
            "1 0 script start accepted line 1 running 1\n"
            "2 100000 script wait unchanged line 1 running 1\n"
            "last running 1\nend 0 0");
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
    void on_event(const EventRecord&, const Step*, const State&) override {}
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

TEST(Runner, PassesPrioritiesParametersAndCausesOn) {
  const Protocol protocol(R"(
- {start: A, priority: 4, parameters: {x: 1}}
- {at: 1, start: A, priority: 4, parameters: {x: 1}}
- {at: 2, start: A, priority: 4, parameters: {x: 2}}
- {start: A, priority: 3}
- expect: {outcome: rejected}
- at: 6.9
- expect: {running: {A: any}}
- at: 7.01
- expect: {stopped: [A]}
- {start: A}
- {finish: a, cause: process_failure}
- expect: {outcome: accepted, stopped: [A], active: []}
)");
  EXPECT_EQ(protocol.result.passed, 4U) << protocol.text;
  EXPECT_EQ(protocol.result.failed, 0U);
  EXPECT_NE(protocol.text.find("script finish process_failure accepted"), std::string::npos);
}

TEST(Runner, EndsEarlyAfterTooManyEventsOfTheClock) {
  CoordinatorOptions options;
  options.max_clock_events = 1;
  const Protocol protocol("[{start: A}, {at: 100}]", options);
  EXPECT_EQ(protocol.result.status, Coordinator::Status::too_many_clock_events);
  EXPECT_EQ(protocol.text.substr(0, protocol.text.find("last")),
            "1 0 script start accepted line 1 running 1\n"
            "2 5000 timeout finish time_out accepted running 0\n");
}

}  // namespace
}  // namespace cbc::runner_test
