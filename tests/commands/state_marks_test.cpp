#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/script/runner.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/state_recorder.h"
#include "unit/compiled_fixture.h"
#include "unit/random_mission.h"

namespace cbc::state_marks_test {
namespace {

using draw::CatalogGraph;
using draw::Mark;

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
  void on_event(const ExplainedRecord& record, const Step* /*step*/, const State& state) override {
    Moment& moment = moments.emplace_back();
    moment.time = record.time;
    for (TaskId task(0); task < catalog_.tasks.size(); ++task) {
      moment.assignment.push_back(state.value_index(task));
      moment.priorities.emplace_back();
      if (state.has_request(task)) moment.priorities.back() = state.request(task).priority;
    }
    for (BehaviorId behavior(0); behavior < catalog_.behaviors.size(); ++behavior) {
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
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
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
  for (BehaviorId behavior(0); behavior < catalog.behaviors.size(); ++behavior) {
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
