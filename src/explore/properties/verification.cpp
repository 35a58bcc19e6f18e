// Properties of one scope are answered by one exploration. Before that, what the constraints alone
// decide is taken out: then only `when` and `after` need states, as they may never hold.

#include "explore/properties/verification.h"

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/property/constraint_proof.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

void add_groups(const CompiledCatalog& catalog, const StateCondition& condition,
                std::set<GroupId>& groups) {
  if (condition.task != none) groups.insert(catalog.tasks[condition.task].group);
  if (condition.behavior != none) groups.insert(catalog.group_of(condition.behavior));
}

void add_groups_of_variable(const CompiledCatalog& catalog, std::uint32_t variable,
                            std::set<GroupId>& groups) {
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (fitting.variable == variable) groups.insert(catalog.group_of(fitting.behavior));
  }
}

}  // namespace

bool Verification::is_complete() const {
  return std::all_of(explorations.begin(), explorations.end(),
                     [](const Exploration& exploration) { return exploration.complete; });
}

PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property) {
  const std::vector<const StateCondition*> conditions = conditions_of(property);
  std::set<GroupId> groups;
  if (property.task != none) groups.insert(catalog.tasks[property.task].group);
  for (const StateCondition* condition : conditions) add_groups(catalog, *condition, groups);
  if (groups.empty()) {
    for (const StateCondition* condition : conditions) {
      add_groups_of_variable(catalog, condition->variable, groups);
    }
  }
  const bool is_about_faults =
      std::any_of(conditions.begin(), conditions.end(), [](const StateCondition* condition) {
        return condition->kind == StateCondition::Kind::none_faulty;
      });
  if (groups.empty() && is_about_faults) {
    for (GroupId group(0); group < catalog.group_count(); ++group) groups.insert(group);
  }
  std::set<std::uint32_t> variables = variables_of(property);
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (groups.contains(catalog.group_of(fitting.behavior))) variables.erase(fitting.variable);
  }
  return {
      {groups.begin(), groups.end()}, std::move(variables), property.after ? &property : nullptr};
}

namespace {

/// What one exploration is about.
struct ExplorationTask {
  std::vector<GroupId> groups;
  std::vector<const Property*> properties;
  std::vector<std::size_t> places;  ///< of their answers
};

/// Whether an exploration is worth several threads.
bool is_large(const CompiledCatalog& catalog, const std::vector<GroupId>& groups) {
  constexpr std::uint32_t many_tasks = 8;
  std::uint32_t tasks = 0;
  for (const GroupId group : groups) {
    tasks += catalog.group_tasks[group + 1] - catalog.group_tasks[group];
  }
  return tasks >= many_tasks;
}

/// Several explorations: large ones with all threads, the others with one each.
std::vector<Exploration> explore_all(const CompiledCatalog& catalog, const Assumptions& assumptions,
                                     const std::vector<ExplorationTask>& tasks,
                                     const ExplorationOptions& options) {
  std::vector<Exploration> explorations(tasks.size());
  ExplorationOptions each = options;
  const auto explore_one = [&](std::size_t place) {
    const ExplorationTask& task = tasks[place];
    explorations[place] = explore(catalog, task.groups, assumptions, task.properties, each);
  };
  std::vector<std::size_t> small;
  for (std::size_t place = 0; place < tasks.size(); ++place) {
    if (is_large(catalog, tasks[place].groups)) {
      explore_one(place);
    } else {
      small.push_back(place);
    }
  }
  each.jobs = 1;
  for_each_in_threads(small.size(), options.jobs,
                      [&](std::size_t, std::size_t number) { explore_one(small[number]); });
  return explorations;
}

std::vector<Exploration> explore_groups(const CompiledCatalog& catalog,
                                        const Assumptions& assumptions,
                                        const ExplorationOptions& options) {
  std::vector<ExplorationTask> tasks;
  tasks.reserve(catalog.group_count());
  for (GroupId group(0); group < catalog.group_count(); ++group) tasks.push_back({{group}, {}, {}});
  return explore_all(catalog, assumptions, tasks, options);
}

/// Whether some state counts for a promise, which decides whether it is vacuous.
Property is_counted(const Property& promise) {
  Property property = promise;
  property.kind = Property::Kind::reachable;
  property.condition = {};
  return property;
}

std::string title_of(const CompiledCatalog& catalog, const PropertyFile& file,
                     const Property& property) {
  const std::string place = fmt::format("{}:{}", printable(file.path), property.line);
  const std::string words = describe_property(catalog, property);
  return property.name.empty()
             ? fmt::format("{}\n({})", words, place)
             : fmt::format("{}: {}\n({})", printable(property.name), words, place);
}

void add_script(const CompiledCatalog& catalog, const PropertyFile& file,
                const std::vector<GroupId>& groups, PropertyAnswer& answer) {
  const bool is_witness = answer.verdict.result == Verdict::Result::proved;
  const std::string comment = fmt::format("{}: {}\nRun it with: cbc solve CATALOG FILE\n",
                                          is_witness ? "Witness" : "Counterexample",
                                          title_of(catalog, file, *answer.property));
  answer.witness = make_witness(catalog, groups, file.assumptions, answer.verdict.script,
                                answer.property, comment);
}

}  // namespace

Verification verify_groups(const CompiledCatalog& catalog, const ExplorationOptions& options) {
  Verification result;
  result.explorations = explore_groups(catalog, default_assumptions(catalog), options);
  return result;
}

Verification verify_properties(const CompiledCatalog& catalog, const PropertyFile& file,
                               const ExplorationOptions& options) {
  Verification result;
  result.file = &file;
  if (file.properties.empty()) {
    result.explorations = explore_groups(catalog, file.assumptions, options);
    return result;
  }
  result.answers.resize(file.properties.size());
  std::deque<Property> counted;
  std::map<PropertyScope, ExplorationTask> by_scope;
  for (std::size_t place = 0; place < file.properties.size(); ++place) {
    const Property* property = &file.properties[place];
    const PropertyScope scope = scope_of(catalog, *property);
    PropertyAnswer& answer = result.answers[place];
    answer.property = property;
    if (is_proved_by_constraints(catalog, scope.groups, file.assumptions, *property)) {
      answer.verdict.result = Verdict::Result::proved;
      answer.verdict.by_constraints = true;
      if (!property->when && !property->after) continue;
      property = &counted.emplace_back(is_counted(*property));
    }
    ExplorationTask& task = by_scope[scope];
    task.groups = scope.groups;
    task.properties.push_back(property);
    task.places.push_back(place);
  }
  std::vector<ExplorationTask> tasks;
  tasks.reserve(by_scope.size());
  for (auto& [scope, task] : by_scope) tasks.push_back(std::move(task));
  result.explorations = explore_all(catalog, file.assumptions, tasks, options);
  for (std::size_t explored = 0; explored < tasks.size(); ++explored) {
    const ExplorationTask& task = tasks[explored];
    for (std::size_t number = 0; number < task.places.size(); ++number) {
      const Verdict& verdict = result.explorations[explored].verdicts[number];
      PropertyAnswer& answer = result.answers[task.places[number]];
      if (answer.verdict.by_constraints) {
        answer.verdict.is_vacuous = verdict.result == Verdict::Result::violated;
        continue;
      }
      answer.exploration = explored;
      answer.verdict = verdict;
      if (verdict.has_script) add_script(catalog, file, task.groups, answer);
    }
  }
  return result;
}

}  // namespace cbc
