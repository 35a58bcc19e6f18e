// Random catalogs and scripts: what is asked later about an event against what the event itself
// explains, which another test compares with brute force.
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "environment.h"
#include "generator.h"
#include "random.h"
#include "runtime/coordinator/coordinator.h"
#include "statistics.h"
#include "support/rounds.h"
#include "why/inquiry.h"
#include "yaml_text.h"

namespace cbc::oracle::journal_test {
namespace {

/// Runs a script, and after each event asks about all behaviors that are not active.
class Hindsight final : private EventListener {
 public:
  Hindsight(const CompiledCatalog& catalog, const CoordinatorOptions& options,
            const Questions& questions, Statistics& statistics)
      : catalog_(catalog),
        statistics_(statistics),
        inquiry_(catalog, questions),
        coordinator_(catalog, options, *this) {}

  void run(const cbc::Script& script) {
    coordinator_.begin(script.situation.availability, script.situation.variables);
    for (const Step& step : script.steps) {
      if (step.time && !is_ok(coordinator_.advance_to(*step.time))) return;
      if (step.expect) continue;
      if (!is_ok(coordinator_.handle(event_of(step)))) return;
      ask();
    }
  }

 private:
  struct Known {
    std::uint64_t event = 0;
    Why why;
  };

  [[nodiscard]] static bool is_ok(Coordinator::Status status) {
    EXPECT_EQ(status, Coordinator::Status::ok);
    return status == Coordinator::Status::ok;
  }

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const cbc::Assignment* solution) override {
    inquiry_.on_decision(record, circumstances, solution);
  }

  void on_event(const EventRecord& happened) override {
    const ExplainedRecord& record = inquiry_.on_event(happened, coordinator_.state());
    if (record.search == nullptr && record.outcome != cbc::Outcome::rejected) return;
    if (record.outcome == cbc::Outcome::accepted) {
      rejected_.erase(record.search->group);
      for (const Why& why : record.explanation.why) {
        // Of what is in the queue, it says what comes next.
        if (why.behavior != cbc::none) known_[why.behavior] = {record.index, why};
        if (why.due) known_.erase(why.behavior);
      }
    } else if (record.verb != cbc::Verb::finish) {
      rejected_[catalog_.tasks[record.task].group] = {record.index, record.task};
    }
  }

  void ask() {
    for (const auto& [behavior, known] : known_) {
      if (!known.why.is_active) ask(behavior, known);
    }
  }

  void ask(BehaviorId behavior, const Known& known) {
    std::vector<Demands> ways;
    bool is_queued = false;
    bool is_blocked = false;
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId task = catalog_.task_of(value);
      is_queued |= coordinator_.state().queue().has(catalog_.tasks[task].catalog_index);
      is_blocked |= is_blocked_start(task);
      ways.push_back({{Demand::Kind::has, task, value - catalog_.values.begin[task]}});
    }
    const GroupId group = catalog_.group_of(behavior);
    const WhyUnmet answer = inquiry_.why_unmet(coordinator_.state(), group, ways);
    ASSERT_EQ(answer.kind == WhyUnmet::Kind::blocked, is_blocked);
    if (is_blocked) {
      check_blocked(answer.blocked);
      return statistics_.count("blocked");
    }
    if (is_queued) {
      EXPECT_EQ(answer.kind, WhyUnmet::Kind::due);
      return statistics_.count("due");
    }
    if (answer.kind == WhyUnmet::Kind::rejected) {
      const auto rejected = rejected_.find(group);
      ASSERT_NE(rejected, rejected_.end());
      EXPECT_EQ(answer.event->index, rejected->second.first);
      EXPECT_FALSE(coordinator_.state().is_running(rejected->second.second));
      return statistics_.count("rejected");
    }
    ASSERT_EQ(answer.kind, WhyUnmet::Kind::decided);
    EXPECT_EQ(answer.event->index, known.event);
    compare(answer.why_not, known.why.why_not);
  }

  /// Whether only tasks that it excludes keep a reactive task from starting.
  [[nodiscard]] bool is_blocked_start(TaskId task) const {
    const cbc::State& state = coordinator_.state();
    return catalog_.tasks[task].reactive_start != 0 && !state.is_running(task) &&
           state.has_available_behavior(task) &&
           state.is_blocked(task, catalog_.rules_of(task).reactive_priority);
  }

