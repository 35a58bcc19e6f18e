#include "core/catalog/situation.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/catalog/shape.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

std::vector<std::string_view> names_of(const std::vector<Variable>& variables) {
  std::vector<std::string_view> names;
  names.reserve(variables.size());
  for (const Variable& variable : variables) names.emplace_back(variable.name);
  return names;
}

}  // namespace

std::optional<std::string_view> value_text(const Node& node, bool is_boolean) {
  if (node.kind != Kind::scalar) return std::nullopt;
  if (!is_boolean) return node.text;
  Node plain = node;
  plain.plain = true;
  const auto truth = yaml::to_boolean(plain);
  if (!truth) return std::nullopt;
  return *truth ? "true" : "false";
}

void report_unknown_value(const Node& node, std::string_view variable,
                          std::span<const std::string_view> values, Reporter& reporter,
                          std::vector<Note> notes) {
  if (node.kind != Kind::scalar) {
    yaml::report_wrong_type(node, variable, "a value of the situation variable", reporter);
    return;
  }
  const auto suggestion = nearest(node.text, values);
  std::vector<std::string> known;
  constexpr std::size_t most = 8;
  const std::size_t listed = values.size() <= most ? values.size() : most - 1;
  for (const std::string_view value : values.first(listed)) known.push_back(quote(value));
  if (listed < values.size()) known.push_back(concat(values.size() - listed, " more"));
  reporter.report(
      rule::situation_value, node.range,
      concat("situation variable ", quote(variable), " has no value ", quote(node.text),
             suggestion ? did_you_mean(suggestion) : "; its values are " + list_with_and(known)),
      std::move(notes));
}

std::vector<Variable> SituationReader::read_variables(const Node* section) {
  if (section == nullptr) return {};
  const Node* const list = yaml::read_list(*section, "situation", "a list of variables", reporter_);
  if (list == nullptr) {
    lacks_variables_ = true;
    return {};
  }
  for (const Node* entry : list->items) read_variable(*entry);
  return variables_;
}

void SituationReader::read_variable(const Node& entry) {
  if (entry.kind != Kind::mapping) {
    reporter_.report(rule::wrong_type, entry.range,
                     "a situation variable must be a mapping ('variable: NAME'), found " +
                         yaml::describe(entry));
    lacks_variables_ = true;
    return;
  }
  Fields fields(entry, shape::variable, reporter_);
  const Node* const node = fields.require("variable", entry.range);
  const auto name =
      node == nullptr
          ? std::nullopt
          : yaml::read_name(*node, "variable", "the name of a situation variable", reporter_);
  Variable variable;
  if (name) {
    variable.name = *name;
    variable.range = node->range;
    names_.push_back({NameKind::variable, node->range});
    fields.call("variable " + quote(*name));
  }
  if (const Node* const values = fields.find("values")) {
    read_values(*values, variable);
  } else {
    variable.is_boolean = true;
    variable.values = {"true", "false"};
  }
  fields.report_unknown(yaml::UnknownKeys::ignored);
  if (!name) {
    lacks_variables_ = true;
    return;
  }
  const auto [known, is_new] =
      places_.try_emplace(*name, static_cast<std::uint32_t>(variables_.size()));
  if (!is_new) {
    reporter_.report(rule::duplicate_situation, node->range,
                     "situation variable " + quote(*name) + " is declared twice",
                     {reporter_.note(variables_[known->second].range, "first declared here")});
    return;
  }
  variables_.push_back(std::move(variable));
}

void SituationReader::read_values(const Node& node, Variable& variable) {
  const Node* const list = yaml::read_list(node, "values", "a list of values", reporter_);
  if (list == nullptr) return;
  std::unordered_map<std::string_view, Range> known;
  for (const Node* item : list->items) {
    const auto text = yaml::read_name(*item, "values", "a list of plain values", reporter_);
    if (!text) continue;
    const auto [first, is_new] = known.try_emplace(*text, item->range);
    if (is_new) {
      variable.values.emplace_back(*text);
    } else {
      reporter_.report(rule::situation_value, item->range,
                       "value " + quote(*text) + " is listed twice",
                       {reporter_.note(first->second, "first listed here")});
    }
  }
  if (list->items.size() < 2) {
    reporter_.report(rule::situation_value, node.range,
                     "a situation variable needs two values or more, found " +
                         std::to_string(list->items.size()));
  }
}

std::vector<Condition> SituationReader::read_conditions(const Node* node,
                                                        std::string_view behavior) {
  std::vector<Condition> conditions;
  if (node == nullptr) return conditions;
  if (yaml::read_mapping(*node, "situation", "a mapping of variables to values", reporter_) ==
      nullptr) {
    lacks_variables_ = true;  // so that no variable is reported as unused
    return conditions;
  }
  yaml::report_duplicate_keys(*node, reporter_);
  for (const auto& [key, value] : node->entries) {
    names_.push_back({NameKind::variable, key->range});
    if (value->kind == Kind::null) continue;
    const auto variable = find_variable(*key, *node, behavior);
    if (!variable) continue;
    if (std::any_of(conditions.begin(), conditions.end(),
                    [&](const Condition& other) { return other.variable == *variable; })) {
      continue;  // reported as a duplicate key
    }
    conditions.push_back(read_condition(*variable, *key, *value));
  }
  return conditions;
}

