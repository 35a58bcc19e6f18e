// A path through states has an order but no times; a script has times. What is due before what
// gives bounds on differences of times: a simple temporal network (R. Dechter, I. Meiri and J.
// Pearl, "Temporal constraint networks", Artificial Intelligence 49 (1991)), whose earliest
// solution is a longest path, found as by Bellman and Ford. There always is one if the delay of
// reactive starts may be cut fine enough: sets of the queue wait from when they join until they are
// due, which are intervals none of which lies inside another, and such intervals can be stretched
// to equal lengths without changing their order (F. S. Roberts, "Indifference graphs", 1969).
//
// A fixed pause between two moves would be simpler, but the queue would come due elsewhere on the
// path, and the script would end in another state.

#include "explore/controls/witness.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "explore/controls/catalog_system.h"
#include "explore/model/model.h"
#include "runtime/base/text.h"
#include "versions/names/translation.h"

namespace cbc {

namespace {

constexpr std::size_t beginning = 0;  ///< the point before the first move

/// The points of a path, and what binds their times: 0 is the beginning, then each move, then the
/// end.
struct Timeline {
  /// By point: the point at which the set that is first in the queue joined it, if there is one
  /// before the point.
  std::vector<std::optional<std::size_t>> first_joined;
  std::vector<bool> is_due;
};

/// A move of the system as it is in the environment, or else in another one: what is a move of only
/// one of two catalogs is an event of the other, too. Null if the system has none, as with moves of
/// a queue that only the other one has, and of what is not available in other groups.
const ControlSystem::StateMove* find_move(CatalogSystem& system, const Move& move,
                                          const std::vector<std::uint8_t>& environment) {
  const ControlSystem::StateMove* found = nullptr;
  for (const ControlSystem::StateMove& one : system.moves()) {
    const bool is_own = move.kind == Move::Kind::own;
    if (one.move.kind != move.kind || one.move.subject != move.subject ||
        (!is_own && one.move.choice != move.choice)) {
      continue;
    }
    if (found == nullptr || system.has(one, environment)) found = &one;
  }
  return found;
}

/// Leaves the system with the control at the end of the path.
Timeline follow(CatalogSystem& system, const std::vector<Move>& path) {
  Timeline timeline;
  timeline.first_joined.emplace_back();
  timeline.is_due.push_back(false);
  const Model::Layout& layout = system.model().layout();
  std::vector<std::size_t> joined(layout.reactive_count, beginning);
  std::vector<std::uint32_t> control = system.first_control();
  std::vector<std::uint8_t> environment = system.first_environment();
  const auto add_point = [&](bool is_due) {
    system.load(control.data());
    timeline.is_due.push_back(is_due);
    auto& first = timeline.first_joined.emplace_back();
    for (std::uint32_t reactive = 0; reactive < layout.reactive_count; ++reactive) {
      if (system.stepper().cells()[layout.queue + reactive] == 1) first = joined[reactive];
    }
  };
  for (const Move& move : path) {
    const ControlSystem::StateMove* const made = find_move(system, move, environment);
    add_point(made != nullptr && move.kind == Move::Kind::due);
    if (made == nullptr) continue;
    const ControlSystem::MoveResult result = system.make(*made, environment);
    system.change(*made, result.values, environment);
    control.assign(result.control, result.control + control.size());
    for (std::uint32_t reactive = 0; reactive < layout.reactive_count; ++reactive) {
      if (system.stepper().has_joined(reactive)) joined[reactive] = timeline.is_due.size() - 1;
    }
  }
  add_point(false);
  return timeline;
}

/// The earliest times in units of which the delay of reactive starts has `delay`; empty: there are
/// none. `pause`: between points where nothing is in the queue.
std::vector<std::int64_t> find_times(const Timeline& timeline, std::int64_t delay,
                                     std::int64_t pause) {
  const std::size_t points = timeline.is_due.size();
  std::vector<std::int64_t> times(points, 0);
  bool changed = true;
  const auto at_least = [&](std::size_t point, std::int64_t time) {
    if (times[point] >= time) return;
    times[point] = time;
    changed = true;
  };
  for (std::size_t round = 0; changed; ++round) {
    // More rounds than points: the bounds contradict one another.
    if (round > points + 1) return {};
    changed = false;
    for (std::size_t point = 1; point < points; ++point) {
      const auto joined = timeline.first_joined[point];
      const std::int64_t gap = point == 1 ? 0 : joined ? 1 : pause;
      at_least(point, times[point - 1] + gap);
      if (!joined) continue;
      if (timeline.is_due[point]) {
        at_least(point, times[*joined] + delay);
        at_least(*joined, times[point] - delay);
      } else {
        at_least(*joined, times[point] - (delay - 1));
      }
    }
    if (times[beginning] > 0) return {};
  }
  return times;
}

/// The delay of reactive starts, and the time of each point.
struct Schedule {
  Microseconds delay = Script{}.reactive_delay;
  std::vector<Microseconds> times;
};

Schedule find_schedule(const Timeline& timeline, Microseconds pause) {
  Schedule schedule;
  const auto try_unit = [&](Microseconds unit) {
    if (schedule.delay % unit != 0) return false;
    schedule.times =
        find_times(timeline, schedule.delay / unit, std::max<Microseconds>(1, pause / unit));
    for (Microseconds& time : schedule.times) time *= unit;
    return !schedule.times.empty();
  };
  // Some unit is short enough, as said above.
  for (;;) {
    for (const Microseconds unit :
         {10'000, 5'000, 2'000, 1'000, 500, 200, 100, 50, 20, 10, 5, 2, 1}) {
      if (try_unit(unit)) return schedule;
    }
    schedule.delay *= 10;
  }
}

/// The variables that moves change.
std::set<std::uint32_t> variables_in(const Assumptions& assumptions,
                                     const std::vector<Move>& moves) {
  std::set<std::uint32_t> variables;
  for (const Move& move : moves) {
    if (move.kind == Move::Kind::variable) variables.insert(move.subject);
    if (move.kind != Move::Kind::together) continue;
    const auto& list = assumptions.together[move.subject];
    variables.insert(list.begin(), list.end());
  }
  return variables;
}

/// Turns the moves of a path into steps, one after the other.
class StepWriter {
 public:
  StepWriter(const CompiledCatalog& catalog, const Assumptions& assumptions)
      : catalog_(catalog), assumptions_(assumptions) {
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      values_.push_back(initial_value(assumptions, variable));
    }
  }

