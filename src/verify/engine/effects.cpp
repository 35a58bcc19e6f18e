// The hitting set tree of R. Reiter, "A theory of diagnosis from first principles", Artificial
// Intelligence 32 (1987), breadth first. A support is an assignment that runs the task, by its
// active behaviors, with a situation in which they fit. A cut set hits every support: it has one of
// the behaviors, or a value that a variable does not have there. A node is a set of such items; if
// it misses some support, its children add one item each that hits it. So each minimal cut set is
// reached from its subsets. Nodes of one size are examined together: a cut set that has none of the
// smaller ones in it is minimal. (The rule that R. Greiner, B. A. Smith and R. W. Wilkerson
// corrected in volume 41 (1989), which removes branches once a smaller support appears, is not
// used.) Where only sets count that suffice in every situation, no node has values.
//
// To test all sets of up to k behaviors would take a search for each. Here only sets of items that
// hit supports are looked at, and a search is needed only where a set hits all supports that are
// known. Fault trees get their cut sets from a formula of what fails by what; here there is none,
// as a task may run in more ways than anybody could write down.
//
// All effects come from the same tree if the support of a node is its best assignment: a fault
// changes that only if it takes one of its behaviors away. So the children add one of these each,
// and every other set has the effect of a part of it. An optimum over fewer assignments that is
// still there stays the optimum, as ranks do not depend on what else is available where nothing
// runs before (docs/semantics.md, "Objectives").

#include "verify/engine/effects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "ask/together.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/solver/objective.h"

namespace cbc {
namespace {

/// What may be part of a cut set: a behavior, by its number, or a value of a situation variable, by
/// its place among all values after the number of the last behavior.
using Item = Id<struct KindOfItem>;
/// Ascending.
using ItemSet = std::vector<Item>;

/// The supports that are known: of each the items that hit it.
class KnownSupports {
 public:
  const ItemSet& add(ItemSet items) {
    const std::size_t number = supports_.size();
    for (const Item item : items) {
      std::vector<std::uint64_t>& users = users_[item];
      users.resize(number / 64 + 1);
      users.back() |= std::uint64_t{1} << (number % 64);
    }
    return supports_.emplace_back(std::move(items));
  }

  /// One that has nothing of a set, or null.
  [[nodiscard]] const ItemSet* find_without(const ItemSet& set) const {
    for (std::size_t word = 0; word * 64 < supports_.size(); ++word) {
      std::uint64_t hit = 0;
      for (const Item item : set) {
        const auto users = users_.find(item);
        if (users != users_.end() && word < users->second.size()) hit |= users->second[word];
      }
      const std::size_t number = word * 64 + static_cast<std::size_t>(std::countr_one(hit));
      if (hit != UINT64_MAX && number < supports_.size()) return &supports_[number];
    }
    return nullptr;
  }

 private:
  std::vector<ItemSet> supports_;
  std::map<Item, std::vector<std::uint64_t>> users_;  ///< bits of supports_
};

/// Grows the tree level by level, and collects the effects.
class EffectSearch {
 public:
  /// `wanted`: the supports, any one or the best one; the best one if degraded counts, too, which
  /// takes a space of one situation.
  EffectSearch(const SituationSpace& situations, ValueSets sets, TaskId task,
               const EffectOptions& options, AssignmentSearch::Wanted wanted)
      : situations_(situations),
        catalog_(situations.catalog()),
        sets_(std::move(sets)),
        options_(options),
        wanted_(wanted),
        first_value_(static_cast<std::uint32_t>(catalog_.behaviors.size())),
        search_(catalog_, 0, Effort(UINT64_MAX, [this] { return !keeps_on(); })),
        ask_(search_, situations) {
    result_.task = task;
  }

  TaskEffects find(std::span<const VariableValue> changes = {}) {
    result_.complete = grow();
    sort();
    if (result_.complete && result_.best) result_.complete = add_changes(changes);
    return std::move(result_);
  }

 private:
  /// False if the search is stopped.
  [[nodiscard]] bool grow() {
    std::set<ItemSet> level{{}};  // in catalog order, as BehaviorIds of a group are
    for (std::uint32_t size = 0; !level.empty(); ++size) {
      result_.incomplete_size = size;
      std::set<ItemSet> next;
      for (const ItemSet& node : level) {
        if (!examine(node, next)) return false;
      }
      level = std::move(next);
    }
    return true;
  }

