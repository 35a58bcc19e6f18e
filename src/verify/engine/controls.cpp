// What a move makes of a control depends on few behaviors, however many environments there are. So
// it is made in one environment, with note of what was asked about it (symbolic execution: J. C.
// King, "Symbolic execution and program testing", Communications of the ACM 19 (1976)): the same
// comes of it in all environments with the same answers. The first decision takes all for available
// that may be; where what it uses is not, the next one lacks it, as E. L. Lawler, "A procedure for
// computing the K best solutions to discrete optimization problems", Management Science 18 (1972),
// divides what is left after the best.

#include "verify/engine/controls.h"

#include <algorithm>

namespace cbc {

/// Answers for one environment, and notes in the tree what was asked.
class Controls::Asked final : public EnvironmentOracle {
 public:
  Asked(Controls& controls, const Environments::Effect& effect, const Place& place)
      : controls_(controls), effect_(effect), place_(place) {}

  [[nodiscard]] bool holds(EnvironmentQuery query) override {
    const Set yes = controls_.environments_.query(effect_, query);
    if (yes == Diagrams::all || yes == Diagrams::empty) return yes == Diagrams::all;
    const bool answer = controls_.environments_.sets().contains(yes, controls_.string_);
    if (controls_.at(place_) == 0) {
      controls_.at(place_) = static_cast<Tree>(controls_.questions_.size());
      controls_.questions_.push_back({query, {0, 0}});
    }
    place_ = {controls_.at(place_), answer ? 1U : 0U, false};
    return answer;
  }

  /// Where the outcome belongs.
  [[nodiscard]] const Place& place() const { return place_; }

 private:
  Controls& controls_;
  const Environments::Effect& effect_;
  Place place_;
};

Controls::Controls(const Model& model, Environments& environments, const Stepper::Options& options)
    : model_(model),
      environments_(environments),
      options_(options),
      stepper_(model, options),
      store_(model.packed_words()),
      questions_(1),
      packed_(model.packed_words()) {
  for (const Environments::Effect& effect : environments.effects()) {
    actions_.push_back({model.moves()[effect.choice], effect});
  }
}

std::uint32_t Controls::find_start(std::uint32_t task, Model::Rank ranks) {
  for (std::uint32_t action = 0; action < actions_.size(); ++action) {
    const Model::Choice& choice = actions_[action].choice;
    if (choice.move.kind == Move::Kind::start && choice.subject == task &&
        choice.choice + 1 == ranks) {
      return action;
    }
  }
  Action& trial = actions_.emplace_back();
  trial.choice.move.kind = Move::Kind::start;
  trial.choice.subject = task;
  trial.choice.choice = ranks - 1U;
  trial.is_move = false;
  return static_cast<std::uint32_t>(actions_.size() - 1);
}

const std::uint32_t* Controls::pack(const std::uint16_t* cells) {
  cells_.assign(cells, cells + model_.layout().variables);
  cells_.resize(model_.layout().cells, 0);
  model_.pack(cells_.data(), packed_.data());
  return packed_.data();
}

void Controls::load(Number control) {
  if (control == loaded_) return;
  loaded_ = control;
  stepper_.load_control(store_.state(control));
  const std::size_t roots = (std::size_t{control} + 1) * actions_.size();
  if (roots_.size() < roots) roots_.resize(std::max(roots, store_.size() * actions_.size()), 0);
}

/// Finds the outcome in one environment of the set.
void Controls::explore(std::uint32_t action, Set set) {
  environments_.sets().pick(set, string_);
  const Action& made = actions_[action];
  Asked asked(*this, made.effect, root_of(action));
  stepper_.take_control(made.choice, environments_.possible_after(made.effect), asked);
  // A start that is no move may lead to what no state is.
  const Number target = made.is_move ? find(stepper_.cells_after()) : loaded_;
  at(asked.place()) = is_outcome | (stepper_.was_accepted() ? is_accepted : 0) | target;
  ++regions_;
}

Controls::Number Controls::after_repair(std::uint32_t group) {
  const Model::Group& repaired = model_.groups()[group];
  if (repaired.reactive.empty() || !repaired.has_faults) return loaded_;
  // Nothing is asked: only the queue may change.
  Model::Choice repair;
  repair.move.kind = Move::Kind::repair;
  repair.subject = repaired.behaviors.begin;
  const Environments::Effect none_at_all;
  Asked asked(*this, none_at_all, {});
  stepper_.take_control(repair, environments_.possible_after(none_at_all), asked);
  return find(stepper_.cells_after());
}

std::vector<Controls::Number> Controls::successors_of(Number control) const {
  std::vector<Number> successors;
  const std::size_t first = std::size_t{control} * actions_.size();
  if (first >= roots_.size()) return successors;
  std::vector<Tree> open;
  for (std::size_t action = 0; action < actions_.size(); ++action) {
    if (actions_[action].is_move) open.push_back(roots_[first + action]);
  }
  while (!open.empty()) {
    const Tree tree = open.back();
    open.pop_back();
    if (tree == 0) continue;
    if ((tree & is_outcome) != 0) {
      successors.push_back(tree & (is_accepted - 1));
    } else {
      for (const Tree answer : questions_[tree].answers) open.push_back(answer);
    }
  }
  std::sort(successors.begin(), successors.end());
  successors.erase(std::unique(successors.begin(), successors.end()), successors.end());
  return successors;
}

std::uint64_t Controls::bytes() const {
  return store_.bytes() + roots_.capacity() * sizeof(Tree) +
         questions_.capacity() * sizeof(Question);
}

}  // namespace cbc
