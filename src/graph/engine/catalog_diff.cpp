#include "graph/engine/catalog_diff.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
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

/// Place of a task among the sorted names of both catalogs.
using Place = std::uint32_t;

/// One of the two catalogs, by places.
struct Side {
  const CompiledCatalog* catalog;
  std::vector<TaskId> tasks;  ///< by place; `none`: the catalog has no such task
  std::vector<Place> places;  ///< by TaskId
  std::vector<Place> marks;   ///< by place: the last task that was found to exclude it

  [[nodiscard]] std::span<const std::uint32_t> cliques_of(Place place) const {
    return tasks[place] == none ? std::span<const std::uint32_t>()
                                : catalog->task_cliques[tasks[place]];
  }
};

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

/// Finds the pairs of tasks that exclude one another in one of the catalogs only, in the order of
/// names.
class ExclusionDiff {
 public:
  ExclusionDiff(const CompiledCatalog& before, const CompiledCatalog& after)
      : names_(names_of_both(before, after)), sides_{side_of(before), side_of(after)} {}

  void run(CatalogDiff& diff) {
    for (Place task = 0; task < names_.size(); ++task) compare(task);
    for (const auto& [task, other, kind] : pairs_) {
      CatalogChange& change = diff.changes.emplace_back();
      change.kind = kind;
      change.subject = CatalogChange::Subject::exclusion;
      change.task = names_[task];
      change.other_task = names_[other];
    }
    diff.further_exclusions = further_;
  }

 private:
  [[nodiscard]] Side side_of(const CompiledCatalog& catalog) const {
    Side side{&catalog,
              {},
              std::vector<Place>(catalog.tasks.size()),
              std::vector<std::uint32_t>(names_.size(), none)};
    for (Place place = 0; place < names_.size(); ++place) {
      const auto index = catalog.find_task(names_[place]);
      side.tasks.push_back(index ? catalog.task_ids[*index] : none);
      if (index) side.places[side.tasks.back()] = place;
    }
    return side;
  }

  void compare(Place task) {
    for (Side& side : sides_) mark_excluded(side, task);
    std::vector<std::pair<Place, CatalogChange::Kind>> found;
    constexpr std::array kinds{CatalogChange::Kind::removed, CatalogChange::Kind::added};
    for (std::size_t side = 0; side < sides_.size(); ++side) {
      for (const Place other : find_only(sides_[side], sides_[1 - side], task)) {
        found.emplace_back(other, kinds[side]);
      }
    }
    std::sort(found.begin(), found.end());
    for (const auto& [other, kind] : found) {
      if (pairs_.size() < most_listed_exclusions) {
        pairs_.emplace_back(task, other, kind);
      } else {
        ++further_;
      }
    }
  }

  void mark_excluded(Side& side, Place task) const {
    for (const std::uint32_t clique : side.cliques_of(task)) {
      for (const TaskId other : side.catalog->cliques[clique]) {
        side.marks[side.places[other]] = task;
      }
    }
  }

  /// Those with later names that `task` excludes in `side` but not in `other`.
  [[nodiscard]] static std::vector<Place> find_only(Side& side, const Side& other, Place task) {
    std::vector<Place> only;
    for (const std::uint32_t clique : side.cliques_of(task)) {
      for (const TaskId excluded : side.catalog->cliques[clique]) {
        const Place place = side.places[excluded];
        if (place <= task || side.marks[place] != task || other.marks[place] == task) continue;
        side.marks[place] = none;  // not twice
        only.push_back(place);
      }
    }
    return only;
  }

  const std::vector<std::string_view> names_;
  std::array<Side, 2> sides_;
  std::vector<std::tuple<Place, Place, CatalogChange::Kind>> pairs_;
  std::uint64_t further_ = 0;  ///< pairs that are not listed
};

using ChangeKind = CatalogChange::Kind;
using ChangeSubject = CatalogChange::Subject;

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

/// Puts a value in quotes that could be taken for several values, or for none.
std::string spell(std::string_view value) {
  const bool is_clear = !value.empty() && value.find_first_of(",[]'") == std::string::npos;
  if (is_clear) return std::string(value);
  std::string text = "'";
  for (const char character : value) text += character == '\'' ? "''" : std::string(1, character);
  return text += '\'';
}

/// What a parameter may be set to. Words are a set; no values allow any.
std::string describe(Parameter parameter) {
  std::vector<std::string>& values = parameter.allowed_values;
  if (values.empty()) return {};
  if (!range_of(parameter)) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
  const std::string text = join(values, ", ", spell);
  return parameter.allowed_is_list ? "[" + text + "]" : text;
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
    attributes.push_back({std::move(name), describe(std::move(parameter))});
  }
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  return attributes;
}

/// "[far, near]"
std::string list_values(const std::vector<std::string_view>& values) {
  return "[" + join(values, ", ", spell) + "]";
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
      break;  // see ExclusionDiff
  }
  std::sort(result.begin(), result.end(), precedes);
  return result;
}

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
  ExclusionDiff(before, after).run(diff);
  return diff;
}

}  // namespace cbc
