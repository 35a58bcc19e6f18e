// Which goals the moves of an exploration meet: a monitor, as of missions, but of the moves of
// controls (monitors of runtime verification: M. Leucker and C. Schallhart, "A brief account of
// runtime verification", Journal of Logic and Algebraic Programming 78 (2009)). The answers to
// events meet the same goals here as there (GoalNotes). What else depends on the environment, as
// whether a behavior began to fit, or what would have been decided without a constraint, is asked,
// so that a move is made once more for the environments with another answer.
//
// Goals as properties of states would be quicker, but most are about events and about what an
// answer would have been otherwise, so each would be written down a second time, and differ some
// day.

#include "coverage/engine/goal_system.h"

#include <algorithm>

#include "core/script/script.h"
#include "explore/controls/witness.h"

namespace cbc {

GoalSystem::GoalSystem(const Model& model, const Stepper::Options& options,
                       const GoalQuestion& question)
    : CatalogSystem(model, options, std::nullopt),
      question_(question),
      notes_(model.catalog(), question.goals),
      relaxed_(model, question.goals, question.wanted, options.decision_bytes),
      race_(model),
      met_(question.goals.size(), 0),
      returns_(model.catalog().tasks.size(), none) {
  for (std::uint32_t goal = 0; goal < met_.size(); ++goal) {
    const bool is_return = question.goals[goal].kind == Goal::Kind::reactive_returned;
    if (is_return && question.wanted[goal] != 0) returns_[question.goals[goal].task] = goal;
  }
  find_changes();
  watch(trace_, *this);
}

void GoalSystem::find_changes() {
  const CompiledCatalog& catalog = model().catalog();
  for (std::uint32_t behavior = 0; behavior < model().behaviors().size(); ++behavior) {
    if (!catalog.fitting_values_of(model().behaviors()[behavior].id).empty()) {
      conditional_.push_back(behavior);
    }
  }
  changes_.resize(actions_.size());
  values_.resize(actions_.size());
  for (const StateMove& move : moves_) {
    const bool is_of_variables =
        move.move.kind == Move::Kind::variable || move.move.kind == Move::Kind::together;
    if (!is_of_variables) continue;
    const Step step = step_of(catalog, model().assumptions(), move.move);
    for (const VariableValue& value : step.situation.variables) {
      const std::uint32_t goal = notes_.find(
          Goal::Kind::variable_value, catalog.variables[value.variable].first_value + value.value);
      if (goal != none) values_[move.action].push_back(goal);
    }
    const Action& action = actions_[move.action];
    for (const std::uint32_t behavior : conditional_) {
      const Set fits = environments().fitting(behavior);
      const Set after = before(action, 0, fits);
      const Fit fit{behavior, sets_.without(after, fits),
                    sets_.without(sets_.both(fits, action.condition), after)};
      if (fit.begins != Diagrams::empty || fit.ceases != Diagrams::empty) {
        changes_[move.action].push_back(fit);
      }
    }
  }
}

ControlSystem::MoveResult GoalSystem::take(std::uint32_t action, SystemOracle& oracle) {
  notes_.begin();
  trace_.events.clear();
  started_.clear();
  changed_.taken.assign(model().tasks().size(), 0);
  changed_.activated.assign(model().behaviors().size(), 0);
  MoveResult result = CatalogSystem::take(action, oracle);
  note_fits(action, oracle);
  const Model::Choice& choice = choice_of(action);
  if (choice.move.kind == Move::Kind::start) {
    const TaskId task = model().tasks()[choice.subject].id;
    GoalFacts& facts = notes_.facts();
    (result.accepted ? facts.start_accepted : facts.start_rejected)[task] = 1;
  }
  for (const MoveTrace::Happening& event : trace_.events) {
    for (const MoveTrace::Change& change : event.changes) {
      if (!change.is_activation) continue;
      changed_.activated[change.behavior] |= change.success ? 1 : 0;
      if (!change.success) {
        notes_.note_failure(model().behaviors()[change.behavior].id);
      }
    }
  }
  race_.note(stepper(), choice.move, changed_);
  result.note = note_of_move(action);
  return result;
}

void GoalSystem::note_fits(std::uint32_t action, SystemOracle& oracle) {
  for (const Fit& fit : changes_[action]) {
    const BehaviorId id = model().behaviors()[fit.behavior].id;
    const std::uint32_t begins = notes_.find(Goal::Kind::behavior_began_to_fit, id);
    const std::uint32_t ceases = notes_.find(Goal::Kind::behavior_ceased_to_fit, id);
    if (is_open(begins) && oracle.is_in(fit.begins)) notes_.meet(begins);
    const bool is_active = has_bit(stepper().active().data(), fit.behavior);
    if (is_active && is_open(ceases) && oracle.is_in(fit.ceases)) notes_.meet(ceases);
  }
}

void GoalSystem::on_answer(Stepper& stepper, const Stepper::Answer& answer) {
  const Stepper::Trigger& trigger = answer.trigger;
  Trigger event;
  event.kind = static_cast<Trigger::Kind>(trigger.kind);
  event.group = model().groups()[trigger.group].number;
  if (trigger.task != none) event.task = model().tasks()[trigger.task].id;
  if (trigger.behavior != none) event.behavior = model().behaviors()[trigger.behavior].id;
  event.cause = trigger.cause;
  event.priority = model().priority_of(trigger.rank);
  event.is_reactive = trigger.is_reactive;
  if (answer.solution != nullptr) note_answer(stepper, event, trigger.group, answer.solution);
  relaxed_.ask(
      stepper, answer, [this](std::uint32_t goal) { return is_open(goal); },
      [this](std::uint32_t goal) { notes_.meet(goal); }, notes_.facts().was_asked);
  if (answer.solution != nullptr || event.kind != Trigger::Kind::start || event.is_reactive) return;
  const std::uint32_t rejected = notes_.find(Goal::Kind::lower_rejected, event.task);
  if (is_open(rejected) && stepper.answer_unprotected(trigger) != nullptr) notes_.meet(rejected);
}

void GoalSystem::note_answer(const Stepper& stepper, const Trigger& trigger, std::uint32_t group,
                             const Word* solution) {
  const Model::Layout& layout = model().layout();
  const BitRange tasks = model().groups()[group].tasks;
  const std::uint16_t* const cells = stepper.cells_after();
  behaviors_.assign(tasks.size(), none);
  requests_.assign(tasks.size(), std::nullopt);
  solution_.assign(tasks.size(), none);
  for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
    const BitRange values = model().tasks()[task].values;
    std::uint32_t& chosen = solution_[LocalTask(task - tasks.begin)];
    for (std::uint32_t value = values.begin; value < values.end && chosen == none; ++value) {
      if (has_bit(solution, value)) chosen = value - values.begin;
    }
    const std::uint32_t present = cells[task] - 1U;  // none if it does not run
    if (chosen != present) changed_.taken[task] = 1;
    if (cells[task] == 0) continue;
    behaviors_[task - tasks.begin] =
        model().behaviors()[model().behavior_of(values.begin + present)].id;
  }
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint32_t task = cells[layout.requests + place] - 1U;
    if (task < tasks.begin || task >= tasks.end) continue;
    requests_[task - tasks.begin] = model().priority_of(cells[layout.ranks + place]);
  }
  notes_.note({trigger, behaviors_, requests_, solution_});
  if (trigger.is_reactive) started_.push_back(trigger.task);
  if (trigger.kind != Trigger::Kind::finish || trigger.cause != FinishCause::process_failure) {
    return;
  }
  const CompiledCatalog& catalog = model().catalog();
  for (const ValueId value : catalog.performs[trigger.behavior]) {
    const TaskId task = catalog.task_of(value);
    const BehaviorId performing = behaviors_[task - catalog.group_tasks[trigger.group]];
    if (performing != trigger.behavior) continue;
    if (timeout_of(catalog, task, performing) > 0) notes_.note_timeout(value);
  }
}

