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

#include "verify/engine/cut_sets.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

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

/// Grows the tree level by level, and collects the cut sets.
class HittingSetTree {
 public:
  HittingSetTree(const SituationSpace& situations, TaskId task, const CutSetOptions& options)
      : situations_(situations),
        catalog_(situations.catalog()),
        options_(options),
        first_value_(static_cast<std::uint32_t>(catalog_.behaviors.size())),
        task_(task),
        search_(catalog_, 0, Effort(UINT64_MAX, [this] { return !keeps_on(); })),
        ask_(search_, situations) {}

  CutSets grow() {
    std::set<ItemSet> level{{}};  // in catalog order, as BehaviorIds of a group are
    for (std::uint32_t size = 0; !level.empty(); ++size) {
      progress_.size = size;
      std::set<ItemSet> next;
      for (const ItemSet& node : level) {
        if (!examine(node, next)) {
          result_.incomplete_size = size;
          return finish();
        }
      }
      level = std::move(next);
    }
    result_.complete = true;
    return finish();
  }

 private:
  [[nodiscard]] bool is_behavior(Item item) const { return item < first_value_; }
  [[nodiscard]] std::size_t count_behaviors(const ItemSet& node) const {
    return static_cast<std::size_t>(
        std::count_if(node.begin(), node.end(), [this](Item item) { return is_behavior(item); }));
  }

  /// False if the search is stopped.
  [[nodiscard]] bool examine(const ItemSet& node, std::set<ItemSet>& children) {
    ++progress_.examined;
    if (const ItemSet* const known = known_.find_without(node)) {
      add_children(node, *known, children);
      return true;
    }
    if (has_cut_set(node)) return true;
    ++result_.searches;
    const CutSet set = cut_set_of(node);
    Demands demands{{Demand::Kind::run, task_, none}};
    for (const BehaviorId behavior : set.behaviors) add_fault(catalog_, behavior, demands);
    switch (ask_.find({{catalog_.tasks[task_].group, demands}}, sets_of(set))) {
      case Feasibility::yes:
        add_children(node, known_.add(items_of_support()), children);
        return true;
      case Feasibility::no:
        add_cut_set(node);
        return true;
      case Feasibility::unknown:
        break;
    }
    return false;
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
    ValueSets sets = sets_of(cut_set_of(node));
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

  [[nodiscard]] CutSet cut_set_of(const ItemSet& node) const {
    CutSet set;
    for (const Item item : node) {
      if (is_behavior(item)) {
        set.behaviors.emplace_back(std::uint32_t{item});
      } else {
        set.values.push_back(value_of(item));
      }
    }
    return set;
  }

  [[nodiscard]] ValueSets sets_of(const CutSet& set) const {
    ValueSets sets = situations_.all();
    for (const VariableValue& value : set.values) situations_.restrict(value, sets);
    return sets;
  }

  [[nodiscard]] bool keeps_on() const {
    return !options_.on_progress || options_.on_progress(progress_);
  }

  void add_cut_set(const ItemSet& node) {
    ++progress_.found;
    if (!node.empty()) by_first_[node.front()].push_back(found_.size());
    found_.push_back(node);
  }

  /// Whether a known cut set is part of the node.
  [[nodiscard]] bool has_cut_set(const ItemSet& node) const {
    for (auto first = node.begin(); first != node.end(); ++first) {
      const auto known = by_first_.find(*first);
      if (known == by_first_.end()) continue;
      for (const std::size_t place : known->second) {
        const ItemSet& cut_set = found_[place];
        if (std::includes(first, node.end(), cut_set.begin(), cut_set.end())) return true;
      }
    }
    return false;
  }

  CutSets finish() {
    for (const ItemSet& node : found_) result_.sets.push_back(cut_set_of(node));
    const auto key_of = [](const CutSet& set) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> values;
      for (const VariableValue& value : set.values)
        values.emplace_back(value.variable, value.value);
      return std::tuple(set.behaviors.size(), set.behaviors, std::move(values));
    };
    std::sort(result_.sets.begin(), result_.sets.end(),
              [&](const CutSet& a, const CutSet& b) { return key_of(a) < key_of(b); });
    return std::move(result_);
  }

  const SituationSpace& situations_;
  const CompiledCatalog& catalog_;
  const CutSetOptions& options_;
  const std::uint32_t first_value_;  ///< the first item that is a value
  const TaskId task_;
  AssignmentSearch search_;
  Ask ask_;
  KnownSupports known_;
  std::vector<ItemSet> found_;
  std::map<Item, std::vector<std::size_t>> by_first_;  ///< places of cut sets in found_
  CutSetProgress progress_;
  CutSets result_;
};

}  // namespace

std::vector<BehaviorSet> CutSets::in_every_situation() const {
  std::vector<BehaviorSet> found;
  for (const CutSet& set : sets) {
    if (set.values.empty()) found.push_back(set.behaviors);
  }
  return found;
}

CutSets find_cut_sets(const SituationSpace& situations, TaskId task, const CutSetOptions& options) {
  return HittingSetTree(situations, task, options).grow();
}

}  // namespace cbc
