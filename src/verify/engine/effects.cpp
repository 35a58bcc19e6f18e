// The sets of faults that matter are found as cut sets are (cut_sets.cpp): a fault changes the best
// assignment only if it takes one of its behaviors away. So the children of a set add one behavior
// of its best assignment each, and every other set has the effect of a part of it. An optimum over
// fewer assignments that is still there stays the optimum, as ranks do not depend on what else is
// available where nothing runs before (docs/semantics.md, "Objectives").

#include "verify/engine/effects.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "runtime/solver/objective.h"

namespace cbc {
namespace {

class EffectSearch {
 public:
  EffectSearch(const CompiledCatalog& catalog, TaskId task, const EffectOptions& options)
      : catalog_(catalog),
        options_(options),
        search_(catalog, 0, Effort(UINT64_MAX, [this] { return !keeps_on(); })) {
    result_.task = task;
  }

  TaskEffects find(const SituationPart& situation, std::span<const VariableValue> changes) {
    misfits_ = misfits_in(situation);
    BestAssignment best;
    if (!find_best({}, best)) return std::move(result_);
    result_.best = best;
    if (!best) {
      result_.effects.push_back({});
      result_.complete = true;
      return std::move(result_);
    }
    result_.complete = add_faults() && add_changes(situation, changes);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool keeps_on() const { return !options_.on_progress || options_.on_progress(); }

  /// What is not available.
  [[nodiscard]] BehaviorSet misfits_in(const SituationPart& situation) const {
    const SituationSpace space(catalog_, situation, {});
    const GroupId group = catalog_.tasks[result_.task].group;
    BehaviorSet misfits;
    for (BehaviorId behavior = catalog_.group_behaviors[group];
         behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
      const bool may_fit = space.may_fit(catalog_.fitting_values_of(behavior), space.all());
      if (!may_fit || !space.is_available(behavior)) misfits.push_back(behavior);
    }
    return misfits;
  }

  /// False if the search is stopped.
  [[nodiscard]] bool find_best(const BehaviorSet& faults, BestAssignment& best) {
    const GroupId group = catalog_.tasks[result_.task].group;
    Demands demands{{Demand::Kind::run, result_.task, none}};
    for (const BehaviorId behavior : faults) add_fault(catalog_, behavior, demands);
    for (const BehaviorId behavior : misfits_) add_fault(catalog_, behavior, demands);
    Assignment found;
    const Feasibility answer =
        search_.find(group, demands, found, {}, AssignmentSearch::Wanted::best);
    if (answer == Feasibility::yes) best = std::move(found);
    return answer != Feasibility::unknown;
  }

  [[nodiscard]] bool add_faults() {
    using Node = std::pair<BehaviorSet, BestAssignment>;
    std::vector<Node> level{{{}, result_.best}};
    for (std::uint32_t size = 1; size <= options_.order && !level.empty(); ++size) {
      std::set<BehaviorSet> sets;
      for (const auto& [set, best] : level) {
        for (const BehaviorId behavior : behaviors_of(catalog_, result_.task, *best)) {
          BehaviorSet larger = set;
          larger.insert(std::lower_bound(larger.begin(), larger.end(), behavior), behavior);
          sets.insert(std::move(larger));
        }
      }
      level.clear();
      for (const BehaviorSet& set : sets) {
        BestAssignment best;
        if (!find_best(set, best)) return false;
        if (!has_effect_of_part(set, best)) add({{}, set, {}, best});
        if (best) level.emplace_back(set, best);
      }
    }
    return true;
  }

  [[nodiscard]] bool has_effect_of_part(const BehaviorSet& set, const BestAssignment& best) const {
    return std::any_of(result_.effects.begin(), result_.effects.end(), [&](const Effect& effect) {
      return effect.best == best &&
             std::includes(set.begin(), set.end(), effect.faults.begin(), effect.faults.end());
    });
  }

  [[nodiscard]] bool add_changes(const SituationPart& situation,
                                 std::span<const VariableValue> changes) {
    for (const VariableValue& change : changes) {
      SituationPart changed = situation;
      for (VariableValue& value : changed.variables) {
        if (value.variable == change.variable) value = change;
      }
      BehaviorSet misfits = misfits_in(changed);
      // What does not depend on the variable stays as it is.
      if (misfits == misfits_) continue;
      std::swap(misfits, misfits_);
      BestAssignment best;
      const bool is_done = find_best({}, best);
      std::swap(misfits, misfits_);
      if (!is_done) return false;
      if (best != result_.best) add({{}, {}, change, best});
    }
    return true;
  }

  void add(Effect effect) {
    effect.kind = effect.best ? Effect::Kind::degraded : Effect::Kind::lost;
    result_.effects.push_back(std::move(effect));
  }

  const CompiledCatalog& catalog_;
  const EffectOptions& options_;
  AssignmentSearch search_;
  BehaviorSet misfits_;  ///< in the situation
  TaskEffects result_;
};

}  // namespace

std::string_view name_of(Effect::Kind kind) {
  constexpr std::array<std::string_view, 3> names = {"lost", "degraded", "none"};
  return names[static_cast<std::size_t>(kind)];
}

SituationPart complete_situation(const CompiledCatalog& catalog, SituationPart given) {
  std::vector<VariableValue> values;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    values.push_back({variable, 0});
  }
  for (const VariableValue& value : given.variables) values[value.variable] = value;
  given.variables = std::move(values);
  return given;
}

std::vector<VariableValue> changes_of(const CompiledCatalog& catalog,
                                      const SituationPart& situation,
                                      std::span<const SituationPart> never) {
  std::vector<VariableValue> changes;
  SituationPart changed = situation;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    for (std::uint32_t value = 0; value < catalog.variables[variable].value_count; ++value) {
      if (value == situation.variables[variable].value) continue;
      changed.variables[variable].value = value;
      const SituationSpace space(catalog, changed, never);
      if (space.find(space.all())) changes.push_back({variable, value});
    }
    changed.variables[variable] = situation.variables[variable];
  }
  return changes;
}

TaskEffects find_effects(const CompiledCatalog& catalog, TaskId task,
                         const SituationPart& situation, std::span<const VariableValue> changes,
                         const EffectOptions& options) {
  return EffectSearch(catalog, task, options).find(situation, changes);
}

std::vector<Millionths> suitabilities_of(const CompiledCatalog& catalog, TaskId task,
                                         const Assignment& assignment) {
  constexpr Millionths whole = 1'000'000;
  const TaskId first = catalog.group_tasks[catalog.tasks[task].group];
  std::vector<Millionths> factors;
  for (LocalTask local(0); local < assignment.size(); ++local) {
    if (assignment[local] == none) continue;
    const Millionths factor = catalog.values[first + local][assignment[local]].suitability;
    if (factor != whole) factors.push_back(factor);
  }
  return factors;
}

bool is_below(std::span<const Millionths> product, std::span<const Millionths> whole,
              std::uint32_t thousandths) {
  ExactProduct left;
  ExactProduct right;
  for (const Millionths factor : product) left.multiply(factor);
  for (const Millionths factor : whole) right.multiply(factor);
  right.multiply(static_cast<Millionths>(thousandths) * 1000);
  return ExactProduct::compare(left, right) < 0;
}

}  // namespace cbc
