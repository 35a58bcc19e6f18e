// Random catalogs, and changed ones: the differences against plain sets of what each of the two
// says. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their number.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "environment.h"
#include "generator.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/catalog_graph.h"
#include "random.h"
#include "yaml_text.h"

namespace cbc::oracle::diff_test {
namespace {

constexpr std::uint64_t default_diffs = 1000;

/// What a catalog says: "b requires t" -> {"minimum_performance": "500000"}.
using Statements = std::map<std::string, std::map<std::string, std::string>>;

std::string truth(bool value) { return value ? "true" : "false"; }

std::string list_of(std::vector<std::string> values) {
  std::sort(values.begin(), values.end());
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return "[" + text + "]";
}

std::vector<std::string> values_of(const Variable& variable) {
  return variable.is_boolean() ? std::vector<std::string>{"true", "false"} : variable.values;
}

std::string text_of(const Condition& condition, const Variable& variable) {
  std::vector<std::string> values;
  for (const std::size_t value : condition.values) values.push_back(values_of(variable)[value]);
  return variable.is_boolean() && values.size() == 1 ? values.front() : list_of(values);
}

Statements statements_of(const Catalog& catalog) {
  Statements statements;
  for (const Variable& variable : catalog.variables) {
    auto& attributes = statements["variable " + variable.name];
    attributes["initial value"] = values_of(variable).front();
    if (!variable.is_boolean()) attributes["values"] = list_of(variable.values);
  }
  for (const Task& task : catalog.tasks) {
    auto& attributes = statements["task " + task.name];
    attributes["execution_goal"] = task.keep_running ? "keep_running" : "achieve_goal";
    attributes["reactive_start"] = truth(task.reactive_start);
    attributes["start_on_request"] = truth(task.start_on_request);
    if (task.timeout.value_or(0) > 0) attributes["timeout"] = std::to_string(*task.timeout);
    if (task.minimum > 0) attributes["minimum_performance"] = std::to_string(task.minimum);
  }
  for (const Behavior& behavior : catalog.behaviors) {
    auto& attributes = statements["behavior " + behavior.name];
    if (behavior.timeout.value_or(0) > 0) attributes["timeout"] = std::to_string(*behavior.timeout);
    for (const Condition& condition : behavior.situation) {
      const Variable& variable = catalog.variables[condition.variable];
      attributes["situation " + variable.name] = text_of(condition, variable);
    }
    for (const Performance& one : behavior.performs) {
      statements[behavior.name + " performs " + catalog.tasks[one.task].name]["suitability"] =
          std::to_string(one.suitability);
    }
    for (const Requirement& one : behavior.requirements) {
      auto& minimum = statements[behavior.name + " requires " + catalog.tasks[one.task].name];
      const Millionths present = minimum.empty() ? 0 : std::stoll(minimum["minimum_performance"]);
      const Millionths strongest = std::max(one.minimum, present);
      if (strongest > 0) minimum["minimum_performance"] = std::to_string(strongest);
    }
  }
  for (const auto& list : catalog.exclusivity) {
    for (const std::size_t one : list) {
      for (const std::size_t other : list) {
        const auto& [a, b] = std::minmax(catalog.tasks[one].name, catalog.tasks[other].name);
        if (one != other) statements[std::string(a).append(" excludes ").append(b)];
      }
    }
  }
  return statements;
}

std::vector<std::string> differences(const Statements& before, const Statements& after) {
  std::vector<std::string> lines;
  for (const auto& [statement, attributes] : before) {
    const auto other = after.find(statement);
    if (other == after.end()) {
      lines.push_back("- " + statement);
    } else if (other->second != attributes) {
      lines.push_back("~ " + statement);
      for (const auto* side : {&attributes, &other->second}) {
        for (const auto& [name, value] : *side) {
          const auto& opposite = side == &attributes ? other->second : attributes;
          const auto found = opposite.find(name);
          if (found != opposite.end() && found->second == value) continue;
          lines.push_back(statement + (side == &attributes ? " before " : " after ") + name + " " +
                          value);
        }
      }
    }
  }
  for (const auto& [statement, attributes] : after) {
    if (!before.contains(statement)) lines.push_back("+ " + statement);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

std::string to_text(const AttributeValue& value) {
  if (const auto* const flag = std::get_if<bool>(&value)) return truth(*flag);
  if (const auto* const degree = std::get_if<cbc::Millionths>(&value)) {
    return std::to_string(*degree);
  }
  if (const auto* const time = std::get_if<cbc::Microseconds>(&value)) {
    return std::to_string(*time);
  }
  return std::get<std::string>(value);
}

/// Packages and parameters are left to the form of the YAML; the model has none.
std::vector<std::string> lines_of(CatalogDiff diff) {
  std::vector<std::string> lines;
  for (CatalogChange& change : diff.changes) {
    std::erase_if(change.attributes, [](const AttributeChange& attribute) {
      return attribute.name == "package" || attribute.name.starts_with("parameter ");
    });
    if (change.kind == CatalogChange::Kind::changed && change.attributes.empty()) continue;
    std::string statement;
    switch (change.subject) {
      case CatalogChange::Subject::task:
        statement = "task " + change.task;
        break;
      case CatalogChange::Subject::behavior:
        statement = "behavior " + change.behavior;
        break;
      case CatalogChange::Subject::performs:
        statement = change.behavior + " performs " + change.task;
        break;
      case CatalogChange::Subject::requirement:
        statement = change.behavior + " requires " + change.task;
        break;
      case CatalogChange::Subject::variable:
        statement = "variable " + change.variable;
        break;
      case CatalogChange::Subject::exclusion:
        statement = change.task + " excludes " + change.other_task;
        break;
    }
    if (change.kind == CatalogChange::Kind::removed) lines.push_back("- " + statement);
    if (change.kind == CatalogChange::Kind::added) lines.push_back("+ " + statement);
    if (change.kind != CatalogChange::Kind::changed) continue;
    lines.push_back("~ " + statement);
    for (const AttributeChange& attribute : change.attributes) {
      const auto add = [&](const char* when, const AttributeValue& value) {
        if (std::holds_alternative<std::monostate>(value)) return;
        lines.push_back(statement + when + attribute.name + " " + to_text(value));
      };
      add(" before ", attribute.before);
      add(" after ", attribute.after);
    }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// What both catalogs say, each statement with the sign of its mark in the picture: '=' if nothing
/// has changed. Attributes of tasks and behaviors do not count, as above.
std::vector<std::string> signs(Statements before, Statements after) {
  // The picture of a catalog has no variables.
  const auto is_variable = [](const auto& entry) { return entry.first.starts_with("variable "); };
  std::erase_if(before, is_variable);
  std::erase_if(after, is_variable);
  std::set<std::string> lines;
  const auto is_thing = [](const std::string& statement) {
    return statement.starts_with("task ") || statement.starts_with("behavior ") ||
           statement.starts_with("variable ");
  };
  for (const auto& [statement, attributes] : before) {
    const auto other = after.find(statement);
    if (other == after.end()) {
      lines.insert("- " + statement);
    } else {
      const bool is_same = is_thing(statement) || other->second == attributes;
      lines.insert((is_same ? "= " : "~ ") + statement);
    }
  }
  for (const auto& [statement, attributes] : after) {
    if (!before.contains(statement)) lines.insert("+ " + statement);
  }
  return {lines.begin(), lines.end()};
}

std::string sign_of(draw::Mark mark) {
  switch (mark) {
    case draw::Mark::added:
      return "+ ";
    case draw::Mark::removed:
      return "- ";
    case draw::Mark::changed:
      return "~ ";
    default:
      return mark == draw::Mark::plain ? "= " : "? ";
  }
}

std::vector<std::string> signs(const draw::CatalogGraph& graph) {
  std::set<std::string> lines;
  const auto sign_of_thing = [](draw::Mark mark) {
    return mark == draw::Mark::changed ? sign_of(draw::Mark::plain) : sign_of(mark);
  };
  for (const auto& task : graph.tasks) {
    lines.insert(sign_of_thing(task.mark) + "task " + std::string(task.name));
  }
  for (const auto& behavior : graph.behaviors) {
    lines.insert(sign_of_thing(behavior.mark) + "behavior " + std::string(behavior.name));
  }
  const auto statement = [&](const auto& link, const char* verb) {
    return sign_of(link.mark) + std::string(graph.behaviors[link.behavior].name) + verb +
           std::string(graph.tasks[link.task].name);
  };
  for (const auto& link : graph.performances) lines.insert(statement(link, " performs "));
  for (const auto& link : graph.requirements) lines.insert(statement(link, " requires "));
  // A pair that stands in several lists is new or gone only if none has it without a mark.
  std::map<std::string, std::string> exclusions;
  for (std::size_t list = 0; list < graph.exclusions.size(); ++list) {
    const auto tasks = graph.exclusions[list];
    const auto marks = graph.exclusion_marks[list];
    for (std::size_t one = 0; one < tasks.size(); ++one) {
      for (std::size_t other = 0; other < one; ++other) {
        const auto mark = draw::join(marks[one], marks[other]);
        if (!mark) continue;
        const auto& [a, b] =
            std::minmax(graph.tasks[tasks[one]].name, graph.tasks[tasks[other]].name);
        std::string& sign = exclusions[std::string(a) + " excludes " + std::string(b)];
        if (sign != "= ") sign = sign_of(*mark);
      }
    }
  }
  for (const auto& [exclusion, sign] : exclusions) lines.insert(sign + exclusion);
  return {lines.begin(), lines.end()};
}

/// The same meaning, otherwise written: tasks, behaviors and lists in another order, lists twice,
/// or as pairs.
Catalog reordered(const Catalog& catalog, Random& random) {
  Catalog result = catalog;
  std::vector<std::size_t> places(catalog.tasks.size());
  for (std::size_t task = 0; task < places.size(); ++task) places[task] = task;
  random.shuffle(places);
  for (std::size_t task = 0; task < places.size(); ++task) {
    result.tasks[places[task]] = catalog.tasks[task];
  }
  for (Behavior& behavior : result.behaviors) {
    for (Performance& one : behavior.performs) one.task = places[one.task];
    for (Requirement& one : behavior.requirements) one.task = places[one.task];
    random.shuffle(behavior.performs);
    random.shuffle(behavior.requirements);
  }
  random.shuffle(result.behaviors);
  for (auto& list : result.exclusivity) {
    for (std::size_t& task : list) task = places[task];
    random.shuffle(list);
  }
  random.shuffle(result.exclusivity);
  if (!result.exclusivity.empty() && random.percent(50)) {
    const std::vector<std::size_t> list = result.exclusivity.back();
    if (random.percent(50)) result.exclusivity.pop_back();
    for (std::size_t one = 0; one < list.size(); ++one) {
      for (std::size_t other = 0; other < one; ++other) {
        result.exclusivity.push_back({list[one], list[other]});
      }
    }
  }
  return result;
}

/// Takes a task out of a list of exclusive ones, or puts into it one that nothing requires.
void change_list(Catalog& catalog, Random& random) {
  if (catalog.exclusivity.empty()) return;
  auto& list = catalog.exclusivity[random.below(catalog.exclusivity.size())];
  if (list.size() > 3 && random.percent(50)) {
    const auto middle =
        list.begin() + static_cast<std::ptrdiff_t>(2 + random.below(list.size() - 3));
    std::vector<std::size_t> half(middle, list.end());
    list.erase(middle, list.end());
    catalog.exclusivity.push_back(std::move(half));
    return;
  }
  if (list.size() > 2 && random.percent(50)) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(random.below(list.size())));
    return;
  }
  const std::size_t place = catalog.tasks.size();
  catalog.tasks.push_back({});
  catalog.tasks.back().name = "EXCLUDED_" + std::to_string(place);
  catalog.tasks.back().listed = true;
  list.push_back(place);
}

/// Changes that leave a catalog valid.
void change(Catalog& catalog, Random& random) {
  if (catalog.tasks.empty() || catalog.behaviors.empty()) return;
  const std::size_t task = random.below(catalog.tasks.size());
  const std::size_t behavior = random.below(catalog.behaviors.size());
  switch (random.below(10)) {
    case 0:
      catalog.tasks[task].name += "_NEW";
      break;
    case 1:
      catalog.behaviors[behavior].name += "_new";
      break;
    case 2:
      catalog.tasks[task].timeout = random.between(1, 9) * 1'000'000;
      catalog.tasks[task].listed = true;
      break;
    case 3:
      catalog.behaviors[behavior].timeout = random.between(1, 9) * 500'000;
      break;
    case 4:
      if (!catalog.behaviors[behavior].requirements.empty()) {
        catalog.behaviors[behavior].requirements.pop_back();
      }
      break;
    case 5:
      if (!catalog.behaviors[behavior].requirements.empty()) {
        catalog.behaviors[behavior].requirements.back().minimum = random.between(0, 4) * 250'000;
      }
      break;
    case 6:
      if (!catalog.behaviors[behavior].performs.empty()) {
        catalog.behaviors[behavior].performs.back().suitability = random.between(0, 9) * 100'000;
      }
      break;
    case 7:
      if (!catalog.exclusivity.empty()) catalog.exclusivity.pop_back();
      break;
    default:
      change_list(catalog, random);
      break;
  }
}

CompiledCatalog compiled(const Catalog& catalog, Random& forms) {
  Diagnostics diagnostics;
  const std::string yaml = catalog_yaml(catalog, forms);
  const auto read = read_catalog(yaml, "catalog.yaml", diagnostics);
  EXPECT_TRUE(read.has_value()) << yaml;
  return compile(read.value());
}

TEST(Diff, AndItsPictureAreThoseOfPlainSets) {
  const std::uint64_t first = environment("CBC_SEED", 1);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", default_diffs);
  std::size_t changes = 0;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    Random random(seed);
    const Catalog before = generate_catalog(random);
    Catalog after = reordered(before, random);
    const CompiledCatalog one = compiled(before, random);
    EXPECT_EQ(lines_of(compare_catalogs(one, compiled(after, random))), std::vector<std::string>())
        << "CBC_SEED=" << seed;
    for (std::size_t count = random.below(4) + 1; count > 0; --count) change(after, random);
    const CompiledCatalog other = compiled(after, random);
    const auto expected = differences(statements_of(before), statements_of(after));
    const CatalogDiff diff = compare_catalogs(one, other);
    ASSERT_EQ(lines_of(diff), expected) << "CBC_SEED=" << seed;
    ASSERT_EQ(lines_of(compare_catalogs(other, one)),
              differences(statements_of(after), statements_of(before)))
        << "CBC_SEED=" << seed;
    ASSERT_EQ(signs(draw::to_graph(one, other, diff)),
              signs(statements_of(before), statements_of(after)))
        << "CBC_SEED=" << seed;
    changes += expected.size();
  }
  EXPECT_GT(changes, cases) << "too few changes to mean anything";
}

}  // namespace
}  // namespace cbc::oracle::diff_test
