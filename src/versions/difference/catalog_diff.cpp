// Two catalogs are compared as sets of facts: this behavior performs that task, with these
// attributes. Facts of either are sorted by names, and a merge of the two lists finds what was
// added, removed or changed. Pairs of tasks that exclude one another are compared without writing
// them down, as a list of n tasks stands for n² of them.
//
// A comparison of texts would show order, comments and layout, which mean nothing. An edit distance
// between trees (K. Zhang and D. Shasha, "Simple fast algorithms for the editing distance between
// trees and related problems", SIAM Journal on Computing 18 (1989)) could guess that something was
// renamed. What counts for that here is its whole content instead (find_renames.cpp), which
// guesses nothing.

#include "versions/difference/catalog_diff.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/text.h"
#include "versions/difference/catalog_facts.h"

namespace cbc {
std::string describe(const AttributeValue& value) {
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

std::string describe(const CatalogChange& change, const AttributeChange& attribute) {
  const std::string name = printable(attribute.name);
  // A behavior that does not name a situation variable fits in any of its values.
  const auto value_of = [&](const AttributeValue& value) {
    const bool is_absent = std::holds_alternative<std::monostate>(value);
    return is_absent && attribute.name.starts_with(condition_prefix) ? "any" : describe(value);
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

std::vector<std::string_view> names_of_both(const NamedCatalog& before, const NamedCatalog& after) {
  std::vector<std::string_view> names = before.tasks;
  names.insert(names.end(), after.tasks.begin(), after.tasks.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// By task: its place.
std::vector<Place> places_of(const NamedCatalog& catalog,
                             const std::vector<std::string_view>& names) {
  std::vector<Place> places;
  for (const std::string_view task : catalog.tasks) {
    const auto found = std::lower_bound(names.begin(), names.end(), task);
    places.push_back(static_cast<Place>(found - names.begin()));
  }
  return places;
}

/// By place: the task, or none that the catalog has.
std::vector<TaskId> tasks_at(const std::vector<Place>& places, std::size_t count) {
  std::vector<TaskId> tasks(count, TaskId(none));
  for (TaskId task(0); task < places.size(); ++task) tasks[places[task]] = task;
  return tasks;
}

/// The tasks with later names that a task excludes, in the order of names; none of a task that the
/// catalog does not have.
std::vector<Place> excluded_after(const CompiledCatalog& catalog, const std::vector<Place>& places,
                                  TaskId task) {
  std::vector<Place> excluded;
  if (task == none) return excluded;
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
void compare_exclusions(const NamedCatalog& before, const NamedCatalog& after, CatalogDiff& diff) {
  const std::vector<std::string_view> names = names_of_both(before, after);
  const std::vector<Place> old_places = places_of(before, names);
  const std::vector<Place> new_places = places_of(after, names);
  const std::vector<TaskId> old_tasks = tasks_at(old_places, names.size());
  const std::vector<TaskId> new_tasks = tasks_at(new_places, names.size());
  std::size_t listed = 0;
  for (Place place = 0; place < names.size(); ++place) {
    const auto add = [&](ChangeKind kind, Place other) {
      if (listed == most_listed_exclusions) {
        ++diff.further_exclusions;
        return;
      }
      ++listed;
      CatalogChange& change = diff.changes.emplace_back();
      change.kind = kind;
      change.subject = ChangeSubject::exclusion;
      change.task = names[place];
      change.other_task = names[other];
    };
    walk(
        excluded_after(before.catalog, old_places, old_tasks[place]),
        excluded_after(after.catalog, new_places, new_tasks[place]), std::less<>(),
        [&](Place other) { add(ChangeKind::removed, other); },
        [&](Place other) { add(ChangeKind::added, other); }, [](Place, Place) {});
  }
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
    case ChangeSubject::limit:
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

}  // namespace

void compare_facts(ChangeSubject subject, const NamedCatalog& before, const NamedCatalog& after,
                   std::vector<CatalogChange>& changes) {
  walk(
      facts(before, subject), facts(after, subject), precedes,
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

std::string_view name_of(ChangeKind kind) {
  constexpr std::array<std::string_view, 3> names{"removed", "added", "changed"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(ChangeSubject subject) {
  constexpr std::array<std::string_view, 7> names{"task",     "behavior", "performs", "requirement",
                                                  "variable", "limit",    "exclusion"};
  return names[static_cast<std::size_t>(subject)];
}

CatalogDiff compare_catalogs(const CompiledCatalog& before, const CompiledCatalog& after,
                             const Renames& renames) {
  CatalogDiff diff;
  const NamedCatalog old_names = with_new_names(before, after, renames);
  const NamedCatalog new_names = with_own_names(after);
  for (const auto& [from, to] : renames.tasks) {
    diff.renamed.push_back({ChangeSubject::task, std::string(before.name_of_task(from)),
                            std::string(after.name_of_task(to))});
  }
  for (const auto& [from, to] : renames.behaviors) {
    diff.renamed.push_back({ChangeSubject::behavior, std::string(before.name_of_behavior(from)),
                            std::string(after.name_of_behavior(to))});
  }
  for (const auto& [from, to] : renames.variables) {
    diff.renamed.push_back({ChangeSubject::variable, std::string(before.name_of_variable(from)),
                            std::string(after.name_of_variable(to))});
  }
  for (const ChangeSubject subject :
       {ChangeSubject::task, ChangeSubject::behavior, ChangeSubject::performs,
        ChangeSubject::requirement, ChangeSubject::variable, ChangeSubject::limit}) {
    compare_facts(subject, old_names, new_names, diff.changes);
  }
  compare_exclusions(old_names, new_names, diff);
  return diff;
}

}  // namespace cbc