  /// Of variables that change together those that have another value after it.
  [[nodiscard]] Step next(const Move& move) {
    Step step = step_of(catalog_, assumptions_, move);
    auto& variables = step.situation.variables;
    if (move.kind == Move::Kind::together) {
      std::erase_if(variables, [this](const VariableValue& value) {
        return values_[value.variable] == value.value;
      });
    }
    for (const VariableValue& value : variables) values_[value.variable] = value.value;
    return step;
  }

 private:
  const CompiledCatalog& catalog_;
  const Assumptions& assumptions_;
  std::vector<std::uint32_t> values_;
};

void add_all_tasks(const Model& model, std::set<TaskId>& tasks) {
  for (const Model::Task& task : model.tasks()) tasks.insert(task.id);
}

/// The tasks that a condition is about.
void add_tasks(const Model& model, const StateCondition& condition, std::set<TaskId>& tasks) {
  const CompiledCatalog& catalog = model.catalog();
  for_each_condition(condition, [&](const StateCondition& part) {
    if (part.kind == StateCondition::Kind::only_active) add_all_tasks(model, tasks);
    if (part.task != none) tasks.insert(part.task);
    if (part.kind != StateCondition::Kind::active) return;
    for (const ValueId value : catalog.performs[part.behavior]) {
      tasks.insert(catalog.task_of(value));
    }
  });
}

/// What holds with the control that the system has loaded, as far as the property is about it.
Expectation expectation_of(const CatalogSystem& system, const Property* property) {
  const Model& model = system.model();
  const CompiledCatalog& catalog = model.catalog();
  Expectation expectation;
  std::set<TaskId> about;
  if (property == nullptr) {
    add_all_tasks(model, about);
  } else if (property->kind == Property::Kind::can_start) {
    expectation.outcome = Outcome::rejected;
    about.insert(property->task);
  } else if (property->task != none) {
    about.insert(property->task);
  } else {
    add_tasks(model, property->condition, about);
  }
  if (property != nullptr && property->when) add_tasks(model, *property->when, about);
  for (const std::uint32_t task : model.tasks_in_order()) {
    const TaskId id = model.tasks()[task].id;
    if (!about.contains(id)) continue;
    const std::uint32_t index = catalog.tasks[id].catalog_index;
    const std::uint16_t cell = system.stepper().cells()[task];
    if (cell == 0) {
      expectation.stopped.push_back(index);
      continue;
    }
    const BehaviorId behavior = catalog.values[id][cell - 1].behavior;
    expectation.running.push_back({index, {catalog.behaviors[behavior].catalog_index}});
  }
  return expectation;
}

/// Which requests are suspended, and what has failed, at the end of the script, where the property
/// is about that. The coordinator knows it best.
void add_memory(const CompiledCatalog& catalog, const Property& property, Script& script) {
  Expectation& expectation = *script.steps.back().expect;
  const auto note = [&](const StateCondition& part) {
    if (part.kind == StateCondition::Kind::suspended) expectation.suspended.emplace();
    if (part.kind == StateCondition::Kind::failed) expectation.failed.emplace();
  };
  for_each_condition(property.condition, note);
  if (property.when) for_each_condition(*property.when, note);
  if (!expectation.suspended && !expectation.failed) return;
  SilentRun silent;
  Runner runner(catalog, options_of(script), silent);
  runner.begin(script.situation);
  for (const Step& step : script.steps) static_cast<void>(runner.take(step));
  const State& state = runner.coordinator().state();
  for (std::uint32_t task = 0; expectation.suspended && task < catalog.tasks.size(); ++task) {
    if (state.is_suspended(catalog.task_ids[task])) expectation.suspended->push_back(task);
  }
  for (std::uint32_t one = 0; expectation.failed && one < catalog.behaviors.size(); ++one) {
    if (state.has_failed(catalog.behavior_ids[one])) expectation.failed->push_back(one);
  }
}

Situation situation_of(const CompiledCatalog& catalog, const SituationPart& part) {
  Situation situation;
  situation.variables = part.variables;
  for (const SituationPart::Own& own : part.behaviors) {
    situation.availability.push_back(
        {catalog.behaviors[own.behavior].catalog_index, own.available});
  }
  return situation;
}

/// Without steps.
Script begin_script(const CompiledCatalog& catalog, const Assumptions& assumptions,
                    const Schedule& schedule) {
  Script script;
  script.timeouts = false;
  script.reactive_delay = schedule.delay;
  script.situation = situation_of(catalog, assumptions.initially);
  return script;
}

}  // namespace

