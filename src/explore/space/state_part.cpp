// Reachability, explicit in controls and symbolic in environments ("control explicit, data
// symbolic"): a set of environments for each control, and one round for each move. A purely
// symbolic search (J. R. Burch, E. M. Clarke, K. L. McMillan, D. L. Dill and L. J. Hwang, "Symbolic
// model checking: 10^20 states and beyond", Information and Computation 98 (1992)) would need every
// decision as a formula, but a decision is an optimum over all assignments, which the solver finds;
// and controls are few.

#include "explore/space/state_part.h"

#include <algorithm>
#include <utility>

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = StatePart::Set;

}  // namespace

StatePart::StatePart(std::unique_ptr<ControlSystem> system, std::size_t place, std::size_t count)
    : system_(std::move(system)), place_(place), count_(count), controls_(*system_) {}

void StatePart::begin() {
  const Number control = controls_.find(system_->first_control().data());
  if (!is_own(control)) return;
  Diagrams::Values values;
  for (const std::uint8_t bit : system_->first_environment()) {
    values.bits.emplace_back(values.bits.size(), bit != 0);
  }
  add(control, system_->sets().with(values));
}

std::uint64_t StatePart::bytes() const {
  std::uint64_t of_layers = 0;
  for (const Layer& layer : layers_) of_layers += layer.capacity() * sizeof(States);
  return system_->sets().bytes() + controls_.bytes() + of_layers;
}

/// Of some states, those that are new.
void StatePart::add(Number control, Set environments) {
  if (control >= visited_.size()) {
    const std::size_t count = std::max<std::size_t>(controls_.size(), visited_.size() * 2);
    visited_.resize(count, Diagrams::empty);
    next_.resize(count, Diagrams::empty);
  }
  Diagrams& sets = system_->sets();
  // With a mark, end_layer() finds out which of them are new.
  const Set fresh =
      system_->has_mark() ? environments : sets.without(environments, visited_[control]);
  if (fresh == Diagrams::empty) return;
  if (next_[control] == Diagrams::empty) touched_.push_back(control);
  next_[control] = sets.either(next_[control], fresh);
}

/// Those that were told of before are left out.
StatePart::Parcel StatePart::take_found(std::size_t part) {
  Layer found;
  erase_if(touched_, [&](Number control) {
    if (part_of(controls_.packed(control)) != part) return false;
    const Set set = std::exchange(next_[control], Diagrams::empty);
    visited_[control] = system_->sets().either(visited_[control], set);
    found.push_back({control, set});
    return true;
  });
  return pack(found);
}

StatePart::Parcel StatePart::pack(const Layer& layer) {
  Parcel parcel;
  const std::size_t words = system_->first_control().size();
  for (const States& states : layer) {
    const std::uint32_t* const packed = controls_.packed(states.control);
    parcel.controls.insert(parcel.controls.end(), packed, packed + words);
    system_->sets().put(states.environments, parcel.environments);
  }
  return parcel;
}

void StatePart::add(const Parcel& parcel) {
  const std::size_t words = system_->first_control().size();
  const std::vector<Set> sets = system_->sets().take(parcel.environments);
  for (std::size_t place = 0; place < sets.size(); ++place) {
    add(controls_.find(&parcel.controls[place * words]), sets[place]);
  }
}

StatePart::Layer StatePart::unpack(const std::vector<Parcel>& parcels) {
  Layer layer;
  const std::size_t words = system_->first_control().size();
  for (const Parcel& parcel : parcels) {
    const std::vector<Set> sets = system_->sets().take(parcel.environments);
    for (std::size_t place = 0; place < sets.size(); ++place) {
      const auto control = controls_.known(&parcel.controls[place * words]);
      if (control) layer.push_back({*control, sets[place]});
    }
  }
  std::sort(layer.begin(), layer.end(),
            [](const States& a, const States& b) { return a.control < b.control; });
  return layer;
}

std::uint64_t StatePart::end_layer() {
  Diagrams& sets = system_->sets();
  std::sort(touched_.begin(), touched_.end());
  Layer& layer = layers_.emplace_back();
  std::uint64_t states = 0;
  for (const Number control : touched_) {
    Set set = std::exchange(next_[control], Diagrams::empty);
    if (system_->has_mark()) {
      controls_.load(control);
      set = sets.without(system_->with_marks(set), visited_[control]);
      if (set == Diagrams::empty) continue;
    }
    if (visited_[control] == Diagrams::empty) ++controls_visited_;
    visited_[control] = sets.either(visited_[control], set);
    layer.push_back({control, set});
    states += sets.count(set);
  }
  touched_.clear();
  return states;
}

