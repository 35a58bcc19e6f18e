#include "coverage/engine/simulated_run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "coverage/engine/goal_monitor.h"
#include "explore/controls/witness.h"

namespace cbc {

/// A coordinator whose events are monitored.
class MissionSimulator::Simulation final : public RunListener {
 public:
  Simulation(const MissionSimulator& simulator, GroupId group, Script script)
      : catalog_(simulator.catalog_),
        monitor_(catalog_, simulator.goals_, options_for_monitor(simulator)),
        is_over_(simulator.is_over_),
        runner_(catalog_, options_of(script), *this) {
    result_.group = group;
    result_.script = std::move(script);
    runner_.begin(result_.script.situation);
    monitor_.begin(runner_.coordinator().state());
  }

  /// Takes the steps of the script that were not taken.
  void take() {
    while (result_.moments.size() < result_.script.steps.size()) {
      if (is_over()) return result_.script.steps.resize(result_.moments.size());
      const Step& step = result_.script.steps[result_.moments.size()];
      outcome_.reset();
      if (!runner_.take(step)) result_.fault = runner_.coordinator().internal_error();
      note_moment();
    }
  }

  /// Waits until an event of the clock has happened in the group. False if none does.
  bool wait() {
    constexpr int most_tries = 100;
    const std::uint64_t before = result_.clock_events;
    for (int tried = 0; tried < most_tries && result_.clock_events == before; ++tried) {
      if (!wait_once()) return false;
    }
    return result_.clock_events > before;
  }

  /// Takes a step soon after the one before it, and before anything comes due.
  void take_soon(Step step) {
    constexpr Microseconds soon = second / 200;
    const auto& steps = result_.script.steps;
    step.time = steps.empty() ? 0 : *steps.back().time + soon;
    const std::optional<Microseconds> next = runner_.coordinator().next_due();
    if (next && *step.time > *next) step.time = *next;
    result_.script.steps.push_back(std::move(step));
    take();
  }

  [[nodiscard]] const SimulatedRun& result() const { return result_; }
  [[nodiscard]] SimulatedRun take_result() { return std::move(result_); }
  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return monitor_.met(); }
  void cut(std::size_t steps) {
    result_.script.steps.resize(steps);
    result_.moments.resize(steps);
  }

 private:
  /// Waits until something has come due. False if nothing ever will.
  bool wait_once() {
    const std::optional<Microseconds> due = runner_.coordinator().next_due();
    if (!due) return false;
    Step& step = result_.script.steps.emplace_back();
    step.expect.emplace();
    step.time = *due + 1;
    const std::size_t taken = result_.moments.size();
    take();
    if (result_.moments.size() == taken) return false;
    // A time that is easy to read, if nothing else comes due until then.
    const std::optional<Microseconds> next = runner_.coordinator().next_due();
    for (const Microseconds later : {second, second / 10, second / 100, second / 1000}) {
      const Microseconds time = (*due + later) / later * later;
      if (next && time > *next) continue;
      result_.script.steps.back().time = time;
      break;
    }
    return true;
  }

  [[nodiscard]] bool is_over() const { return is_over_ && is_over_(); }

  static CoordinatorOptions options_for_monitor(const MissionSimulator& simulator) {
    CoordinatorOptions options;
    options.is_stopped = simulator.is_over_;
    return options;
  }

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    monitor_.on_decision(record, circumstances, solution);
  }
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    monitor_.on_event(record, step, state);
    if (record.origin == Origin::script && form_of(record.verb).is_decided) {
      outcome_ = record.outcome;
    }
    if (record.origin == Origin::timeout && catalog_.group_of(record.behavior) == result_.group) {
      ++result_.clock_events;
    }
    if (record.origin == Origin::reactive && catalog_.tasks[record.task].group == result_.group &&
        std::exchange(last_reactive_, record.time) != record.time) {
      ++result_.clock_events;
    }
  }

  void note_moment() {
    SimulatedRun::Moment& moment = result_.moments.emplace_back();
    moment.outcome = outcome_;
    known_.resize(monitor_.met().size(), 0);
    for (std::uint32_t goal = 0; goal < known_.size(); ++goal) {
      if (monitor_.met()[goal] == 0 || std::exchange(known_[goal], std::uint8_t{1}) != 0) continue;
      moment.goals.push_back(goal);
    }
    const State& state = runner_.coordinator().state();
    for (TaskId task = catalog_.group_tasks[result_.group];
         task < catalog_.group_tasks[result_.group + 1]; ++task) {
      moment.behaviors.push_back(state.behavior(task));
    }
  }

  const CompiledCatalog& catalog_;
  GoalMonitor monitor_;
  const std::function<bool()>& is_over_;
  Runner runner_;
  SimulatedRun result_;
  std::optional<Outcome> outcome_;
  Microseconds last_reactive_ = -1;
  std::vector<std::uint8_t> known_;  ///< by goal
};

SimulatedRun MissionSimulator::run(GroupId group, const std::vector<Move>& moves) const {
  Simulation simulation(*this, group, make_script(catalog_, {group}, assumptions_, moves, second));
  simulation.take();
  return simulation.take_result();
}

SimulatedRun MissionSimulator::run_by_clock(GroupId group, const std::vector<Move>& moves,
                                            const std::vector<std::uint8_t>& is_timeout) const {
  Script script = make_script(catalog_, {group}, assumptions_, moves, second);
  const std::vector<Step> steps = std::exchange(script.steps, {});
  script.timeouts = true;
  script.reactive_delay = Script{}.reactive_delay;
  Simulation simulation(*this, group, std::move(script));
  std::uint64_t made = 0;
  for (std::size_t place = 0; place < moves.size(); ++place) {
    const std::size_t taken = simulation.result().moments.size();
    if (moves[place].kind != Move::Kind::due && is_timeout[place] == 0) {
      simulation.take_soon(steps[place]);
      ++made;
    } else if (!simulation.wait()) {
      break;
    }
    // Where several timeouts come at once, the mission would be longer than it may be.
    if (made + simulation.result().clock_events > moves.size()) {
      simulation.cut(taken);
      break;
    }
  }
  return simulation.take_result();
}