CompiledCatalog seen_from(const CompiledCatalog& catalog, const std::vector<GroupId>& groups) {
  return without_reactive_starts(catalog, [&](TaskId task) {
    return !std::binary_search(groups.begin(), groups.end(), catalog.tasks[task].group);
  });
}

Step step_of(const CompiledCatalog& catalog, const Assumptions& assumptions, const Move& move) {
  Step step;
  step.subject = move.subject;
  switch (move.kind) {
    case Move::Kind::start:
      step.verb = Verb::start;
      step.priority = move.choice;
      break;
    case Move::Kind::stop:
      step.verb = Verb::stop;
      break;
    case Move::Kind::success:
    case Move::Kind::failure:
    case Move::Kind::situation_change:
      step.verb = Verb::finish;
      step.cause = move.kind == Move::Kind::success   ? FinishCause::goal_achieved
                   : move.kind == Move::Kind::failure ? FinishCause::process_failure
                                                      : FinishCause::situation_change;
      break;
    case Move::Kind::fault:
      step.verb = Verb::fault;
      break;
    case Move::Kind::repair:
      step.verb = Verb::repair;
      break;
    case Move::Kind::variable:
      step.verb = Verb::situation;
      step.situation.variables.push_back({move.subject, static_cast<std::uint32_t>(move.choice)});
      break;
    case Move::Kind::own:
      step.verb = Verb::situation;
      step.situation.availability.push_back({move.subject, move.choice != 0});
      break;
    case Move::Kind::together:
      step.verb = Verb::situation;
      step.situation.variables = combination_of(catalog, assumptions.together[move.subject],
                                                static_cast<std::uint32_t>(move.choice));
      break;
    case Move::Kind::due:
      break;
  }
  return step;
}

