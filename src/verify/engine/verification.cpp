#include "verify/engine/verification.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/report/property_words.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

ExplorationOptions options_for(const std::vector<std::uint32_t>& groups,
                               const VerificationOptions& options) {
  ExplorationOptions result;
  result.limits = options.limits;
  result.jobs = options.jobs;
  result.reduce = options.reduce;
  if (options.on_progress) {
    result.on_progress = [&groups, &options](const ExplorationProgress& progress) {
      return options.on_progress(groups, progress);
    };
  }
  return result;
}

void add_groups(const CompiledCatalog& catalog, const StateCondition& condition,
                std::set<std::uint32_t>& groups) {
  const auto add_task = [&](TaskId task) { groups.insert(catalog.tasks[task].group); };
  const auto add_behavior = [&](BehaviorId behavior) { groups.insert(catalog.group_of(behavior)); };
  for (const auto& running : condition.running) add_task(running.task);
  for (const TaskId task : condition.stopped) add_task(task);
  for (const auto& requested : condition.requested) add_task(requested.task);
  for (const BehaviorId behavior : condition.active) add_behavior(behavior);
  for (const BehaviorId behavior : condition.faulty) add_behavior(behavior);
  for (const BehaviorId behavior : condition.available) add_behavior(behavior);
  for (const auto& own : condition.situation.behaviors) add_behavior(own.behavior);
}

void add_groups_of_variables(const CompiledCatalog& catalog, const StateCondition& condition,
                             std::set<std::uint32_t>& groups) {
  for (const VariableValue& value : condition.situation.variables) {
    for (const FittingValue& fitting : catalog.fitting_values) {
      if (fitting.variable == value.variable) groups.insert(catalog.group_of(fitting.behavior));
    }
  }
}

std::string title_of(const CompiledCatalog& catalog, const PropertyFile& file,
                     const Property& property) {
  const std::string place = fmt::format("{}:{}", printable(file.path), property.line);
  const std::string words = describe_property(catalog, property);
  return property.name.empty()
             ? fmt::format("{}\n({})", words, place)
             : fmt::format("{}: {}\n({})", printable(property.name), words, place);
}

}  // namespace

bool Verification::is_complete() const {
  return std::all_of(explorations.begin(), explorations.end(),
                     [](const Exploration& exploration) { return exploration.complete; });
}

PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property) {
  std::set<std::uint32_t> groups;
  if (property.task != none) groups.insert(catalog.tasks[property.task].group);
  add_groups(catalog, property.condition, groups);
  if (property.when) add_groups(catalog, *property.when, groups);
  if (groups.empty()) {
    add_groups_of_variables(catalog, property.condition, groups);
    if (property.when) add_groups_of_variables(catalog, *property.when, groups);
  }
  std::set<std::uint32_t> variables = variables_of(property);
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (groups.contains(catalog.group_of(fitting.behavior))) variables.erase(fitting.variable);
  }
  return {{groups.begin(), groups.end()}, std::move(variables)};
}

namespace {

std::vector<Exploration> explore_groups(const CompiledCatalog& catalog,
                                        const Assumptions& assumptions,
                                        const VerificationOptions& options) {
  std::vector<Exploration> explorations;
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) {
    const std::vector<std::uint32_t> groups{group};
    explorations.push_back(explore(catalog, groups, assumptions, {}, options_for(groups, options)));
  }
  return explorations;
}

}  // namespace

Verification verify_groups(const CompiledCatalog& catalog, const VerificationOptions& options) {
  Verification result;
  result.explorations = explore_groups(catalog, default_assumptions(catalog), options);
  return result;
}

Verification verify_properties(const CompiledCatalog& catalog, const PropertyFile& file,
                               const VerificationOptions& options) {
  Verification result;
  result.file = &file;
  if (file.properties.empty()) {
    result.explorations = explore_groups(catalog, file.assumptions, options);
    return result;
  }
  result.answers.resize(file.properties.size());
  std::map<PropertyScope, std::vector<std::size_t>> by_scope;
  for (std::size_t place = 0; place < file.properties.size(); ++place) {
    by_scope[scope_of(catalog, file.properties[place])].push_back(place);
  }
  for (const auto& [scope, places] : by_scope) {
    std::vector<const Property*> properties;
    for (const std::size_t place : places) properties.push_back(&file.properties[place]);
    const std::vector<std::uint32_t>& explored = scope.groups;
    result.explorations.push_back(
        explore(catalog, explored, file.assumptions, properties, options_for(explored, options)));
    const Exploration& exploration = result.explorations.back();
    for (std::size_t number = 0; number < places.size(); ++number) {
      Answer& answer = result.answers[places[number]];
      answer.property = properties[number];
      answer.exploration = result.explorations.size() - 1;
      answer.verdict = exploration.verdicts[number];
      if (!answer.verdict.has_script) continue;
      const bool is_witness = answer.verdict.result == Verdict::Result::proved;
      const std::string comment = fmt::format("{}: {}\nRun it with: cbc solve CATALOG FILE\n",
                                              is_witness ? "Witness" : "Counterexample",
                                              title_of(catalog, file, *answer.property));
      answer.witness = make_witness(catalog, explored, file.assumptions, answer.verdict.script,
                                    answer.property, comment);
    }
  }
  return result;
}

}  // namespace cbc
