// What holds in all reachable states of some groups: model checking of invariants ("Handbook of
// Model Checking", edited by E. M. Clarke, T. A. Henzinger, H. Veith and R. Bloem, 2018, chapter
// 5). StateSpace goes by the number of moves, so where something is seen first, it is at the end of
// a shortest path: a task runs, a start is refused, a property is violated.
//
// A depth-first search finds long counterexamples. A bounded search (SAT) would need every decision
// as a formula, but a decision is an optimum over all assignments.

#include "explore/properties/explore.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/support/system.h"
#include "explore/controls/catalog_system.h"
#include "explore/space/state_space.h"

namespace cbc {

namespace {

using States = StatePart::States;
using Tests = std::vector<std::unique_ptr<PropertyTest>>;  // by property
constexpr std::uint32_t never_seen = FirstStates::never;

/// Notes the least depth at which something was seen, and looks at properties.
class PropertyVisitor {
 public:
  PropertyVisitor(CatalogSystem& system, const Tests& properties, bool tries_starts)
      : system_(system),
        properties_(properties),
        runs_(system.model().tasks().size(), never_seen),
        active_(system.model().behaviors().size(), never_seen),
        start_refused_(runs_.size(), never_seen),
        together_(runs_.size() * words_for(runs_.size()), 0) {
    for (const auto& property : properties) {
      if (property->looks_at_moves()) of_moves_.push_back(property.get());
    }
    if (!tries_starts) return;
    const Model& model = system.model();
    for (std::uint32_t task = 0; task < model.tasks().size(); ++task) {
      if (!model.tasks()[task].start_on_request) continue;
      const std::uint32_t trial = system.find_start(task, model.ranks_up_to(1));
      trials_.resize(system.actions().size(), none);
      trials_[trial] = task;
    }
  }

  void visit(const States& states, std::uint32_t depth) {
    depth_ = depth;
    if (states.control >= is_known_.size()) is_known_.resize(states.control * 2 + 1, 0);
    if (std::exchange(is_known_[states.control], std::uint8_t{1}) == 0) visit_control();
    for (const auto& property : properties_) property->visit(states, depth);
  }

  void on_refusal(std::uint32_t action, const States& states) {
    if (system_.stepper().cells()[system_.choice_of(action).subject] != 0) return;
    if (action < trials_.size() && trials_[action] != none) note(start_refused_[trials_[action]]);
    for (const auto& property : properties_) property->on_refusal(action, states, depth_);
  }

  void on_result(std::uint32_t action, const States& states,
                 Controls::NumberedResult result) const {
    for (PropertyTest* const property : of_moves_) {
      property->on_result(action, states, result, depth_);
    }
  }

  void on_note(std::uint32_t /*note*/, const States& /*states*/) const {}

  /// What the visitors of all parts saw.
  static void report(const std::vector<PropertyVisitor>& parts, Exploration& result);

 private:
  struct Together {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t depth = 0;
  };

  void note(std::uint32_t& first) const { first = std::min(first, depth_); }

  /// What is the same in all environments.
  void visit_control() {
    const Stepper& control = system_.stepper();
    const auto& running = control.running();
    const std::size_t words = running.size();
    for_each_bit(running.data(), words, [&](std::uint32_t task) {
      note(runs_[task]);
      Word* const known = &together_[task * words];
      for (std::size_t word = 0; word < words; ++word) {
        Word fresh = running[word] & ~known[word];
        known[word] |= fresh;
        for (; fresh != 0; fresh &= fresh - 1) {
          const auto other = static_cast<std::uint32_t>(
              word * 64 + static_cast<unsigned>(std::countr_zero(fresh)));
          if (other != task) pairs_.push_back({task, other, depth_});
        }
      }
    });
    for_each_bit(control.active().data(), control.active().size(),
                 [&](std::uint32_t behavior) { note(active_[behavior]); });
  }

