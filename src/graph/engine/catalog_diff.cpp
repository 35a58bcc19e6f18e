// Two catalogs are compared as sets of facts: this behavior performs that task, with these
// attributes. Facts of either are sorted by names, and a merge of the two lists finds what was
// added, removed or changed. Pairs of tasks that exclude one another are compared without writing
// them down, as a list of n tasks stands for n² of them.
//
// A comparison of texts would show order, comments and layout, which mean nothing. An edit distance
// between trees (K. Zhang and D. Shasha, "Simple fast algorithms for the editing distance between
// trees and related problems", SIAM Journal on Computing 18 (1989)) could guess that something was
// renamed. But scripts, programs and other catalogs use the names, so to these a new name is
// another thing.

#include "graph/engine/catalog_diff.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/catalog/allowed_values.h"
#include "core/catalog/situation.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// The beginning of the name of an attribute that is a condition on a situation variable.
constexpr std::string_view condition_prefix = "situation ";

std::string describe_value(const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    return format_percent(*degree);
  }
  if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    return format_decimal(*time, 6) + " s";
  }
  if (const std::string* const text = std::get_if<std::string>(&value)) {
    return text->empty() ? "any" : printable(*text);
  }
  return "none";
}

}  // namespace

std::string describe(const CatalogChange& change, const AttributeChange& attribute) {
  const std::string name = printable(attribute.name);
  // A behavior that does not name a situation variable fits in any of its values.
  const auto value_of = [&](const AttributeValue& value) {
    const bool is_absent = std::holds_alternative<std::monostate>(value);
    return is_absent && attribute.name.starts_with(condition_prefix) ? "any"
                                                                     : describe_value(value);
  };
  const std::string before = value_of(attribute.before);
  const std::string after = value_of(attribute.after);
  switch (change.kind) {
    case CatalogChange::Kind::removed:
      return fmt::format("{} {}", name, before);
    case CatalogChange::Kind::added:
      return fmt::format("{} {}", name, after);
    case CatalogChange::Kind::changed:
      break;
  }
  return fmt::format("{} {} -> {}", name, before, after);
}

