// A mutant that no mission notices either shows a gap in the missions or is equivalent: no mission
// can notice it. For programs that is undecidable (T. A. Budd and D. Angluin, "Two notions of
// correctness and their relation to testing", Acta Informatica 18 (1982)), and people sort it out
// by hand. A catalog has finitely many states, so the mutant and the original are compared in their
// product, by what an expectation can see. A difference comes with the shortest events that show
// it, which become a script, and the script is run on both: only a mission that was seen to fail is
// proposed.
//
// Timeouts are not part of states. For these, states in which the timeout would run are visited,
// and a script waits there; if nothing shows, and nothing is proven, the mutant is undecided.

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "coverage/engine/mutants/mutants.h"
#include "explore/controls/witness.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "versions/lockstep/same_as.h"

namespace cbc {
namespace {

/// The finish by the timeout of a behavior with a task; 0: there is none.
Microseconds timeout_of(const Catalog& catalog, const Behavior& behavior, TaskIndex index) {
  const Task& task = catalog.tasks[index];
  if (task.execution_goal == ExecutionGoal::keep_running) return 0;
  return behavior.timeout.value_or(task.timeout.value_or(0));
}

/// A behavior that times out with one of its tasks in only one of two catalogs, or earlier.
struct TimeDifference {
  TaskIndex task = 0;
  BehaviorIndex behavior = 0;
  Microseconds first = 0;  ///< the shorter timeout
};

/// Both catalogs have the same tasks and behaviors.
std::vector<TimeDifference> find_time_differences(const Catalog& original, const Catalog& mutant) {
  std::vector<TimeDifference> differences;
  for (BehaviorIndex place = 0; place < original.behaviors.size(); ++place) {
    for (const Performance& performance : original.behaviors[place].performs) {
      const Microseconds before = timeout_of(original, original.behaviors[place], performance.task);
      const Microseconds after = timeout_of(mutant, mutant.behaviors[place], performance.task);
      if (before == after) continue;
      const Microseconds first = before == 0  ? after
                                 : after == 0 ? before
                                              : std::min(before, after);
      differences.push_back({performance.task, place, first});
    }
  }
  return differences;
}

/// Other tasks of the same group that may time out no later, so that it is not the only one.
std::vector<TaskIndex> find_sooner(const Catalog& catalog, const CompiledCatalog& compiled,
                                   const TimeDifference& difference) {
  std::set<TaskIndex> found;
  const auto group_of = [&](TaskIndex task) {
    return compiled.tasks[compiled.task_ids[task]].group;
  };
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      const Microseconds timeout = timeout_of(catalog, behavior, performance.task);
      if (timeout == 0 || timeout > difference.first || performance.task == difference.task) {
        continue;
      }
      if (group_of(performance.task) == group_of(difference.task)) found.insert(performance.task);
    }
  }
  return {found.begin(), found.end()};
}

/// The events of a script up to its end, and the time of that.
Microseconds take_expectation(Script& script) {
  const Microseconds end = script.steps.back().time.value_or(0);
  script.steps.pop_back();
  return end;
}

/// So long after the end of a script that everything in the queue has come due.
Microseconds settled(const Script& script, Microseconds end) {
  return end + script.reactive_delay + second;
}

/// What an expectation at the end of a script can see.
struct Observation {
  std::vector<std::string_view> behaviors;  ///< by task in catalog order; empty: it does not run
  std::optional<Outcome> outcome;           ///< of the last step
};

/// Empty if the script cannot be read or run.
std::optional<Observation> observe_end(const CompiledCatalog& catalog, const std::string& text) {
  Diagnostics ignored;
  const auto document = yaml::parse(text, "script", ignored);
  if (document == nullptr) return std::nullopt;
  const auto script = read_script(*document, catalog, Severity::note, ignored);
  if (!script) return std::nullopt;
  SilentRun listener;
  Runner runner(catalog, options_of(*script), listener);
  runner.begin(script->situation);
  for (const Step& step : script->steps) {
    if (!runner.take(step)) return std::nullopt;
  }
  Observation end;
  const State& state = runner.coordinator().state();
  for (const TaskId task : catalog.task_ids) {
    const BehaviorId behavior = state.behavior(task);
    end.behaviors.push_back(behavior == none ? std::string_view()
                                             : catalog.name_of_behavior(behavior));
  }
  end.outcome = runner.snapshot().outcome;
  return end;
}

