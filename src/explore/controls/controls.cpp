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
    while (is_question() && asked_here() != set) go_on(contains(asked_here()));
    if (!is_question()) {
      controls_.at(place_) = static_cast<Tree>(controls_.questions_.size());
      controls_.questions_.push_back({set, {0, 0}});
    }
    go_on(answer);
    return answer;
  }

  /// Where the outcome belongs.
  [[nodiscard]] const Place& place() {
    while (is_question()) go_on(contains(asked_here()));
    return place_;
  }

 private:
  [[nodiscard]] bool contains(Set set) const {
    return controls_.system_.sets().contains(set, environment_);
  }
  [[nodiscard]] bool is_question() const {
    const Tree tree = controls_.at(place_);
    return tree != 0 && (tree & is_outcome) == 0;
  }
  [[nodiscard]] Set asked_here() const { return controls_.questions_[controls_.at(place_)].asked; }
  void go_on(bool answer) { place_ = {controls_.at(place_), answer ? 1U : 0U, false}; }

  Controls& controls_;
  const std::vector<std::uint8_t>& environment_;
  Place place_;
};

Controls::Controls(ControlSystem& system)
    : system_(system), store_(system.first_control().size()), questions_(1) {}

void Controls::load(Number control) {
  if (control == loaded_) return;
  loaded_ = control;
  system_.load(store_.state(control));
  const std::size_t actions = system_.actions().size();
  const std::size_t roots = (std::size_t{control} + 1) * actions;
  if (roots_.size() < roots) roots_.resize(std::max(roots, store_.size() * actions), 0);
}

/// Finds the outcome in one environment.
void Controls::explore(std::uint32_t action, const std::vector<std::uint8_t>& environment) {
  Asked asked(*this, environment, root_of(action));
  const Outcome outcome = numbered(system_.take(action, asked));
  at(asked.place()) = tree_of(outcome);
  ++regions_;
}

Controls::Outcome Controls::numbered(const ControlSystem::Outcome& outcome) {
  return {outcome.control == nullptr ? none : find(outcome.control), outcome.accepted,
          outcome.note};
}

Controls::Tree Controls::tree_of(const Outcome& outcome) {
  if (outcome.note != 0) {
    noted_.push_back(outcome);
    return is_outcome | is_noted | static_cast<Tree>(noted_.size() - 1);
  }
  return is_outcome | (outcome.accepted ? is_accepted : 0) |
         (outcome.control == none ? no_control : outcome.control);
}

Controls::Outcome Controls::outcome_in(std::uint32_t action,
                                       const std::vector<std::uint8_t>& environment) {
  Place place = root_of(action);
  for (;;) {
    if (at(place) == 0) explore(action, environment);
    const Tree tree = at(place);
    if ((tree & is_outcome) != 0) return outcome_of(tree);
    const bool answer = system_.sets().contains(questions_[tree].asked, environment);
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
    if ((tree & is_outcome) == 0) {
      for (const Tree answer : questions_[tree].answers) open.push_back(answer);
    } else if (const Outcome outcome = outcome_of(tree); outcome.control != none) {
      successors.push_back(outcome.control);
    }
  }
  std::sort(successors.begin(), successors.end());
  successors.erase(std::unique(successors.begin(), successors.end()), successors.end());
  return successors;
}

std::uint64_t Controls::bytes() const {
  return store_.bytes() + roots_.capacity() * sizeof(Tree) +
         questions_.capacity() * sizeof(Question) + noted_.capacity() * sizeof(Outcome);
}

}  // namespace cbc
