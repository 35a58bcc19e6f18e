// Reachability, explicit in controls and symbolic in environments ("control explicit, data
// symbolic"): a set of environments for each control, and one round for each move. A purely
// symbolic search (J. R. Burch, E. M. Clarke, K. L. McMillan, D. L. Dill and L. J. Hwang, "Symbolic
// model checking: 10^20 states and beyond", Information and Computation 98 (1992)) would need every
// decision as a formula, but a decision is an optimum over all assignments, which the solver finds;
// and controls are few.
//
// The first shortest path to a target: backward, the states of each depth from which it can still
// be reached in time; then forward, in single states, always the first move into those.

#include "verify/engine/state_part.h"

#include <algorithm>
#include <utility>

#include "verify/engine/move_kinds.h"

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = Environments::Set;

}  // namespace

StatePart::StatePart(const Model& model, const Stepper::Options& options,
                     const std::optional<Mark>& mark, std::size_t place, std::size_t count)
    : model_(model),
      place_(place),
      count_(count),
      environments_(model, mark.has_value()),
      controls_(model, environments_, options) {
  if (!mark) return;
  mark_after_.emplace(model, mark->after, environments_);
  keep(*mark_after_);
  if (!mark->until) return;
  mark_until_.emplace(model, *mark->until, environments_);
  keep(*mark_until_);
}

void StatePart::begin() {
  const std::vector<std::uint16_t> first = model_.first_state();
  const Number control = controls_.find(first.data());
  if (is_own(control)) add(control, environments_.environment_of(first.data()));
}

std::uint64_t StatePart::bytes() const {
  std::uint64_t of_layers = 0;
  for (const Layer& layer : layers_) of_layers += layer.capacity() * sizeof(States);
  return environments_.sets().bytes() + controls_.bytes() + of_layers;
}

/// Of some states, those that are new.
void StatePart::add(Number control, Set environments) {
  if (control >= visited_.size()) {
    const std::size_t count = std::max<std::size_t>(controls_.size(), visited_.size() * 2);
    visited_.resize(count, Diagrams::empty);
    next_.resize(count, Diagrams::empty);
  }
  // With a mark, end_layer() finds out which of them are new.
  const Set fresh =
      mark_after_ ? environments : environments_.sets().without(environments, visited_[control]);
  if (fresh == Diagrams::empty) return;
  if (next_[control] == Diagrams::empty) touched_.push_back(control);
  next_[control] = environments_.sets().either(next_[control], fresh);
}

void StatePart::add_faults(const States& states) {
  if (model_.layout().faulty_count == 0) return;
  transitions_ += environments_.count_faults(states.environments) +
                  environments_.count_repairs(states.environments);
  add(states.control, environments_.after_fault(states.environments));
  for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
    add(controls_.after_repair(group), environments_.after_repair(group, states.environments));
  }
}

/// Those that were told of before are left out.
StatePart::Parcel StatePart::take_found(std::size_t part) {
  Layer found;
  erase_if(touched_, [&](Number control) {
    if (part_of(controls_.packed(control)) != part) return false;
    const Set set = std::exchange(next_[control], Diagrams::empty);
    visited_[control] = environments_.sets().either(visited_[control], set);
    found.push_back({control, set});
    return true;
  });
  return pack(found);
}

StatePart::Parcel StatePart::pack(const Layer& layer) {
  Parcel parcel;
  for (const States& states : layer) {
    const std::uint32_t* const packed = controls_.packed(states.control);
    parcel.controls.insert(parcel.controls.end(), packed, packed + model_.packed_words());
    environments_.sets().put(states.environments, parcel.environments);
  }
  return parcel;
}

void StatePart::add(const Parcel& parcel) {
  const std::vector<Set> sets = environments_.sets().take(parcel.environments);
  for (std::size_t place = 0; place < sets.size(); ++place) {
    add(controls_.find_packed(&parcel.controls[place * model_.packed_words()]), sets[place]);
  }
}

