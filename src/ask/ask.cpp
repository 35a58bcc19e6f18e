// A search does not go through the situations, of which there may be too many. It looks for
// assignments whose behaviors may fit, each by itself. If they fit in no common situation, the
// situations are split in two by the condition of one of these behaviors, and each part is
// searched. A proof that there is none then consists of one for each part, and what all of them
// use is where a minimal conflict set is looked for.

#include "ask/ask.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "ask/conflict/quickxplain.h"

namespace cbc {

Asked asked_of(const CompiledCatalog& catalog, std::span<const Demand> demands) {
  Asked question;
  for (const Demand& demand : demands) {
    const GroupId group = catalog.tasks[demand.task].group;
    auto part = std::find_if(question.begin(), question.end(),
                             [group](const GroupDemands& one) { return one.group == group; });
    if (part == question.end()) part = question.insert(part, {group, {}});
    part->demands.push_back(demand);
  }
  return question;
}

void add_fault(const CompiledCatalog& catalog, BehaviorId behavior, Demands& demands) {
  for (const ValueId value : catalog.performs[behavior]) {
    const TaskId task = catalog.task_of(value);
    demands.push_back({Demand::Kind::has_not, task, value - catalog.values.begin[task]});
  }
}

Feasibility SituationSplits::find(const ValueSets& sets, const Search& search,
                                  const ConditionSet* only) {
  if (!space_->find(sets)) return Feasibility::no;
  active_.clear();
  const Feasibility answer = search(sets, active_);
  if (answer != Feasibility::yes) return answer;
  ValueSets fitting = sets;
  for (const BehaviorId behavior : active_) space_->restrict(behavior, fitting, only);
  if (auto situation = space_->find(fitting)) {
    situation_ = std::move(*situation);
    return Feasibility::yes;
  }
  const Split split = choose_split(sets, fitting, only);
  for (const bool meets : {true, false}) {
    const Feasibility of_part = find(take_part(sets, split, meets), search, only);
    if (of_part != Feasibility::no) return of_part;
  }
  ++refuted_[split.variable];
  return Feasibility::no;
}

/// The situations of the sets that meet the condition of a behavior on a variable, or those that do
/// not.
ValueSets SituationSplits::take_part(const ValueSets& sets, const Split& split, bool meets) const {
  const CompiledVariable& variable = space_->catalog().variables[split.variable];
  ValueSets of_one = sets;
  space_->restrict(split.behavior, of_one);
  ValueSets part = sets;
  for (std::uint32_t value = variable.first_value;
       value < variable.first_value + variable.value_count; ++value) {
    if ((of_one[value] != 0) != meets) part[value] = 0;
  }
  return part;
}

/// A condition of an active behavior that some situation of the sets does not meet. `fitting`: the
/// values with which all active behaviors fit. A variable that has none of these is what the
/// behaviors disagree about, so it is taken first; of several that which refuted most, as what
/// cannot be settled is then met before all else has been tried.
SituationSplits::Split SituationSplits::choose_split(const ValueSets& sets,
                                                     const ValueSets& fitting,
                                                     const ConditionSet* only) const {
  Split best;
  std::pair<bool, std::uint64_t> best_key;
  bool has_best = false;
  for (const BehaviorId behavior : active_) {
    ValueSets of_one = sets;
    space_->restrict(behavior, of_one, only);
    for (const FittingValue& condition : space_->catalog().fitting_values_of(behavior)) {
      const CompiledVariable& variable = space_->catalog().variables[condition.variable];
      const auto begin = variable.first_value;
      const auto end = begin + variable.value_count;
      if (std::equal(sets.begin() + begin, sets.begin() + end, of_one.begin() + begin)) continue;
      const bool is_disputed =
          std::find(fitting.begin() + begin, fitting.begin() + end, 1) == fitting.begin() + end;
      const std::pair key(is_disputed, refuted_[condition.variable]);
      if (has_best && key <= best_key) continue;
      has_best = true;
      best = {behavior, condition.variable};
      best_key = key;
    }
  }
  return best;
}

Feasibility Ask::find(const Asked& question, const ValueSets& sets,
                      AssignmentSearch::Wanted wanted) {
  found_.resize(question.size());
  return situations_.find(sets, [&](const ValueSets& part, BehaviorSet& active) {
    for (std::size_t place = 0; place < question.size(); ++place) {
      const GroupDemands& demanded = question[place];
      const Feasibility answer =
          search_.find(demanded.group, demanded.demands, found_[place], {&space_, &part}, wanted);
      if (answer != Feasibility::yes) return answer;
      const TaskId task = search_.catalog().group_tasks[demanded.group];
      const BehaviorSet of_group = behaviors_of(search_.catalog(), task, found_[place]);
      active.insert(active.end(), of_group.begin(), of_group.end());
    }
    return Feasibility::yes;
  });
}

std::vector<Reason> constraints_on(const CompiledCatalog& catalog, const RelevantTasks& relevant) {
  std::vector<Reason> constraints;
  for (const TaskId task : relevant.tasks()) {
    add_exclusions(catalog, task, relevant, most_constraints + 1, constraints);
    add_minimum(catalog, task, constraints);
  }
  for (const BehaviorId behavior : relevant.behaviors()) {
    add_requirements(catalog, behavior, constraints);
  }
  return constraints;
}

namespace {

void add_conditions(const CompiledCatalog& catalog, BehaviorId behavior,
                    std::vector<Reason>& reasons) {
  std::uint32_t last = none;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable == std::exchange(last, fitting.variable)) continue;
    Reason& reason = reasons.emplace_back();
    reason.kind = Reason::Kind::situation;
    reason.behavior = behavior;
    reason.variable = fitting.variable;
    reason.value = none;
  }
}

