// The ways to satisfy a formula are gone through one by one. Each says which tasks run, with which
// behaviors, and in which situations, so that a search for assignments settles it (ask.h).

#include "ask/formula.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cbc {
namespace {

/// What one more case costs, in decisions of the solver.
constexpr std::uint64_t effort_of_case = 500'000;
/// What each part of a formula costs.
constexpr std::uint64_t effort_of_part = 10;
/// More cases would take too long to find a conflict in.
constexpr std::size_t most_cases_of_conflict = 200;
constexpr std::size_t most_constraints_of_conflict = 2'000;

template <typename List, typename Item>
bool is_listed(const List& list, Item item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

Formula FormulaMaker::runs(TaskId task, const std::vector<BehaviorId>& behaviors,
                           bool holds) const {
  Formula formula{Formula::Kind::task, task, {}, !holds};
  for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
       ++value) {
    const bool is_meant =
        behaviors.empty() || is_listed(behaviors, catalog_.values.items[value].behavior);
    if (is_meant == holds) formula.values.push_back(value);
  }
  return formula;
}

Formula FormulaMaker::active(BehaviorId behavior, bool holds) const {
  Formula formula = join(!holds);
  for (const ValueId value : catalog_.performs[behavior]) {
    formula.parts.push_back(runs(catalog_.task_of(value), {behavior}, holds));
  }
  return formula;
}

Formula FormulaMaker::has_value(std::uint32_t variable, const std::vector<std::uint32_t>& listed,
                                bool holds) const {
  Formula formula{Formula::Kind::variable, variable};
  for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
    if (is_listed(listed, value) == holds) formula.values.push_back(value);
  }
  return formula;
}

Formula FormulaMaker::none_faulty(const std::vector<BehaviorId>& behaviors, bool holds) {
  if (!holds) return {Formula::Kind::some_fault, 0, {behaviors.begin(), behaviors.end()}};
  Formula formula = join(true);
  for (const BehaviorId behavior : behaviors) formula.parts.push_back(faulty(behavior, false));
  return formula;
}

Formula FormulaMaker::available(BehaviorId behavior, bool holds) const {
  Formula formula = join(holds);
  formula.parts.push_back(own(behavior, holds));
  std::map<std::uint32_t, std::vector<std::uint32_t>> fitting;
  for (const FittingValue& value : catalog_.fitting_values_of(behavior)) {
    fitting[value.variable].push_back(value.value);
  }
  for (const auto& [variable, values] : fitting) {
    formula.parts.push_back(has_value(variable, values, holds));
  }
  return formula;
}

StateAsk::StateAsk(const CompiledCatalog& catalog, const PossibleStates& possible,
                   std::uint64_t effort)
    : catalog_(catalog),
      possible_(possible),
      space_(catalog, possible_.constant, {}),
      search_(catalog, 0, Effort(effort)) {}

Feasibility StateAsk::find(const Formulas& formulas) {
  return go_through(formulas, [this](const SituationSpace& space, const Asked& question,
                                     const ValueSets& values) {
    return Ask(search_, space).find(question, values);
  });
}

Feasibility StateAsk::find_under(const Formulas& formulas, const Counts& counts) {
  RelaxedQuestions questions(space_, search_.effort());
  std::vector<Reason> constraints;
  std::deque<SituationSpace> spaces;
  if (!collect(formulas, counts, questions, constraints, spaces)) return Feasibility::unknown;
  return questions.solve(constraints);
}

std::vector<Reason> StateAsk::conflict(const Formulas& formulas, const Counts& counts) {
  RelaxedQuestions questions(space_, search_.effort());
  std::vector<Reason> constraints;
  std::deque<SituationSpace> spaces;
  if (!collect(formulas, counts, questions, constraints, spaces)) return {};
  if (constraints.size() > most_constraints_of_conflict) return {};
  return questions.conflict(constraints);
}