StatePart::Layer StatePart::unpack(const std::vector<Parcel>& parcels) {
  Layer layer;
  for (const Parcel& parcel : parcels) {
    const std::vector<Set> sets = environments_.sets().take(parcel.environments);
    for (std::size_t place = 0; place < sets.size(); ++place) {
      const auto control = controls_.known(&parcel.controls[place * model_.packed_words()]);
      if (control) layer.push_back({*control, sets[place]});
    }
  }
  std::sort(layer.begin(), layer.end(),
            [](const States& a, const States& b) { return a.control < b.control; });
  return layer;
}

std::uint64_t StatePart::end_layer() {
  std::sort(touched_.begin(), touched_.end());
  Layer& layer = layers_.emplace_back();
  std::uint64_t states = 0;
  for (const Number control : touched_) {
    Set set = std::exchange(next_[control], Diagrams::empty);
    if (mark_after_) {
      controls_.load(control);
      const MarkSets marks = find_marks(controls_.stepper());
      set = environments_.with_mark(set, marks.to_set, marks.to_clear);
      set = environments_.sets().without(set, visited_[control]);
      if (set == Diagrams::empty) continue;
    }
    if (visited_[control] == Diagrams::empty) ++controls_visited_;
    visited_[control] = environments_.sets().either(visited_[control], set);
    layer.push_back({control, set});
    states += environments_.sets().count(set);
  }
  touched_.clear();
  return states;
}

void StatePart::collect() {
  environments_.sets().collect([&](auto&& keep) {
    environments_.for_each_kept(keep);
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
    auto& list = predecessors_[target];
    if (list.empty() || list.back() != control) list.push_back(control);
  };
  for (Number control = 0; control < predecessors_.size(); ++control) {
    if (!is_own(control)) continue;
    for (const Number successor : controls_.successors_of(control)) add_one(successor, control);
    if (model_.layout().faulty_count == 0 || visited(control) == Diagrams::empty) continue;
    add_one(control, control);
    controls_.load(control);
    for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
      const Number repaired = controls_.after_repair(group);
      if (repaired < predecessors_.size()) add_one(repaired, control);
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

StatePart::MarkSets StatePart::find_marks(const Stepper& control) {
  MarkSets marks;
  if (mark_until_) marks.to_clear = mark_until_->holds_in(control, environments_.sets());
  marks.to_set = mark_after_->holds_in(control, environments_.sets());
  marks.to_set = environments_.sets().without(marks.to_set, marks.to_clear);
  return marks;
}

/// Of some states, those from which a move of the kinds (null: all) leads to one of the wanted
/// ones, of which the mark is still that of the state before. Loads their control.
Set StatePart::sources_in(const States& all, const Layer& wanted, const MoveKinds* kinds) {
  Diagrams& sets = environments_.sets();
  controls_.load(all.control);
  Set found = Diagrams::empty;
  for (std::uint32_t action = 0; action < environments_.effects().size(); ++action) {
    if (!controls_.may_have(action)) continue;
    const Controls::Action& made = controls_.actions()[action];
    if (kinds != nullptr && !is_of_kinds(*kinds, made.choice, model_)) continue;
    const Set set = sets.both(all.environments, made.effect.condition);
    if (set == Diagrams::empty) continue;
    controls_.for_each_outcome(action, set, [&](Controls::Outcome outcome, Set part) {
      const Set after = environments_in(wanted, outcome.control);
      if (after == Diagrams::empty) return;
      found = sets.either(found, sets.both(part, environments_.before(made.effect, after)));
    });
  }
  if (model_.layout().faulty_count == 0) return found;
  if (kinds == nullptr || kinds->fault) {
    const Set after = environments_in(wanted, all.control);
    found = sets.either(found, sets.both(all.environments, environments_.before_fault(after)));
  }
  if (kinds != nullptr && !kinds->repair) return found;
  for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
    const Set after = environments_in(wanted, controls_.after_repair(group));
    found =
        sets.either(found, sets.both(all.environments, environments_.before_repair(group, after)));
  }
  return found;
}

/// The states as they are before their marks are set and cleared.
StatePart::Layer StatePart::before_marks(const Layer& layer) {
  if (!mark_after_) return layer;
  Layer before = layer;
  for (States& states : before) {
    controls_.load(states.control);
    const MarkSets marks = find_marks(controls_.stepper());
    states.environments =
        environments_.before_mark(states.environments, marks.to_set, marks.to_clear);
  }
  return before;
}

}  // namespace cbc