std::optional<std::uint32_t> SituationReader::find_variable(const Node& name,
                                                            const Node& conditions,
                                                            std::string_view behavior) {
  const auto text =
      yaml::read_name(name, "situation", "the name of a situation variable", reporter_);
  if (!text) return std::nullopt;
  const auto found = places_.find(*text);
  if (found != places_.end()) return found->second;
  const std::vector<std::string_view> names = names_of(variables_);
  const auto suggestion = nearest(*text, names, [&conditions](std::string_view other) {
    return yaml::stands_in(conditions, other);
  });
  if (suggestion || !lacks_variables_) {
    reporter_.report(rule::undeclared_situation, name.range,
                     concat("situation variable ", quote(*text), ", named by behavior ",
                            quote(behavior), ", is not declared", did_you_mean(suggestion)));
  }
  return std::nullopt;
}

Condition SituationReader::read_condition(std::uint32_t variable, const Node& key,
                                          const Node& value) {
  const Variable& declared = variables_[variable];
  Condition condition;
  condition.variable = variable;
  condition.range = key.range;
  const std::vector<const Node*> single{&value};
  const std::vector<const Node*>& nodes = value.kind == Kind::sequence ? value.items : single;
  if (nodes.empty()) {
    reporter_.report(rule::situation_value, value.range,
                     "the list of values of " + quote(declared.name) +
                         " is empty, so that the behavior never fits");
  }
  const std::vector<std::string_view> values(declared.values.begin(), declared.values.end());
  std::unordered_map<std::uint32_t, Range> known;
  for (const Node* node : nodes) {
    const auto text = value_text(*node, declared.is_boolean);
    const auto found = text ? std::find(values.begin(), values.end(), *text) : values.end();
    if (found != values.end()) {
      const auto place = static_cast<std::uint32_t>(found - values.begin());
      condition.values.push_back(place);
      const auto [first, is_new] = known.try_emplace(place, node->range);
      if (!is_new) {
        reporter_.report(rule::unused_situation, node->range,
                         "value " + quote(*text) + " is listed twice",
                         {reporter_.note(first->second, "first listed here")});
      }
    } else if (!values.empty()) {  // otherwise they could not be read
      report_unknown_value(*node, declared.name, values, reporter_,
                           {reporter_.note(declared.range, "declared here")});
    }
  }
  std::sort(condition.values.begin(), condition.values.end());
  condition.values.erase(std::unique(condition.values.begin(), condition.values.end()),
                         condition.values.end());
  report_all_values(condition);
  return condition;
}

void SituationReader::report_all_values(const Condition& condition) {
  const Variable& declared = variables_[condition.variable];
  if (declared.values.size() < 2 || condition.values.size() < declared.values.size()) return;
  reporter_.report(
      rule::unused_situation, condition.range,
      "all values of " + quote(declared.name) + " are listed, so that the condition has no effect",
      {reporter_.note(declared.range, "declared here")});
}

void SituationReader::check_names(const std::vector<Behavior>& behaviors) {
  std::unordered_map<std::string_view, const Behavior*> by_name;
  std::vector<bool> is_used(variables_.size(), false);
  for (const Behavior& behavior : behaviors) {
    by_name.try_emplace(behavior.name, &behavior);
    for (const Condition& condition : behavior.situation) is_used[condition.variable] = true;
  }
  for (std::size_t place = 0; place < variables_.size(); ++place) {
    const Variable& variable = variables_[place];
    if (const auto found = by_name.find(variable.name); found != by_name.end()) {
      reporter_.report(rule::duplicate_situation, variable.range,
                       "situation variable " + quote(variable.name) +
                           " has the name of a behavior; an event 'situation' could mean both",
                       {reporter_.note(found->second->range, "the behavior is defined here")});
    }
    if (is_used[place] || lacks_variables_) continue;
    reporter_.report(rule::unused_situation, variable.range,
                     "no behavior names situation variable " + quote(variable.name));
  }
}

std::vector<NamedCondition> conditions_of(const CompiledCatalog& catalog, BehaviorId behavior) {
  std::vector<NamedCondition> conditions;
  std::uint32_t variable = none;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable != variable) {
      variable = fitting.variable;
      NamedCondition& condition = conditions.emplace_back();
      condition.variable = catalog.name_of_variable(variable);
      condition.is_boolean = catalog.variables[variable].is_boolean != 0;
    }
    conditions.back().values.push_back(catalog.name_of_value({variable, fitting.value}));
  }
  return conditions;
}

std::vector<NamedCondition> conditions_of(const Catalog& catalog, const Behavior& behavior) {
  std::vector<Condition> sorted = behavior.situation;
  std::sort(sorted.begin(), sorted.end(),
            [](const Condition& a, const Condition& b) { return a.variable < b.variable; });
  std::vector<NamedCondition> conditions;
  for (const Condition& from : sorted) {
    const Variable& variable = catalog.variables[from.variable];
    NamedCondition& condition = conditions.emplace_back();
    condition.variable = variable.name;
    condition.is_boolean = variable.is_boolean;
    for (const std::uint32_t value : from.values) {
      condition.values.emplace_back(variable.values[value]);
    }
  }
  return conditions;
}

std::string describe(const NamedCondition& condition) {
  const std::string variable = printable(condition.variable);
  if (condition.is_boolean && condition.values.size() == 1) {
    return condition.values.front() == "true" ? variable : "not " + variable;
  }
  if (condition.values.empty()) return variable + ": no value";
  std::string text = variable + ":";
  for (const std::string_view value : condition.values) {
    text += text.back() == ':' ? " " : ", ";
    text += printable(value);
  }
  return text;
}

}  // namespace cbc
