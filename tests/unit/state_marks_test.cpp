#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/script/reader.h"
#include "core/script/runner.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/engine/state_recorder.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"
#include "unit/random_mission.h"

namespace cbc::state_marks_test {
namespace {

using draw::CatalogGraph;
using draw::Mark;

// GO requires POWER and, by go2, SEE; WATCH starts by itself when GO does not run.
constexpr const char* catalog_text = R"(
default_values: {tasks: {execution_goal: keep_running, start_on_request: false}}
tasks:
- {task: GO, execution_goal: achieve_goal, start_on_request: true, timeout: 5}
- {task: POWER}
- {task: SEE}
- {task: WATCH, reactive_start: true}
behaviors:
- {behavior: go1, task: GO, requires: [{task: POWER}]}
- {behavior: go2, task: GO, suitability: 80, requires: [{task: POWER}, {task: SEE}]}
- {behavior: battery, tasks: [{task: POWER}, {task: SEE, suitability: 10}]}
- {behavior: camera, task: SEE}
- {behavior: watch, task: WATCH}
exclusivity_constraints:
- mutually_exclusive: [GO, WATCH]
)";

Script read(std::string_view text, const CompiledCatalog& catalog) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  if (document == nullptr) throw std::logic_error("no YAML");
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  EXPECT_TRUE(script.has_value()) << show(diagnostics);
  return script.value_or(Script{});
}

/// A run, up to the state that is wanted.
class Subject {
 public:
  Subject(std::string_view script, const WantedState& wanted, const char* catalog = catalog_text)
      : catalog_(test::compile_text(catalog)),
        script_(read(script, catalog_)),
        recorder_(catalog_, script_, wanted),
        graph_(draw::to_graph(catalog_)) {
    static_cast<void>(run_script(catalog_, script_, {}, recorder_));
    draw::mark_state(graph_, recorder_.state());
  }

  /// What is marked, or noted, a line each.
  [[nodiscard]] std::string nodes() const {
    std::string text;
    for (const auto& task : graph_.tasks) text += show(task);
    for (const auto& behavior : graph_.behaviors) text += show(behavior);
    return text;
  }
  /// The lines that are not faint.
  [[nodiscard]] std::string links() const {
    std::string text;
    for (const auto& link : graph_.performances) text += show(link, " by ", true);
    for (const auto& link : graph_.requirements) text += show(link, " requires ", false);
    return text;
  }
  [[nodiscard]] std::string caption() const {
    std::string text;
    for (const std::string& line : caption_of(recorder_.moment())) text += line + "\n";
    return text;
  }
  [[nodiscard]] const StateRecorder& recorder() const { return recorder_; }
  [[nodiscard]] const CatalogGraph& graph() const { return graph_; }

 private:
  template <typename Node>
  static std::string show(const Node& node) {
    if (node.mark == Mark::faint && node.notes.empty()) return {};
    std::string text = std::string(node.name) + ": " + std::string(name_of(node.mark));
    for (const std::string& note : node.notes) text += ", " + note;
    return text + "\n";
  }
  template <typename Link>
  [[nodiscard]] std::string show(const Link& link, const char* between, bool is_task_first) const {
    if (link.mark == Mark::faint) return {};
    const std::string task(graph_.tasks[link.task].name);
    const std::string behavior(graph_.behaviors[link.behavior].name);
    return (is_task_first ? task + between + behavior : behavior + between + task) + ": " +
           std::string(name_of(link.mark)) + "\n";
  }

  CompiledCatalog catalog_;
  Script script_;
  StateRecorder recorder_;
  CatalogGraph graph_;
};

constexpr const char* patrol = R"(
- start: GO
  priority: 2
- finish: go1
  cause: process_failure
- stop: GO
  at: 5.5
- at: 6
)";

TEST(StateMarks, WhatAnEventStartsIsNumbered) {
  const Subject subject(patrol, {1, {}});
  EXPECT_EQ(subject.caption(), "s.yaml, after event 1 at 0 s\nstart GO, priority 2: accepted\n");
  EXPECT_EQ(subject.nodes(),
            "GO: started, started, request, priority 2\n"
            "POWER: started, started, required\n"
            "go1: started, 2. activated\n"
            "battery: started, 1. activated\n");
  EXPECT_EQ(subject.links(),
            "GO by go1: started\n"
            "POWER by battery: started\n"
            "go1 requires POWER: started\n");
}

