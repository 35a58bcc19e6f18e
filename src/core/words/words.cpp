#include "core/words/words.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

double to_seconds(Microseconds time) {
  return static_cast<double>(time) / static_cast<double>(second);
}

std::string format_time(Microseconds time) {
  return fmt::format("{:.{}f}", to_seconds(time), time % 1000 == 0 ? 3 : 6);
}

std::string task_name(const CompiledCatalog& catalog, TaskId task) {
  const std::string_view name = catalog.name_of_task(task);
  return (catalog.find_behavior(name) ? "task " : "") + printable(name);
}

std::string behavior_name(const CompiledCatalog& catalog, BehaviorId behavior) {
  const std::string_view name = catalog.name_of_behavior(behavior);
  return (catalog.find_task(name) ? "behavior " : "") + printable(name);
}

std::vector<std::string> names_in_sentence(const CompiledCatalog& catalog,
                                           std::span<const TaskId> tasks) {
  std::vector<std::string> names;
  for (const TaskId task : tasks) names.push_back(task_name(catalog, task));
  return names;
}

std::vector<std::string> names_of_tasks(const CompiledCatalog& catalog,
                                        std::span<const TaskId> tasks) {
  std::vector<std::string> names;
  for (const TaskId task : tasks) names.push_back(printable(catalog.name_of_task(task)));
  return names;
}

std::vector<std::string> names_of_behaviors(const CompiledCatalog& catalog,
                                            std::span<const BehaviorId> behaviors) {
  std::vector<std::string> names;
  for (const BehaviorId id : behaviors) names.push_back(printable(catalog.name_of_behavior(id)));
  return names;
}

std::string place_in_catalog(const CompiledCatalog& catalog, std::uint32_t line) {
  return fmt::format(" ({}:{})", printable(catalog.file), line);
}

std::string describe_value(const CompiledCatalog& catalog, VariableValue value) {
  return fmt::format("{} is {}", printable(catalog.name_of_variable(value.variable)),
                     printable(catalog.name_of_value(value)));
}

std::string describe_situation(const CompiledCatalog& catalog, const Situation& situation) {
  std::vector<std::string> parts;
  for (const Availability& entry : situation.availability) {
    parts.push_back(fmt::format("{} {}", printable(catalog.behavior_names[entry.behavior]),
                                entry.available ? "available" : "unavailable"));
  }
  for (const VariableValue value : situation.variables) {
    parts.push_back(describe_value(catalog, value));
  }
  return parts.empty() ? "" : " " + join(parts, ", ");
}

namespace {

/// "start (LAND), stop and queue"
std::string describe_move_kinds(const CompiledCatalog& catalog, const MoveKinds& kinds) {
  std::vector<std::string> words;
  for (const MoveKindWord& known : move_kind_words) {
    if (!(kinds.*known.kind)) continue;
    std::string& word = words.emplace_back(known.word);
    const std::vector<TaskId> all;
    const auto& only = known.kind == &MoveKinds::start  ? kinds.start_only
                       : known.kind == &MoveKinds::stop ? kinds.stop_only
                                                        : all;
    if (only.empty()) continue;
    word += fmt::format(" ({})", join(only, ", ", [&](TaskId task) {
                          return printable(catalog.name_of_task(task));
                        }));
  }
  return list_with_and(words);
}

}  // namespace

