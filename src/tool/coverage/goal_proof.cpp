#include "coverage/goal_proof.h"

#include <algorithm>
#include <deque>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "coordinator/coordinator.h"
#include "coverage/goal_watch.h"
#include "coverage/state_replay.h"
#include "coverage/timeout_race.h"
#include "verify/model.h"
#include "verify/stepper.h"

namespace cbc {
namespace {

using Number = std::uint32_t;

/// The graph of the reachable states of a group.
class GroupExploration {
 public:
  GroupExploration(const CompiledCatalog& catalog, std::uint32_t group,
                   const Assumptions& assumptions, GoalWatch& watch,
                   const GoalProofOptions& options)
      : model_(catalog, {group}, assumptions),
        stepper_(model_, {.reduce = true}),
        replay_(model_, watch),
        race_(catalog, group),
        group_(group),
        options_(options) {}

  [[nodiscard]] bool begins_excluded() const {
    return model_.is_excluded(model_.first_state().data());
  }

  GoalProof::Group run() {
    std::vector<std::uint32_t> packed(model_.packed_words());
    model_.pack(model_.first_state().data(), packed.data());
    find(packed);
    result_.is_complete = true;
    for (Number state = 0; state < states_.size() && result_.is_complete; ++state) {
      if (states_.size() > options_.max_states || !goes_on()) {
        result_.is_complete = false;
      } else {
        expand(state);
      }
    }
    result_.states = states_.size();
    return result_;
  }

  [[nodiscard]] const TimeoutRace& race() const { return race_; }

  /// The reactive tasks that start by themselves in some path after they have given way.
  [[nodiscard]] std::vector<TaskId> returning() const {
    std::vector<TaskId> tasks;
    for (const auto& [task, states] : left_behind_) {
      const auto starts = starts_from_.find(task);
      if (starts != starts_from_.end() && leads_to_any(states, starts->second)) {
        tasks.push_back(task);
      }
    }
    return tasks;
  }

 private:
  [[nodiscard]] bool goes_on() const {
    return !options_.on_progress || options_.on_progress(group_, states_.size());
  }

  Number find(const std::vector<std::uint32_t>& packed) {
    const std::string_view bytes(reinterpret_cast<const char*>(packed.data()),
                                 packed.size() * sizeof(packed.front()));
    const auto [entry, is_new] =
        numbers_.try_emplace(std::string(bytes), static_cast<Number>(states_.size()));
    if (is_new) {
      states_.push_back(packed);
      next_.emplace_back();
    }
    return entry->second;
  }

  void expand(Number state) {
    std::vector<std::uint32_t> packed(model_.packed_words());
    stepper_.load(states_[state].data());
    replay_.load(stepper_);
    for (const Model::Choice& choice : model_.moves()) {
      if (!stepper_.has_move(choice)) continue;
      const Move move = stepper_.move_of(choice);
      if (!stepper_.take(choice)) continue;
      ++result_.moves;
      stepper_.pack(packed.data());
      const Number reached = find(packed);
      next_[state].push_back(reached);
      replay_.take(move);
      race_.note(replay_, move);
      for (const TaskId task : replay_.gave_way()) left_behind_[task].push_back(reached);
      for (const TaskId task : replay_.started()) starts_from_[task].push_back(state);
    }
  }

  [[nodiscard]] bool leads_to_any(const std::vector<Number>& from,
                                  const std::vector<Number>& to) const {
    std::vector<std::uint8_t> is_wanted(states_.size(), 0);
    for (const Number state : to) is_wanted[state] = 1;
    std::vector<std::uint8_t> is_seen(states_.size(), 0);
    std::vector<Number> waiting;
    const auto add = [&](Number state) {
      if (std::exchange(is_seen[state], std::uint8_t{1}) == 0) waiting.push_back(state);
    };
    for (const Number state : from) add(state);
    while (!waiting.empty()) {
      const Number state = waiting.back();
      waiting.pop_back();
      if (is_wanted[state] != 0) return true;
      for (const Number reached : next_[state]) add(reached);
    }
    return false;
  }

  const Model model_;
  Stepper stepper_;
  StateReplay replay_;
  TimeoutRace race_;
  const std::uint32_t group_;
  const GoalProofOptions& options_;
  GoalProof::Group result_;
  std::unordered_map<std::string, Number> numbers_;
  std::deque<std::vector<std::uint32_t>> states_;
  std::deque<std::vector<Number>> next_;
  std::map<TaskId, std::vector<Number>> left_behind_;  ///< states after a task gave way
  std::map<TaskId, std::vector<Number>> starts_from_;  ///< states before a task started by itself
};

/// The groups that a goal is about: of a variable those whose behaviors name it.
std::vector<std::uint32_t> groups_of(const CompiledCatalog& catalog, const Goal& goal) {
  if (goal.task != none) return {catalog.tasks[goal.task].group};
  if (goal.behavior != none) return {catalog.group_of(goal.behavior)};
  std::vector<std::uint32_t> groups;
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (fitting.variable == goal.variable) groups.push_back(catalog.group_of(fitting.behavior));
  }
  return groups;
}

/// Of a variable that no behavior names.
bool may_have(const Assumptions& assumptions, const Goal& goal) {
  return initial_value(assumptions, goal.variable) == goal.value ||
         std::find(assumptions.variables.begin(), assumptions.variables.end(), goal.variable) !=
             assumptions.variables.end();
}

}  // namespace

Assumptions assumptions_of_goals(const CompiledCatalog& catalog) {
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : catalog.task_ids) {
    const CompiledTask& compiled = catalog.tasks[task];
    const bool starts_otherwise = compiled.reactive_start != 0 || !catalog.incoming[task].empty();
    if (compiled.start_on_request == 0 && starts_otherwise) continue;
    assumptions.start.push_back({task, {1, 2}});
    assumptions.stop.push_back(task);
  }
  return assumptions;
}

GoalProof prove_unreachable(const CompiledCatalog& catalog, std::span<const Goal> goals,
                            const Assumptions& assumptions, const GoalProofOptions& options) {
  GoalProof proof;
  proof.unreachable.resize(goals.size());
  proof.groups.resize(catalog.group_count());
  std::vector<ValueId> forestalled_by(catalog.values.items.size(), none);
  GoalWatch watch(catalog, goals, {});
  watch.take_failures_for_timeouts();
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) {
    if (options.group.value_or(group) != group) continue;
    GroupExploration exploration(catalog, group, assumptions, watch, options);
    if (exploration.begins_excluded()) {
      proof.error = "the first state is in a situation that 'never' excludes";
      return proof;
    }
    proof.groups[group] = exploration.run();
    if (proof.groups[group].is_complete) exploration.race().tell(forestalled_by);
    for (const TaskId task : exploration.returning()) watch.note_return(task);
  }
  proof.facts = watch.facts();
  proof.facts.forestalled_by = std::move(forestalled_by);
  for (std::size_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    const std::vector<std::uint32_t> groups = groups_of(catalog, goal);
    const bool is_proven = std::all_of(groups.begin(), groups.end(), [&](std::uint32_t group) {
      return proof.groups[group].is_complete;
    });
    const bool is_free = groups.empty() && may_have(assumptions, goal);
    const bool is_met = watch.met()[number] != 0 && !is_forestalled(catalog, goal, proof.facts);
    if (is_met || !is_proven || is_free) continue;
    proof.unreachable[number] = why_unreachable(catalog, goals, number, assumptions, proof.facts);
  }
  return proof;
}

}  // namespace cbc
