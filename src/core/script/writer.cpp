#include <cstddef>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "core/script/script.h"
#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc {
namespace {

using yaml::in_quotes;

std::string situation_map(const CompiledCatalog& catalog, const Situation& situation) {
  std::vector<std::string> entries;
  for (const Availability& entry : situation.availability) {
    entries.push_back(
        fmt::format("{}: {}", in_quotes(catalog.behavior_names[entry.behavior]), entry.available));
  }
  for (const VariableValue value : situation.variables) {
    entries.push_back(fmt::format("{}: {}", in_quotes(catalog.name_of_variable(value.variable)),
                                  in_quotes(catalog.name_of_value(value))));
  }
  return "{" + join(entries, ", ") + "}";
}

std::string expectation_entry(const CompiledCatalog& catalog, const Expectation& expectation) {
  const auto task = [&](std::uint32_t index) { return in_quotes(catalog.task_names[index]); };
  const auto behavior = [&](std::uint32_t index) {
    return in_quotes(catalog.behavior_names[index]);
  };
  std::vector<std::string> parts;
  if (expectation.outcome)
    parts.push_back(fmt::format("outcome: {}", name_of(*expectation.outcome)));
  if (!expectation.running.empty()) {
    const auto entry = [&](const Expectation::Running& running) {
      const auto& behaviors = running.behaviors;
      const std::string value = behaviors.empty() ? "any"
                                : behaviors.size() == 1
                                    ? behavior(behaviors.front())
                                    : "[" + join(behaviors, ", ", behavior) + "]";
      return task(running.task) + ": " + value;
    };
    parts.push_back("running: {" + join(expectation.running, ", ", entry) + "}");
  }
  if (!expectation.stopped.empty()) {
    parts.push_back("stopped: [" + join(expectation.stopped, ", ", task) + "]");
  }
  if (expectation.active) {
    parts.push_back("active: [" + join(*expectation.active, ", ", behavior) + "]");
  }
  if (!expectation.active_includes.empty()) {
    parts.push_back("active_includes: [" + join(expectation.active_includes, ", ", behavior) + "]");
  }
  if (expectation.suspended) {
    parts.push_back("suspended: [" + join(*expectation.suspended, ", ", task) + "]");
  }
  if (expectation.failed) {
    parts.push_back("failed: [" + join(*expectation.failed, ", ", behavior) + "]");
  }
  return "expect: {" + join(parts, ", ") + "}";
}

std::string step_entry(const CompiledCatalog& catalog, const Step& step) {
  if (step.expect) return expectation_entry(catalog, *step.expect);
  const VerbForm& form = form_of(step.verb);
  std::string text;
  switch (form.subject) {
    case VerbForm::SubjectKind::nothing:
      return {};
    case VerbForm::SubjectKind::situation:
      return fmt::format("{}: {}", form.name, situation_map(catalog, step.situation));
    case VerbForm::SubjectKind::task:
      text = in_quotes(catalog.task_names[step.subject]);
      break;
    case VerbForm::SubjectKind::behavior:
      text = step.is_by_task
                 ? fmt::format("{{task: {}}}", in_quotes(catalog.task_names[step.subject]))
                 : in_quotes(catalog.behavior_names[step.subject]);
      break;
  }
  text = fmt::format("{}: {}", form.name, text);
  if (step.priority) text += fmt::format(", priority: {}", *step.priority);
  if (step.parameters) text += fmt::format(", parameters: {}", step.parameters->json);
  if (form.has_cause) text += fmt::format(", cause: {}", name_of(step.cause));
  return text;
}

std::string as_comment(const std::string& text) {
  std::string comment;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    comment += line.empty() ? "#\n" : "# " + line + "\n";
  }
  return comment;
}

}  // namespace

std::string write_script(const CompiledCatalog& catalog, const Script& script,
                         const std::string& comment, std::span<const std::string> comments) {
  std::string text = as_comment(comment);
  if (!script.catalog.empty()) text += fmt::format("catalog: {}\n", in_quotes(script.catalog));
  if (script.reactive_delay != Script{}.reactive_delay) {
    text += fmt::format("reactive_delay: {}\n", format_decimal(script.reactive_delay, 6));
  }
  if (!script.timeouts) text += "timeouts: false\n";
  if (!script.situation.is_empty()) {
    text += fmt::format("situation: {}\n", situation_map(catalog, script.situation));
  }
  text += script.steps.empty() ? "events: []\n" : "events:\n";
  Microseconds time = 0;
  for (std::size_t place = 0; place < script.steps.size(); ++place) {
    const Step& step = script.steps[place];
    if (place < comments.size()) text += as_comment(comments[place]);
    const std::string event = step_entry(catalog, step);
    time = step.time.value_or(time);
    text += fmt::format("- {{at: {}{}{}}}\n", format_decimal(time, 6), event.empty() ? "" : ", ",
                        event);
  }
  return text;
}

}  // namespace cbc