/// All cases as questions. False if there are too many.
bool StateAsk::collect(const Formulas& formulas, const Counts& counts, RelaxedQuestions& questions,
                       std::vector<Reason>& constraints, std::deque<SituationSpace>& spaces) {
  return go_through(formulas, [&](const SituationSpace& space, const Asked& question,
                                  const ValueSets& values) {
           if (spaces.size() == most_cases_of_conflict) return Feasibility::unknown;
           questions.add(question, &values, &spaces.emplace_back(space));
           for (const Reason& reason : constraints_on(catalog_, question, true)) {
             if (counts(reason) && !is_listed(constraints, reason)) constraints.push_back(reason);
           }
           return Feasibility::no;
         }) == Feasibility::no;
}

Feasibility StateAsk::go_through(const Formulas& formulas, const OnCase& on_case) {
  return go_on({{}, space_.all(), {}, {}, {}}, formulas, on_case);
}

/// `open`: what the case has to satisfy, too.
Feasibility StateAsk::go_on(Case of_state, Formulas open, const OnCase& on_case) {
  Formulas choices;
  while (!open.empty()) {
    const Formula& next = *open.back();
    open.pop_back();
    search_.effort().spend(effort_of_part);
    if (next.kind == Formula::Kind::all) {
      for (const Formula& part : next.parts) open.push_back(&part);
    } else if (next.kind == Formula::Kind::any) {
      choices.push_back(&next);
    } else if (!add(next, of_state)) {
      return Feasibility::no;
    }
  }
  if (choices.empty()) return settle(std::move(of_state), on_case);
  const Formula& choice = *choices.back();
  choices.pop_back();
  for (const Formula& part : choice.parts) {
    Formulas rest = choices;
    rest.push_back(&part);
    search_.effort().spend(effort_of_case);
    if (search_.is_exhausted()) return Feasibility::unknown;
    const Feasibility answer = go_on(of_state, std::move(rest), on_case);
    if (answer != Feasibility::no) return answer;
  }
  return Feasibility::no;
}

/// False if the case has no state with it, by itself.
bool StateAsk::add(const Formula& literal, Case& of_state) const {
  switch (literal.kind) {
    case Formula::Kind::task:
      return add_task(literal, of_state.tasks[TaskId(literal.subject)]);
    case Formula::Kind::variable:
      return add_variable(literal, of_state.values);
    case Formula::Kind::own: {
      const BehaviorId behavior(literal.subject);
      for (const SituationPart::Own& own : possible_.constant.behaviors) {
        if (own.behavior == behavior) return own.available == literal.wanted;
      }
      return of_state.own.try_emplace(behavior, literal.wanted).first->second == literal.wanted;
    }
    case Formula::Kind::fault:
      return add_fault(BehaviorId(literal.subject), literal.wanted, of_state);
    case Formula::Kind::some_fault:
      of_state.some_faults.push_back(&literal);
      break;
    case Formula::Kind::all:
    case Formula::Kind::any:
      break;
  }
  return true;
}

bool StateAsk::add_task(const Formula& literal, OfTask& task) const {
  const std::uint32_t begin = catalog_.values.begin[literal.subject];
  task.is_open.resize(catalog_.values.begin[literal.subject + 1] - begin, 1);
  task.runs |= !literal.may_stop;
  for (std::uint32_t place = 0; place < task.is_open.size(); ++place) {
    if (!is_listed(literal.values, begin + place)) task.is_open[place] = 0;
  }
  return !task.runs || is_listed(task.is_open, 1);
}

bool StateAsk::add_variable(const Formula& literal, ValueSets& values) const {
  const CompiledVariable& variable = catalog_.variables[literal.subject];
  bool has_value = false;
  for (std::uint32_t value = 0; value < variable.value_count; ++value) {
    auto& is_open = values[variable.first_value + value];
    if (!is_listed(literal.values, value)) is_open = 0;
    has_value |= is_open != 0;
  }
  return has_value;
}

bool StateAsk::can_fail(BehaviorId behavior) const {
  return possible_.faults > 0 && (!possible_.can_fail || possible_.can_fail(behavior));
}