void StatePart::collect() {
  system_->sets().collect([&](auto&& keep) {
    system_->for_each_kept(keep);
    controls_.for_each_kept(keep);
    for (const Set set : visited_) keep(set);
    for (const Set set : next_) keep(set);
    for (const Layer& layer : layers_) {
      for (const States& states : layer) keep(states.environments);
    }
    for (const Set set : kept_) keep(set);
  });
}

/// A layer is in the order of controls.
Set StatePart::environments_in(const Layer& layer, Number control) {
  const auto found =
      std::lower_bound(layer.begin(), layer.end(), control,
                       [](const States& states, Number other) { return states.control < other; });
  return found == layer.end() || found->control != control ? Diagrams::empty : found->environments;
}

void StatePart::find_predecessors() {
  predecessors_.resize(controls_.size());
  const auto add_one = [&](Number target, Number control) {
    if (target >= predecessors_.size()) return;
    auto& list = predecessors_[target];
    if (list.empty() || list.back() != control) list.push_back(control);
  };
  const FaultSets& faults = system_->faults();
  for (Number control = 0; control < predecessors_.size(); ++control) {
    if (!is_own(control)) continue;
    for (const Number successor : controls_.successors_of(control)) add_one(successor, control);
    if (faults.count() == 0 || visited(control) == Diagrams::empty) continue;
    controls_.load(control);
    add_one(controls_.after_fault().control, control);
    for (std::uint32_t kind = 0; kind < faults.kind_count(); ++kind) {
      add_one(controls_.after_repair(kind).control, control);
    }
  }
}

/// The controls with a move to one of the layer, ascending.
std::vector<Number> StatePart::controls_before(const Layer& layer) {
  if (predecessors_.empty()) find_predecessors();
  std::vector<Number> sources;
  for (const States& states : layer) {
    if (states.control >= predecessors_.size()) continue;
    const auto& of_target = predecessors_[states.control];
    sources.insert(sources.end(), of_target.begin(), of_target.end());
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

/// Of some states, those from which a move of the selection (null: all) leads to one of the wanted
/// ones, of which the mark is still that of the state before. Loads their control.
Set StatePart::sources_in(const States& all, const Layer& wanted, const MoveSelection* selection) {
  Diagrams& sets = system_->sets();
  controls_.load(all.control);
  Set found = Diagrams::empty;
  const auto& actions = system_->actions();
  for (std::uint32_t action = 0; action < actions.size(); ++action) {
    const ControlSystem::Action& made = actions[action];
    if (!made.is_move || !system_->may_have(action)) continue;
    if (selection != nullptr && selection->actions[action] == 0) continue;
    const Set set = sets.both(all.environments, made.condition);
    if (set == Diagrams::empty) continue;
    controls_.for_each_result(action, set, [&](Controls::NumberedResult result, Set part) {
      const Set after = environments_in(wanted, result.control);
      if (after == Diagrams::empty) return;
      found = sets.either(found, sets.both(part, system_->before(made, result.values, after)));
    });
  }
  return sets.either(found, sources_by_faults(all, wanted, selection));
}

/// The control is loaded.
Set StatePart::sources_by_faults(const States& all, const Layer& wanted,
                                 const MoveSelection* selection) {
  FaultSets& faults = system_->faults();
  Diagrams& sets = system_->sets();
  Set found = Diagrams::empty;
  if (faults.count() == 0) return found;
  if (selection == nullptr || selection->has_fault) {
    const Set after = environments_in(wanted, controls_.after_fault().control);
    found = sets.both(all.environments, faults.before_fault(after));
  }
  if (selection != nullptr && !selection->has_repair) return found;
  for (std::uint32_t kind = 0; kind < faults.kind_count(); ++kind) {
    const Set after = environments_in(wanted, controls_.after_repair(kind).control);
    found = sets.either(found, sets.both(all.environments, faults.before_repair(kind, after)));
  }
  return found;
}

/// The states as they are before their marks are set and cleared.
StatePart::Layer StatePart::before_marks(const Layer& layer) {
  if (!system_->has_mark()) return layer;
  Layer before = layer;
  for (States& states : before) {
    controls_.load(states.control);
    states.environments = system_->before_marks(states.environments);
  }
  return before;
}

}  // namespace cbc
