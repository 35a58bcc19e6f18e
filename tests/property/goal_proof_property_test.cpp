// Random small catalogs and assumptions: the goals that are proven unreachable must be those that
// no move meets, where all paths of a plain search are run from their beginning, each by one
// coordinator. CBC_SEED and CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/goals.h"
#include "demand.h"
#include "plain_model.h"
#include "random_cases.h"
#include "verify_case.h"

namespace cbc::plain::goal_proof_property_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 100;
constexpr std::size_t most_states = 40;

/// By move, counted from 1: the one by which the first set of the queue before it joined; 0 is the
/// start of the script, nothing an empty queue.
using Joins = std::vector<std::optional<std::size_t>>;

Joins joins_of_first_sets(const PlainModel& model, const std::vector<Move>& script) {
  Joins joins(1);
  Snapshot state = model.first_state();
  std::vector<std::size_t> queue(PlainModel::sets_of_queue(state).size(), 0);
  for (const Move& move : script) {
    joins.push_back(queue.empty() ? std::nullopt : std::optional(queue.front()));
    Step step = model.step(state, move);
    std::vector<std::size_t> next;
    for (const auto& old_place : step.old_place) {
      next.push_back(old_place ? queue[*old_place] : joins.size() - 1);
    }
    queue = std::move(next);
    state = std::move(step.next);
  }
  return joins;
}

/// Instants of the moves, increasing, at which the sets of the queue come due exactly where the
/// script has it: the least ones that satisfy all lower bounds, one move after the other, again and
/// again.
std::vector<Microseconds> times_of(const PlainModel& model, const std::vector<Move>& script) {
  const Joins joins = joins_of_first_sets(model, script);
  std::vector<Microseconds> times(joins.size(), 0);
  bool has_changed = true;
  for (std::size_t round = 0; has_changed; ++round) {
    demand(round <= joins.size() + 1, "no times fit the script");
    has_changed = false;
    const auto raise = [&](std::size_t place, Microseconds time) {
      if (times[place] >= time) return;
      times[place] = time;
      has_changed = true;
    };
    for (std::size_t place = 1; place < times.size(); ++place) {
      raise(place, times[place - 1] + 1);
      if (!joins[place]) continue;
      if (script[place - 1].kind == Move::Kind::due) {
        raise(place, times[*joins[place]] + reactive_delay);
        raise(*joins[place], times[place] - reactive_delay);
      } else {
        raise(*joins[place], times[place] - reactive_delay + 1);
      }
    }
  }
  times.erase(times.begin());
  return times;
}

class Watched final : public EventListener {
 public:
  explicit Watched(GoalMonitor& watch) : watch_(watch) {}
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    watch_.on_decision(record, circumstances, solution);
  }
  void on_event(const EventRecord& record) override {
    watch_.note_event(record, coordinator->state());
  }

  const Coordinator* coordinator = nullptr;

 private:
  GoalMonitor& watch_;
};

void run_path(const PlainModel& model, const std::vector<Move>& path, GoalMonitor& watch) {
  const CompiledCatalog& catalog = model.catalog();
  const std::vector<Microseconds> times = times_of(model, path);
  std::vector<Availability> own;
  for (const SituationPart::Own& entry : model.assumptions().initially.behaviors) {
    own.push_back({catalog.behaviors[entry.behavior].catalog_index, entry.available});
  }
  CoordinatorOptions options;
  options.reactive_delay = reactive_delay;
  Watched watched(watch);
  Coordinator coordinator(catalog, options, watched);
  watched.coordinator = &coordinator;
  coordinator.begin(own, model.assumptions().initially.variables);
  watch.begin(coordinator.state());
  for (std::size_t place = 0; place < path.size(); ++place) {
    demand(coordinator.advance_to(times[place]) == Coordinator::Status::ok, "it goes on");
    handle_move(catalog, model.assumptions(), path[place], coordinator);
  }
}

/// Runs the path of each move from each state of a group. False: these are too many.
bool run_group(const PlainModel& model, GoalMonitor& watch) {
  std::map<std::string, std::vector<Move>> paths;
  std::vector<std::pair<Snapshot, std::vector<Move>>> states;
  const auto add = [&](const Snapshot& state, const std::vector<Move>& path) {
    if (paths.emplace(model.key(state), path).second) states.emplace_back(state, path);
  };
  add(model.first_state(), {});
  run_path(model, {}, watch);
  for (std::size_t next = 0; next < states.size(); ++next) {
    if (states.size() > most_states) return false;
    const auto [state, path] = states[next];
    for (const Move& move : model.moves(state)) {
      std::vector<Move> longer = path;
      longer.push_back(move);
      run_path(model, longer, watch);
      add(model.step(state, move).next, longer);
    }
  }
  return true;
}

