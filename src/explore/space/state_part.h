#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "explore/controls/control_system.h"
#include "explore/controls/controls.h"

namespace cbc {

/// The moves of a system that count where goals are looked for by going backward.
struct MoveSelection {
  std::vector<std::uint8_t> actions;  ///< by action
  bool has_fault = false;
  bool has_repair = false;
};

/// A part of the states of a system, for one thread: those whose control is its own, by a hash of
/// the control. Everything in it, numbers of controls and sets too, means something in this part
/// only. See StateSpace.
class StatePart {
 public:
  using Set = ControlSystem::Set;
  /// States of one control, in the environments of a set.
  struct States {
    Controls::Number control = 0;
    Set environments = Diagrams::empty;
  };
  using Layer = std::vector<States>;  ///< in the order of controls
  /// States on their way to another part.
  struct Parcel {
    std::vector<std::uint32_t> controls;  ///< packed, one after the other
    Diagrams::Parcel environments;
  };

  /// It is the part number `place` of `count` parts.
  StatePart(std::unique_ptr<ControlSystem> system, std::size_t place, std::size_t count);

  [[nodiscard]] ControlSystem& system() { return *system_; }
  [[nodiscard]] Controls& controls() { return controls_; }
  /// Keeps sets from being forgotten while states are visited.
  void keep(const States& states) { kept_.push_back(states.environments); }
  /// Forgets, if there are many sets, those that are neither kept nor of a layer.
  void collect_if_crowded() {
    if (system_->sets().is_crowded()) collect();
  }

  // Visiting states.

  /// Adds the first state to the first layer, if it is of this part.
  void begin();
  /// See StateSpace::run().
  template <typename Visitor>
  void visit(std::uint32_t depth, Visitor& visitor);
  /// Makes all moves of the layer, as long as `may_go_on()` returns true, which is asked now and
  /// then. False: it did not.
  template <typename Visitor, typename MayGoOn>
  bool make_moves(std::uint32_t depth, Visitor& visitor, MayGoOn&& may_go_on);
  /// What moves led to: the states of another part.
  [[nodiscard]] Parcel take_found(std::size_t part);
  void add(const Parcel& parcel);
  /// Makes all that was added and is new the next layer. Returns the number of its states.
  std::uint64_t end_layer();

  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  /// Whether there would be more moves, but for `suspended` in `assume`.
  [[nodiscard]] bool has_left_out() const { return has_left_out_; }
  [[nodiscard]] std::uint64_t bytes() const;
  /// The number of its controls that were visited, or are to be.
  [[nodiscard]] std::uint64_t controls_visited() const { return controls_visited_; }

  // Going backward, once all states were visited that count.

  /// The place of the part of a packed control.
  [[nodiscard]] std::size_t part_of(const std::uint32_t* packed) const {
    return controls_.hash(packed) / 64 % count_;
  }
  [[nodiscard]] Parcel pack(const Layer& layer);
  /// The states of parcels of all parts whose controls are known here.
  [[nodiscard]] Layer unpack(const std::vector<Parcel>& parcels);
  /// Of the part's own states, for each control those that `here` returns, the states with a move
  /// of the selection (null: all) to some of the layer, of which the mark is still that of the
  /// state before.
  template <typename Here>
  [[nodiscard]] Layer sources_of(const Layer& layer, const MoveSelection* selection, Here&& here);
  /// The states as they are before their marks are set and cleared.
  [[nodiscard]] Layer before_marks(const Layer& layer);
  [[nodiscard]] static Set environments_in(const Layer& layer, Controls::Number control);
  /// The environments of all states of the part that have a control of its own.
  [[nodiscard]] Set visited(Controls::Number control) const {
    return control < visited_.size() ? visited_[control] : Diagrams::empty;
  }
  [[nodiscard]] bool is_own(Controls::Number control) const {
    return part_of(controls_.packed(control)) == place_;
  }

