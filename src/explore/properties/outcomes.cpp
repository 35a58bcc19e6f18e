// Which tasks run with which behaviors is part of the control, and so is the queue: the outcomes
// are found by looking at each control once after the run, however many environments it is reached
// in (docs/verify.md, "All outcomes"). The environments matter again for the script, which leads to
// the first of all states with the outcome. To note the states while they are visited would find
// the same, and keep more of them.

#include "explore/properties/outcomes.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "explore/moves/stepper.h"
#include "explore/space/first_states.h"

namespace cbc {

namespace {

using Running = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

using Found = std::vector<FirstStates>;  // by part

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

std::map<Running, Found> find_first_states(const std::vector<CatalogSystem*>& systems,
                                           StateSpace& space) {
  std::map<Running, Found> found;
  Found nothing;
  for (const auto& part : space.parts()) nothing.emplace_back(*part);
  for (std::size_t place = 0; place < systems.size(); ++place) {
    StatePart& part = *space.parts()[place];
    const CatalogSystem& system = *systems[place];
    std::vector<bool> is_known(part.controls().size(), false);
    const std::size_t layers =
        std::min<std::size_t>(part.layers().size(), space.expanded_depth() + std::size_t{1});
    for (std::uint32_t depth = 0; depth < layers; ++depth) {
      for (const StatePart::States& states : part.layers()[depth]) {
        if (is_known[states.control]) continue;
        is_known[states.control] = true;
        part.controls().load(states.control);
        if (!system.stepper().is_settled()) continue;
        const auto entry =
            found.try_emplace(running_in(system.model(), system.stepper()), nothing).first;
        entry->second[place].add(states, depth);
      }
    }
  }
  return found;
}

/// What a state is like, besides what runs.
void describe_environment(CatalogSystem& system, const std::vector<std::uint8_t>& environment,
                          ReachableOutcome& outcome) {
  const Model& model = system.model();
  const CompiledCatalog& catalog = model.catalog();
  Environments& environments = system.environments();
  const auto is_in = [&](Diagrams::Set set) { return system.sets().contains(set, environment); };
  for (std::uint32_t variable = 0; variable < model.variables().size(); ++variable) {
    std::uint32_t value = 0;
    while (!is_in(environments.with_value(variable, value))) ++value;
    outcome.situation.variables.push_back({model.variables()[variable].id, value});
  }
  for (std::uint32_t own = 0; own < model.own_flags().size(); ++own) {
    outcome.situation.behaviors.push_back(
        {model.own_flags()[own].id, !is_in(environments.with_own_flag(own))});
  }
  std::sort(outcome.situation.behaviors.begin(), outcome.situation.behaviors.end(),
            [&](const SituationPart::Own& a, const SituationPart::Own& b) {
              return catalog.behaviors[a.behavior].catalog_index <
                     catalog.behaviors[b.behavior].catalog_index;
            });
  for (const std::uint32_t behavior : model.behaviors_in_order()) {
    if (!is_in(environments.faulty(behavior))) continue;
    outcome.faulty.push_back(model.behaviors()[behavior].id);
  }
}

}  // namespace

std::vector<ReachableOutcome> find_outcomes(const std::vector<CatalogSystem*>& systems,
                                            StateSpace& space) {
  std::vector<ReachableOutcome> outcomes;
  for (const auto& [running, first] : find_first_states(systems, space)) {
    ReachableOutcome& outcome = outcomes.emplace_back();
    outcome.running = running;
    std::vector<const FirstStates*> noted;
    for (const FirstStates& of_part : first) noted.push_back(&of_part);
    StateSpace::Path path = space.path_to(noted);
    outcome.script = std::move(path.moves);
    for (const auto& part : space.parts()) part->collect_if_crowded();
    describe_environment(*systems.front(), path.end.environment(), outcome);
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
  std::vector<StateCondition>& parts = property.condition.parts;
  for (const auto& [task, behavior] : outcome.running) {
    parts.push_back(StateCondition::of_task(StateCondition::Kind::running, catalog.task_ids[task],
                                            {catalog.behavior_ids[behavior]}));
    stopped.erase(catalog.task_ids[task]);
  }
  for (const TaskId task : stopped) {
    parts.push_back(StateCondition::of_task(StateCondition::Kind::stopped, task));
  }
  return property;
}

}  // namespace cbc
