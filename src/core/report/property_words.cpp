#include "core/report/property_words.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/report/catalog_words.h"
#include "core/report/layout.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

std::string describe_condition(const CompiledCatalog& catalog, const StateCondition& condition) {
  std::vector<std::string> parts;
  const auto task = [&](TaskId id) { return printable(catalog.name_of_task(id)); };
  const auto behavior = [&](BehaviorId id) { return printable(catalog.name_of_behavior(id)); };
  for (const auto& running : condition.running) {
    parts.push_back(describe_running(catalog, running.task, running.behavior));
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
    parts.push_back(describe_value(catalog, value));
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
  return join(parts, " and ");
}

}  // namespace

std::string describe_property(const CompiledCatalog& catalog, const Property& property) {
  const std::string condition = describe_condition(catalog, property.condition);
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
  if (property.when) text += fmt::format(", when {}", describe_condition(catalog, *property.when));
  if (property.settled) text += ", with nothing in the queue";
  return text;
}

namespace {

/// "priorities 1 and 2"
std::string describe_priorities(const Assumptions& assumptions) {
  std::set<std::int32_t> priorities;
  for (const Assumptions::Start& start : assumptions.start) {
    priorities.insert(start.priorities.begin(), start.priorities.end());
  }
  std::vector<std::string> words;
  for (const std::int32_t priority : priorities) words.push_back(std::to_string(priority));
  return (words.size() == 1 ? "priority " : "priorities ") + list_with_and(words);
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

std::string assumptions_to_text(const CompiledCatalog& catalog, const StatedAssumptions& stated,
                                std::size_t columns) {
  const std::size_t width = columns == 0 ? text_width : std::min(columns, text_width);
  return wrap_line(describe_assumptions(catalog, stated), width, 2) + "\n";
}

}  // namespace cbc