TEST(StateMarks, WhatGoesOnIsActiveAndWhatEndsIsStopped) {
  const Subject subject(patrol, {2, {}});
  EXPECT_EQ(subject.nodes(),
            "GO: active, request, priority 2\n"
            "POWER: active, required\n"
            "SEE: started, started, required\n"
            "go1: stopped, finished\n"
            "go2: started, 2. activated\n"
            "battery: active\n"
            "camera: started, 1. activated\n");
  EXPECT_EQ(subject.links(),
            "GO by go1: stopped\n"
            "GO by go2: started\n"
            "POWER by battery: active\n"
            "SEE by camera: started\n"
            "go1 requires POWER: stopped\n"
            "go2 requires POWER: started\n"
            "go2 requires SEE: started\n");
}

TEST(StateMarks, EventsOfTheClockCount) {
  const Subject timeout(patrol, {3, {}});
  EXPECT_EQ(timeout.caption(),
            "s.yaml, after event 3 at 5 s\nfinish go2, time_out (timeout): accepted\n");
  EXPECT_EQ(timeout.nodes(),
            "GO: active, request, priority 2\n"
            "POWER: active, required\n"
            "SEE: stopped, stopped\n"
            "go1: started, 2. activated\n"
            "go2: stopped, finished\n"
            "battery: active\n"
            "camera: stopped, 1. deactivated\n");
  const Subject reactive(patrol, {5, {}});
  EXPECT_EQ(reactive.caption(),
            "s.yaml, after event 5 at 5.58 s\nstart WATCH, priority 0 (reactive): accepted\n");
  EXPECT_EQ(reactive.nodes(),
            "WATCH: started, started, reactive start, priority 0\n"
            "watch: started, 1. activated\n");
}

TEST(StateMarks, ATimeIsAfterAllThatHappensAtIt) {
  const auto index_at = [](Microseconds time) {
    return Subject(patrol, {{}, time}).recorder().moment().index;
  };
  EXPECT_EQ(index_at(0), 2U);
  EXPECT_EQ(index_at(4'999'999), 2U);
  EXPECT_EQ(index_at(5'000'000), 3U);
  EXPECT_EQ(index_at(5'500'000), 4U);
  EXPECT_EQ(index_at(5'580'000), 5U);
  EXPECT_EQ(index_at(6'000'000), 6U);
  EXPECT_EQ(Subject(patrol, {}).recorder().moment().index, 6U);
  EXPECT_EQ(Subject("[{at: 2, start: GO}]", {{}, 1'999'999}).caption(),
            "s.yaml, after event 1 at 0.08 s\nstart WATCH, priority 0 (reactive): accepted\n");
}

TEST(StateMarks, TheBeginningHasItsSituation) {
  constexpr const char* script = "{situation: {camera: false, go1: true}, events: [{start: GO}]}";
  const Subject subject(script, {0, {}});
  EXPECT_EQ(subject.caption(), "s.yaml, before the first event\n");
  EXPECT_EQ(subject.nodes(), "camera: unavailable, unavailable\n");
  EXPECT_TRUE(subject.recorder().has_passed());
  EXPECT_EQ(subject.links(), "");
}

TEST(StateMarks, ThereAreOnlySoManyEvents) {
  const Subject subject(patrol, {7, {}});
  EXPECT_FALSE(subject.recorder().has_passed());
  EXPECT_EQ(subject.recorder().events(), 6U);
  EXPECT_TRUE(Subject(patrol, {6, {}}).recorder().has_passed());
}

TEST(StateMarks, ActiveBehaviorsMayBeUnavailableAndFaulty) {
  const Subject subject("[{start: GO}, {situation: {go1: false, watch: false}}, {fault: go1}]", {});
  EXPECT_EQ(subject.nodes(),
            "GO: active, request, priority 1\n"
            "POWER: active, required\n"
            "go1: active, unavailable, faulty\n"
            "battery: active\n"
            "watch: unavailable, unavailable\n");
}

TEST(StateMarks, BehaviorsThatDoNotFitSayWhy) {
  constexpr const char* with_variables = R"(
situation:
- {variable: TARGET, values: [far, near]}
- {variable: LIGHT}
behaviors:
- {behavior: see, task: LOOK, situation: {LIGHT: true}}
- {behavior: reach, task: TOUCH, situation: {TARGET: near}}
- {behavior: hear, task: LISTEN, situation: {TARGET: near}}
)";
  constexpr const char* script = R"(
