// What a move makes of a control depends on few behaviors, however many environments there are. So
// it is made in one environment, with note of what was asked about it (symbolic execution: J. C.
// King, "Symbolic execution and program testing", Communications of the ACM 19 (1976)): the same
// comes of it in all environments with the same answers. The first decision takes all for available
// that may be; where what it uses is not, the next one lacks it, as E. L. Lawler, "A procedure for
// computing the K best solutions to discrete optimization problems", Management Science 18 (1972),
// divides what is left after the best.

#include "explore/controls/controls.h"

#include <algorithm>

namespace cbc {

/// Answers for one environment, and notes in the tree what was asked.
class Controls::Asked final : public SystemOracle {
 public:
  Asked(Controls& controls, const std::vector<std::uint8_t>& environment, const Place& place)
      : controls_(controls), environment_(environment), place_(place) {
    controls_.known_.clear();
  }

  [[nodiscard]] bool is_in(Set set) override {
    if (set == Diagrams::all || set == Diagrams::empty) return set == Diagrams::all;
    const bool answer = contains(set);
    // Behaviors often depend on the same, and so do those of two catalogs.
    std::vector<Set>& known = controls_.known_;
    if (std::find(known.begin(), known.end(), set) != known.end()) return answer;
    known.push_back(set);
    // What was asked before may be more than what is asked now.
    while (is_branch() && asked_here() != set) go_on(contains(asked_here()));
    if (!is_branch()) {
      controls_.at(place_) = static_cast<Tree>(controls_.branches_.size());
      controls_.branches_.push_back({set, {0, 0}});
    }
    go_on(answer);
    return answer;
  }

  /// Where the result belongs.
  [[nodiscard]] const Place& place() {
    while (is_branch()) go_on(contains(asked_here()));
    return place_;
  }

 private:
  [[nodiscard]] bool contains(Set set) const {
    return controls_.system_.sets().contains(set, environment_);
  }
  [[nodiscard]] bool is_branch() const {
    const Tree tree = controls_.at(place_);
    return tree != 0 && (tree & is_result) == 0;
  }
  [[nodiscard]] Set asked_here() const { return controls_.branches_[controls_.at(place_)].asked; }
  void go_on(bool answer) { place_ = {controls_.at(place_), answer ? 1U : 0U, false}; }

  Controls& controls_;
  const std::vector<std::uint8_t>& environment_;
  Place place_;
};

Controls::Controls(ControlSystem& system)
    : system_(system), store_(system.first_control().size()), branches_(1) {}

void Controls::load(Number control) {
  if (control == loaded_) return;
  loaded_ = control;
  system_.load(store_.state(control));
  const std::size_t actions = system_.actions().size();
  const std::size_t roots = (std::size_t{control} + 1) * actions;
  if (roots_.size() < roots) roots_.resize(std::max(roots, store_.size() * actions), 0);
}

/// Finds the result in one environment.
void Controls::explore(std::uint32_t action, const std::vector<std::uint8_t>& environment) {
  Asked asked(*this, environment, root_of(action));
  const NumberedResult result = numbered(system_.take(action, asked));
  at(asked.place()) = tree_of(result);
  ++regions_;
}

Controls::NumberedResult Controls::numbered(const ControlSystem::MoveResult& result) {
  return {result.control == nullptr ? none : find(result.control), result.accepted, result.note,
          result.values, result.exists};
}

Controls::Tree Controls::tree_of(const NumberedResult& result) {
  if (result.note != 0 || result.values != 0 || !result.exists) {
    noted_.push_back(result);
    return is_result | is_noted | static_cast<Tree>(noted_.size() - 1);
  }
  return is_result | (result.accepted ? is_accepted : 0) |
         (result.control == none ? no_control : result.control);
}

Controls::NumberedResult Controls::result_in(std::uint32_t action,
                                             const std::vector<std::uint8_t>& environment) {
  Place place = root_of(action);
  for (;;) {
    if (at(place) == 0) explore(action, environment);
    const Tree tree = at(place);
    if ((tree & is_result) != 0) return result_of(tree);
    const bool answer = system_.sets().contains(branches_[tree].asked, environment);
    place = {tree, answer ? 1U : 0U, false};
  }
}

std::vector<Controls::Number> Controls::successors_of(Number control) const {
  std::vector<Number> successors;
  const std::size_t actions = system_.actions().size();
  const std::size_t first = std::size_t{control} * actions;
  if (first >= roots_.size()) return successors;
  std::vector<Tree> open(roots_.begin() + static_cast<std::ptrdiff_t>(first),
                         roots_.begin() + static_cast<std::ptrdiff_t>(first + actions));
  while (!open.empty()) {
    const Tree tree = open.back();
    open.pop_back();
    if (tree == 0) continue;
    if ((tree & is_result) == 0) {
      for (const Tree answer : branches_[tree].answers) open.push_back(answer);
    } else if (const NumberedResult result = result_of(tree); result.control != none) {
      successors.push_back(result.control);
    }
  }
  std::sort(successors.begin(), successors.end());
  successors.erase(std::unique(successors.begin(), successors.end()), successors.end());
  return successors;
}

std::uint64_t Controls::bytes() const {
  return store_.bytes() + roots_.capacity() * sizeof(Tree) + branches_.capacity() * sizeof(Branch) +
         noted_.capacity() * sizeof(NumberedResult);
}

}  // namespace cbc