SimulatedRun MissionSimulator::wait_after(GroupId group, const std::vector<Move>& moves,
                                          const std::vector<std::uint8_t>& wanted,
                                          std::uint32_t most_clock_events) const {
  constexpr Microseconds soon = second / 100;
  Script script = make_script(catalog_, {group}, assumptions_, moves, soon);
  script.timeouts = true;
  Simulation simulation(*this, group, std::move(script));
  simulation.take();
  std::size_t useful = simulation.result().script.steps.size();
  const auto count = [&] {
    std::size_t met = 0;
    for (std::size_t goal = 0; goal < wanted.size(); ++goal) {
      if (wanted[goal] != 0 && simulation.met()[goal] != 0) ++met;
    }
    return met;
  };
  for (std::size_t met = count(); simulation.result().clock_events < most_clock_events;) {
    if (!simulation.wait() || simulation.result().clock_events > most_clock_events) break;
    const std::size_t now = count();
    if (now > met) useful = simulation.result().script.steps.size();
    met = now;
  }
  simulation.cut(useful);
  return simulation.take_result();
}

namespace {

/// "Shows that task LAND ran."
std::string describe_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                           const std::vector<std::uint32_t>& shown) {
  if (shown.empty()) return {};
  if (shown.size() == 1) {
    return fmt::format("Shows that {}.\n", describe(catalog, goals[shown.front()]));
  }
  std::string text = "Shows that\n";
  for (std::size_t place = 0; place < shown.size(); ++place) {
    text += fmt::format("- {}{}\n", describe(catalog, goals[shown[place]]),
                        place + 1 < shown.size() ? "," : ".");
  }
  return text;
}

/// What an event has decided: its outcome, and what has changed by it, or since the last
/// expectation. Where it matters that nothing else was chosen, also what goes on.
Expectation expect(const CompiledCatalog& catalog, GroupId group,
                   const SimulatedRun::Moment& moment, const std::vector<BehaviorId>& before,
                   const std::vector<BehaviorId>& expected, bool tells_all) {
  Expectation expectation;
  if (moment.outcome == Outcome::accepted || moment.outcome == Outcome::rejected) {
    expectation.outcome = moment.outcome;
  }
  const TaskId first = catalog.group_tasks[group];
  for (LocalTask place(0); place < moment.behaviors.size(); ++place) {
    const BehaviorId behavior = moment.behaviors[place];
    const bool is_changed = before[place] != behavior || expected[place] != behavior;
    const std::uint32_t task = catalog.tasks[first + place].catalog_index;
    if (behavior != none && (is_changed || tells_all)) {
      expectation.running.push_back({task, {catalog.behaviors[behavior].catalog_index}});
    } else if (behavior == none && is_changed) {
      expectation.stopped.push_back(task);
    }
  }
  std::sort(expectation.running.begin(), expectation.running.end(),
            [](const auto& a, const auto& b) { return a.task < b.task; });
  std::sort(expectation.stopped.begin(), expectation.stopped.end());
  return expectation;
}

bool is_empty(const Expectation& expectation) {
  return !expectation.outcome && expectation.running.empty() && expectation.stopped.empty();
}

}  // namespace

WrittenScript write_down(const CompiledCatalog& catalog, std::span<const Goal> goals,
                         const SimulatedRun& run, const std::vector<std::uint8_t>& counts,
                         const std::string& title) {
  WrittenScript written;
  Script& script = written.script;
  script = run.script;
  script.steps.clear();
  std::vector<std::string> comments;
  std::vector<BehaviorId> before(run.moments.front().behaviors.size(), none);
  std::vector<BehaviorId> expected = before;
  const auto counts_here = [&](const SimulatedRun::Moment& moment) {
    return std::any_of(moment.goals.begin(), moment.goals.end(),
                       [&](std::uint32_t goal) { return counts[goal] != 0; });
  };
  std::size_t end = run.moments.size();
  while (end > 0 && !counts_here(run.moments[end - 1])) --end;
  for (std::size_t place = 0; place < end; ++place) {
    const Step& step = run.script.steps[place];
    const SimulatedRun::Moment& moment = run.moments[place];
    std::vector<std::uint32_t> shown = moment.goals;
    std::erase_if(shown, [&](std::uint32_t goal) { return counts[goal] == 0; });
    const bool is_deciding = std::any_of(shown.begin(), shown.end(), [&](std::uint32_t goal) {
      return is_about_deciding(goals[goal].kind);
    });
    std::string comment = describe_goals(catalog, goals, shown);
    if (!step.expect) {
      script.steps.push_back(step);
      comments.push_back(std::exchange(comment, {}));
    }
    const bool is_rejected = moment.outcome == Outcome::rejected;
    Step checked;
    checked.time = step.time;
    checked.expect = expect(catalog, run.group, moment, std::exchange(before, moment.behaviors),
                            expected, is_deciding || is_rejected);
    if (shown.empty()) continue;
    if (is_empty(*checked.expect)) {
      if (!step.expect) continue;
      checked.expect.reset();  // only waits
    }
    expected = moment.behaviors;
    script.steps.push_back(std::move(checked));
    comments.push_back(std::move(comment));
  }
  written.text = write_script(catalog, script, title, comments);
  return written;
}

}  // namespace cbc