Witness make_witness(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                     const Assumptions& assumptions, const std::vector<Move>& moves,
                     const Property* property, const std::string& comment) {
  const Model model(catalog, groups, assumptions, variables_in(assumptions, moves));
  const bool ends_with_start = property != nullptr && property->kind == Property::Kind::can_start;
  std::vector<Move> path = moves;
  if (ends_with_start) path.pop_back();
  CatalogSystem system(model, {}, std::nullopt);
  Timeline timeline = follow(system, path);
  if (ends_with_start) {
    // The refused start is one point more, before which nothing comes due.
    timeline.is_due.push_back(false);
    timeline.first_joined.push_back(timeline.first_joined.back());
  }
  const Schedule schedule = find_schedule(timeline, second);

  Witness witness;
  Script& script = witness.script;
  script = begin_script(catalog, assumptions, schedule);
  std::string due;
  StepWriter writer(catalog, assumptions);
  for (std::size_t place = 0; place < moves.size(); ++place) {
    const Microseconds time = schedule.times[place + 1];
    if (moves[place].kind == Move::Kind::due) {
      witness.due.push_back(time);
      due += fmt::format("At {} s reactive tasks try to start.\n", format_decimal(time, 6));
      continue;
    }
    // What is no change in one of two catalogs may be one in the other.
    Step& step = script.steps.emplace_back(property != nullptr
                                               ? writer.next(moves[place])
                                               : step_of(catalog, assumptions, moves[place]));
    step.time = time;
    witness.comments.push_back(std::exchange(due, {}));
  }
  Step& end = script.steps.emplace_back();
  end.time = schedule.times.back();
  end.expect = expectation_of(system, property);
  if (property != nullptr) add_memory(catalog, *property, script);
  witness.comments.push_back(std::exchange(due, {}));
  witness.text = write_script(catalog, script, comment, witness.comments);
  return witness;
}

Script make_script(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                   const Assumptions& assumptions, const std::vector<Move>& moves,
                   Microseconds pause) {
  const Model model(catalog, groups, assumptions, variables_in(assumptions, moves));
  CatalogSystem system(model, {}, std::nullopt);
  const Schedule schedule = find_schedule(follow(system, moves), pause);
  Script script = begin_script(catalog, assumptions, schedule);
  StepWriter writer(catalog, assumptions);
  for (std::size_t place = 0; place < moves.size(); ++place) {
    Step& step = script.steps.emplace_back(writer.next(moves[place]));
    const bool is_due = moves[place].kind == Move::Kind::due;
    if (is_due) step.expect.emplace();
    step.time = schedule.times[place + (is_due ? 2 : 1)];
  }
  Step& end = script.steps.emplace_back();
  end.expect.emplace();
  end.time = schedule.times.back();
  return script;
}

}  // namespace cbc