/// What the original shows and the mutant does not.
Expectation find_difference(const CompiledCatalog& original, const Observation& of_original,
                            const Observation& of_mutant) {
  Expectation expectation;
  for (std::uint32_t task = 0; task < of_original.behaviors.size(); ++task) {
    const std::string_view behavior = of_original.behaviors[task];
    if (behavior == of_mutant.behaviors[task]) continue;
    if (behavior.empty()) {
      expectation.stopped.push_back(task);
    } else {
      expectation.running.push_back({task, {original.find_behavior(behavior).value()}});
    }
  }
  if (of_original.outcome != of_mutant.outcome) expectation.outcome = of_original.outcome;
  return expectation;
}

/// A script that tells a mutant from the original, as text (a separating sequence: D. Lee and
/// M. Yannakakis, "Principles and methods of testing finite state machines", Proceedings of the
/// IEEE 84 (1996)): these events, with timeouts if these are not in the way, then an expectation
/// that holds on the original, and of which no part holds on the mutant. Empty if no expectation at
/// one of the times tells them apart; the first one that does counts. `script` is one for the
/// original, without expectations; both catalogs have the same tasks.
std::optional<std::string> find_distinguishing_script(const CompiledCatalog& original,
                                                      const CompiledCatalog& mutant,
                                                      const Script& script,
                                                      std::span<const Microseconds> times) {
  for (const bool timeouts : {true, false}) {
    for (const Microseconds time : times) {
      Script script_with_end = script;
      script_with_end.timeouts = timeouts;
      Step& last = script_with_end.steps.emplace_back();
      last.time = time;
      const std::string text = write_script(original, script_with_end, {});
      const std::optional<Observation> of_original = observe_end(original, text);
      const std::optional<Observation> of_mutant = observe_end(mutant, text);
      if (!of_original || !of_mutant) continue;
      Expectation expectation = find_difference(original, *of_original, *of_mutant);
      if (!expectation.outcome && expectation.running.empty() && expectation.stopped.empty()) {
        continue;
      }
      script_with_end.steps.back().expect = std::move(expectation);
      return write_script(original, script_with_end, {});
    }
  }
  return std::nullopt;
}

ExplorationOptions exploration_options(const MutantJudge::Limits& limits) {
  ExplorationOptions options;
  options.budget.max_states = limits.max_states;
  options.budget.max_memory = limits.max_memory;
  options.budget.is_stopped = limits.is_stopped;
  options.reduce = true;
  return options;
}

/// Whether other timeouts always come before these: then they never end anything. The facts are
/// those of a complete search.
bool never_time_out(const CompiledCatalog& catalog, const std::vector<TimeDifference>& differences,
                    const GoalFacts& facts) {
  return std::all_of(differences.begin(), differences.end(), [&](const TimeDifference& difference) {
    const TaskId task = catalog.task_ids[difference.task];
    const BehaviorId behavior = catalog.behavior_ids[difference.behavior];
    const auto values = catalog.performs[behavior];
    const ValueId value = *std::find_if(values.begin(), values.end(),
                                        [&](ValueId one) { return catalog.task_of(one) == task; });
    return timeout_of(catalog, task, behavior) == 0 || facts.performed[value] == 0 ||
           facts.forestalled_by[value] != none;
  });
}

/// A limit came before it was known.
void give_up(const std::optional<Budget::End>& end, MutantVerdict& verdict) {
  verdict.result = MutantVerdict::Result::undecided;
  verdict.doubt = MutantVerdict::Doubt::limit;
  verdict.lacks_memory = end == Budget::End::max_memory;
}

}  // namespace