situation: {hear: false}
events:
- start: LOOK
- situation: {LIGHT: false}
- situation: {TARGET: near}
)";
  const Subject before(script, {0, {}}, with_variables);
  EXPECT_EQ(before.nodes(),
            "reach: unavailable, does not fit: TARGET is far\n"
            "hear: unavailable, unavailable\n");
  EXPECT_EQ(before.caption(), "s.yaml, before the first event\nTARGET is far, LIGHT is true\n");
  const Subject after(script, {3, {}}, with_variables);  // the automatic finish
  EXPECT_EQ(after.nodes(),
            "LOOK: stopped, stopped\n"
            "see: stopped, finished, does not fit: LIGHT is false\n"
            "reach: unavailable, does not fit: TARGET is far\n"
            "hear: unavailable, unavailable\n");
  const Subject last(script, {4, {}}, with_variables);
  EXPECT_EQ(last.nodes(),
            "see: unavailable, does not fit: LIGHT is false\n"
            "hear: unavailable, unavailable\n");
}

TEST(StateMarks, FailedActivationsAreNumberedToo) {
  const Subject subject("[{fault: go1}, {start: GO}]", {});
  EXPECT_EQ(subject.nodes(),
            "GO: started, started, request, priority 1\n"
            "POWER: started, started, required\n"
            "SEE: started, started, required\n"
            "go1: unavailable, 2. activation failed, faulty\n"
            "go2: started, 4. activated\n"
            "battery: started, 1. activated\n"
            "camera: started, 3. activated\n");
}

TEST(StateMarks, ARejectionChangesNothing) {
  const Subject subject("[{situation: {battery: false}}, {start: GO}]", {});
  EXPECT_EQ(subject.caption(), "s.yaml, after event 2 at 0 s\nstart GO, priority 1: rejected\n");
  EXPECT_EQ(subject.nodes(), "battery: unavailable, unavailable\n");
}

TEST(StateMarks, ARestartedBehaviorIsStarted) {
  const Subject subject("[{start: GO}, {start: GO, parameters: {to: 1}}]", {});
  EXPECT_EQ(subject.nodes(),
            "GO: active, request, priority 1\n"
            "POWER: active, required\n"
            "go1: started, 1. deactivated, 2. activated\n"
            "battery: active\n");
  EXPECT_NE(subject.links().find("GO by go1: active\n"), std::string::npos);
}

TEST(StateMarks, OtherViewsShowWhatIsInUse) {
  const Subject subject(patrol, {2, {}});
  const auto edges = [&](draw::View view) {
    draw::ViewOptions options;
    options.view = view;
    const draw::Diagram diagram = make_diagram(subject.graph(), whole(subject.graph()), options);
    std::string text;
    for (const draw::Edge& edge : diagram.edges) {
      text += std::string(diagram.nodes[edge.from].name) + " " +
              std::string(diagram.nodes[edge.to].name) + " " +
              (edge.mark == Mark::faint ? "faint" : std::string(name_of(edge.mark))) + "\n";
    }
    return text;
  };
  EXPECT_EQ(edges(draw::View::tasks), "GO POWER active\nGO SEE started\n");
  EXPECT_EQ(edges(draw::View::behaviors),
            "go1 battery stopped\ngo2 battery started\ngo2 camera started\n");
  EXPECT_EQ(edges(draw::View::constraints),
            "GO POWER active\nGO SEE started\nPOWER SEE \nGO WATCH faint\n");
}

/// The state of a coordinator after each event, in words.
class Witness final : public RunListener {
 public:
  struct Moment {
    Microseconds time = 0;
    std::vector<std::uint32_t> assignment;                ///< by task
    std::vector<std::optional<std::int32_t>> priorities;  ///< by task
    std::vector<bool> active;                             ///< by behavior
    std::vector<Change> changes;
  };

  explicit Witness(const CompiledCatalog& catalog) : catalog_(catalog) {
    Moment& first = moments.emplace_back();
    first.assignment.assign(catalog.tasks.size(), none);
    first.priorities.resize(catalog.tasks.size());
    first.active.resize(catalog.behaviors.size());
  }
  void on_event(const EventRecord& record, const Step* /*step*/, const State& state) override {
    Moment& moment = moments.emplace_back();
    moment.time = record.time;
    for (TaskId task = 0; task < catalog_.tasks.size(); ++task) {
      moment.assignment.push_back(state.value_index(task));
      moment.priorities.emplace_back();
      if (state.has_request(task)) moment.priorities.back() = state.request(task).priority;
    }
    for (BehaviorId behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      moment.active.push_back(state.is_active(behavior));
    }
    moment.changes = record.changes;
  }
  void on_failure(const Failure& /*failure*/) override {}
  void on_end(const State& /*state*/) override {}

  std::vector<Moment> moments;  ///< the first is before all events

 private:
  const CompiledCatalog& catalog_;
};

Mark expected_mark(bool was, bool is) {
  if (was && is) return Mark::active;
  if (was) return Mark::stopped;
  return is ? Mark::started : Mark::faint;
}

