// Situations change whatever else happens, so which of them can be reached is found without states:
// by breadth-first search through the situations of what `never` ties together. Mostly it ends
// after a few of them, as each variable has changed by then; and where `never` keeps many from
// changing, few are reached.

#include "core/property/frozen_variables.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "runtime/base/disjoint_sets.h"

namespace cbc {

namespace {

/// The most comparisons of an entry of `never` with a situation, of all searches.
constexpr std::uint64_t most_comparisons = 1'000'000;

/// The situation, as far as `never` ties it together: values of variables, own(b) denied or not.
using Values = std::vector<std::uint32_t>;

/// What may change in a situation.
struct Item {
  std::uint32_t number = 0;  ///< of the variable; of the behavior, after those of variables
  std::uint32_t values = 0;
  std::uint32_t initial = 0;
};

/// An entry of `never`: values of items that do not occur together.
struct Entry {
  std::size_t place = 0;
  std::vector<std::pair<std::size_t, std::uint32_t>> parts;  ///< place of an item, its value

  [[nodiscard]] bool excludes(const Values& values) const {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const auto& part) { return values[part.first] == part.second; });
  }
};

/// Searches the situations of items that `never` ties together.
class SituationSearch {
 public:
  SituationSearch(const CompiledCatalog& catalog, std::vector<Item> items,
                  std::vector<Entry> entries, std::uint64_t& comparisons)
      : catalog_(catalog),
        items_(std::move(items)),
        entries_(std::move(entries)),
        comparisons_(comparisons) {}

  /// The places of the variables that never change; empty if the search takes too long. Notes the
  /// entries that exclude their changes.
  std::vector<std::size_t> run(const std::vector<std::vector<std::uint32_t>>& together) {
    has_changed_.assign(items_.size(), false);
    excluding_.assign(items_.size(), {});
    open_ = 0;
    for (std::size_t place = 0; place < items_.size(); ++place) {
      if (is_variable(place) && items_[place].values > 1) ++open_;
    }
    find_lists(together);
    Values first;
    for (const Item& item : items_) first.push_back(item.initial);
    seen_ = {first};
    waiting_ = {std::move(first)};
    for (std::size_t next = 0; next < waiting_.size() && open_ > 0; ++next) {
      const Values values = waiting_[next];  // the list may move
      expand(values);
      if (took_too_long()) return {};
    }
    std::vector<std::size_t> frozen;
    for (std::size_t place = 0; place < items_.size() && open_ > 0; ++place) {
      if (is_variable(place) && items_[place].values > 1 && !has_changed_[place]) {
        frozen.push_back(place);
      }
    }
    return frozen;
  }

  [[nodiscard]] const std::set<std::size_t>& excluding(std::size_t place) const {
    return excluding_[place];
  }
  [[nodiscard]] bool took_too_long() const { return comparisons_ > most_comparisons; }
  [[nodiscard]] bool is_variable(std::size_t place) const {
    return items_[place].number < catalog_.variables.size();
  }

 private:
  void find_lists(const std::vector<std::vector<std::uint32_t>>& together) {
    lists_.clear();
    for (const std::vector<std::uint32_t>& list : together) {
      std::vector<std::size_t> places;
      for (std::size_t place = 0; place < items_.size(); ++place) {
        if (std::find(list.begin(), list.end(), items_[place].number) != list.end()) {
          places.push_back(place);
        }
      }
      if (places.size() > 1) lists_.push_back(std::move(places));
    }
  }

  void expand(const Values& values) {
    for (std::size_t place = 0; place < items_.size(); ++place) {
      for (std::uint32_t value = 0; value < items_[place].values; ++value) {
        if (value == values[place]) continue;
        Values next = values;
        next[place] = value;
        const Entry* const excluding = add(std::move(next));
        if (excluding != nullptr) excluding_[place].insert(excluding->place);
      }
    }
    for (const std::vector<std::size_t>& list : lists_) change_together(list, values);
  }

  void change_together(const std::vector<std::size_t>& list, const Values& values) {
    Values next = values;
    for (const std::size_t place : list) next[place] = 0;
    for (;;) {
      add(next);
      // The next combination, counted like a number.
      std::size_t digit = list.size();
      while (digit > 0 && ++next[list[digit - 1]] == items_[list[digit - 1]].values) {
        next[list[--digit]] = 0;
      }
      if (digit == 0 || took_too_long()) return;
    }
  }

  /// Returns what excludes the situation, or null.
  const Entry* add(Values values) {
    comparisons_ += entries_.size() + 1;
    for (const Entry& entry : entries_) {
      if (entry.excludes(values)) return &entry;
    }
    if (!seen_.insert(values).second) return nullptr;
    for (std::size_t place = 0; place < items_.size(); ++place) {
      if (values[place] == items_[place].initial || has_changed_[place]) continue;
      has_changed_[place] = true;
      if (is_variable(place)) --open_;
    }
    waiting_.push_back(std::move(values));
    return nullptr;
  }

  const CompiledCatalog& catalog_;
  const std::vector<Item> items_;
  const std::vector<Entry> entries_;
  std::vector<std::vector<std::size_t>> lists_;  ///< of `together`, as places
  std::set<Values> seen_;
  std::vector<Values> waiting_;
  std::vector<bool> has_changed_;
  std::size_t open_ = 0;  ///< variables that have not changed yet
  std::vector<std::set<std::size_t>> excluding_;
  std::uint64_t& comparisons_;
};