std::string describe_property(const CompiledCatalog& catalog, const Property& property) {
  const std::string condition = describe_condition(catalog, property.condition);
  const auto task = [&] { return printable(catalog.name_of_task(property.task)); };
  std::string text;
  switch (property.kind) {
    case Property::Kind::can_start:
      text = fmt::format("{} can always start with priority {}", task(), property.priority);
      break;
    case Property::Kind::always:
      text = fmt::format("always {}", condition);
      break;
    case Property::Kind::never:
      text = fmt::format("never {}", condition);
      break;
    case Property::Kind::reachable:
      text = fmt::format("some state in which {}", condition);
      break;
    case Property::Kind::keeps_running:
      text = fmt::format("{} keeps running once it is requested", task());
      break;
    case Property::Kind::always_possible:
      text = fmt::format("it is always possible that {}", condition);
      break;
  }
  if (property.within) {
    text += fmt::format(", within {} more {}", *property.within,
                        *property.within == 1 ? "move" : "moves");
  }
  if (property.by) {
    const bool is_keeping = property.kind == Property::Kind::keeps_running;
    text += fmt::format(", {} {}", is_keeping ? "whatever moves there are of" : "by moves of",
                        describe_move_kinds(catalog, *property.by));
  }
  if (property.when) text += fmt::format(", when {}", describe_condition(catalog, *property.when));
  if (property.after) {
    text += fmt::format(", after {}", describe_condition(catalog, *property.after));
  }
  if (property.until) {
    text += fmt::format(", until {}", describe_condition(catalog, *property.until));
  }
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
  words.reserve(priorities.size());
  for (const std::int32_t priority : priorities) words.push_back(std::to_string(priority));
  return (words.size() == 1 ? "priority " : "priorities ") + list_with_and(words);
}

/// "LAND, DOCK and 7 more"
std::string list_some(std::vector<std::string> names, std::size_t most) {
  const std::size_t count = names.size();
  if (count > most) {
    names.resize(most - 1);
    names.push_back(fmt::format("{} more", count - names.size()));
  }
  return list_with_and(names);
}

/// Tasks that a script may request, though the assumptions do not: "; LOCALIZE is not".
std::string describe_unrequested(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  constexpr std::size_t most_names = 5;
  std::set<TaskId> requested;
  for (const Assumptions::Start& start : assumptions.start) requested.insert(start.task);
  std::vector<std::string> names;
  for (const TaskId task : catalog.task_ids) {
    if (!requested.contains(task)) names.push_back(printable(catalog.name_of_task(task)));
  }
  if (names.empty()) return {};
  const bool is_one = names.size() == 1;
  return fmt::format("; {} {} not", list_some(std::move(names), most_names), is_one ? "is" : "are");
}

/// "; up to 2 of 5 behaviors faulty at a time"
std::string describe_faults(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  if (assumptions.faults == 0) return "; none is faulty";
  std::string text = fmt::format("; up to {}", assumptions.faults);
  const std::size_t listed = assumptions.listed_for_faults.size();
  if (assumptions.only_listed_fail || listed > 0) {
    const std::size_t all = catalog.behaviors.size();
    const std::size_t fallible = assumptions.only_listed_fail ? listed : all - listed;
    text += fmt::format(" of {}", quantity(fallible, "behavior"));
  }
  return text + " faulty at a time";
}

/// "FLYING and HEIGHT"; of many some.
std::string list_variables(const CompiledCatalog& catalog,
                           const std::vector<std::uint32_t>& variables) {
  constexpr std::size_t most_names = 5;
  std::vector<std::string> names;
  names.reserve(variables.size());
  for (const std::uint32_t variable : variables) {
    names.push_back(printable(catalog.name_of_variable(variable)));
  }
  return list_some(std::move(names), most_names);
}

