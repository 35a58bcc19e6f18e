#include "core/report/event_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                           const Step* step) {
  const VerbForm& form = form_of(record.verb);
  std::string text(form.name);
  if (record.task != none && record.verb == Verb::finish) {
    text += " task " + printable(catalog.name_of_task(record.task));
    text += record.behavior == none
                ? ", which nothing performs"
                : " (" + printable(catalog.name_of_behavior(record.behavior)) + ")";
  } else if (record.task != none) {
    text += " " + printable(catalog.name_of_task(record.task));
    if (form.has_priority) text += fmt::format(", priority {}", record.priority);
  }
  if (record.behavior != none && record.task == none) {
    text += " " + behavior_name(catalog, record.behavior);
  }
  if (form.has_cause) text += fmt::format(", {}", name_of(record.cause));
  if (step != nullptr && record.verb == Verb::situation) {
    text += describe_situation(catalog, step->situation);
  }
  if (step != nullptr && step->parameters) text += " " + printable(step->parameters->json);
  if (record.origin != Origin::script) text += fmt::format(" ({})", name_of(record.origin));
  return text;
}

std::string event_and_outcome(const CompiledCatalog& catalog, const EventRecord& record,
                              const Step* step) {
  const std::string text = describe_event(catalog, record, step);
  if (!form_of(record.verb).is_decided) return text;
  return fmt::format("{}: {}", text, name_of(record.outcome));
}

std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped) {
  if (stopped.has_finished) return name_of(stopped.cause);
  if (record.verb == Verb::stop && record.task == stopped.task) {
    return name_of(ChangeCause::requested);
  }
  return name_of(stopped.had_request ? ChangeCause::displaced : ChangeCause::released);
}

std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior) {
  return fmt::format(
      "{} is active, and goes on; the fault takes effect at its next activation; "
      "'finish: {}, cause: process_failure' stops it",
      behavior_name(catalog, behavior), printable(catalog.name_of_behavior(behavior)));
}

std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                          const State& state) {
  if (record.verb == Verb::stop && record.outcome == Outcome::unchanged) {
    return task_name(catalog, record.task) + " does not run";
  }
  const BehaviorId behavior = record.behavior;
  if (behavior == none) return {};
  const std::string name = behavior_name(catalog, behavior);
  const bool is_active = state.is_active(behavior);
  if (record.verb == Verb::fault && is_active) {
    return describe_late_fault(catalog, behavior);
  }
  if (record.verb != Verb::finish || record.outcome != Outcome::unchanged || is_active) return {};
  std::vector<std::string> instead;
  for (const ValueId value : catalog.performs[behavior]) {
    const TaskId task = catalog.task_of(value);
    const std::string task_text = task_name(catalog, task);
    instead.push_back(
        state.is_running(task)
            ? fmt::format("{} performs {}", behavior_name(catalog, state.behavior(task)), task_text)
            : fmt::format("nothing performs {}", task_text));
  }
  return fmt::format("{} is not active: {}", name, join(instead, ", "));
}

std::string describe_expectation(const CompiledCatalog& catalog, const Expectation& expectation) {
  std::vector<std::string> parts;
  if (expectation.outcome)
    parts.push_back(fmt::format("outcome {}", name_of(*expectation.outcome)));
  for (const Expectation::Running& expected : expectation.running) {
    parts.push_back(
        describe_running(catalog, catalog.task_ids[expected.task],
                         expected.behavior ? catalog.behavior_ids[*expected.behavior] : none));
  }
  for (const std::uint32_t task : expectation.stopped) {
    parts.push_back(printable(catalog.task_names[task]) + " does not run");
  }
  if (expectation.active) {
    const auto name = [&](std::uint32_t index) { return printable(catalog.behavior_names[index]); };
    parts.push_back(expectation.active->empty()
                        ? "no behavior is active"
                        : "active exactly: " + join(*expectation.active, ", ", name));
  }
  return join(parts, ", ");
}

std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state) {
  std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue;
  for (const auto& [time, index] : state.queue().entries()) queue.emplace_back(index, time);
  for (TaskId task = 0; state.waiting_count() > 0 && task < catalog.tasks.size(); ++task) {
    const std::uint32_t index = catalog.tasks[task].catalog_index;
    if (state.is_waiting(task) && !state.queue().has(index)) {
      queue.emplace_back(index, std::nullopt);
    }
  }
  std::sort(queue.begin(), queue.end());
  return queue;
}

}  // namespace cbc