/// What `never` ties together: items, and the entries about them.
struct Component {
  std::vector<Item> items;  ///< ascending
  std::vector<Entry> entries;
};

class ComponentFinder {
 public:
  ComponentFinder(const CompiledCatalog& catalog, const Assumptions& assumptions)
      : assumptions_(assumptions),
        variables_(static_cast<std::uint32_t>(catalog.variables.size())),
        may_change_(catalog.variables.size() + catalog.behaviors.size(), false),
        ties_(may_change_.size()) {
    for (const std::uint32_t variable : assumptions.variables) may_change_[variable] = true;
    for (const BehaviorId behavior : assumptions.behaviors)
      may_change_[variables_ + behavior] = true;
    for (std::size_t place = 0; place < assumptions.never.size(); ++place) read(place);
    std::vector<std::uint32_t> numbers = ties_.numbers();
    std::map<std::uint32_t, std::set<std::uint32_t>> members;
    for (const auto& [place, parts] : entries_) {
      for (const auto& [number, value] : parts) members[numbers[number]].insert(number);
    }
    std::map<std::uint32_t, std::size_t> places;
    for (const auto& [component, numbers_of_items] : members) {
      places[component] = components_.size();
      Component& added = components_.emplace_back();
      for (const std::uint32_t number : numbers_of_items) {
        added.items.push_back(
            number < variables_
                ? Item{number, catalog.variables[number].value_count,
                       initial_value(assumptions, number)}
                : Item{number, 2,
                       is_available_at_first(assumptions, BehaviorId(number - variables_)) ? 0U
                                                                                           : 1U});
      }
    }
    for (const auto& [place, parts] : entries_) {
      Component& of = components_[places.at(numbers[parts.front().first])];
      Entry& entry = of.entries.emplace_back();
      entry.place = place;
      for (const auto& [number, value] : parts) {
        const auto item = std::lower_bound(
            of.items.begin(), of.items.end(), number,
            [](const Item& one, std::uint32_t other) { return one.number < other; });
        entry.parts.emplace_back(static_cast<std::size_t>(item - of.items.begin()), value);
      }
    }
  }

  std::vector<Component> take() && { return std::move(components_); }

 private:
  /// Of an entry what may change, unless what does not change makes it exclude nothing.
  void read(std::size_t place) {
    const SituationPart& part = assumptions_.never[place];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> parts;
    for (const VariableValue& value : part.variables) {
      if (may_change_[value.variable]) {
        parts.emplace_back(value.variable, value.value);
      } else if (initial_value(assumptions_, value.variable) != value.value) {
        return;
      }
    }
    for (const SituationPart::Own& own : part.behaviors) {
      if (may_change_[variables_ + own.behavior]) {
        parts.emplace_back(variables_ + own.behavior, own.available ? 0U : 1U);
      } else if (is_available_at_first(assumptions_, own.behavior) != own.available) {
        return;
      }
    }
    if (parts.empty()) return;
    for (const auto& [number, value] : parts) ties_.join(parts.front().first, number);
    entries_.emplace_back(place, std::move(parts));
  }

  const Assumptions& assumptions_;
  const std::uint32_t variables_;
  std::vector<bool> may_change_;  ///< by number of an item
  DisjointSets ties_;
  std::vector<std::pair<std::size_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>>>
      entries_;
  std::vector<Component> components_;
};

}  // namespace

std::vector<FrozenVariables> find_frozen_variables(const CompiledCatalog& catalog,
                                                   const Assumptions& assumptions) {
  std::vector<FrozenVariables> result;
  if (assumptions.never.empty()) return result;
  std::uint64_t comparisons = 0;
  for (Component& component : ComponentFinder(catalog, assumptions).take()) {
    std::vector<std::uint32_t> all;
    for (const Item& item : component.items) {
      if (item.number < catalog.variables.size()) all.push_back(item.number);
    }
    const std::vector<Item> items = component.items;
    SituationSearch search(catalog, std::move(component.items), std::move(component.entries),
                           comparisons);
    const std::vector<std::size_t> frozen = search.run(assumptions.together);
    if (frozen.empty()) continue;
    FrozenVariables& added = result.emplace_back();
    for (const std::size_t place : frozen) added.variables.push_back(items[place].number);
    std::vector<std::set<std::size_t>> excluding;
    excluding.reserve(frozen.size());
    for (const std::size_t place : frozen) excluding.push_back(search.excluding(place));
    for (const std::vector<std::uint32_t>& list : {added.variables, all}) {
      if (list.size() < 2 || count_combinations(catalog, list) > most_values_together) continue;
      std::vector<std::vector<std::uint32_t>> together = assumptions.together;
      together.push_back(list);
      const std::vector<std::size_t> left = search.run(together);
      if (left.size() >= frozen.size() || search.took_too_long()) continue;
      added.together = list;
      std::set<std::size_t> entries;
      for (std::size_t number = 0; number < frozen.size(); ++number) {
        if (std::binary_search(left.begin(), left.end(), frozen[number])) continue;
        added.coupled.push_back(items[frozen[number]].number);
        entries.insert(excluding[number].begin(), excluding[number].end());
      }
      added.entries.assign(entries.begin(), entries.end());
      break;
    }
  }
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.variables < b.variables; });
  return result;
}

}  // namespace cbc
