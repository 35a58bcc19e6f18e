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

#include "verify/engine/move_kinds.h"

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = Environments::Set;

}  // namespace

StateSpace::StateSpace(const Model& model, const Stepper::Options& options,
                       const ExplorationLimits& limits, OnProgress on_progress,
                       const std::optional<Mark>& mark)
    : model_(model),
      limits_(limits),
      on_progress_(std::move(on_progress)),
      environments_(model, mark.has_value()),
      controls_(model, environments_, options) {
  if (limits_.seconds > 0) {
    deadline_ = std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(limits_.seconds));
  }
  if (mark) {
    mark_after_.emplace(model, environments_, mark->after);
    keep({0, mark_after_->in_environment()});
    if (mark->until) {
      mark_until_.emplace(model, environments_, *mark->until);
      keep({0, mark_until_->in_environment()});
    }
  }
}

void StateSpace::begin() {
  const std::vector<std::uint16_t> first = model_.first_state();
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
  // With a mark, end_layer() finds out which of them are new.
  const Set fresh =
      mark_after_ ? environments : environments_.sets().without(environments, visited_[control]);
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
    Set set = std::exchange(next_[control], Diagrams::empty);
    if (mark_after_) {
      controls_.load(control);
      const MarkSets marks = find_marks(controls_.stepper());
      set = environments_.with_mark(set, marks.to_set, marks.to_clear);
      set = environments_.sets().without(set, visited_[control]);
      if (set == Diagrams::empty) continue;
    }
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
    for (const Set set : reaching_) keep(set);
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

/// The controls with a move to one of the layer, ascending.
std::vector<Number> StateSpace::sources_of(const Layer& layer) {
  if (predecessors_.empty()) find_predecessors();
  std::vector<Number> sources;
  for (const States& states : layer) {
    const auto& of_target = predecessors_[states.control];
    sources.insert(sources.end(), of_target.begin(), of_target.end());
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

StateSpace::MarkSets StateSpace::find_marks(const Stepper& control) {
  MarkSets marks;
  if (mark_until_) marks.to_clear = mark_until_->holds_in(control);
  marks.to_set = mark_after_->holds_in(control);
  marks.to_set = environments_.sets().without(marks.to_set, marks.to_clear);
  return marks;
}

/// Of some states, those from which a move of the kinds (null: all) leads to one of the wanted
/// ones, of which the mark is still that of the state before. Loads their control.
Set StateSpace::sources_in(const States& all, const Layer& wanted, const MoveKinds* kinds) {
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
StateSpace::Layer StateSpace::before_marks(const Layer& layer) {
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

/// By depth, the states of that depth from which targets can be reached in time, before their marks
/// are set and cleared.
std::vector<StateSpace::Layer> StateSpace::paths_backward(const Layer& targets,
                                                          std::uint32_t depth) {
  std::vector<Layer> layers(depth + 1);
  layers[depth] = before_marks(targets);
  for (std::uint32_t after = depth; after > 0; --after) {
    Layer found;
    for (const Number source : sources_of(layers[after])) {
      const Set here = environments_in(layers_[after - 1], source);
      if (here == Diagrams::empty) continue;
      const Set part = sources_in({source, here}, layers[after], nullptr);
      if (part != Diagrams::empty) found.push_back({source, part});
    }
    layers[after - 1] = before_marks(found);
  }
  return layers;
}

std::vector<Move> StateSpace::path_to(const std::vector<States>& targets, std::uint32_t depth) {
  const std::vector<Layer> layers = paths_backward(targets, depth);
  Diagrams& sets = environments_.sets();
  std::vector<Move> moves;
  Stepper stepper(model_, controls_.options());
  std::vector<std::uint32_t> packed = model_.packed_first();
  std::vector<std::uint8_t> string;
  bool is_marked = false;
  for (std::uint32_t after = 0;; ++after) {
    stepper.load(packed.data());
    if (mark_after_) {
      environments_.read(stepper.cells(), string);
      const MarkSets marks = find_marks(stepper);
      is_marked = !sets.contains(marks.to_clear, string) &&
                  (is_marked || sets.contains(marks.to_set, string));
    }
    if (after == depth) return moves;
    for (const Model::Choice& choice : model_.moves()) {
      if (!stepper.try_move(choice)) continue;
      const Number control = controls_.find(stepper.cells_after());
      environments_.read(stepper.cells_after(), string);
      if (mark_after_) environments_.write_mark(is_marked, string);
      if (!sets.contains(environments_in(layers[after + 1], control), string)) continue;
      moves.push_back(stepper.move_of(choice));
      stepper.pack(packed.data());
      break;
    }
  }
}

void StateSpace::follow(const std::vector<Move>& moves, Stepper& stepper) const {
  std::vector<std::uint32_t> packed = model_.packed_first();
  stepper.load(packed.data());
  for (const Move& move : moves) {
    for (const Model::Choice& choice : model_.moves()) {
      if (choice.move.kind != move.kind || !stepper.has_move(choice)) continue;
      if (stepper.move_of(choice) != move || !stepper.take(choice)) continue;
      stepper.pack(packed.data());
      stepper.load(packed.data());
      break;
    }
  }
}

std::optional<std::vector<Set>> StateSpace::can_reach(const StateTest& goal,
                                                      const std::optional<MoveKinds>& kinds,
                                                      std::optional<std::uint32_t> within) {
  Diagrams& sets = environments_.sets();
  reaching_.assign(visited_.size(), Diagrams::empty);
  Layer newest;
  const auto add_new = [&](Number control, Set set) {
    set = sets.without(set, reaching_[control]);
    if (set == Diagrams::empty) return;
    reaching_[control] = sets.either(reaching_[control], set);
    newest.push_back({control, set});
  };
  for (Number control = 0; control < visited_.size(); ++control) {
    if (visited_[control] == Diagrams::empty) continue;
    controls_.load(control);
    add_new(control, sets.both(visited_[control], goal.holds_in(controls_.stepper())));
  }
  for (std::uint32_t moves = 0; !newest.empty() && (!within || moves < *within); ++moves) {
    const Layer wanted = std::exchange(newest, {});
    for (const Number source : sources_of(wanted)) {
      const Set left = sets.without(visited_[source], reaching_[source]);
      if (left == Diagrams::empty) continue;
      add_new(source, sources_in({source, left}, wanted, kinds ? &*kinds : nullptr));
      if (may_go_on()) continue;
      is_complete_ = false;
      return std::nullopt;
    }
  }
  return std::exchange(reaching_, {});
}

}  // namespace cbc