/// "; FLYING and HEIGHT may change at once"
std::string describe_together(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  const std::size_t lists = assumptions.together.size();
  if (lists == 0) return {};
  if (lists > 1) return fmt::format("; {} lists of variables may change at once", lists);
  return fmt::format("; {} may change at once",
                     list_variables(catalog, assumptions.together.front()));
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
  text += stops_the_same ? " and stopped" : fmt::format(", {} stopped", assumptions.stop.size());
  return text + describe_unrequested(catalog, assumptions);
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
  if (assumptions.most_failed) {
    text += fmt::format(", up to {} of them remembered", *assumptions.most_failed);
  }
  text += describe_faults(catalog, assumptions);
  if (assumptions.most_suspended) {
    text += fmt::format("; up to {} suspended", quantity(*assumptions.most_suspended, "request"));
  }
  const std::size_t variables = catalog.variables.size();
  if (variables > 0) {
    const std::size_t changing = assumptions.variables.size() - assumptions.frozen.size();
    text += changing == 0 ? "; no variable changes"
            : changing < variables
                ? fmt::format("; {} of {} variables change", changing, variables)
                : std::string(variables == 1 ? "; the variable changes" : "; all variables change");
  }
  if (!assumptions.frozen.empty()) {
    text +=
        fmt::format("; never keeps {} from changing", list_variables(catalog, assumptions.frozen));
  }
  text += describe_together(catalog, assumptions);
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
  std::string text = describe_event(catalog, record, step);
  if (!form_of(record.verb).is_decided) return text;
  return fmt::format("{}: {}", text, name_of(record.outcome));
}

std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped) {
  if (stopped.has_finished) return name_of(stopped.cause);
  if (record.verb == Verb::stop && record.task == stopped.task) {
    return name_of(ChangeCause::requested);
  }
  return name_of(stopped.priority ? ChangeCause::displaced : ChangeCause::released);
}

std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior) {
  return fmt::format(
      "{} is active, and goes on; the fault takes effect at its next activation; "
      "'finish: {}, cause: process_failure' stops it",
      behavior_name(catalog, behavior), printable(catalog.name_of_behavior(behavior)));
}

namespace {

/// Who performs tasks from now on, or goes on with the started one, without a change that says so;
/// and whose requests wait from now on, or wait no more.
std::string describe_taken_over(const CompiledCatalog& catalog, const EventRecord& record,
                                const State& state) {
  std::vector<std::string> sentences;
  for (const TaskId task : record.tasks_taken_over) {
    sentences.push_back(fmt::format("{}, which is active already, performs {}",
                                    behavior_name(catalog, state.behavior(task)),
                                    task_name(catalog, task)));
  }
  for (const StoppedTask& stopped : record.stopped_tasks) {
    if (!state.is_suspended(stopped.task)) continue;
    sentences.push_back(fmt::format("the request of {} waits", task_name(catalog, stopped.task)));
  }
  if (record.verb == Verb::stop && record.search == nullptr) {
    sentences.push_back(
        fmt::format("the request of {}, which waited, ends", task_name(catalog, record.task)));
  }
  if (record.verb == Verb::start && record.changes.empty() && sentences.empty()) {
    sentences.push_back(fmt::format("{} goes on performing {}",
                                    behavior_name(catalog, state.behavior(record.task)),
                                    task_name(catalog, record.task)));
  }
  return join(sentences, "; ");
}

}  // namespace

std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                          const State& state) {
  if (record.verb == Verb::stop && record.outcome == Outcome::unchanged) {
    return task_name(catalog, record.task) + " does not run";
  }
  if (record.outcome == Outcome::accepted) return describe_taken_over(catalog, record, state);
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
    std::vector<BehaviorId> behaviors;
    for (const std::uint32_t one : expected.behaviors) {
      behaviors.push_back(catalog.behavior_ids[one]);
    }
    parts.push_back(describe_running(catalog, catalog.task_ids[expected.task], behaviors));
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
  for (const std::uint32_t index : expectation.active_includes) {
    parts.push_back(fmt::format("{} is active", printable(catalog.behavior_names[index])));
  }
  return join(parts, ", ");
}

std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state) {
  std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue;
  for (const auto& [time, index] : state.queue().entries()) queue.emplace_back(index, time);
  for (TaskId task(0); state.waiting_count() > 0 && task < catalog.tasks.size(); ++task) {
    const std::uint32_t index = catalog.tasks[task].catalog_index;
    if (state.is_waiting(task) && !state.queue().has(index)) {
      queue.emplace_back(index, std::nullopt);
    }
  }
  std::sort(queue.begin(), queue.end());
  return queue;
}

}  // namespace cbc
