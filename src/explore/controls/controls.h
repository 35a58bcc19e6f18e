#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/controls/control_system.h"
#include "explore/sets/state_store.h"

namespace cbc {

/// The controls of a system, numbered, and what moves make of them. A move is made in one
/// environment, and never again for others about which its questions have the same answers: these
/// questions are kept as a tree for each action of each control. The system must outlive it. Not
/// for use by several threads.
class Controls {
 public:
  using Number = std::uint32_t;
  using Set = ControlSystem::Set;

  /// A ControlSystem::MoveResult, whose control has a number.
  struct NumberedResult {
    Number control = none;
    bool accepted = false;
    std::uint32_t note = 0;
    Diagrams::ValuesNumber values = 0;
    bool exists = true;
  };

  explicit Controls(ControlSystem& system);

  [[nodiscard]] Number size() const { return store_.size(); }
  /// The number of a control.
  [[nodiscard]] Number find(const std::uint32_t* packed) {
    return store_.insert(packed, store_.hash(packed));
  }
  /// The number of a control, or nothing if it is new.
  [[nodiscard]] std::optional<Number> known(const std::uint32_t* packed) const {
    return store_.find(packed, store_.hash(packed));
  }
  [[nodiscard]] const std::uint32_t* packed(Number control) const { return store_.state(control); }
  /// The hash of a control: the same one in all objects of this class.
  [[nodiscard]] std::uint64_t hash(const std::uint32_t* packed) const {
    return store_.hash(packed);
  }
  /// Takes up a control.
  void load(Number control);

  /// What an action makes of the loaded control in the environments of a set, in which it exists:
  /// calls `take` with each result and the part of the set where it is the one.
  template <typename Take>
  void for_each_result(std::uint32_t action, Set set, Take&& take) {
    walk(root_of(action), action, set, take);
  }
  /// What an action makes of the loaded control in one environment.
  [[nodiscard]] NumberedResult result_in(std::uint32_t action,
                                         const std::vector<std::uint8_t>& environment);
  [[nodiscard]] NumberedResult after_fault() { return numbered(system_.take_fault()); }
  [[nodiscard]] NumberedResult after_repair(std::uint32_t kind) {
    return numbered(system_.take_repair(kind));
  }
  /// The controls that actions make of one, in some environment that was asked about.
  [[nodiscard]] std::vector<Number> successors_of(Number control) const;

  /// How often a result of an action was found; those that lead to the same control are several.
  [[nodiscard]] std::uint64_t regions() const { return regions_; }
  [[nodiscard]] std::uint64_t bytes() const;

  /// What must survive Diagrams::collect().
  template <typename Keep>
  void for_each_kept(Keep&& keep) const {
    for (const Branch& branch : branches_) keep(branch.asked);
  }

 private:
  /// A branch, or a result; 0: it is not known yet.
  using Tree = std::uint32_t;
  /// A question that a move asked, and what comes after either answer.
  struct Branch {
    Set asked = Diagrams::empty;
    Tree answers[2] = {0, 0};  ///< no, yes
  };
  /// Where a tree stands: it is that of an action, or behind an answer.
  struct Place {
    std::size_t number = 0;  ///< of a root, of a branch
    std::uint32_t answer = 0;
    bool is_root = false;
  };
  class Asked;

  // A result: a control, or a place in `noted_`.
  static constexpr Tree is_result = Tree{1} << 31U;
  static constexpr Tree is_noted = Tree{1} << 30U;
  static constexpr Tree is_accepted = Tree{1} << 29U;
  static constexpr Tree no_control = is_accepted - 1;

  [[nodiscard]] Place root_of(std::uint32_t action) const {
    return {static_cast<std::size_t>(loaded_) * system_.actions().size() + action, 0, true};
  }
  [[nodiscard]] Tree& at(const Place& place) {
    return place.is_root ? roots_[place.number] : branches_[place.number].answers[place.answer];
  }
  [[nodiscard]] Tree tree_of(const NumberedResult& result);
  [[nodiscard]] NumberedResult result_of(Tree tree) const {
    const Tree number = tree & no_control;
    if ((tree & is_noted) != 0) return noted_[number];
    return {number == no_control ? none : number, (tree & is_accepted) != 0};
  }
  [[nodiscard]] NumberedResult numbered(const ControlSystem::MoveResult& result);
  void explore(std::uint32_t action, const std::vector<std::uint8_t>& environment);

  template <typename Take>
  void walk(const Place& place, std::uint32_t action, Set set, Take& take) {
    Diagrams& sets = system_.sets();
    if (at(place) == 0) {
      sets.pick(set, string_);
      explore(action, string_);
    }
    const Tree tree = at(place);
    if ((tree & is_result) != 0) {
      take(result_of(tree), set);
      return;
    }
    const Set asked = branches_[tree].asked;
    const Set yes = sets.both(set, asked);
    if (yes != Diagrams::empty) walk({tree, 1, false}, action, yes, take);
    if (yes == set) return;
    const Set no = yes == Diagrams::empty ? set : sets.without(set, asked);
    walk({tree, 0, false}, action, no, take);
  }

  ControlSystem& system_;
  StateStore store_;
  Number loaded_ = none;
  std::vector<Tree> roots_;  ///< by control and action
  std::vector<Branch> branches_;
  std::vector<NumberedResult> noted_;
  std::uint64_t regions_ = 0;
  std::vector<Set> known_;  ///< what was asked in the present environment
  std::vector<std::uint8_t> string_;
};

}  // namespace cbc
