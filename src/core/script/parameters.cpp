#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/catalog/allowed_values.h"
#include "core/diagnostic/rules.h"
#include "core/script/reader.h"
#include "core/support/json.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

void report_duplicates(const Node& node, Reporter& reporter) {
  if (node.kind == Kind::mapping) yaml::report_duplicate_keys(node, reporter);
  for (const Node* item : node.items) report_duplicates(*item, reporter);
  for (const auto& entry : node.entries) report_duplicates(*entry.second, reporter);
}

// Canonical form -----------------------------------------------------------------------------
//
// Every value begins with its length, so that no two values have the same text: a scalar is
// "s<bytes>:<text>", a list "l<items>:<items>", a mapping "m<entries>:<keys and values>", and an
// empty item of a list "n".

std::string tagged(char tag, std::size_t size) { return tag + std::to_string(size) + ":"; }

std::string canonical(const Node& node);

std::string canonical_list(const Node& node) {
  std::string text;
  std::size_t size = 0;
  std::size_t waiting = 0;  // empty items, which only count if another item follows
  for (const Node* item : node.items) {
    const std::string value = canonical(*item);
    if (value.empty()) {
      ++waiting;
      continue;
    }
    text.append(waiting, 'n');
    text += value;
    size += waiting + 1;
    waiting = 0;
  }
  return size == 0 ? "" : tagged('l', size) + text;
}

std::string canonical_mapping(const Node& node) {
  std::vector<std::pair<std::string_view, std::string>> entries;
  for (const auto& [key, value] : node.entries) {
    std::string text = canonical(*value);
    if (!text.empty()) entries.emplace_back(key->text, std::move(text));
  }
  if (entries.empty()) return {};
  std::sort(entries.begin(), entries.end());
  std::string text = tagged('m', entries.size());
  for (const auto& [key, value] : entries) {
    text += tagged('s', key.size());
    text += key;
    text += value;
  }
  return text;
}

std::string canonical(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      break;
    case Kind::scalar:
      return node.text.empty() ? "" : tagged('s', node.text.size()) + node.text;
    case Kind::sequence:
      return canonical_list(node);
    case Kind::mapping:
      return canonical_mapping(node);
  }
  return {};
}

// JSON ---------------------------------------------------------------------------------------

void write_json(JsonWriter& json, const Node& node) {
  switch (node.kind) {
    case Kind::null:
      json.write(nullptr);
      break;
    case Kind::scalar:
      if (!node.plain) {
        json.write(node.text);
      } else if (node.text == "true" || node.text == "false") {
        json.write_json(node.text);
      } else {
        std::string text;
        append_as_written(text, node.text);
        json.write_json(text);
      }
      break;
    case Kind::sequence:
      json.open('[');
      for (const Node* item : node.items) write_json(json, *item);
      json.close(']');
      break;
    case Kind::mapping:
      json.open('{');
      for (const auto& [key, value] : node.entries) {
        json.key(key->text);
        write_json(json, *value);
      }
      json.close('}');
      break;
  }
}

}  // namespace

std::optional<Parameters> read_parameters(const Node& node, Reporter& reporter) {
  if (yaml::read_mapping(node, "parameters", "a mapping", reporter) == nullptr) {
    return std::nullopt;
  }
  report_duplicates(node, reporter);
  Parameters parameters{canonical(node), {}};
  JsonWriter json(parameters.json);
  write_json(json, node);
  return parameters;
}

namespace {

std::vector<std::string_view> list_names(const std::vector<Parameter>& parameters) {
  std::vector<std::string_view> names;
  names.reserve(parameters.size());
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

std::string describe(const std::vector<Parameter>& parameters) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t place = 0; place < std::min(parameters.size(), most); ++place) {
    text += (place > 0 ? ", " : "") + quote(parameters[place].name);
  }
  if (parameters.size() > most)
    text += " and " + std::to_string(parameters.size() - most) + " more";
  return text;
}

}  // namespace

ParameterChecks::Declared::Declared(std::vector<Parameter> declared)
    : parameters(std::move(declared)),
      suggestions(list_names(parameters)),
      all(describe(parameters)) {
  for (const Parameter& parameter : parameters) values.try_emplace(parameter.name, parameter);
}

ParameterChecks::Declared& ParameterChecks::declared_by(std::uint32_t task) {
  const auto found = declared_.find(task);
  if (found != declared_.end()) return found->second;
  return declared_.try_emplace(task, parameters_of(catalog_, task)).first->second;
}

void ParameterChecks::check(std::uint32_t task, const yaml::Node& given, Reporter& reporter) {
  Declared& declared = declared_by(task);
  std::unordered_set<std::string_view> known;
  for (const auto& [name, value] : given.entries) {
    if (!known.insert(name->text).second) continue;  // reported elsewhere
    const auto found = declared.values.find(name->text);
    if (found == declared.values.end()) {
      report_undeclared(task, *name, given, reporter);
    } else if (const auto fault = found->second.find_fault(*value)) {
      reporter.report_as({severity_}, rule::parameter_value, fault->node->range,
                         "parameter " + quote(name->text) + " of task " +
                             quote(catalog_.task_names[task]) + ": " + fault->message);
    }
  }
}

void ParameterChecks::report_undeclared(std::uint32_t task, const yaml::Node& name,
                                        const yaml::Node& given, Reporter& reporter) {
  Declared& declared = declared_by(task);
  std::string message = "task " + quote(catalog_.task_names[task]);
  if (declared.values.empty()) {
    message += " declares no parameters, found " + quote(name.text);
  } else {
    message += " declares no parameter " + quote(name.text);
    const auto is_taken = [&given](std::string_view other) {
      return yaml::stands_in(given, other);
    };
    if (const auto suggestion = declared.suggestions.nearest(name.text, is_taken)) {
      message += did_you_mean(suggestion);
    } else {
      message += ", only " + declared.all;
    }
  }
  reporter.report_as({severity_}, rule::undeclared_parameter, name.range, std::move(message));
}

}  // namespace cbc