/// What the move meets, as a number.
std::uint32_t GoalSystem::note_of_move(std::uint32_t action) {
  items_ = notes_.found();
  notes_.forget();
  items_.insert(items_.end(), values_[action].begin(), values_[action].end());
  for (const std::uint32_t goal : items_) met_[goal] = 1;
  std::erase_if(items_, [&](std::uint32_t goal) {
    return question_.wanted[goal] == 0 ||
           question_.goals[goal].kind == Goal::Kind::reactive_returned;
  });
  const auto add_return = [&](TaskId task, std::size_t offset) {
    if (returns_[task] == none) return;
    items_.push_back(returns_[task] + static_cast<std::uint32_t>(offset));
  };
  for (const TaskId task : started_) add_return(task, 0);
  for (const std::uint32_t task : model().reactive()) {
    const TaskId id = model().tasks()[task].id;
    if (notes_.has_given_way(id)) add_return(id, question_.goals.size());
  }
  if (items_.empty()) return 0;
  std::sort(items_.begin(), items_.end());
  items_.erase(std::unique(items_.begin(), items_.end()), items_.end());
  const auto number = static_cast<std::uint32_t>(items_of_notes_.size());
  const auto [entry, is_new] = numbers_of_notes_.try_emplace(items_, number);
  if (is_new) items_of_notes_.push_back(items_);
  return entry->second;
}

void GoalSystem::note_situations(Set environments) {
  const CompiledCatalog& catalog = model().catalog();
  for (const std::uint32_t behavior : conditional_) {
    GoalFacts& facts = notes_.facts();
    const BehaviorId id = model().behaviors()[behavior].id;
    const Set fits = this->environments().fitting(behavior);
    if (sets_.both(environments, fits) != Diagrams::empty) facts.fitted[id] = 1;
    if (sets_.without(environments, fits) != Diagrams::empty) facts.misfitted[id] = 1;
  }
  for (std::uint32_t number = 0; number < model().variables().size(); ++number) {
    const Model::Variable& variable = model().variables()[number];
    for (std::uint32_t value = 0; value < variable.values; ++value) {
      const std::uint32_t goal = notes_.find(Goal::Kind::variable_value,
                                             catalog.variables[variable.id].first_value + value);
      const Set here = sets_.both(environments, this->environments().with_value(number, value));
      if (goal != none && here != Diagrams::empty) met_[goal] = 1;
    }
  }
}

void GoalSystem::for_each_kept(const std::function<void(Set)>& keep) const {
  CatalogSystem::for_each_kept(keep);
  for (const std::vector<Fit>& of_action : changes_) {
    for (const Fit& fit : of_action) {
      keep(fit.begins);
      keep(fit.ceases);
    }
  }
}

}  // namespace cbc