 private:
  void add(Controls::Number control, Set environments);
  template <typename Visitor, typename MayGoOn>
  bool make_moves_of(const States& states, Visitor& visitor, MayGoOn& may_go_on);
  template <typename Visitor>
  void add_faults(const States& states, Visitor& visitor);
  void leave_out(Set set) {
    transitions_ -= system_->sets().count(set);
    has_left_out_ = true;
  }
  void collect();
  void find_predecessors();
  [[nodiscard]] std::vector<Controls::Number> controls_before(const Layer& layer);
  [[nodiscard]] Set sources_in(const States& all, const Layer& wanted,
                               const MoveSelection* selection);
  [[nodiscard]] Set sources_by_faults(const States& all, const Layer& wanted,
                                      const MoveSelection* selection);

  const std::unique_ptr<ControlSystem> system_;
  const std::size_t place_;
  const std::size_t count_;
  Controls controls_;
  std::vector<Layer> layers_;
  std::vector<Set> visited_;               ///< by control; of other parts: what they were told of
  std::vector<Set> next_;                  ///< by control: of the next layer
  std::vector<Controls::Number> touched_;  ///< controls with some
  std::vector<Set> kept_;
  /// By control: its own ones that have a move to it; found when it is first asked.
  std::vector<std::vector<Controls::Number>> predecessors_;
  std::uint64_t transitions_ = 0;
  bool has_left_out_ = false;
  std::uint64_t controls_visited_ = 0;
};

template <typename Visitor>
void StatePart::visit(std::uint32_t depth, Visitor& visitor) {
  for (const States& states : layers_[depth]) {
    controls_.load(states.control);
    visitor.visit(states, depth);
  }
}

template <typename Visitor, typename MayGoOn>
bool StatePart::make_moves(std::uint32_t depth, Visitor& visitor, MayGoOn&& may_go_on) {
  for (const States& states : layers_[depth]) {
    controls_.load(states.control);
    if (!make_moves_of(states, visitor, may_go_on)) return false;
    collect_if_crowded();
  }
  return true;
}

template <typename Visitor, typename MayGoOn>
bool StatePart::make_moves_of(const States& states, Visitor& visitor, MayGoOn& may_go_on) {
  Diagrams& sets = system_->sets();
  const auto& actions = system_->actions();
  for (std::uint32_t action = 0; action < actions.size(); ++action) {
    if (!system_->may_have(action)) continue;
    const ControlSystem::Action& made = actions[action];
    const Set set = sets.both(states.environments, made.condition);
    if (set == Diagrams::empty) continue;
    if (made.is_move) transitions_ += sets.count(set);
    controls_.for_each_result(action, set, [&](Controls::NumberedResult result, Set part) {
      const States from{states.control, part};
      if (result.note != 0) visitor.on_note(result.note, from);
      if (made.is_start && !result.accepted) visitor.on_refusal(action, from);
      if (result.control == none) {
        if (!result.exists) leave_out(part);
        return;
      }
      visitor.on_result(action, from, result);
      const bool changes = made.changes || result.values != 0 || result.control != states.control;
      if (changes) add(result.control, system_->after(made, result.values, part));
    });
    if (!may_go_on()) return false;
  }
  add_faults(states, visitor);
  return true;
}

template <typename Visitor>
void StatePart::add_faults(const States& states, Visitor& visitor) {
  FaultSets& faults = system_->faults();
  if (faults.count() == 0) return;
  transitions_ += faults.count_moves(states.environments);
  const auto take = [&](const Controls::NumberedResult& result, Set after, const auto& before) {
    if (after == Diagrams::empty) return;
    if (result.note != 0) {
      visitor.on_note(result.note,
                      {states.control, system_->sets().both(states.environments, before())});
    }
    if (result.control != none) add(result.control, after);
  };
  take(controls_.after_fault(), faults.after_fault(states.environments),
       [&] { return faults.before_fault(Diagrams::all); });
  for (std::uint32_t kind = 0; kind < faults.kind_count(); ++kind) {
    take(controls_.after_repair(kind), faults.after_repair(kind, states.environments),
         [&] { return faults.before_repair(kind, Diagrams::all); });
  }
}

template <typename Here>
StatePart::Layer StatePart::sources_of(const Layer& layer, const MoveSelection* selection,
                                       Here&& here) {
  Layer sources;
  for (const Controls::Number control : controls_before(layer)) {
    const Set set = here(control);
    if (set == Diagrams::empty) continue;
    const Set found = sources_in({control, set}, layer, selection);
    if (found != Diagrams::empty) sources.push_back({control, found});
  }
  return sources;
}

}  // namespace cbc
