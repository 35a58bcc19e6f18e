#include <cstddef>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "core/script/script.h"
#include "core/support/json.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc {

/// JSON writes what lies beyond U+FFFF and does not show as two escapes, which YAML does not take
/// for one character.
std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  const auto add = [&quoted](std::string_view part) {
    std::string json;
    append_text(json, part);
    quoted.append(json, 1, json.size() - 2);
  };
  std::size_t begin = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    if (decoded.character > 0xFFFF && is_control(decoded.character)) {
      add(text.substr(begin, offset - begin));
      quoted += fmt::format("\\U{:08x}", static_cast<std::uint32_t>(decoded.character));
      begin = offset + decoded.bytes;
    }
    offset += decoded.bytes;
  }
  add(text.substr(begin));
  return quoted + "\"";
}

namespace {

std::string describe(const CompiledCatalog& catalog, const Situation& situation) {
  std::string text;
  for (const Availability& entry : situation.availability) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ",
                        in_quotes(catalog.behavior_names[entry.behavior]), entry.available);
  }
  for (const VariableValue value : situation.variables) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ",
                        in_quotes(catalog.name_of_variable(value.variable)),
                        in_quotes(catalog.name_of_value(value)));
  }
  return fmt::format("{{{}}}", text);
}

std::string describe(const CompiledCatalog& catalog, const Expectation& expectation) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", part);
  };
  const auto join = [](const auto& items, const auto& name) {
    std::string all;
    for (const auto& item : items) all += fmt::format("{}{}", all.empty() ? "" : ", ", name(item));
    return all;
  };
  if (expectation.outcome) add(fmt::format("outcome: {}", name_of(*expectation.outcome)));
  if (!expectation.running.empty()) {
    add(fmt::format("running: {{{}}}", join(expectation.running, [&](const auto& running) {
                      return fmt::format("{}: {}", in_quotes(catalog.task_names[running.task]),
                                         running.behavior
                                             ? in_quotes(catalog.behavior_names[*running.behavior])
                                             : "any");
                    })));
  }
  if (!expectation.stopped.empty()) {
    add(fmt::format("stopped: [{}]", join(expectation.stopped, [&](std::uint32_t task) {
                      return in_quotes(catalog.task_names[task]);
                    })));
  }
  if (expectation.active) {
    add(fmt::format("active: [{}]", join(*expectation.active, [&](std::uint32_t behavior) {
                      return in_quotes(catalog.behavior_names[behavior]);
                    })));
  }
  return fmt::format("expect: {{{}}}", text);
}

std::string describe(const CompiledCatalog& catalog, const Step& step) {
  if (step.expect) return describe(catalog, *step.expect);
  const VerbForm& form = form_of(step.verb);
  std::string text;
  switch (form.subject) {
    case VerbForm::SubjectKind::nothing:
      return {};
    case VerbForm::SubjectKind::situation:
      return fmt::format("{}: {}", form.name, describe(catalog, step.situation));
    case VerbForm::SubjectKind::task:
      text = in_quotes(catalog.task_names[step.subject]);
      break;
    case VerbForm::SubjectKind::behavior:
      text = in_quotes(catalog.behavior_names[step.subject]);
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
    text += fmt::format("situation: {}\n", describe(catalog, script.situation));
  }
  text += "events:\n";
  for (std::size_t place = 0; place < script.steps.size(); ++place) {
    const Step& step = script.steps[place];
    if (place < comments.size()) text += as_comment(comments[place]);
    const std::string event = describe(catalog, step);
    text += fmt::format("- {{at: {}{}{}}}\n", format_decimal(step.time.value_or(0), 6),
                        event.empty() ? "" : ", ", event);
  }
  return text;
}

}  // namespace cbc