/// Whether some situation has the value, by a search through all that may be.
bool may_have(const CompiledCatalog& catalog, const Assumptions& assumptions, const Goal& goal) {
  const PlainModel model(catalog, {}, assumptions, {goal.variable});
  std::vector<Snapshot> states = {model.first_state()};
  std::set<std::string> seen = {model.key(states.front())};
  for (std::size_t place = 0; place < states.size(); ++place) {
    const Snapshot state = states[place];  // the states may move
    if (state.variables[goal.variable] == goal.value) return true;
    for (const Move& move : model.moves(state)) {
      Snapshot next = model.step(state, move).next;
      if (seen.insert(model.key(next)).second) states.push_back(std::move(next));
    }
  }
  return false;
}

/// The paths are the shortest ones: they need not have what came before another path to the same
/// state. And they have no times.
bool is_judged(const Goal& goal) {
  return goal.kind != Goal::Kind::reactive_returned && goal.kind != Goal::Kind::timeout_fired;
}

void compare(const VerifyCase& sample, oracle::Statistics& statistics) {
  const CompiledCatalog& catalog = sample.catalog;
  const Assumptions& assumptions = sample.question.assumptions;
  const std::vector<Goal> goals = find_goals(catalog);
  GoalMonitor watch(catalog, goals, {});
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    const PlainModel model(catalog, {group}, assumptions);
    if (model.is_excluded(model.first_state())) return statistics.count("excluded");
    if (!run_group(model, watch)) return statistics.count("too many states");
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    const PlainModel model(catalog, {}, assumptions, {variable});
    if (model.is_excluded(model.first_state())) return statistics.count("excluded");
  }
  const GoalProof proof = prove_unreachable(catalog, goals, assumptions, {});
  demand(!proof.error, "an error");
  for (std::size_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    const bool is_met = watch.met()[number] != 0;
    const bool is_unreachable = !proof.unreachable[number].empty();
    const std::string text = describe(catalog, goal);
    demand(!is_met || !is_unreachable, "it is met: " + text);
    if (!is_judged(goal)) {
      if (is_forestalled(catalog, goal, proof.facts)) statistics.count("forestalled");
      continue;
    }
    const bool is_of_free_variable =
        goal.variable != none &&
        std::none_of(catalog.fitting_values.begin(), catalog.fitting_values.end(),
                     [&](const FittingValue& one) { return one.variable == goal.variable; });
    demand(is_met || is_unreachable || is_of_free_variable, "nothing meets it: " + text);
    if (is_of_free_variable) {
      demand(is_unreachable != may_have(catalog, assumptions, goal), "of a free variable: " + text);
      statistics.count(is_unreachable ? "free, unreachable" : "free, reachable");
      if (!is_met && !is_unreachable) continue;
    }
    statistics.count(is_met ? "met" : "unreachable");
    if (is_unreachable) {
      const std::string reason =
          why_unreachable(catalog, goals, number, assumptions, watch.facts());
      demand(proof.unreachable[number] == reason,
             text + ": " + proof.unreachable[number] + ", but " + reason);
    }
    if (is_about_deciding(goal.kind)) statistics.count(is_met ? "decides" : "never decides");
  }
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  try {
    compare(generate_verify_case(seed), results.statistics);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, fault.what()});
  }
}

constexpr oracle::LowerBound lower_bounds[] = {
    {"met", 3000}, {"unreachable", 1000}, {"decides", 150}, {"never decides", 100}};

TEST(GoalProof, IsWhatAllPathsShow) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

TEST(GoalProof, KnowsWhatReturns) {
  const auto unreachable = [](const std::string& yaml) {
    const CompiledCatalog catalog = oracle::compile_yaml(yaml).value();
    const std::vector<Goal> goals = find_goals(catalog);
    const GoalProof proof = prove_unreachable(catalog, goals, assumptions_of_goals(catalog), {});
    std::vector<std::string> texts;
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      const bool is_about_blinking = goals[goal].kind >= Goal::Kind::timeout_fired &&
                                     goals[goal].kind <= Goal::Kind::reactive_returned;
      if (is_about_blinking && !proof.unreachable[goal].empty()) {
        texts.push_back(describe(catalog, goals[goal]) + ": " + proof.unreachable[goal]);
      }
    }
    return texts;
  };
  EXPECT_EQ(unreachable(R"(
behaviors: [{behavior: BLINK_ON, task: BLINK}, {behavior: DOCK_NOW, task: DOCK}]
tasks: [{task: BLINK, reactive_start: true, execution_goal: keep_running}, {task: DOCK, timeout: 5}]
exclusivity_constraints: [{mutually_exclusive: [BLINK, DOCK]}]
)"),
            std::vector<std::string>());
  EXPECT_EQ(unreachable(R"(
behaviors: [{behavior: BLINK_ON, task: BLINK}, {behavior: DOCK_NOW, task: DOCK}]
tasks:
- {task: BLINK, reactive_start: true, start_on_request: false, execution_goal: keep_running}
- {task: DOCK}
)"),
            (std::vector<std::string>{"task BLINK gave way: only its own stop and the end of its "
                                      "behavior stop task BLINK",
                                      "task BLINK returned by itself after it gave way: task "
                                      "BLINK never gives way"}));
}

}  // namespace
}  // namespace cbc::plain::goal_proof_property_test