bool StateAsk::add_fault(BehaviorId behavior, bool wanted, Case& of_state) const {
  if (!can_fail(behavior)) return !wanted;
  const bool is_faulty = of_state.faulty.try_emplace(behavior, wanted).first->second;
  const auto count = std::count_if(of_state.faulty.begin(), of_state.faulty.end(),
                                   [](const auto& one) { return one.second; });
  return is_faulty == wanted && static_cast<std::uint64_t>(count) <= possible_.faults;
}

/// Whether one of the behaviors of each of some_faults may be faulty; one of another is not
/// counted, which matters only where few may be.
bool StateAsk::may_have_faults(const Case& of_state) const {
  return std::all_of(
      of_state.some_faults.begin(), of_state.some_faults.end(), [&](const Formula* some) {
        return std::any_of(some->values.begin(), some->values.end(), [&](std::uint32_t behavior) {
          Case with_fault = of_state;
          return add_fault(BehaviorId(behavior), true, with_fault);
        });
      });
}

/// Decides own(b) of what `never` names, and hands the case over.
Feasibility StateAsk::settle(Case of_state, const OnCase& on_case) {
  if (!may_have_faults(of_state)) return Feasibility::no;
  if (const auto behavior = find_open_own(of_state)) {
    for (const bool is_available : {true, false}) {
      of_state.own[*behavior] = is_available;
      search_.effort().spend(effort_of_case);
      if (search_.is_exhausted()) return Feasibility::unknown;
      const Feasibility answer = settle(of_state, on_case);
      if (answer != Feasibility::no) return answer;
    }
    return Feasibility::no;
  }
  const Asked question = asked_of(of_state);
  if (possible_.never.empty()) return on_case(space_, question, of_state.values);
  const SituationSpace space(catalog_, possible_.constant, never_in(of_state));
  return on_case(space, question, of_state.values);
}

/// An own(b) that is not decided, but that an entry of `never` names.
std::optional<BehaviorId> StateAsk::find_open_own(const Case& of_state) const {
  for (const SituationPart& entry : possible_.never) {
    for (const SituationPart::Own& own : entry.behaviors) {
      const auto is_it = [&](const auto& other) { return other.behavior == own.behavior; };
      const auto& constant = possible_.constant.behaviors;
      if (std::any_of(constant.begin(), constant.end(), is_it)) continue;
      if (!of_state.own.contains(own.behavior)) return own.behavior;
    }
  }
  return std::nullopt;
}

/// The entries of `never`, with all own(b) as decided.
std::vector<SituationPart> StateAsk::never_in(const Case& of_state) const {
  std::map<BehaviorId, bool> decided = of_state.own;
  for (const auto& own : possible_.constant.behaviors) decided[own.behavior] = own.available;
  std::vector<SituationPart> entries;
  for (const SituationPart& entry : possible_.never) {
    const bool may_be = std::all_of(
        entry.behaviors.begin(), entry.behaviors.end(),
        [&](const SituationPart::Own& own) { return decided.at(own.behavior) == own.available; });
    if (may_be) entries.push_back({entry.variables, {}});
  }
  return entries;
}

/// Nothing is demanded of a group in which nothing has to run: it may be idle.
Asked StateAsk::asked_of(const Case& of_state) const {
  Demands demands;
  std::vector<bool> has_to_run(catalog_.group_count(), false);
  for (const auto& [task, of_task] : of_state.tasks) {
    if (of_task.runs) has_to_run[catalog_.tasks[task].group] = true;
  }
  for (const auto& [task, of_task] : of_state.tasks) {
    if (!has_to_run[catalog_.tasks[task].group]) continue;
    if (of_task.runs) demands.push_back({Demand::Kind::run, task, none});
    for (std::uint32_t place = 0; place < of_task.is_open.size(); ++place) {
      if (of_task.is_open[place] == 0) demands.push_back({Demand::Kind::has_not, task, place});
    }
  }
  return cbc::asked_of(catalog_, demands);
}

}  // namespace cbc