void check(const CompiledCatalog& catalog, const CatalogGraph& graph, const Witness::Moment& before,
           const Witness::Moment& after) {
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    const CatalogGraph::Task& drawn = graph.tasks[catalog.tasks[task].catalog_index];
    ASSERT_EQ(drawn.mark,
              expected_mark(before.assignment[task] != none, after.assignment[task] != none));
    ASSERT_EQ(drawn.priority, after.priorities[task]);
  }
  std::vector<std::set<std::string>> numbers(catalog.behaviors.size());
  std::vector<bool> is_new(catalog.behaviors.size());
  for (std::size_t index = 0; index < after.changes.size(); ++index) {
    const Change& change = after.changes[index];
    const std::string word = change.is_activation ? ". activat" : ". deactivat";
    numbers[change.behavior].insert(std::to_string(index + 1) + word +
                                    (change.success ? "ed" : "ion failed"));
    if (change.is_activation && change.success && change.cause != ChangeCause::undone) {
      is_new[change.behavior] = true;
    }
  }
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const CatalogGraph::Behavior& drawn =
        graph.behaviors[catalog.behaviors[behavior].catalog_index];
    const bool is_active = after.active[behavior];
    const bool is_restarted = is_active && is_new[behavior];
    const Mark mark = drawn.mark == Mark::unavailable ? Mark::faint : drawn.mark;
    ASSERT_EQ(mark, expected_mark(before.active[behavior] && !is_restarted, is_active));
    std::set<std::string> numbered;
    for (const std::string& note : drawn.notes) {
      if (note.find(". ") != std::string::npos) numbered.insert(note);
    }
    ASSERT_EQ(numbered, numbers[behavior]);
  }
  for (const CatalogGraph::Performance& link : graph.performances) {
    const TaskId task = catalog.task_ids[link.task];
    const auto has = [&](const Witness::Moment& moment) {
      const std::uint32_t index = moment.assignment[task];
      return index != none &&
             catalog.values[task][index].behavior == catalog.behavior_ids[link.behavior];
    };
    ASSERT_EQ(link.mark, expected_mark(has(before), has(after)));
  }
  for (const CatalogGraph::Requirement& link : graph.requirements) {
    const BehaviorId behavior = catalog.behavior_ids[link.behavior];
    ASSERT_EQ(link.mark, expected_mark(before.active[behavior], after.active[behavior]));
  }
}

Script script_of(const test::RandomMission& mission) {
  Script script;
  script.file = "random.yaml";
  for (const test::RandomMission::Step& from : mission.steps()) {
    Step& step = script.steps.emplace_back();
    step.time = from.time;
    step.verb = from.event.verb;
    step.subject = from.event.subject;
    step.priority = from.event.priority;
    if (from.event.parameters) step.parameters = {std::string(*from.event.parameters), "{}"};
    step.cause = from.event.cause;
    step.situation.availability.assign(from.event.situation.begin(), from.event.situation.end());
  }
  return script;
}

TEST(StateMarks, AgreeWithTheCoordinator) {
  std::size_t undone = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Random random(seed);
    const CompiledCatalog catalog =
        test::restless_catalog(random, static_cast<std::uint32_t>(random.between(3, 20)));
    const test::RandomMission mission(random, catalog, 40);
    const Script script = script_of(mission);
    Witness witness(catalog);
    ASSERT_EQ(run_script(catalog, script, {}, witness).status, Coordinator::Status::ok);
    const auto& moments = witness.moments;
    for (std::uint64_t index = 0; index < moments.size(); ++index) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", event " + std::to_string(index));
      StateRecorder recorder(catalog, script, {index, {}});
      static_cast<void>(run_script(catalog, script, {}, recorder));
      ASSERT_TRUE(recorder.has_passed());
      CatalogGraph graph = draw::to_graph(catalog);
      draw::mark_state(graph, recorder.state());
      check(catalog, graph, index == 0 ? moments[0] : moments[index - 1], moments[index]);
      if (testing::Test::HasFatalFailure()) return;
      for (const Change& change : moments[index].changes) {
        undone += change.cause == ChangeCause::undone ? 1 : 0;
      }
      // The state at the time of an event is that of the last event at this time.
      const bool is_last = index + 1 == moments.size() ||
                           (index > 0 && moments[index + 1].time > moments[index].time);
      if (!is_last) continue;
      StateRecorder by_time(catalog, script, {{}, moments[index].time});
      static_cast<void>(run_script(catalog, script, {}, by_time));
      ASSERT_EQ(by_time.moment().index, index);
    }
  }
  EXPECT_GT(undone, 20U) << "the missions are too tame";
}

}  // namespace
}  // namespace cbc::state_marks_test
