// Random catalogs, and changed ones: the differences against plain sets of what each of the two
// says. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their number.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "catalog_changes.h"
#include "compiled_text.h"
#include "environment.h"
#include "generator.h"
#include "graph/engine/catalog_graph.h"
#include "random.h"
#include "support/rounds.h"
#include "versions/difference/catalog_diff.h"
#include "yaml_text.h"

namespace cbc::oracle::diff_test {
namespace {

constexpr std::uint64_t default_diffs = 500;

/// What a catalog says: "b requires t" -> {"minimum_performance": "500000"}.
using Statements = std::map<std::string, std::map<std::string, std::string>>;

std::string truth(bool value) { return value ? "true" : "false"; }

std::string list_of(const std::set<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return "[" + text + "]";
}

std::vector<std::string> values_of(const Variable& variable) {
  return variable.is_boolean() ? std::vector<std::string>{"true", "false"} : variable.values;
}

std::string text_of(const Condition& condition, const Variable& variable) {
  std::set<std::string> values;
  for (const std::size_t value : condition.values) values.insert(values_of(variable)[value]);
  return variable.is_boolean() && values.size() == 1 ? *values.begin() : list_of(values);
}

Statements statements_of(const Catalog& catalog) {
  Statements statements;
  for (const Variable& variable : catalog.variables) {
    auto& attributes = statements["variable " + variable.name];
    attributes["initial value"] = values_of(variable).front();
    if (!variable.is_boolean())
      attributes["values"] = list_of({variable.values.begin(), variable.values.end()});
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
  const auto& text = std::get<std::string>(value);
  if (!text.starts_with("[")) return text;
  std::set<std::string> values;
  for (std::size_t begin = 1; begin < text.size();) {
    const std::size_t end = text.find_first_of(",]", begin);
    values.insert(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return list_of(values);
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
      case CatalogChange::Subject::limit:
        statement = "limit of " + change.task;
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

CompiledCatalog compiled(const Catalog& catalog, Random& forms) {
  return compile_yaml(catalog_yaml(catalog, forms)).value();
}

/// Some changes that leave a catalog valid.
Catalog changed(Catalog catalog, Random& random) {
  for (std::size_t count = random.below(4) + 1; count > 0; --count) {
    Catalog next = catalog;
    if (plain::change_one(next, random).empty()) continue;
    if (compile_yaml(catalog_yaml(next, random))) catalog = std::move(next);
  }
  return catalog;
}

TEST(Diff, IsThatOfPlainSets) {
  const std::uint64_t first = environment("CBC_SEED", 1);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", test::rounds(default_diffs));
  std::size_t changes = 0;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    Random random(seed);
    const Catalog before = generate_catalog(random);
    Catalog after = plain::rewrite(before, random);
    random.shuffle(after.behaviors);
    const CompiledCatalog one = compiled(before, random);
    EXPECT_EQ(lines_of(compare_catalogs(one, compiled(after, random))), std::vector<std::string>())
        << "CBC_SEED=" << seed;
    after = changed(after, random);
    const CompiledCatalog other = compiled(after, random);
    const auto expected = differences(statements_of(before), statements_of(after));
    ASSERT_EQ(lines_of(compare_catalogs(one, other)), expected) << "CBC_SEED=" << seed;
    ASSERT_EQ(lines_of(compare_catalogs(other, one)),
              differences(statements_of(after), statements_of(before)))
        << "CBC_SEED=" << seed;
    changes += expected.size();
  }
  EXPECT_GT(changes, cases) << "too few changes to mean anything";
}

}  // namespace
}  // namespace cbc::oracle::diff_test
