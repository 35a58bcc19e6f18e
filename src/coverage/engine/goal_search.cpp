// Which goals can be met at all: explicit-state reachability, as in `cbc verify`, but each move is
// made twice. The exploration of states makes it on packed states and finds the state that comes
// next; a coordinator, which a monitor watches as it watches missions, makes it once more and meets
// the goals. So a goal counts here exactly if it would in a mission (monitors of runtime
// verification: M. Leucker and C. Schallhart, "A brief account of runtime verification", Journal of
// Logic and Algebraic Programming 78 (2009)).
//
// Goals as properties of states would be quicker, but most are about events and about what an
// answer would have been otherwise, so each would be written down a second time, and differ some
// day.

#include "coverage/engine/goal_search.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/script/runner.h"
#include "coverage/engine/breadth_first.h"
#include "explore/moves/stepper.h"
#include "explore/moves/witness.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"

namespace cbc {
namespace {

/// The present instant. What is in the queue comes due in the microseconds after it, set by set.
constexpr Microseconds present_instant = second;

CoordinatorOptions without_times() {
  CoordinatorOptions options;
  options.timeouts = false;
  return options;
}

/// Makes moves of an exploration once more, on a coordinator that is monitored for goals.
class StateReplay final : private EventListener {
 public:
  /// Model and monitor must outlive this object.
  StateReplay(const Model& model, GoalMonitor& monitor);

  /// Takes up the state of the stepper.
  void load(const Stepper& stepper);
  /// Makes a move from the state, which must have it.
  void take(const Move& move);

  /// After the last move.
  [[nodiscard]] const State& state() const { return coordinator_.state(); }
  /// Whether a task that runs after the last move ran before it with the same behavior, which has
  /// not been activated again.
  [[nodiscard]] bool goes_on(TaskId task) const;
  /// The reactive tasks that started by themselves, that gave way in the last move.
  [[nodiscard]] const std::vector<TaskId>& started() const { return started_; }
  [[nodiscard]] const std::vector<TaskId>& gave_way() const { return gave_way_; }

 private:
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override;
  void on_event(const EventRecord& record) override;