/// The values of one condition.
std::span<const FittingValue> fitting_values_of(const CompiledCatalog& catalog,
                                                const Reason& condition) {
  const auto all = catalog.fitting_values_of(condition.behavior);
  const auto [begin, end] = std::equal_range(
      all.begin(), all.end(), FittingValue{condition.behavior, condition.variable, 0},
      [](const FittingValue& a, const FittingValue& b) { return a.variable < b.variable; });
  return {begin, end};
}

}  // namespace

std::vector<Reason> constraints_on(const CompiledCatalog& catalog, const Asked& question,
                                   bool with_conditions) {
  std::vector<Reason> constraints;
  for (const GroupDemands& part : question) {
    RelevantTasks relevant(catalog, part.group);
    for (const Demand& demand : part.demands) {
      const bool runs = demand.kind == Demand::Kind::run || demand.kind == Demand::Kind::has;
      if (runs) relevant.add(demand.task);
    }
    relevant.close();
    const std::vector<Reason> of_group = constraints_on(catalog, relevant);
    constraints.insert(constraints.end(), of_group.begin(), of_group.end());
    if (!with_conditions) continue;
    for (const BehaviorId behavior : relevant.behaviors()) {
      add_conditions(catalog, behavior, constraints);
    }
  }
  return constraints;
}

void RelaxedQuestions::add(Asked question, const ValueSets* sets, const SituationSpace* space) {
  const CompiledCatalog& catalog = space_.catalog();
  if (present_.empty()) present_.resize(most_in_a_group(catalog.group_tasks), none);
  One& one = questions_.emplace_back();
  one.space = space != nullptr ? space : &space_;
  one.sets = sets != nullptr ? *sets : space_.all();
  one.has_situation = one.space->find(one.sets).has_value();
  one.parts.reserve(question.size());
  for (GroupDemands& demanded : question) {
    one.parts.push_back({demanded.group, ConflictSearch(catalog, demanded.group, present_,
                                                        std::move(demanded.demands))});
    if (demanded.low_task != none) {
      one.parts.back().search.keep_below(demanded.low_task, demanded.low_minimum);
    }
  }
}