  void check_blocked(const std::vector<BlockedStart>& blocked) const {
    for (const BlockedStart& start : blocked) {
      EXPECT_TRUE(is_blocked_start(start.task));
      EXPECT_FALSE(start.rivals.empty());
      for (const BlockedStart::Rival& rival : start.rivals) {
        const auto cliques = catalog_.task_cliques[start.task];
        EXPECT_TRUE(coordinator_.state().is_running(rival.task));
        EXPECT_TRUE(std::any_of(cliques.begin(), cliques.end(), [&](std::uint32_t clique) {
          const auto members = catalog_.cliques[clique];
          return std::find(members.begin(), members.end(), rival.task) != members.end();
        }));
      }
    }
  }

  void compare(const WhyNot& later, const WhyNot& then) {
    ASSERT_EQ(later.is_cut, then.is_cut);
    ASSERT_EQ(later.alternative.has_value(), then.alternative.has_value());
    if (later.alternative) {
      const ObjectiveValues& one = later.alternative->objective;
      const ObjectiveValues& other = then.alternative->objective;
      EXPECT_EQ(later.alternative->assignment, then.alternative->assignment);
      EXPECT_EQ(one.satisfied, other.satisfied);
      EXPECT_EQ(one.requests, other.requests);
      EXPECT_EQ(one.idle_running, other.idle_running);
      EXPECT_EQ(one.changes, other.changes);
      EXPECT_EQ(later.difference.criterion, then.difference.criterion);
      EXPECT_EQ(later.difference.task, then.difference.task);
      return statistics_.count("alternative");
    }
    if (!later.conflict.empty() && later.conflict.front().kind == Reason::Kind::on_request) {
      // The simplest reasons of several.
      return statistics_.count("not requested");
    }
    ASSERT_EQ(later.conflict.size(), then.conflict.size());
    for (std::size_t place = 0; place < later.conflict.size(); ++place) {
      const Reason& one = later.conflict[place];
      const Reason& other = then.conflict[place];
      EXPECT_EQ(one.kind, other.kind);
      EXPECT_EQ(one.task, other.task);
      EXPECT_EQ(one.behavior, other.behavior);
      EXPECT_EQ(one.priority, other.priority);
      EXPECT_EQ(one.value, other.value);
    }
    statistics_.count("conflict");
  }

  const CompiledCatalog& catalog_;
  Statistics& statistics_;
  Inquiry inquiry_;
  Coordinator coordinator_;
  std::map<BehaviorId, Known> known_;
  std::map<GroupId, std::pair<std::uint64_t, TaskId>> rejected_;  ///< event and task
};

void run_case(std::uint64_t seed, Statistics& statistics) {
  const Case inputs = generate_case(seed);
  Random forms(~seed);
  Diagnostics diagnostics;
  const auto read = read_catalog(catalog_yaml(inputs.catalog, forms), "catalog.yaml", diagnostics);
  ASSERT_TRUE(read);
  const CompiledCatalog catalog = compile(*read);
  const auto document =
      yaml::parse(script_yaml(inputs.catalog, inputs.script, forms), "script.yaml", diagnostics);
  ASSERT_NE(document, nullptr);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  ASSERT_TRUE(script);
  Questions questions{.failures = true};
  for (std::uint32_t behavior = 0; behavior < catalog.behavior_names.size(); ++behavior) {
    questions.why.push_back({false, behavior});
  }
  Hindsight(catalog, options_of(*script), questions, statistics).run(*script);
}

TEST(Journal, KnowsWhatTheEventExplained) {
  const std::uint64_t first = environment("CBC_SEED", 1);
  const std::uint64_t cases = environment("CBC_HINDSIGHT_CASES", test::rounds(60U));
  Statistics statistics;
  for (std::uint64_t seed = first; seed < first + cases && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_case(seed, statistics);
  }
  for (const char* const what :
       {"alternative", "conflict", "not requested", "rejected", "due", "blocked"}) {
    EXPECT_GE(statistics.of(what), 5) << what;
  }
}

}  // namespace
}  // namespace cbc::oracle::journal_test