  const Model& model_;
  GoalMonitor& monitor_;
  Coordinator coordinator_;
  Snapshot state_;
  std::vector<TaskId> started_;
  std::vector<TaskId> gave_way_;
};

StateReplay::StateReplay(const Model& model, GoalMonitor& monitor)
    : model_(model), monitor_(monitor), coordinator_(model.catalog(), without_times(), *this) {}

void StateReplay::load(const Stepper& stepper) {
  const Model::Layout& layout = model_.layout();
  const CompiledCatalog& catalog = model_.catalog();
  const std::uint16_t* const cells = stepper.cells();
  state_ = {};
  state_.now = present_instant;
  state_.reactive_delay = CoordinatorOptions{}.reactive_delay;
  state_.timeouts = false;
  state_.events = layout.request_count;
  for (std::uint32_t task = 0; task < model_.tasks().size(); ++task) {
    if (cells[task] == 0) continue;
    Snapshot::RunningTask& entry = state_.running.emplace_back();
    entry.task = model_.tasks()[task].id;
    entry.value_index = cells[task] - 1U;
    for (std::uint32_t place = 0; place < layout.request_count; ++place) {
      if (cells[layout.requests + place] != task + 1) continue;
      // The later one is the more important one of two with the same priority.
      entry.request = Request{
          model_.priority_of(cells[layout.ranks + place]), layout.request_count - place, {}};
    }
  }
  for_each_bit(stepper.active().data(), stepper.active().size(), [&](std::uint32_t behavior) {
    state_.active.emplace_back(model_.behaviors()[behavior].id, 0);
  });
  for (std::uint32_t behavior = 0; behavior < model_.behaviors().size(); ++behavior) {
    if (stepper.is_denied(behavior)) state_.denied.push_back(model_.behaviors()[behavior].id);
    if (stepper.is_faulty(behavior)) state_.faulty.push_back(model_.behaviors()[behavior].id);
  }
  for (std::uint32_t flag = 0; flag < layout.own_count; ++flag) {
    const Model::OwnFlag& own = model_.own_flags()[flag];
    if (own.behavior == none && cells[layout.own + flag] != 0) state_.denied.push_back(own.id);
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    const std::uint32_t known = model_.find_variable(variable);
    state_.variables.push_back(known == none ? initial_value(model_.assumptions(), variable)
                                             : stepper.value_of(known));
  }
  for (std::uint32_t reactive = 0; reactive < layout.reactive_count; ++reactive) {
    const TaskId task = model_.tasks()[model_.reactive()[reactive]].id;
    const std::uint16_t set = cells[layout.queue + reactive];
    if (set != 0) state_.queue.emplace_back(task, present_instant + set);
    if (cells[layout.waiting + reactive] != 0) state_.waiting.push_back(task);
  }
  coordinator_.resume(state_);
  monitor_.begin(coordinator_.state());
}

void StateReplay::take(const Move& move) {
  coordinator_.resume(state_);
  monitor_.begin(coordinator_.state());
  started_.clear();
  if (move.kind == Move::Kind::due) {
    // Before the second set.
    static_cast<void>(coordinator_.advance_to(present_instant + 2));
  } else {
    const Step step = step_of(model_.catalog(), model_.assumptions(), move);
    static_cast<void>(coordinator_.handle(event_of(step)));
  }
  gave_way_.clear();
  for (const std::uint32_t task : model_.reactive()) {
    const TaskId id = model_.tasks()[task].id;
    if (monitor_.has_given_way(id)) gave_way_.push_back(id);
  }
}

/// What was there before has been there since the beginning.
bool StateReplay::goes_on(TaskId task) const {
  const State& state = coordinator_.state();
  return std::max(state.taken_at(task), state.activated_at(state.behavior(task))) < present_instant;
}

void StateReplay::on_decision(const EventRecord& record, const Circumstances& circumstances,
                              const Assignment* solution) {
  monitor_.on_decision(record, circumstances, solution);
  if (solution != nullptr && circumstances.trigger.is_reactive) {
    started_.push_back(circumstances.trigger.task);
  }
}

void StateReplay::on_event(const EventRecord& record) {
  monitor_.note_event(record, coordinator_.state());
}

/// Finds timeouts before which another one always comes, from all moves between the reachable
/// states of a group, although these have no times.
///
/// Take a task x with behavior b, and a task y with c, whose timeout is shorter, or the same and y
/// comes first in the catalog. Where x begins to run with b, y runs with c; and as long as the one
/// goes on, so does the other. So c has been there for as long as b at least, and its timeout comes
/// first. It is a failure of c, and as after no failure of c x goes on with b, the timeout of b
/// does not come.
class TimeoutRace {
 public:
  /// The catalog must outlive this object. `group`: empty if there are no tasks.
  TimeoutRace(const CompiledCatalog& catalog, std::optional<GroupId> group)
      : catalog_(catalog), group_(group) {}

  /// Notes a move, which the replay has just made.
  void note(const StateReplay& replay, const Move& move);

  /// After all moves of the group: tells of each value one that always times out before it, if
  /// there is any.
  void tell(GoalMonitor& monitor) const;