  [[nodiscard]] bool is_behavior(Item item) const { return item < first_value_; }
  [[nodiscard]] std::size_t count_behaviors(const ItemSet& node) const {
    return static_cast<std::size_t>(
        std::count_if(node.begin(), node.end(), [this](Item item) { return is_behavior(item); }));
  }
  [[nodiscard]] bool wants_best() const { return wanted_ == AssignmentSearch::Wanted::best; }

  /// False if the search is stopped.
  [[nodiscard]] bool examine(const ItemSet& node, std::set<ItemSet>& children) {
    ++examined_;
    const ItemSet* const known = wants_best() ? nullptr : known_.find_without(node);
    if (known != nullptr) {
      add_children(node, *known, children);
      return true;
    }
    if (has_cut_set(node)) return true;
    const Effect effect = effect_of(node);
    switch (ask(effect.faults, sets_of(effect))) {
      case Feasibility::yes:
        if (wants_best()) add_degraded(effect);
        add_children(node, known_.add(items_of_support()), children);
        return true;
      case Feasibility::no:
        add_cut_set(node, effect);
        return true;
      case Feasibility::unknown:
        break;
    }
    return false;
  }

  [[nodiscard]] Feasibility ask(const BehaviorSet& faults, const ValueSets& sets) {
    ++result_.searches;
    Demands demands{{Demand::Kind::run, result_.task, none}};
    for (const BehaviorId behavior : faults) add_fault(catalog_, behavior, demands);
    return ask_.find({{catalog_.tasks[result_.task].group, demands}}, sets, wanted_);
  }

  void add_children(const ItemSet& node, const ItemSet& support,
                    std::set<ItemSet>& children) const {
    const bool takes_behaviors = count_behaviors(node) < options_.order;
    for (const Item item : support) {
      if (is_behavior(item) ? !takes_behaviors : !takes_value(node, item)) continue;
      ItemSet child = node;
      child.insert(std::lower_bound(child.begin(), child.end(), item), item);
      children.insert(std::move(child));
    }
  }

  /// Whether there is a situation with a value and those of the node.
  [[nodiscard]] bool takes_value(const ItemSet& node, Item item) const {
    ValueSets sets = sets_of(effect_of(node));
    situations_.restrict(value_of(item), sets);
    return situations_.find(std::move(sets)).has_value();
  }

  /// What hits the support that was found: each of its behaviors; and if values count, each that
  /// its situation does not have, of the variables that matter to these behaviors.
  [[nodiscard]] ItemSet items_of_support() const {
    ItemSet items;
    for (const BehaviorId behavior : ask_.active()) items.emplace_back(std::uint32_t{behavior});
    if (!options_.in_some_situation) return items;
    for (const std::uint32_t variable : situations_.variables_of(ask_.active())) {
      const CompiledVariable& of = catalog_.variables[variable];
      for (std::uint32_t value = 0; value < of.value_count; ++value) {
        if (value == ask_.situation()[variable]) continue;
        items.emplace_back(first_value_ + of.first_value + value);
      }
    }
    return items;
  }

  [[nodiscard]] VariableValue value_of(Item item) const {
    const std::uint32_t place = std::uint32_t{item} - first_value_;
    std::uint32_t variable = 0;
    while (place >=
           catalog_.variables[variable].first_value + catalog_.variables[variable].value_count) {
      ++variable;
    }
    return {variable, place - catalog_.variables[variable].first_value};
  }

  /// That the task is lost by a node.
  [[nodiscard]] Effect effect_of(const ItemSet& node) const {
    Effect effect;
    for (const Item item : node) {
      if (is_behavior(item)) {
        effect.faults.emplace_back(std::uint32_t{item});
      } else {
        effect.situation.push_back(value_of(item));
      }
    }
    return effect;
  }

  [[nodiscard]] ValueSets sets_of(const Effect& effect) const {
    ValueSets sets = sets_;
    for (const VariableValue& value : effect.situation) situations_.restrict(value, sets);
    return sets;
  }