namespace {

using ChangeKind = CatalogChange::Kind;
using ChangeSubject = CatalogChange::Subject;

/// Walks through two sorted lists side by side. Calls `removed` for what only the old one has,
/// `added` for what only the new one has, and `kept` for what both have.
template <typename Item, typename Precedes, typename Removed, typename Added, typename Kept>
void walk(const std::vector<Item>& before, const std::vector<Item>& after, const Precedes& precedes,
          const Removed& removed, const Added& added, const Kept& kept) {
  auto old = before.begin();
  auto now = after.begin();
  while (old != before.end() || now != after.end()) {
    if (now == after.end() || (old != before.end() && precedes(*old, *now))) {
      removed(*old++);
    } else if (old == before.end() || precedes(*now, *old)) {
      added(*now++);
    } else {
      kept(*old++, *now++);
    }
  }
}

/// Place of a task among the sorted names of both catalogs.
using Place = std::uint32_t;

std::vector<std::string_view> names_of_both(const CompiledCatalog& before,
                                            const CompiledCatalog& after) {
  std::vector<std::string_view> names;
  for (const CompiledCatalog* catalog : {&before, &after}) {
    for (const std::string_view name : catalog->task_names) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// By task: its place.
std::vector<Place> places_of(const CompiledCatalog& catalog,
                             const std::vector<std::string_view>& names) {
  std::vector<Place> places;
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
    const auto found = std::lower_bound(names.begin(), names.end(), catalog.name_of_task(task));
    places.push_back(static_cast<Place>(found - names.begin()));
  }
  return places;
}

/// The tasks with later names that a task excludes, in the order of names; none of a task that the
/// catalog does not have.
std::vector<Place> excluded_after(const CompiledCatalog& catalog, const std::vector<Place>& places,
                                  std::string_view name) {
  std::vector<Place> excluded;
  const auto index = catalog.find_task(name);
  if (!index) return excluded;
  const TaskId task = catalog.task_ids[*index];
  for (const std::uint32_t clique : catalog.task_cliques[task]) {
    for (const TaskId other : catalog.cliques[clique]) {
      if (places[other] > places[task]) excluded.push_back(places[other]);
    }
  }
  std::sort(excluded.begin(), excluded.end());
  excluded.erase(std::unique(excluded.begin(), excluded.end()), excluded.end());
  return excluded;
}

/// Adds the pairs of tasks that exclude one another in one of the catalogs only.
void compare_exclusions(const CompiledCatalog& before, const CompiledCatalog& after,
                        CatalogDiff& diff) {
  const std::vector<std::string_view> names = names_of_both(before, after);
  const std::vector<Place> old_places = places_of(before, names);
  const std::vector<Place> new_places = places_of(after, names);
  std::size_t listed = 0;
  for (const std::string_view name : names) {
    const auto add = [&](ChangeKind kind, Place other) {
      if (listed == most_listed_exclusions) {
        ++diff.further_exclusions;
        return;
      }
      ++listed;
      CatalogChange& change = diff.changes.emplace_back();
      change.kind = kind;
      change.subject = ChangeSubject::exclusion;
      change.task = name;
      change.other_task = names[other];
    };
    walk(
        excluded_after(before, old_places, name), excluded_after(after, new_places, name),
        std::less<>(), [&](Place other) { add(ChangeKind::removed, other); },
        [&](Place other) { add(ChangeKind::added, other); }, [](Place, Place) {});
  }
}

/// An attribute and its value.
struct Attribute {
  std::string name;
  AttributeValue value;    ///< what is compared
  std::string shown = {};  ///< if not empty, what is shown of it
};
using Attributes = std::vector<Attribute>;  ///< in the order of names

/// Something that a catalog says, and the names by which to find it in another one.
struct Fact {
  std::string_view first;
  std::string_view second;  ///< of pairs
  Attributes attributes;
};

bool precedes(const Fact& a, const Fact& b) {
  return std::pair(a.first, a.second) < std::pair(b.first, b.second);
}

template <typename Number>
AttributeValue unless_zero(Number number) {
  return number == 0 ? AttributeValue() : AttributeValue(number);
}

Attributes attributes_of_task(const CompiledCatalog& catalog, std::uint32_t index) {
  const CompiledTask& task = catalog.tasks[catalog.task_ids[index]];
  Attributes attributes{
      {"execution_goal", std::string(task.keep_running != 0 ? "keep_running" : "achieve_goal")},
      {"minimum_performance", unless_zero(task.minimum_performance)},
      {"reactive_start", task.reactive_start != 0},
      {"start_on_request", task.start_on_request != 0},
      {"timeout", unless_zero(task.timeout)}};
  for (Parameter& parameter : parameters_of(catalog, index)) {
    std::string name = "parameter " + parameter.name;
    attributes.push_back({std::move(name), describe_allowed(std::move(parameter))});
  }
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  return attributes;
}

/// "[far, near]"
std::string list_values(const std::vector<std::string_view>& values) {
  return "[" + join(values, ", ", spell_value) + "]";
}

/// Values of a situation variable, whose order does not count; they are shown in catalog order.
Attribute set_of_values(std::string name, std::vector<std::string_view> values) {
  std::string shown = list_values(values);
  std::sort(values.begin(), values.end());
  return {std::move(name), list_values(values), std::move(shown)};
}

/// True or false for a variable without values of its own.
Attribute attribute_of(const NamedCondition& condition) {
  std::string name = std::string(condition_prefix) + std::string(condition.variable);
  const bool is_truth = condition.is_boolean && condition.values.size() == 1;
  if (is_truth) return {std::move(name), condition.values.front() == "true"};
  return set_of_values(std::move(name), condition.values);
}

Attributes attributes_of_behavior(const CompiledCatalog& catalog, std::uint32_t index) {
  const std::string_view package = catalog.texts[catalog.behavior_packages[index]];
  const BehaviorId id = catalog.behavior_ids[index];
  Attributes attributes{
      {"package", package.empty() ? AttributeValue() : AttributeValue(std::string(package))},
      {"timeout", unless_zero(catalog.behaviors[id].timeout)}};
  for (const NamedCondition& condition : conditions_of(catalog, id)) {
    attributes.push_back(attribute_of(condition));
  }
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  return attributes;
}

/// The order of the values does not count, apart from the first one.
Attributes attributes_of_variable(const CompiledCatalog& catalog, std::uint32_t index) {
  const CompiledVariable& variable = catalog.variables[index];
  std::vector<std::string_view> values;
  for (std::uint32_t value = 0; value < variable.value_count; ++value) {
    values.push_back(catalog.name_of_value({index, value}));
  }
  const std::string initial(values.front());
  const bool has_own = variable.is_boolean == 0;
  return {{"initial value", initial},
          has_own ? set_of_values("values", std::move(values)) : Attribute{"values", {}}};
}

std::vector<Fact> facts(const CompiledCatalog& catalog, ChangeSubject subject) {
  std::vector<Fact> result;
  const auto task_count = static_cast<std::uint32_t>(catalog.tasks.size());
  const auto behavior_count = static_cast<std::uint32_t>(catalog.behaviors.size());
  switch (subject) {
    case ChangeSubject::task:
      for (std::uint32_t task = 0; task < task_count; ++task) {
        result.push_back({catalog.task_names[task], {}, attributes_of_task(catalog, task)});
      }
      break;
    case ChangeSubject::behavior:
      for (std::uint32_t behavior = 0; behavior < behavior_count; ++behavior) {
        result.push_back(
            {catalog.behavior_names[behavior], {}, attributes_of_behavior(catalog, behavior)});
      }
      break;
    case ChangeSubject::performs:
      for (TaskId task(0); task < task_count; ++task) {
        for (const Value& value : catalog.values[task]) {
          result.push_back({catalog.name_of_behavior(value.behavior),
                            catalog.name_of_task(task),
                            {{"suitability", value.suitability}}});
        }
      }
      break;
    case ChangeSubject::requirement:
      for (BehaviorId behavior(0); behavior < behavior_count; ++behavior) {
        for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
          result.push_back(
              {catalog.name_of_behavior(behavior),
               catalog.name_of_task(requirement.task),
               {{"minimum_performance", unless_zero(requirement.minimum_performance)}}});
        }
      }
      break;
    case ChangeSubject::variable:
      for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
        result.push_back(
            {catalog.name_of_variable(variable), {}, attributes_of_variable(catalog, variable)});
      }
      break;
    case ChangeSubject::exclusion:
      break;  // see compare_exclusions
  }
  std::sort(result.begin(), result.end(), precedes);
  return result;
}