 private:
  const CompiledCatalog& catalog_;
  const std::optional<GroupId> group_;
  /// By value that ran and has a timeout: those that have always come first so far, ascending.
  std::map<ValueId, std::vector<ValueId>> sooner_;
  std::vector<ValueId> running_;  ///< after the move; kept for its memory
};

void TimeoutRace::note(const StateReplay& replay, const Move& move) {
  const State& state = replay.state();
  // Of timeouts that are due at the same instant, that of the task first in the catalog comes
  // first.
  const auto timeout = [&](ValueId value) {
    const TaskId task = catalog_.task_of(value);
    return std::pair(timeout_of(catalog_, task, catalog_.values.items[value].behavior),
                     catalog_.tasks[task].catalog_index);
  };
  running_.clear();
  if (!group_) return;
  for (TaskId task = catalog_.group_tasks[*group_]; task < catalog_.group_tasks[*group_ + 1];
       ++task) {
    if (!state.is_running(task)) continue;
    const ValueId value(catalog_.values.begin[task] + state.value_index(task));
    if (timeout(value).first > 0) running_.push_back(value);
  }
  for (const ValueId value : running_) {
    const bool goes_on = replay.goes_on(catalog_.task_of(value));
    const auto [entry, is_new] = sooner_.try_emplace(value);
    std::vector<ValueId>& sooner = entry->second;
    if (is_new) {
      for (const ValueId other : running_) {
        if (timeout(other) < timeout(value)) sooner.push_back(other);
      }
    }
    std::erase_if(sooner, [&](ValueId other) {
      if (!std::binary_search(running_.begin(), running_.end(), other)) return true;
      if (!goes_on) return false;
      const BehaviorId behavior = catalog_.values.items[other].behavior;
      const bool fails = move.kind == Move::Kind::failure &&
                         catalog_.behaviors[behavior].catalog_index == move.subject;
      return fails || !replay.goes_on(catalog_.task_of(other));
    });
  }
}

void TimeoutRace::tell(GoalMonitor& monitor) const {
  for (const auto& [value, sooner] : sooner_) {
    if (!sooner.empty()) monitor.note_forestalled(value, sooner.front());
  }
}

/// Makes each move of the search once more, and passes on what it did.
class ReplayVisitor {
 public:
  ReplayVisitor(const Model& model, std::optional<GroupId> group, GoalMonitor& monitor,
                const std::vector<std::uint8_t>* unwanted,
                const std::function<void(const SeenMove&)>& on_move)
      : monitor_(monitor),
        unwanted_(unwanted),
        on_move_(on_move),
        stepper_(model, {.reduce = true}),
        replay_(model, monitor),
        race_(model.catalog(), group) {}

  [[nodiscard]] Stepper& system() { return stepper_; }
  void visit(StateStore::Number /*number*/) { replay_.load(stepper_); }
  void on_move(StateStore::Number from, const Model::Choice& choice, StateStore::Number to) {
    const Move move = stepper_.move_of(choice);
    if (unwanted_ != nullptr) monitor_.restart(*unwanted_);
    replay_.take(move);
    race_.note(replay_, move);
    on_move_({from, to, move, replay_.started(), replay_.gave_way()});
  }

  [[nodiscard]] const TimeoutRace& race() const { return race_; }

