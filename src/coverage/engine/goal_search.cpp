// Which goals can be met at all: reachability, as in `cbc verify`. A return needs two moves, the
// one in which a task gives way, and a later one in which it starts by itself: whether the one
// leads to the other is found going backward, once all states are known.

#include "coverage/engine/goal_search.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "explore/properties/explore.h"

namespace cbc {
namespace {

using Set = StatePart::Set;
using Layer = StatePart::Layer;

std::vector<GroupId> groups_in(const GoalScope& scope) {
  return scope.group ? std::vector{*scope.group} : std::vector<GroupId>();
}

std::set<std::uint32_t> variables_in(const GoalScope& scope) {
  return scope.group ? std::set<std::uint32_t>() : std::set{scope.variable};
}

/// Of a part: the states before moves with an item, or those after them, by control.
using Found = std::map<Controls::Number, Set>;

Layer layer_of(const Found& found) {
  Layer layer;
  for (const auto& [control, environments] : found) layer.push_back({control, environments});
  return layer;
}

/// Calls `take(from, result, after)` with all moves between states of a part that meet something.
template <typename Take>
void for_each_note(StatePart& part, Take&& take) {
  ControlSystem& system = part.system();
  const Controls::Number count = part.controls().size();
  for (Controls::Number control = 0; control < count; ++control) {
    if (!part.is_own(control) || part.visited(control) == Diagrams::empty) continue;
    part.controls().load(control);
    for (std::uint32_t action = 0; action < system.actions().size(); ++action) {
      const ControlSystem::Action& made = system.actions()[action];
      const Set set = system.sets().both(part.visited(control), made.condition);
      if (set == Diagrams::empty || !system.may_have(action)) continue;
      part.controls().for_each_result(action, set, [&](Controls::NumberedResult result, Set from) {
        if (result.note != 0)
          take({control, from}, result, system.after(made, result.values, from));
      });
    }
  }
}

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

Budget GoalSearchOptions::budget_of(GroupId group, std::size_t groups) const {
  const auto count = static_cast<double>(groups);
  const double after = groups == 0 ? 0 : (count - 1 - group) / count;
  return budget.until(1 - kept - 0.1 * after);
}

/// What is about no group comes after the last one.
GoalSearch::GoalSearch(const CompiledCatalog& catalog, GoalScope scope,
                       const Assumptions& assumptions, const GoalQuestion& question,
                       const GoalSearchOptions& options)
    : question_(question), model_(catalog, groups_in(scope), assumptions, variables_in(scope)) {
  if (model_.find_obstacle()) return;
  const std::size_t groups = catalog.group_count();
  const GroupId shown = scope.group.value_or(
      GroupId(static_cast<std::uint32_t>(std::max<std::size_t>(1, groups) - 1)));
  ExplorationOptions of_exploration;
  of_exploration.budget = options.budget_of(shown, groups);
  of_exploration.reduce = true;
  Stepper::Options of_stepper = share_memory(of_exploration, of_exploration.budget);
  const std::size_t jobs = std::max(1U, options.jobs);
  of_stepper.decision_bytes /= jobs;
  StateSpace::Systems systems;
  systems_ = add_systems<GoalSystem>(jobs, systems, model_, of_stepper, question);
  space_.emplace(std::move(systems), of_exploration.budget, name_groups({shown}));
}

GoalSearchResult GoalSearch::run(GoalFacts& facts, std::vector<std::uint8_t>& met,
                                 const std::function<void()>& on_depth) {
  GoalSearchResult result;
  result.error = model_.find_obstacle();
  if (result.error) return result;
  struct NoVisitor {
    void visit(const StatePart::States& /*states*/, std::uint32_t /*depth*/) const {}
    void on_refusal(std::uint32_t /*action*/, const StatePart::States& /*states*/) const {}
    void on_result(std::uint32_t /*action*/, const StatePart::States& /*states*/,
                   Controls::NumberedResult /*result*/) const {}
    void on_note(std::uint32_t /*note*/, const StatePart::States& /*states*/) const {}
  };
  std::vector<NoVisitor> visitors(systems_.size());
  space_->run(visitors, [&] {
    if (on_depth) on_depth();
    return false;
  });
  if (space_->is_complete() && !question_.is_about_moves) find_returns(met);
  if (space_->is_complete()) report(facts, met);
  result.states = space_->states();
  result.moves = space_->transitions();
  result.is_complete = space_->is_complete();
  if (!result.is_complete) result.end = space_->end();
  return result;
}

void GoalSearch::find_returns(std::vector<std::uint8_t>& met) {
  const auto& goals = question_.goals;
  std::map<std::uint32_t, std::vector<Found>> before;  // by goal and part: before it starts
  std::map<std::uint32_t, std::vector<Found>> after;   // the same: after it gave way
  for (std::size_t place = 0; place < systems_.size() && !model_.reactive().empty(); ++place) {
    StatePart& part = *space_->parts()[place];
    const auto add = [&](std::vector<Found>& found, Controls::Number control, Set environments) {
      found.resize(systems_.size());
      Set& known = found[place].try_emplace(control, Diagrams::empty).first->second;
      known = part.system().sets().either(known, environments);
    };
    for_each_note(
        part, [&](const StatePart::States& from, Controls::NumberedResult result, Set to) {
          for (const std::uint32_t item : systems_[place]->items_of(result.note)) {
            if (item >= goals.size()) {
              add(after[item - static_cast<std::uint32_t>(goals.size())], result.control, to);
            } else if (goals[item].kind == Goal::Kind::reactive_returned) {
              add(before[item], from.control, from.environments);
            }
          }
        });
  }
  for (const auto& [goal, starts] : before) {
    if (!after.contains(goal)) continue;
    std::vector<Layer> targets;
    std::vector<StatePart::Parcel> left_behind;
    for (std::size_t place = 0; place < systems_.size(); ++place) {
      targets.push_back(layer_of(starts[place]));
      left_behind.push_back(space_->parts()[place]->pack(layer_of(after[goal][place])));
    }
    const auto reaching = space_->can_reach(targets, nullptr, std::nullopt);
    if (!reaching) return;
    const auto leads_there = [&](std::size_t place) {
      StatePart& part = *space_->parts()[place];
      const Layer layer = part.unpack(left_behind);
      return std::any_of(layer.begin(), layer.end(), [&](const StatePart::States& states) {
        if (!part.is_own(states.control)) return false;
        const Set known = (*reaching)[place][states.control];
        return part.system().sets().both(states.environments, known) != Diagrams::empty;
      });
    };
    for (std::size_t place = 0; place < systems_.size(); ++place) {
      if (met[goal] == 0 && leads_there(place)) met[goal] = 1;
    }
  }
}

void GoalSearch::report(GoalFacts& facts, std::vector<std::uint8_t>& met) {
  TimeoutRace race(model_);
  for (std::size_t place = 0; place < systems_.size(); ++place) {
    StatePart& part = *space_->parts()[place];
    GoalSystem& system = *systems_[place];
    Set all = Diagrams::empty;
    for (Controls::Number control = 0; control < part.controls().size(); ++control) {
      if (part.is_own(control)) all = system.sets().either(all, part.visited(control));
    }
    system.note_situations(all);
    facts.add(system.facts());
    race.add(system.race());
    for (std::size_t goal = 0; goal < met.size(); ++goal) met[goal] |= system.met()[goal];
  }
  race.tell(facts);
}

}  // namespace cbc
