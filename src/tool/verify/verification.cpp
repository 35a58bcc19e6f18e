#include "verify/verification.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "support/wording.h"

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

// Words.

std::string describe(const CompiledCatalog& catalog, const StateCondition& condition) {
  std::vector<std::string> parts;
  const auto task = [&](TaskId id) { return printable(catalog.name_of_task(id)); };
  const auto behavior = [&](BehaviorId id) { return printable(catalog.name_of_behavior(id)); };
  for (const auto& running : condition.running) {
    parts.push_back(running.behavior == none ? fmt::format("{} runs", task(running.task))
                                             : fmt::format("{} runs with {}", task(running.task),
                                                           behavior(running.behavior)));
  }
  for (const TaskId id : condition.stopped) {
    parts.push_back(fmt::format("{} does not run", task(id)));
  }
  for (const BehaviorId id : condition.active) {
    parts.push_back(fmt::format("behavior {} is active", behavior(id)));
  }
  for (const auto& requested : condition.requested) {
    parts.push_back(fmt::format("{} is requested with priority {} or more", task(requested.task),
                                requested.priority));
  }
  for (const VariableValue& value : condition.situation.variables) {
    parts.push_back(fmt::format("{} is {}", printable(catalog.name_of_variable(value.variable)),
                                printable(catalog.name_of_value(value))));
  }
  for (const auto& own : condition.situation.behaviors) {
    parts.push_back(fmt::format("the situation {} {}", own.available ? "allows" : "forbids",
                                behavior(own.behavior)));
  }
  for (const BehaviorId id : condition.available) {
    parts.push_back(fmt::format("behavior {} is available", behavior(id)));
  }
  for (const BehaviorId id : condition.faulty) {
    parts.push_back(fmt::format("behavior {} is faulty", behavior(id)));
  }
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string title_of(const CompiledCatalog& catalog, const PropertyFile& file,
                     const Property& property) {
  const std::string place = fmt::format("{}:{}", printable(file.path), property.line);
  const std::string words = describe(catalog, property);
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

std::string describe(const CompiledCatalog& catalog, const Property& property) {
  const std::string condition = describe(catalog, property.condition);
  std::string text;
  switch (property.kind) {
    case Property::Kind::can_start:
      return fmt::format("{} can always start with priority {}",
                         printable(catalog.name_of_task(property.task)), property.priority);
    case Property::Kind::always:
      text = fmt::format("always {}", condition);
      break;
    case Property::Kind::never:
      text = fmt::format("never {}", condition);
      break;
    case Property::Kind::reachable:
      text = fmt::format("some state in which {}", condition);
      break;
  }
  if (property.when) text += fmt::format(", when {}", describe(catalog, *property.when));
  if (property.settled) text += ", with nothing in the queue";
  return text;
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

namespace {

/// "priorities 1 and 2"
std::string describe_priorities(const Assumptions& assumptions) {
  std::set<std::int32_t> priorities;
  for (const Assumptions::Start& start : assumptions.start) {
    priorities.insert(start.priorities.begin(), start.priorities.end());
  }
  std::string text = priorities.size() == 1 ? "priority" : "priorities";
  for (const std::int32_t priority : priorities) {
    const bool is_last = priority == *priorities.rbegin() && priorities.size() > 1;
    const bool is_first = priority == *priorities.begin();
    text += fmt::format("{}{}", is_last ? " and " : is_first ? " " : ", ", priority);
  }
  return text;
}

std::string describe_requests(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  if (assumptions.start.empty()) return "no task is requested";
  const auto& start = assumptions.start;
  std::string text = fmt::format(
      "{} of {} {} requested ({})", start.size(), quantity(catalog.tasks.size(), "task"),
      start.size() == 1 ? "is" : "are", describe_priorities(assumptions));
  const bool stops_the_same =
      std::equal(start.begin(), start.end(), assumptions.stop.begin(), assumptions.stop.end(),
                 [](const Assumptions::Start& one, TaskId task) { return one.task == task; });
  if (stops_the_same) return text + " and stopped";
  return text + fmt::format(", {} stopped", assumptions.stop.size());
}

}  // namespace

std::string describe_assumptions(const CompiledCatalog& catalog, const StatedAssumptions& stated) {
  const Assumptions& assumptions = stated.assumptions;
  std::string text =
      fmt::format("assumed ({}): {}", stated.file.empty() ? "default" : printable(stated.file),
                  describe_requests(catalog, assumptions));
  text += assumptions.successes && assumptions.failures ? "; behaviors succeed and fail"
          : assumptions.successes                       ? "; behaviors succeed, but do not fail"
          : assumptions.failures                        ? "; behaviors fail, but do not succeed"
                                                        : "; behaviors do not finish";
  text += assumptions.faults == 0 ? "; none is faulty"
                                  : fmt::format("; up to {} faulty at a time", assumptions.faults);
  const std::size_t variables = catalog.variables.size();
  if (variables > 0) {
    const std::size_t changing = assumptions.variables.size();
    text += changing == 0 ? "; no variable changes"
            : changing < variables
                ? fmt::format("; {} of {} variables change", changing, variables)
                : std::string(variables == 1 ? "; the variable changes" : "; all variables change");
  }
  if (!assumptions.behaviors.empty()) {
    text += fmt::format("; {} may become unavailable",
                        quantity(assumptions.behaviors.size(), "behavior"));
  }
  if (!assumptions.never.empty()) {
    text += fmt::format("; {} never {}", quantity(assumptions.never.size(), "situation"),
                        assumptions.never.size() == 1 ? "occurs" : "occur");
  }
  const SituationPart& initially = assumptions.initially;
  const std::size_t given = initially.variables.size() + initially.behaviors.size();
  if (given > 0) text += fmt::format("; {} given initially", quantity(given, "value"));
  return text;
}

}  // namespace cbc