std::string_view name_of(Notice::How how) {
  static constexpr std::array<std::string_view, 2> names = {"failed", "ended"};
  return names.at(static_cast<std::size_t>(how));
}

std::string_view name_of(MutantVerdict::Result result) {
  static constexpr std::array<std::string_view, 5> names = {"noticed", "survived", "equivalent",
                                                            "undecided", "unjudged"};
  return names.at(static_cast<std::size_t>(result));
}

std::string_view name_of(MutantVerdict::Doubt doubt) {
  static constexpr std::array<std::string_view, 2> names = {"limit", "no_script"};
  return names.at(static_cast<std::size_t>(doubt));
}

std::optional<Notice> find_notice(const CompiledCatalog& catalog, const Script& mission,
                                  const std::function<bool()>& is_stopped) {
  Notice notice;
  CoordinatorOptions options = options_of(mission);
  options.is_stopped = is_stopped;
  SilentRun listener;
  Runner runner(catalog, options, listener);
  runner.begin(mission.situation);
  bool goes_on = true;
  for (const Step& step : mission.steps) {
    goes_on = runner.take(step);
    if (!goes_on || runner.result().failed > 0) break;
  }
  if (goes_on && runner.result().failed == 0) goes_on = runner.settle();
  const RunResult& result = runner.result();
  if (!result.failures.empty()) {
    notice.line = result.failures.front().range.begin.line;
    notice.message = result.failures.front().message;
    return notice;
  }
  if (goes_on || result.status == Coordinator::Status::stopped) return std::nullopt;
  notice.how = Notice::How::ended;
  notice.message = result.status == Coordinator::Status::too_many_clock_events
                       ? "timeouts and reactive starts follow each other without end"
                       : result.internal_error;
  return notice;
}

MutantJudge::MutantJudge(const Catalog& source, const CompiledCatalog& catalog,
                         const std::vector<Script>& missions, Assumptions assumptions)
    : source_(source),
      catalog_(catalog),
      missions_(missions),
      assumptions_(std::move(assumptions)) {}

MutantVerdict MutantJudge::run_missions(const Mutant& mutant,
                                        const std::function<bool()>& is_stopped) const {
  MutantVerdict verdict;
  const auto is_over = [&] { return is_stopped && is_stopped(); };
  if (is_over()) return verdict;
  const CompiledCatalog changed = compile(mutate(source_, mutant));
  for (std::size_t mission = 0; mission < missions_.size(); ++mission) {
    if (is_over()) return verdict;
    verdict.notice = find_notice(changed, missions_[mission], is_stopped);
    if (!verdict.notice) continue;
    verdict.notice->mission = mission;
    verdict.result = MutantVerdict::Result::noticed;
    return verdict;
  }
  if (!is_over()) verdict.result = MutantVerdict::Result::undecided;
  return verdict;
}

MutantVerdict MutantJudge::compare(const Mutant& mutant, const Limits& limits) const {
  MutantVerdict verdict;
  const Catalog changed_source = mutate(source_, mutant);
  const CompiledCatalog changed = compile(changed_source);
  if (mutant.kind == Mutant::Kind::timeout_removed ||
      mutant.kind == Mutant::Kind::execution_goal_turned) {
    compare_times(mutant, changed_source, changed, limits, verdict);
  } else {
    compare_states(mutant, changed, limits, verdict);
  }
  return verdict;
}

GroupId MutantJudge::group_of(const Mutant& mutant) const {
  return mutant.task != Mutant::none ? catalog_.tasks[catalog_.task_ids[mutant.task]].group
                                     : catalog_.group_of(catalog_.behavior_ids[mutant.behavior]);
}