  CatalogSystem& system_;
  const Tests& properties_;
  std::vector<PropertyTest*> of_moves_;  ///< those that look at moves
  std::vector<std::uint32_t> trials_;    ///< by action: the task whose start is tried, or none
  std::uint32_t depth_ = 0;
  std::vector<std::uint8_t> is_known_;  ///< by control
  std::vector<std::uint32_t> runs_;
  std::vector<std::uint32_t> active_;
  std::vector<std::uint32_t> start_refused_;
  std::vector<Word> together_;   ///< by task: the tasks that were seen to run beside it
  std::vector<Together> pairs_;  ///< each in both orders
};

void PropertyVisitor::report(const std::vector<PropertyVisitor>& parts, Exploration& result) {
  const Model& model = parts.front().system_.model();
  const CompiledCatalog& catalog = model.catalog();
  const auto index_of = [&](std::uint32_t task) {
    return catalog.tasks[model.tasks()[task].id].catalog_index;
  };
  const auto first_of = [&](std::vector<std::uint32_t> PropertyVisitor::*list, std::uint32_t at) {
    std::uint32_t first = never_seen;
    for (const PropertyVisitor& part : parts) first = std::min(first, (part.*list)[at]);
    return first;
  };
  for (const std::uint32_t task : model.tasks_in_order()) {
    const std::uint32_t runs = first_of(&PropertyVisitor::runs_, task);
    const std::uint32_t refused = first_of(&PropertyVisitor::start_refused_, task);
    if (runs != never_seen) result.runs.emplace_back(index_of(task), runs);
    if (refused != never_seen) result.start_refused.emplace_back(index_of(task), refused);
  }
  for (const std::uint32_t behavior : model.behaviors_in_order()) {
    const std::uint32_t active = first_of(&PropertyVisitor::active_, behavior);
    if (active == never_seen) continue;
    const BehaviorId id = model.behaviors()[behavior].id;
    result.active.emplace_back(catalog.behaviors[id].catalog_index, active);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> together;
  for (const PropertyVisitor& part : parts) {
    for (const Together& pair : part.pairs_) {
      const std::pair key(index_of(pair.a), index_of(pair.b));
      if (key.first > key.second) continue;
      std::uint32_t& first = together.try_emplace(key, pair.depth).first->second;
      first = std::min(first, pair.depth);
    }
  }
  for (const auto& [pair, depth] : together) {
    result.together.push_back({pair.first, pair.second, depth});
  }
}

/// What the tables of pairs of tasks take, before any state is visited: in the model, the needs and
/// the rivals; and what was seen to run together.
std::uint64_t bytes_of_pairs(const Model& model) {
  const std::uint64_t pairs = std::uint64_t{model.tasks().size()} * model.tasks().size();
  return pairs / 4 + pairs / 8;
}

}  // namespace

Stepper::Options share_memory(const ExplorationOptions& options, Budget& budget) {
  std::uint64_t& memory = budget.max_memory;
  Stepper::Options result;
  result.reduce = options.reduce;
  result.on_decision = options.on_decision;
  constexpr std::uint64_t most = std::uint64_t{256} << 20;
  result.decision_bytes = static_cast<std::size_t>(memory == 0 ? most : std::min(most, memory / 4));
  // An array that grows takes twice its size for a while.
  if (memory > 0) memory -= std::min<std::uint64_t>(memory / 2, 2 * result.decision_bytes);
  return result;
}

std::string name_groups(const std::vector<GroupId>& groups) {
  std::string text = groups.size() == 1 ? "group" : "groups";
  for (const GroupId group : groups) text += fmt::format(" {}", std::uint32_t{group});
  return text;
}

Exploration explore(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                    const Assumptions& assumptions, const std::vector<const Property*>& properties,
                    const ExplorationOptions& options) {
  Exploration result;
  result.groups = groups;
  if (options.outcomes) result.outcomes.emplace();
  const auto end_before_moves = [&](Budget::End end) {
    result.end = end;
    result.states = 1;
    result.states_at_depth = {1};
    result.verdicts.resize(properties.size());
    return std::move(result);
  };
  // The model of a group takes a while, and there may be thousands of groups.
  if (const auto end = options.budget.find_end()) return end_before_moves(*end);
  std::set<std::uint32_t> variables;
  for (const Property* const property : properties) variables.merge(variables_of(*property));
  const Model model(catalog, groups, assumptions, variables);
  result.error = model.find_obstacle();
  if (result.error) {
    result.verdicts.resize(properties.size());
    return result;
  }
  Budget budget = options.budget;
  if (std::uint64_t& memory = budget.max_memory; memory > 0) {
    const std::uint64_t of_pairs = bytes_of_pairs(model);
    if (of_pairs >= memory) return end_before_moves(Budget::End::max_memory);
    memory -= of_pairs;
  }
  Stepper::Options of_stepper = share_memory(options, budget);
  const std::size_t jobs = std::max(1U, options.jobs);
  of_stepper.decision_bytes /= jobs;
  std::optional<CatalogSystem::Mark> mark;
  if (!properties.empty() && properties.front()->after) {
    mark = {*properties.front()->after, properties.front()->until};
  }
  StateSpace::Systems systems;
  const auto of_parts = add_systems<CatalogSystem>(jobs, systems, model, of_stepper, mark);
  StateSpace space(std::move(systems), budget, name_groups(groups));
  std::vector<Tests> tests(of_parts.size());
  std::vector<PropertyVisitor> visitors;
  visitors.reserve(tests.size());
  for (std::size_t place = 0; place < tests.size(); ++place) {
    for (const Property* const property : properties) {
      tests[place].push_back(
          make_property_test(*property, *of_parts[place], *space.parts()[place]));
    }
    visitors.emplace_back(*of_parts[place], tests[place], !options.on_decision);
  }
  const auto tests_of = [&](std::size_t property) {
    std::vector<PropertyTest*> of_property;
    of_property.reserve(tests.size());
    for (const Tests& of_part : tests) of_property.push_back(of_part[property].get());
    return of_property;
  };
  space.run(visitors, [&] {
    for (std::size_t property = 0; property < properties.size(); ++property) {
      const auto of_property = tests_of(property);
      const bool is_decided =
          std::any_of(of_property.begin(), of_property.end(),
                      [](const auto* test) { return test->met().depth() != never_seen; });
      if (!is_decided) return false;
    }
    return !properties.empty();
  });
  for (std::size_t property = 0; property < properties.size(); ++property) {
    result.verdicts.push_back(find_verdict(*properties[property], space, tests_of(property)));
  }
  if (options.outcomes) result.outcomes = find_outcomes(of_parts, space);

  for (const CatalogSystem* const system : of_parts) {
    const Decisions& decisions = system->stepper().decisions();
    result.decisions_remembered += decisions.remembered();
    result.decisions_computed += decisions.computed();
  }
  for (const auto& part : space.parts()) {
    result.has_left_out |= part->has_left_out();
    result.controls += part->controls_visited();
    result.regions += part->controls().regions();
    result.diagram_nodes += part->system().sets().nodes();
  }
  result.complete = space.is_complete();
  result.decided = space.is_decided();
  if (!result.complete && !result.decided) result.end = space.end();
  result.states = space.states();
  result.transitions = space.transitions();
  result.depth = space.expanded_depth();
  result.states_at_depth = space.states_at_depth();
  result.bytes = space.bytes();
  PropertyVisitor::report(visitors, result);
  return result;
}

}  // namespace cbc