  [[nodiscard]] bool keeps_on() const {
    if (options_.budget.tell) {
      options_.budget.tell(printable(catalog_.name_of_task(result_.task)), [this] {
        return fmt::format(
            " ({} of {}, {} found)", quantity(examined_, "set"),
            quantity(result_.incomplete_size, options_.in_some_situation ? "item" : "behavior"),
            result_.effects.size());
      });
    }
    return !options_.budget.find_end();
  }

  /// Adds what the best assignment that was found is, unless a part of the set leaves the same one.
  void add_degraded(Effect effect) {
    effect.kind = Effect::Kind::degraded;
    effect.best = ask_.assignment(0);
    if (effect.faults.empty()) {
      result_.best = effect.best;
      return;
    }
    const bool is_of_part = std::any_of(
        result_.effects.begin(), result_.effects.end(), [&effect](const Effect& of_part) {
          return of_part.best == effect.best &&
                 std::includes(effect.faults.begin(), effect.faults.end(), of_part.faults.begin(),
                               of_part.faults.end());
        });
    if (!is_of_part) result_.effects.push_back(std::move(effect));
  }

  void add_cut_set(const ItemSet& node, const Effect& lost) {
    if (!node.empty()) cut_sets_[node.front()].push_back(node);
    result_.effects.push_back(lost);
  }

  /// Whether a known cut set is part of the node.
  [[nodiscard]] bool has_cut_set(const ItemSet& node) const {
    for (auto first = node.begin(); first != node.end(); ++first) {
      const auto known = cut_sets_.find(*first);
      if (known == cut_sets_.end()) continue;
      for (const ItemSet& cut_set : known->second) {
        if (std::includes(first, node.end(), cut_set.begin(), cut_set.end())) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool add_changes(std::span<const VariableValue> changes) {
    const std::vector<std::uint32_t> that_matter =
        changes.empty() ? std::vector<std::uint32_t>() : variables_of(catalog_, {{result_.task}});
    for (const VariableValue& change : changes) {
      if (!std::binary_search(that_matter.begin(), that_matter.end(), change.variable)) continue;
      const CompiledVariable& variable = catalog_.variables[change.variable];
      ValueSets changed = sets_;
      std::copy_n(situations_.all().begin() + variable.first_value, variable.value_count,
                  changed.begin() + variable.first_value);
      situations_.restrict(change, changed);
      const Feasibility answer = ask({}, changed);
      if (answer == Feasibility::unknown) return false;
      if (answer == Feasibility::no) {
        result_.effects.push_back({Effect::Kind::lost, {}, {change}});
      } else if (ask_.assignment(0) != *result_.best) {
        result_.effects.push_back({Effect::Kind::degraded, {}, {change}, ask_.assignment(0)});
      }
    }
    return true;
  }

  void sort() {
    const auto key_of = [](const Effect& effect) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> values;
      for (const VariableValue& value : effect.situation) {
        values.emplace_back(value.variable, value.value);
      }
      return std::tuple(effect.faults.size(), effect.faults, std::move(values));
    };
    std::sort(result_.effects.begin(), result_.effects.end(),
              [&](const Effect& a, const Effect& b) { return key_of(a) < key_of(b); });
  }

  const SituationSpace& situations_;
  const CompiledCatalog& catalog_;
  const ValueSets sets_;  ///< the situations that count
  const EffectOptions& options_;
  const AssignmentSearch::Wanted wanted_;
  const std::uint32_t first_value_;  ///< the first item that is a value
  AssignmentSearch search_;
  Ask ask_;
  KnownSupports known_;
  std::map<Item, std::vector<ItemSet>> cut_sets_;  ///< by the first item
  std::uint64_t examined_ = 0;                     ///< sets
  TaskEffects result_;
};

}  // namespace

TaskEffects find_cut_sets(const SituationSpace& situations, TaskId task,
                          const EffectOptions& options) {
  return EffectSearch(situations, situations.all(), task, options, AssignmentSearch::Wanted::any)
      .find();
}

TaskEffects find_effects(const CompiledCatalog& catalog, TaskId task,
                         const SituationPart& situation, std::span<const VariableValue> changes,
                         const EffectOptions& options) {
  const SituationSpace any(catalog, {{}, situation.behaviors}, {});
  ValueSets sets = any.all();
  for (const VariableValue& value : situation.variables) any.restrict(value, sets);
  return EffectSearch(any, std::move(sets), task, options, AssignmentSearch::Wanted::best)
      .find(changes);
}

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