/// The original is the new catalog of the comparison, so that the script tells what it does.
void MutantJudge::compare_states(const Mutant& mutant, const CompiledCatalog& changed,
                                 const Limits& limits, MutantVerdict& verdict) const {
  ComparisonScope scope;
  scope.differences = ComparisonScope::Differences::expectable;
  scope.only_first = true;
  scope.group = group_of(mutant);
  const CatalogComparison found =
      compare_catalogs(changed, catalog_, assumptions_, exploration_options(limits), scope);
  if (found.result == Verdict::Result::undecided) return give_up(found.end, verdict);
  if (found.result == Verdict::Result::proved) {
    verdict.result = MutantVerdict::Result::equivalent;
    return;
  }
  Script script = found.first_difference()->witness.script;
  const Microseconds end = take_expectation(script);
  const std::array times = {end, settled(script, end)};
  verdict.script = find_distinguishing_script(catalog_, changed, script, times);
  verdict.result =
      verdict.script ? MutantVerdict::Result::survived : MutantVerdict::Result::undecided;
  verdict.doubt = MutantVerdict::Doubt::no_script;
}

/// States have no times, so a difference between timeouts is none between states. It shows in every
/// state in which such a behavior has begun, if one waits for the timeout.
void MutantJudge::compare_times(const Mutant& mutant, const Catalog& changed_source,
                                const CompiledCatalog& changed, const Limits& limits,
                                MutantVerdict& verdict) const {
  const std::vector<TimeDifference> differences = find_time_differences(source_, changed_source);
  std::vector<Property> properties;
  for (const TimeDifference& difference : differences) {
    Property property;
    property.kind = Property::Kind::reachable;
    property.condition.parts = {
        StateCondition::of_task(StateCondition::Kind::running, catalog_.task_ids[difference.task],
                                {catalog_.behavior_ids[difference.behavior]})};
    // Alone it is not hidden by others that time out before.
    Property& alone = properties.emplace_back(property);
    for (const TaskIndex task : find_sooner(source_, catalog_, difference)) {
      alone.condition.parts.push_back(
          StateCondition::of_task(StateCondition::Kind::stopped, catalog_.task_ids[task]));
    }
    properties.push_back(std::move(property));
  }
  std::vector<const Property*> asked;
  asked.reserve(properties.size());
  for (const Property& property : properties) asked.push_back(&property);
  verdict.result = MutantVerdict::Result::equivalent;
  // Nothing fails, and so nothing times out.
  if (differences.empty() || !assumptions_.failures) return;
  bool is_any_reachable = false;
  const std::vector<GroupId> groups = {group_of(mutant)};
  const Exploration found =
      explore(catalog_, groups, assumptions_, asked, exploration_options(limits));
  for (std::size_t place = 0; place < properties.size(); ++place) {
    if (!found.verdicts[place].has_script) continue;
    is_any_reachable = true;
    Script script =
        make_witness(catalog_, groups, assumptions_, found.verdicts[place].script, asked[place], {})
            .script;
    const Microseconds end = take_expectation(script) + differences[place / 2].first;
    const std::array times = {end, settled(script, end)};
    verdict.script = find_distinguishing_script(catalog_, changed, script, times);
    if (!verdict.script) continue;
    verdict.result = MutantVerdict::Result::survived;
    return;
  }
  if (found.end) return give_up(found.end, verdict);
  if (!is_any_reachable) return;
  for (const CompiledCatalog* const catalog : {&catalog_, &changed}) {
    const GroupId group = catalog->tasks[catalog->task_ids[differences.front().task]].group;
    GoalFacts facts(*catalog, 0);
    std::vector<std::uint8_t> no_goals;
    const GoalSearchOptions of_search{exploration_options(limits).budget};
    const GoalSearchResult search =
        GoalSearch(*catalog, {group}, assumptions_, {}, of_search).run(facts, no_goals);
    if (!search.error && !search.is_complete) return give_up(search.end, verdict);
    if (!search.error && never_time_out(*catalog, differences, facts)) continue;
    verdict.result = MutantVerdict::Result::undecided;
    verdict.doubt = MutantVerdict::Doubt::no_script;
    return;
  }
}

}  // namespace cbc
