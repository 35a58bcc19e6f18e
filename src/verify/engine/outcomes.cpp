// Which tasks run with which behaviors is part of the control, and so is the queue: the outcomes
// are found by looking at each control once after the run, however many environments it is reached
// in (docs/verify.md, "All outcomes"). The environments matter again for the script, which leads to
// the first of all states with the outcome. To note the states while they are visited would find
// the same, and keep more of them.

#include "verify/engine/outcomes.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Running = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Where an outcome is first reached.
struct FirstStates {
  std::uint32_t depth = 0;
  std::vector<StatePart::Layer> layers;  ///< by part
};

Running running_in(const Model& model, const Stepper& control) {
  const CompiledCatalog& catalog = model.catalog();
  Running running;
  for (const std::uint32_t task : model.tasks_in_order()) {
    const std::uint16_t cell = control.cells()[task];
    if (cell == 0) continue;
    const std::uint32_t value = model.tasks()[task].values.begin + cell - 1U;
    const BehaviorId behavior = model.behaviors()[model.behavior_of(value)].id;
    running.emplace_back(catalog.tasks[model.tasks()[task].id].catalog_index,
                         catalog.behaviors[behavior].catalog_index);
  }
  return running;
}

std::map<Running, FirstStates> find_first_states(const Model& model, StateSpace& space) {
  std::map<Running, FirstStates> found;
  const std::size_t count = space.parts().size();
  for (std::size_t place = 0; place < count; ++place) {
    StatePart& part = *space.parts()[place];
    std::vector<bool> is_known(part.controls().size(), false);
    const std::size_t layers =
        std::min<std::size_t>(part.layers().size(), space.expanded_depth() + std::size_t{1});
    for (std::uint32_t depth = 0; depth < layers; ++depth) {
      for (const StatePart::States& states : part.layers()[depth]) {
        if (is_known[states.control]) continue;
        is_known[states.control] = true;
        part.controls().load(states.control);
        const Stepper& control = part.controls().stepper();
        if (!control.is_settled()) continue;
        FirstStates& first = found[running_in(model, control)];
        if (first.layers.empty() || depth < first.depth) {
          first.depth = depth;
          first.layers.assign(count, {});
        }
        if (depth == first.depth) first.layers[place].push_back(states);
      }
    }
  }
  return found;
}

/// What the state that the stepper has loaded is like, besides what runs.
void describe_environment(const Model& model, const Stepper& state, ReachableOutcome& outcome) {
  const CompiledCatalog& catalog = model.catalog();
  for (std::uint32_t variable = 0; variable < model.variables().size(); ++variable) {
    outcome.situation.variables.push_back(
        {model.variables()[variable].id, state.value_of(variable)});
  }
  for (std::uint32_t own = 0; own < model.own_flags().size(); ++own) {
    outcome.situation.behaviors.push_back(
        {model.own_flags()[own].id, state.cells()[model.layout().own + own] == 0});
  }
  std::sort(outcome.situation.behaviors.begin(), outcome.situation.behaviors.end(),
            [&](const SituationPart::Own& a, const SituationPart::Own& b) {
              return catalog.behaviors[a.behavior].catalog_index <
                     catalog.behaviors[b.behavior].catalog_index;
            });
  for (const std::uint32_t behavior : model.behaviors_in_order()) {
    if (state.is_faulty(behavior)) outcome.faulty.push_back(model.behaviors()[behavior].id);
  }
}

}  // namespace

std::vector<ReachableOutcome> find_outcomes(const Model& model, StateSpace& space) {
  std::vector<ReachableOutcome> outcomes;
  Stepper stepper(model);
  for (const auto& [running, first] : find_first_states(model, space)) {
    ReachableOutcome& outcome = outcomes.emplace_back();
    outcome.running = running;
    StateSpace::Path path = space.path_to(first.layers, first.depth);
    outcome.script = std::move(path.moves);
    for (const auto& part : space.parts()) part->collect_if_crowded();
    stepper.load(path.end.data());
    describe_environment(model, stepper, outcome);
  }
  std::stable_sort(outcomes.begin(), outcomes.end(),
                   [](const ReachableOutcome& a, const ReachableOutcome& b) {
                     return a.script.size() < b.script.size();
                   });
  return outcomes;
}

Property property_of(const CompiledCatalog& catalog, GroupId group,
                     const ReachableOutcome& outcome) {
  Property property;
  property.kind = Property::Kind::reachable;
  property.settled = true;
  std::set<TaskId> stopped;
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    stopped.insert(task);
  }
  for (const auto& [task, behavior] : outcome.running) {
    property.condition.running.push_back(
        {catalog.task_ids[task], {catalog.behavior_ids[behavior]}});
    stopped.erase(catalog.task_ids[task]);
  }
  property.condition.stopped.assign(stopped.begin(), stopped.end());
  return property;
}

}  // namespace cbc
