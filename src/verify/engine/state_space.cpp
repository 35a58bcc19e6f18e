// Reachability, explicit in controls and symbolic in environments ("control explicit, data
// symbolic"): a set of environments for each control, and one round for each move. A purely
// symbolic search (J. R. Burch, E. M. Clarke, K. L. McMillan, D. L. Dill and L. J. Hwang, "Symbolic
// model checking: 10^20 states and beyond", Information and Computation 98 (1992)) would need every
// decision as a formula, but a decision is an optimum over all assignments, which the solver finds;
// and controls are few.
//
// The first shortest path to a target: backward, the states of each depth from which it can still
// be reached in time; then forward, in single states, always the first move into those.

#include "verify/engine/state_space.h"

#include <algorithm>
#include <utility>

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = Environments::Set;

}  // namespace

StateSpace::StateSpace(const Model& model, const Stepper::Options& options,
                       const ExplorationLimits& limits, OnProgress on_progress)
    : model_(model),
      limits_(limits),
      on_progress_(std::move(on_progress)),
      environments_(model),
      controls_(model, environments_, options) {
  if (limits_.seconds > 0) {
    deadline_ = std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(limits_.seconds));
  }
  const std::vector<std::uint16_t> first = model.first_state();
  add(controls_.find(first.data()), environments_.environment_of(first.data()));
  end_layer();
}

std::uint64_t StateSpace::bytes() const {
  std::uint64_t of_layers = 0;
  for (const Layer& layer : layers_) of_layers += layer.capacity() * sizeof(States);
  return environments_.sets().bytes() + controls_.bytes() + of_layers;
}

bool StateSpace::look_at_limits() {
  if (limits_.max_states > 0 && states_ >= limits_.max_states) {
    return end_by(ExplorationEnd::max_states);
  }
  if (limits_.max_memory > 0 && bytes() >= limits_.max_memory) {
    return end_by(ExplorationEnd::max_memory);
  }
  if (deadline_ && std::chrono::steady_clock::now() >= *deadline_) {
    return end_by(ExplorationEnd::time_limit);
  }
  if (!on_progress_) return true;
  return on_progress_({states_, transitions_, states_at_depth_.back(),
                       static_cast<std::uint32_t>(layers_.size() - 1)}) ||
         end_by(ExplorationEnd::stopped);
}

/// Of some states, those that are new.
void StateSpace::add(Number control, Set environments) {
  if (control >= visited_.size()) {
    const std::size_t count = std::max<std::size_t>(controls_.size(), visited_.size() * 2);
    visited_.resize(count, Diagrams::empty);
    next_.resize(count, Diagrams::empty);
  }
  const Set fresh = environments_.sets().without(environments, visited_[control]);
  if (fresh == Diagrams::empty) return;
  if (next_[control] == Diagrams::empty) touched_.push_back(control);
  next_[control] = environments_.sets().either(next_[control], fresh);
}

void StateSpace::add_faults(const States& states) {
  if (model_.layout().faulty_count == 0) return;
  transitions_ += environments_.count_faults(states.environments) +
                  environments_.count_repairs(states.environments);
  add(states.control, environments_.after_fault(states.environments));
  for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
    add(controls_.after_repair(group), environments_.after_repair(group, states.environments));
  }
}

void StateSpace::end_layer() {
  std::sort(touched_.begin(), touched_.end());
  Layer& layer = layers_.emplace_back();
  std::uint64_t states = 0;
  for (const Number control : touched_) {
    const Set set = std::exchange(next_[control], Diagrams::empty);
    visited_[control] = environments_.sets().either(visited_[control], set);
    layer.push_back({control, set});
    states += environments_.sets().count(set);
  }
  touched_.clear();
  states_ += states;
  if (states > 0) states_at_depth_.push_back(states);
}

void StateSpace::collect() {
  environments_.sets().collect([&](auto&& keep) {
    environments_.for_each_kept(keep);
    for (const Set set : visited_) keep(set);
    for (const Set set : next_) keep(set);
    for (const Layer& layer : layers_) {
      for (const States& states : layer) keep(states.environments);
    }
    for (const States& states : kept_) keep(states.environments);
  });
}