/// The attributes that differ. Both lists are in the order of names; either may be empty.
std::vector<AttributeChange> compare(const Attributes& before, const Attributes& after) {
  std::vector<AttributeChange> changes;
  const auto shown = [](const Attribute& attribute) {
    return attribute.shown.empty() ? attribute.value : AttributeValue(attribute.shown);
  };
  const auto add = [&](const Attribute& old, const Attribute& now) {
    if (old.value == now.value) return;
    changes.push_back({old.name.empty() ? now.name : old.name, shown(old), shown(now)});
  };
  walk(
      before, after, [](const Attribute& a, const Attribute& b) { return a.name < b.name; },
      [&](const Attribute& old) { add(old, {}); }, [&](const Attribute& now) { add({}, now); },
      add);
  return changes;
}

CatalogChange to_change(ChangeKind kind, ChangeSubject subject, const Fact& fact,
                        std::vector<AttributeChange> attributes) {
  CatalogChange change;
  change.kind = kind;
  change.subject = subject;
  switch (subject) {
    case ChangeSubject::task:
      change.task = fact.first;
      break;
    case ChangeSubject::variable:
      change.variable = fact.first;
      break;
    default:
      change.behavior = fact.first;
      change.task = fact.second;
  }
  change.attributes = std::move(attributes);
  return change;
}

void compare_facts(ChangeSubject subject, const std::vector<Fact>& before,
                   const std::vector<Fact>& after, std::vector<CatalogChange>& changes) {
  walk(
      before, after, precedes,
      [&](const Fact& old) {
        changes.push_back(
            to_change(ChangeKind::removed, subject, old, compare(old.attributes, {})));
      },
      [&](const Fact& now) {
        changes.push_back(to_change(ChangeKind::added, subject, now, compare({}, now.attributes)));
      },
      [&](const Fact& old, const Fact& now) {
        std::vector<AttributeChange> attributes = compare(old.attributes, now.attributes);
        if (attributes.empty()) return;
        changes.push_back(to_change(ChangeKind::changed, subject, now, std::move(attributes)));
      });
}

}  // namespace

std::string_view name_of(ChangeKind kind) {
  constexpr std::array<std::string_view, 3> names{"removed", "added", "changed"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(ChangeSubject subject) {
  constexpr std::array<std::string_view, 6> names{"task",        "behavior", "performs",
                                                  "requirement", "variable", "exclusion"};
  return names[static_cast<std::size_t>(subject)];
}

CatalogDiff compare_catalogs(const CompiledCatalog& before, const CompiledCatalog& after) {
  CatalogDiff diff;
  for (const ChangeSubject subject :
       {ChangeSubject::task, ChangeSubject::behavior, ChangeSubject::performs,
        ChangeSubject::requirement, ChangeSubject::variable}) {
    compare_facts(subject, facts(before, subject), facts(after, subject), diff.changes);
  }
  compare_exclusions(before, after, diff);
  return diff;
}

}  // namespace cbc
