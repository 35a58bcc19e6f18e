// A search does not go through the situations, of which there may be too many. It looks for
// assignments whose behaviors may fit, each by itself. If they fit in no common situation, the
// situations are split in two by the condition of one of these behaviors, and each part is
// searched.

#include "ask/fitting_search.h"

#include <algorithm>
#include <utility>

namespace cbc {

namespace {

/// The situations of the sets that meet the condition of a behavior on a variable, or those that do
/// not.
ValueSets part_of(const SituationSpace& situations, const ValueSets& sets, BehaviorId behavior,
                  const CompiledVariable& variable, bool meets) {
  ValueSets of_one = sets;
  situations.restrict(behavior, of_one);
  ValueSets part = sets;
  for (std::uint32_t value = variable.first_value;
       value < variable.first_value + variable.value_count; ++value) {
    if ((of_one[value] != 0) != meets) part[value] = 0;
  }
  return part;
}

}  // namespace

FittingSearch::FittingSearch(const CompiledCatalog& catalog, std::vector<GroupId> groups)
    : catalog_(catalog), groups_(std::move(groups)), refuted_(catalog.variables.size(), 0) {
  searches_.reserve(groups_.size());
  for (const GroupId group : groups_) {
    searches_.emplace_back(catalog, group, GroupSearch::Wanted::any);
  }
}

FittingSearch::Answer FittingSearch::find(const SituationSpace& situations,
                                          const GroupDemand& demand, const ValueSets& sets,
                                          const GroupSearch::KeepOn& keep_on) {
  if (!situations.find(sets)) return Answer::impossible;
  const GroupDemand of_sets = with_fitting(situations, demand, sets);
  active_.clear();
  for (GroupSearch& search : searches_) {
    const Answer answer = search.find(of_sets, keep_on);
    if (answer != Answer::found) return answer;
    const BehaviorSet active = search.active();
    active_.insert(active_.end(), active.begin(), active.end());
  }
  ValueSets fitting = sets;
  for (const BehaviorId behavior : active_) situations.restrict(behavior, fitting);
  if (auto situation = situations.find(fitting)) {
    situation_ = std::move(*situation);
    return Answer::found;
  }
  const Split split = choose_split(situations, sets, fitting);
  for (const bool meets : {true, false}) {
    const ValueSets part =
        part_of(situations, sets, split.behavior, catalog_.variables[split.variable], meets);
    const Answer answer = find(situations, demand, part, keep_on);
    if (answer != Answer::impossible) return answer;
  }
  ++refuted_[split.variable];
  return Answer::impossible;
}

/// Rules out what does not fit in any situation of the sets.
GroupDemand FittingSearch::with_fitting(const SituationSpace& situations, GroupDemand demand,
                                        const ValueSets& sets) const {
  for (const GroupId group : groups_) {
    for (BehaviorId behavior = catalog_.group_behaviors[group];
         behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
      if (situations.is_available(behavior) && situations.may_fit(behavior, sets)) continue;
      demand.rule_out(catalog_, behavior);
    }
  }
  return demand;
}

/// A condition of an active behavior that some situation of the sets does not meet. `fitting`: the
/// values with which all active behaviors fit. A variable that has none of these is what the
/// behaviors disagree about, so it is taken first; of several that which refuted most, as what
/// cannot be settled is then met before all else has been tried.
FittingSearch::Split FittingSearch::choose_split(const SituationSpace& situations,
                                                 const ValueSets& sets,
                                                 const ValueSets& fitting) const {
  Split best;
  std::pair<bool, std::uint64_t> best_key;
  bool has_best = false;
  for (const BehaviorId behavior : active_) {
    ValueSets of_one = sets;
    situations.restrict(behavior, of_one);
    for (const FittingValue& condition : catalog_.fitting_values_of(behavior)) {
      const CompiledVariable& variable = catalog_.variables[condition.variable];
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

}  // namespace cbc