 private:
  GoalMonitor& monitor_;
  const std::vector<std::uint8_t>* const unwanted_;
  const std::function<void(const SeenMove&)>& on_move_;
  Stepper stepper_;
  StateReplay replay_;
  TimeoutRace race_;
};

}  // namespace

std::vector<std::uint32_t> bound_variables(const CompiledCatalog& catalog,
                                           const Assumptions& assumptions) {
  std::set<std::uint32_t> named;
  for (const FittingValue& fitting : catalog.fitting_values) named.insert(fitting.variable);
  std::set<std::uint32_t> bound;
  for (const SituationPart& part : assumptions.never) {
    for (const VariableValue& value : part.variables) bound.insert(value.variable);
  }
  std::vector<std::uint32_t> variables;
  for (const std::uint32_t variable : assumptions.variables) {
    if (bound.contains(variable) && !named.contains(variable)) variables.push_back(variable);
  }
  return variables;
}

GoalSearchResult search_goals(const CompiledCatalog& catalog, GoalScope scope,
                              const Assumptions& assumptions, GoalMonitor& monitor,
                              const std::vector<std::uint8_t>* unwanted,
                              const GoalSearchOptions& options,
                              const std::function<void(const SeenMove&)>& on_move) {
  GoalSearchResult result;
  std::vector<GroupId> groups;
  std::set<std::uint32_t> variables;
  if (scope.group) {
    groups.push_back(*scope.group);
  } else {
    variables.insert(scope.variable);
  }
  const Model model(catalog, groups, assumptions, variables);
  // What is about no group comes after the last one.
  const GroupId shown = scope.group.value_or(
      GroupId(static_cast<std::uint32_t>(std::max<std::size_t>(1, catalog.group_count()) - 1)));
  result.error = model.find_obstacle();
  if (result.error) return result;
  // One state more than may be visited ends the search.
  BreadthFirst search(model.packed_first(), {options.max_states + 1, options.max_memory},
                      [&](std::uint64_t states) {
                        return !options.on_progress || options.on_progress(shown, states);
                      });
  ReplayVisitor visitor(model, scope.group, monitor, unwanted, on_move);
  search.run(visitor);
  result.states = search.store().size();
  result.moves = search.transitions();
  result.is_complete = search.is_complete();
  result.end = search.end();
  if (result.is_complete) visitor.race().tell(monitor);
  return result;
}

namespace {

class GraphBuilder {
 public:
  GraphBuilder(const CompiledCatalog& catalog, std::span<const Goal> goals,
               const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
               const GoalSearchOptions& options)
      : catalog_(catalog),
        goals_(goals),
        assumptions_(assumptions),
        options_(options),
        monitor_(catalog, goals, {}),
        bound_(bound_variables(catalog, assumptions)),
        is_met_(goals.size(), 0),
        returns_(catalog.tasks.size(), none) {
    monitor_.take_failures_for_timeouts();
    graph_.goal_count = goals.size();
    for (const Goal& goal : goals) {
      const bool is_return = goal.kind == Goal::Kind::reactive_returned;
      graph_.is_return.push_back(is_return ? 1 : 0);
    }
    for (std::uint32_t goal = 0; goal < goals.size(); ++goal) {
      unwanted_.push_back(wanted[goal] == 0 || graph_.is_return[goal] != 0 ? 1 : 0);
      if (wanted[goal] != 0 && graph_.is_return[goal] != 0) returns_[goals[goal].task] = goal;
    }
  }

  GoalGraph build() {
    for (GroupId group(0); group < catalog_.group_count(); ++group) {
      // To begin the searches of very many groups takes long, too.
      if (options_.on_progress && !options_.on_progress(group, 0)) break;
      first_state_ = static_cast<std::uint32_t>(graph_.state_count());
      if (group == 0) add_free_variables();
      if (!add_part({group}, {group, first_state_})) break;
    }
    if (!graph_.error && graph_.parts.size() == catalog_.group_count()) add_bound_variables();
    graph_.facts = monitor_.facts();
    return std::move(graph_);
  }

 private:
  /// False if nothing can be explored.
  bool add_part(GoalScope scope, GoalGraph::Part part) {
    const GoalSearchResult result =
        search_goals(catalog_, scope, assumptions_, monitor_, &unwanted_, options_,
                     [this](const SeenMove& move) { add_move(move); });
    graph_.error = result.error;
    if (graph_.error) return false;
    part.is_complete = result.is_complete;
    graph_.parts.push_back(part);
    end_states_before(first_state_ + static_cast<std::uint32_t>(result.states));
    return true;
  }

  /// Values of these that no group shows, as nothing ties them to any.
  void add_bound_variables() {
    if (catalog_.group_count() == 0) return;
    for (const std::uint32_t variable : bound_) {
      const auto is_open = [&](std::uint32_t goal) {
        return goals_[goal].variable == variable && unwanted_[goal] == 0 && is_met_[goal] == 0;
      };
      bool is_wanted = false;
      for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
        is_wanted = is_wanted || is_open(goal);
      }
      if (!is_wanted) continue;
      first_state_ = static_cast<std::uint32_t>(graph_.state_count());
      if (!add_part({std::nullopt, variable}, {GroupId(0), first_state_, false, variable})) return;
    }
  }