/// A layer is in the order of controls.
Set StateSpace::environments_in(const Layer& layer, Number control) {
  const auto found =
      std::lower_bound(layer.begin(), layer.end(), control,
                       [](const States& states, Number other) { return states.control < other; });
  return found == layer.end() || found->control != control ? Diagrams::empty : found->environments;
}

void StateSpace::find_predecessors() {
  predecessors_.resize(controls_.size());
  const auto add_one = [&](Number target, Number control) {
    auto& list = predecessors_[target];
    if (list.empty() || list.back() != control) list.push_back(control);
  };
  for (Number control = 0; control < predecessors_.size(); ++control) {
    for (const Number successor : controls_.successors_of(control)) add_one(successor, control);
    if (model_.layout().faulty_count == 0 || visited_[control] == Diagrams::empty) continue;
    add_one(control, control);
    controls_.load(control);
    for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
      const Number repaired = controls_.after_repair(group);
      if (repaired < predecessors_.size()) add_one(repaired, control);
    }
  }
}

/// By depth, the states of that depth from which targets can be reached in time.
std::vector<StateSpace::Layer> StateSpace::paths_backward(const Layer& targets,
                                                          std::uint32_t depth) {
  if (predecessors_.empty()) find_predecessors();
  Diagrams& sets = environments_.sets();
  std::vector<Layer> layers(depth + 1);
  layers[depth] = targets;
  for (std::uint32_t before = depth; before-- > 0;) {
    const Layer& wanted = layers[before + 1];
    std::vector<Number> sources;
    for (const States& states : wanted) {
      const auto& of_target = predecessors_[states.control];
      sources.insert(sources.end(), of_target.begin(), of_target.end());
    }
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    for (const Number source : sources) {
      const Set here = environments_in(layers_[before], source);
      if (here == Diagrams::empty) continue;
      controls_.load(source);
      Set found = Diagrams::empty;
      for (std::uint32_t action = 0; action < environments_.effects().size(); ++action) {
        if (!controls_.may_have(action)) continue;
        const Environments::Effect& effect = controls_.actions()[action].effect;
        const Set set = sets.both(here, effect.condition);
        if (set == Diagrams::empty) continue;
        controls_.for_each_outcome(action, set, [&](Controls::Outcome outcome, Set part) {
          const Set after = environments_in(wanted, outcome.control);
          if (after == Diagrams::empty) return;
          found = sets.either(found, sets.both(part, environments_.before(effect, after)));
        });
      }
      if (model_.layout().faulty_count > 0) {
        found = sets.either(
            found, sets.both(here, environments_.before_fault(environments_in(wanted, source))));
        for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
          const Set after = environments_in(wanted, controls_.after_repair(group));
          found = sets.either(found, sets.both(here, environments_.before_repair(group, after)));
        }
      }
      if (found != Diagrams::empty) layers[before].push_back({source, found});
    }
  }
  return layers;
}

std::vector<Move> StateSpace::path_to(const std::vector<States>& targets, std::uint32_t depth) {
  const std::vector<Layer> layers = paths_backward(targets, depth);
  std::vector<Move> moves;
  Stepper stepper(model_, controls_.options());
  std::vector<std::uint32_t> packed = model_.packed_first();
  std::vector<std::uint8_t> string;
  for (std::uint32_t after = 1; after <= depth; ++after) {
    stepper.load(packed.data());
    for (const Model::Choice& choice : model_.moves()) {
      if (!stepper.try_move(choice)) continue;
      const Number control = controls_.find(stepper.cells_after());
      environments_.read(stepper.cells_after(), string);
      const Set wanted = environments_in(layers[after], control);
      if (!environments_.sets().contains(wanted, string)) continue;
      moves.push_back(stepper.move_of(choice));
      stepper.pack(packed.data());
      break;
    }
  }
  return moves;
}

}  // namespace cbc
