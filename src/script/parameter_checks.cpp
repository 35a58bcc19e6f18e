#include "script/parameter_checks.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "cbc/rules.h"
#include "compiled/parameters.h"
#include "text/quote.h"

namespace cbc {
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
    if (!known.insert(name->text).second) continue;  // an error of its own
    const auto found = declared.values.find(name->text);
    if (found == declared.values.end()) {
      report_undeclared(task, *name, reporter);
    } else if (const auto fault = found->second.find_fault(*value)) {
      reporter.report_as(severity_, rule::parameter_value, fault->node->range,
                         "parameter " + quote(name->text) + " of task " +
                             quote(catalog_.task_names[task]) + ": " + fault->message);
    }
  }
}

void ParameterChecks::report_undeclared(std::uint32_t task, const yaml::Node& name,
                                        Reporter& reporter) {
  Declared& declared = declared_by(task);
  std::string message = "task " + quote(catalog_.task_names[task]);
  if (declared.values.empty()) {
    message += " declares no parameters, found " + quote(name.text);
  } else {
    message += " declares no parameter " + quote(name.text);
    if (const auto suggestion = declared.suggestions.nearest(name.text)) {
      message += did_you_mean(suggestion);
    } else {
      message += ", only " + declared.all;
    }
  }
  reporter.report_as(severity_, rule::undeclared_parameter, name.range, std::move(message));
}

}  // namespace cbc