std::vector<Reason> RelaxedQuestions::conflict(std::span<const Reason> candidates) {
  if (candidates.size() > most_constraints) return {};
  std::vector<Reason> used(candidates.begin(), candidates.end());
  // Most of them have no part in the proofs, so it need not be found which of them are needed.
  for (std::size_t before = used.size() + 1; used.size() < before;) {
    before = used.size();
    std::vector<bool> is_used(before, false);
    if (solve(used, &is_used) != Feasibility::no) return {};
    std::size_t place = 0;
    std::erase_if(used, [&](const Reason& /*reason*/) { return !is_used[place++]; });
  }
  const auto has_solution = [this](std::span<const Reason> some) {
    return solve(some) != Feasibility::no;
  };
  std::vector<Reason> minimal =
      QuickXplain<Reason, decltype(has_solution)>(has_solution).find(used);
  return effort_.left() == 0 ? std::vector<Reason>{} : minimal;
}

Feasibility RelaxedQuestions::solve(std::span<const Reason> reasons, std::vector<bool>* is_used) {
  Feasibility answer = Feasibility::no;
  for (One& one : questions_) {
    if (!one.has_situation) continue;
    const Feasibility of_one = solve(one, reasons, is_used);
    if (of_one == Feasibility::yes) {
      answered_ = &one;
      return of_one;
    }
    if (of_one == Feasibility::unknown) answer = of_one;
  }
  return answer;
}

Feasibility RelaxedQuestions::solve(One& one, std::span<const Reason> reasons,
                                    std::vector<bool>* is_used) {
  const bool has_conditions = std::any_of(reasons.begin(), reasons.end(), [](const Reason& reason) {
    return reason.kind == Reason::Kind::situation;
  });
  const auto search = [&](const ValueSets& sets, BehaviorSet& active) {
    for (Part& part : one.parts) {
      const Feasibility of_part = solve(part, reasons, sets, is_used);
      if (of_part != Feasibility::yes) return of_part;
      if (has_conditions) add_active(part, active);
    }
    return Feasibility::yes;
  };
  if (!has_conditions) {  // whatever the situation is
    BehaviorSet not_asked;
    return search(one.sets, not_asked);
  }
  ConditionSet conditions(space_.catalog().fitting_values.size(), 0);
  for (const Reason& reason : reasons) {
    if (reason.kind != Reason::Kind::situation) continue;
    for (const FittingValue& value : fitting_values_of(space_.catalog(), reason)) {
      conditions[place_of(space_.catalog(), value)] = 1;
    }
  }
  return SituationSplits(*one.space).find(one.sets, search, &conditions);
}

Feasibility RelaxedQuestions::solve(Part& part, std::span<const Reason> reasons,
                                    const ValueSets& sets, std::vector<bool>* is_used) {
  const CompiledCatalog& catalog = space_.catalog();
  const auto is_in_force = [&](const Reason& reason) {
    const GroupId group = reason.behavior != none ? catalog.group_of(reason.behavior)
                                                  : catalog.tasks[reason.task].group;
    return group == part.group && (reason.kind != Reason::Kind::situation ||
                                   !space_.may_fit(fitting_values_of(catalog, reason), sets));
  };
  std::vector<Reason> some;
  std::vector<std::size_t> places;
  if (!std::all_of(reasons.begin(), reasons.end(), is_in_force)) {
    for (std::size_t place = 0; place < reasons.size(); ++place) {
      if (!is_in_force(reasons[place])) continue;
      some.push_back(reasons[place]);
      places.push_back(place);
    }
    reasons = some;
  }
  const Feasibility answer = part.search.solve(reasons, effort_);
  if (answer != Feasibility::no || is_used == nullptr) return answer;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (part.search.is_used()[i] != 0) (*is_used)[places.empty() ? i : places[i]] = true;
  }
  return answer;
}

std::vector<ValueId> RelaxedQuestions::values_of(TaskId task) {
  return answered_->parts.back().search.values_of(task);
}

/// The behaviors that perform what is demanded, and all that this requires.
void RelaxedQuestions::add_active(Part& part, BehaviorSet& active) const {
  for (const Demand& demand : part.search.demands()) {
    for (const ValueId value : part.search.values_of(demand.task)) {
      active.push_back(space_.catalog().values.items[value].behavior);
    }
  }
}

}  // namespace cbc
