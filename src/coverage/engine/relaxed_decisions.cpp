// The answer without a constraint is sought as the stepper seeks that with it: first as if all were
// available that may be. Where it is the same answer then, it is the same in each environment that
// the move stands for, as the best of more choices is the best of fewer that it is one of; and this
// is remembered by what the answer depends on. For the few other constraints the environment is
// asked, and the move is made once more for those in which the answers are different.
//
// To solve the problem of each single environment, as missions do, would need no second way to ask,
// but a state of many variables has thousands of them.

#include "coverage/engine/relaxed_decisions.h"

#include <algorithm>

#include "coverage/engine/constraint_relaxation.h"

namespace cbc {

RelaxedDecisions::RelaxedDecisions(const Model& model, std::span<const Goal> goals,
                                   const std::vector<std::uint8_t>& wanted, std::size_t most_bytes)
    : model_(model),
      goals_(goals),
      deciding_(model.groups().size()),
      most_variants_(most_variants_of(model.catalog())) {
  std::size_t count = 1;
  for (std::uint32_t number = 0; number < goals.size(); ++number) {
    if (wanted[number] == 0 || !is_about_deciding(goals[number].kind)) continue;
    const std::uint32_t task = model.find_task(goals[number].task);
    if (task == none) continue;
    deciding_[model.tasks()[task].group].push_back(number);
    ++count;
  }
  unasked_ = deciding_;
  bytes_of_variant_ = most_bytes / 2 / count;
  constexpr std::size_t bytes_of_entry = 512;
  most_suspects_ = most_bytes / 2 / bytes_of_entry;
}

void RelaxedDecisions::ask(Stepper& stepper, const Stepper::Answer& answer,
                           const std::function<bool(std::uint32_t)>& is_open,
                           const std::function<void(std::uint32_t)>& meet,
                           std::vector<std::uint8_t>& was_asked) {
  if (deciding_[answer.trigger.group].empty()) return;
  // First those that ask nothing, and rest on what is known of the environment by now.
  for (const std::uint32_t goal : suspects(stepper, answer, is_open)) {
    if (is_open(goal) && differs(stepper, answer, goal, true)) meet(goal);
  }
  note_asked(stepper, answer.trigger, was_asked);
}

/// Another answer has to violate the constraint: both tasks of a pair have to run in it, and the
/// behavior of a requirement has to be active.
bool RelaxedDecisions::may_matter(const Goal& goal, const Values& may_have) const {
  const auto may_run = [&](TaskId task) {
    const BitRange values = model_.tasks()[model_.find_task(task)].values;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      if (may_have(value)) return true;
    }
    return false;
  };
  if (goal.kind == Goal::Kind::exclusion_decided) {
    return may_run(goal.task) && may_run(goal.other_task);
  }
  if (goal.behavior == none) return may_run(goal.task);
  const auto& values = model_.behaviors()[model_.find_behavior(goal.behavior)].values;
  return std::any_of(values.begin(), values.end(), may_have);
}

/// The environment is asked for each goal until it may matter somewhere.
void RelaxedDecisions::note_asked(Stepper& stepper, const Stepper::Trigger& trigger,
                                  std::vector<std::uint8_t>& was_asked) {
  std::erase_if(unasked_[trigger.group], [&](std::uint32_t goal) {
    const auto is_known = [&](std::uint32_t value) {
      return has_bit(stepper.domains().data(), value);
    };
    const auto may_have = [&](std::uint32_t value) {
      return is_known(value) && stepper.may_have(trigger, value);
    };
    if (!may_matter(goals_[goal], is_known) || !may_matter(goals_[goal], may_have)) return false;
    was_asked[goal] = 1;
    return true;
  });
}

/// Whether the answer without the constraint of the goal is another one: perhaps, or, if the
/// environment is asked, certainly.
bool RelaxedDecisions::differs(Stepper& stepper, const Stepper::Answer& answer, std::uint32_t goal,
                               bool is_asked) {
  if (!variants_.contains(goal) && variants_.size() >= most_variants_) variants_.clear();
  std::unique_ptr<Variant>& variant = variants_[goal];
  if (variant == nullptr) {
    variant = std::make_unique<Variant>(model_, without_constraint(model_.catalog(), goals_[goal]),
                                        bytes_of_variant_);
  }
  Model::Rank ranks = answer.first;
  const Word* const other = stepper.solve(variant->decisions, answer.trigger, ranks, is_asked);
  if (other == nullptr || answer.solution == nullptr) return other != nullptr;
  return ranks != answer.ranks ||
         !std::equal(other, other + words_for(model_.value_count()), answer.solution);
}

const std::vector<std::uint32_t>& RelaxedDecisions::suspects(
    Stepper& stepper, const Stepper::Answer& answer,
    const std::function<bool(std::uint32_t)>& is_open) {
  write_key(stepper, answer.trigger);
  if (suspects_.size() >= most_suspects_) suspects_.clear();
  const auto [known, is_new] = suspects_.try_emplace(key_);
  if (!is_new) return known->second;
  for (const std::uint32_t goal : deciding_[answer.trigger.group]) {
    const auto is_known = [&](std::uint32_t value) {
      return has_bit(stepper.domains().data(), value);
    };
    if (!is_open(goal) || !may_matter(goals_[goal], is_known)) continue;
    if (differs(stepper, answer, goal, false)) known->second.push_back(goal);
  }
  return known->second;
}

/// All that the answer depends on.
void RelaxedDecisions::write_key(const Stepper& stepper, const Stepper::Trigger& trigger) {
  key_.clear();
  const auto append = [this](const auto* items, std::size_t count) {
    key_.append(reinterpret_cast<const char*>(items), count * sizeof(*items));
  };
  const std::uint32_t head[] = {
      trigger.task, trigger.behavior, (std::uint32_t{trigger.ranks} << 16U) + trigger.rank,
      (static_cast<std::uint32_t>(trigger.kind) << 16U) +
          (static_cast<std::uint32_t>(trigger.cause) << 8U) + (trigger.is_reactive ? 1U : 0U)};
  append(head, std::size(head));
  const Model::Layout& layout = model_.layout();
  append(stepper.cells_after(), layout.queue);  // values, requests and ranks
  append(stepper.domains().data(), stepper.domains().size());
}

}  // namespace cbc