  void add_move(const SeenMove& seen) {
    items_.clear();
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      if (monitor_.met()[goal] != 0 && unwanted_[goal] == 0 &&
          is_shown_by(goals_[goal], seen.move)) {
        items_.push_back(goal);
        is_met_[goal] = 1;
      }
    }
    for (const TaskId task : seen.started) add_return(task, 0);
    for (const TaskId task : seen.gave_way) add_return(task, graph_.goal_count);
    end_states_before(first_state_ + seen.from);
    add_edge(first_state_ + seen.from, first_state_ + seen.to, seen.move);
  }

  /// The edges of the states before this one are complete.
  void end_states_before(std::uint32_t state) {
    graph_.begin.resize(state + 1, static_cast<std::uint32_t>(graph_.edges.size()));
  }

  /// A monitor notes the values in each state. A path shows those at its beginning anyway.
  [[nodiscard]] bool is_shown_by(const Goal& goal, const Move& move) const {
    if (goal.kind != Goal::Kind::variable_value) return true;
    if (move.kind != Move::Kind::variable && move.kind != Move::Kind::together) return false;
    const Step step = step_of(catalog_, assumptions_, move);
    const auto& values = step.situation.variables;
    return std::any_of(values.begin(), values.end(), [&](const VariableValue& value) {
      return value.variable == goal.variable && value.value == goal.value;
    });
  }

  void add_return(TaskId task, std::size_t offset) {
    if (returns_[task] == none) return;
    items_.push_back(returns_[task] + static_cast<std::uint32_t>(offset));
  }

  /// Leaves out a move if another one does the same, and meets these goals and perhaps more.
  void add_edge(std::uint32_t from, std::uint32_t to, const Move& move) {
    std::sort(items_.begin(), items_.end());
    if (from == to && items_.empty()) return;
    for (std::size_t other = graph_.begin.back(); other < graph_.edges.size(); ++other) {
      const auto items = graph_.items_of(graph_.edges[other]);
      if (graph_.edges[other].to == to &&
          std::includes(items.begin(), items.end(), items_.begin(), items_.end())) {
        return;
      }
    }
    graph_.edges.push_back({to, static_cast<std::uint32_t>(graph_.items.size()),
                            static_cast<std::uint32_t>(items_.size()), move});
    graph_.items.insert(graph_.items.end(), items_.begin(), items_.end());
  }

  /// Variables that neither a behavior nor `never` names are no part of any state.
  void add_free_variables() {
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      const std::uint32_t variable = goals_[goal].variable;
      const auto& may_change = assumptions_.variables;
      if (unwanted_[goal] != 0 || variable == none ||
          std::find(may_change.begin(), may_change.end(), variable) == may_change.end() ||
          std::find(bound_.begin(), bound_.end(), variable) != bound_.end() ||
          std::any_of(catalog_.fitting_values.begin(), catalog_.fitting_values.end(),
                      [&](const FittingValue& one) { return one.variable == variable; })) {
        continue;
      }
      items_ = {goal};
      add_edge(first_state_, first_state_,
               {Move::Kind::variable, variable, static_cast<std::int32_t>(goals_[goal].value)});
    }
  }

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  const Assumptions& assumptions_;
  const GoalSearchOptions& options_;
  GoalMonitor monitor_;
  GoalGraph graph_;
  std::vector<std::uint8_t> unwanted_;      ///< by goal: not asked about
  const std::vector<std::uint32_t> bound_;  ///< see bound_variables()
  std::vector<std::uint8_t> is_met_;        ///< by goal: by an edge
  std::vector<std::uint32_t> returns_;      ///< by task: its goal of returning, if it is wanted
  std::uint32_t first_state_ = 0;           ///< of the present group
  std::vector<std::uint32_t> items_;        ///< of the present edge
};

}  // namespace

GoalGraph explore_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                        const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
                        const GoalSearchOptions& options) {
  return GraphBuilder(catalog, goals, wanted, assumptions, options).build();
}

}  // namespace cbc
