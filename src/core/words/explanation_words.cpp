#include "core/words/explanation_words.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "core/words/reason_words.h"
#include "core/words/suitability.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// More differences would hide the rest.
constexpr std::size_t most_differences = 20;

/// The name of a value.
std::string value_name(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  return place == none ? "not running"
                       : printable(catalog.name_of_behavior(catalog.values[task][place].behavior));
}

/// The same with its suitability.
std::string value_text(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  std::string name = value_name(catalog, task, place);
  if (place == none) return name;
  return fmt::format("{} ({})", name, format_percent(catalog.values[task][place].suitability));
}

/// How many of the supporting tasks run: "4 of 7".
std::string supporting_text(const ObjectiveValues& objective) {
  return fmt::format("{} of {}", objective.idle_running, objective.idle_total);
}

/// The values of the objective in which an answer that was not chosen is worse.
struct Figures {
  std::string_view name;    ///< in a few words
  std::string_view naming;  ///< in full
  std::string chosen;
  std::string other;
};

/// `state`: before the event or after it; what runs outside the group counts. Of objectives that
/// are a number.
Figures figures_of(const CompiledCatalog& catalog, GroupId group, const State& state,
                   const Configuration& chosen, const WhyNot& why_not) {
  const Configuration& other = *why_not.alternative;
  const auto served = [](const ObjectiveValues& objective) {
    return fmt::format("{} of {}", objective.satisfied, objective.requests);
  };
  switch (why_not.difference.criterion) {
    case Criterion::asked: {
      auto [ours, theirs] =
          shorten_both(exact_product(chosen.asked.degrees), exact_product(other.asked.degrees));
      return {"suitability of what was asked for",
              "the suitability of what was asked for, before what nobody asked for",
              std::move(ours), std::move(theirs)};
    }
    case Criterion::suitability: {
      auto [ours, theirs] =
          shorten_both(exact_suitability(catalog, state, group, chosen.assignment),
                       exact_suitability(catalog, state, group, other.assignment));
      return {"suitability", "the suitability of all that runs", std::move(ours),
              std::move(theirs)};
    }
    case Criterion::idle:
      return {"supporting tasks running", "the supporting tasks running",
              supporting_text(chosen.objective), supporting_text(other.objective)};
    case Criterion::changes:
      return {"changes", "the behaviors activated or deactivated",
              std::to_string(chosen.objective.changes), std::to_string(other.objective.changes)};
    default:
      return {"requests", "the requests served", served(chosen.objective), served(other.objective)};
  }
}

/// " (lost: A and B)": the requests that the alternative does not serve, unlike the answer, without
/// those of the tasks in question. `state`: before the event or after it.
std::string describe_lost_requests(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                   const WhyNot& why_not, std::span<const TaskId> in_question,
                                   const State& state) {
  std::vector<TaskId> lost;
  for (const TaskId task :
       differing_tasks(catalog, record.search->group, record.explanation.chosen.assignment,
                       why_not.alternative->assignment)) {
    const LocalTask place = task - catalog.group_tasks[record.search->group];
    const bool is_requested =
        state.has_request(task) || (record.verb == Verb::start && record.task == task);
    const bool is_in_question =
        std::find(in_question.begin(), in_question.end(), task) != in_question.end();
    if (!is_requested || is_in_question || why_not.alternative->assignment[place] != none) continue;
    lost.push_back(task);
  }
  if (lost.empty()) return {};
  return fmt::format(" (lost: {})", list_with_and(names_in_sentence(catalog, lost)));
}

/// The task, and all that it requires in an answer for its group.
std::vector<TaskId> needed_tasks(const CompiledCatalog& catalog, GroupId group,
                                 const Assignment& assignment, TaskId task) {
  std::vector<TaskId> needed{task};
  for (std::size_t next = 0; next < needed.size(); ++next) {
    const std::uint32_t index = assignment[needed[next] - catalog.group_tasks[group]];
    if (index == none) continue;
    const BehaviorId behavior = catalog.values[needed[next]][index].behavior;
    for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
      if (std::find(needed.begin(), needed.end(), requirement.task) == needed.end()) {
        needed.push_back(requirement.task);
      }
    }
  }
  return needed;
}

/// The line of an exclusion of two tasks; nothing if there is none.
std::optional<std::uint32_t> find_exclusion(const CompiledCatalog& catalog, TaskId task,
                                            TaskId other) {
  for (const std::uint32_t clique : catalog.task_cliques[task]) {
    const auto members = catalog.cliques[clique];
    if (task != other && std::find(members.begin(), members.end(), other) != members.end()) {
      return catalog.clique_lines[clique];
    }
  }
  return std::nullopt;
}

/// "REAR would need ENCODER, which excludes FRONT (robot.yaml:18)": why the two tasks of a
/// difference do not run together, if an exclusion of what they need is the reason.
std::string describe_rivalry(const CompiledCatalog& catalog, const ExplainedRecord& record,
                             const WhyNot& why_not) {
  const GroupId group = record.search->group;
  const TaskId served = why_not.difference.task;
  const TaskId other = why_not.difference.other_task;
  if (other == none) return {};
  for (const TaskId needed : needed_tasks(catalog, group, why_not.alternative->assignment, other)) {
    for (const TaskId excluded :
         needed_tasks(catalog, group, record.explanation.chosen.assignment, served)) {
      const auto line = find_exclusion(catalog, needed, excluded);
      if (!line) continue;
      std::string text = task_name(catalog, other);
      if (needed != other) text += fmt::format(" would need {}, which", task_name(catalog, needed));
      text += " excludes " + task_name(catalog, excluded);
      if (excluded != served) text += fmt::format(", which {} needs", task_name(catalog, served));
      return text + place_in_catalog(catalog, *line);
    }
  }
  return {};
}

/// "(priority 2, at 10.000 s)"
std::string describe_request(const RankedRequest& request) {
  const std::string priority = fmt::format("(priority {}", request.priority);
  return request.time ? fmt::format("{}, at {} s)", priority, format_time(*request.time))
                      : priority + ")";
}

/// Which of the requests of a difference is served, and by what rule.
std::string describe_order(const CompiledCatalog& catalog, const WhyNot& why_not) {
  if (why_not.difference.other_task == none) {
    return why_not.request.priority > 0 ? "its request waits, and comes back as soon as it can"
                                        : "it goes on where that makes nothing worse";
  }
  return fmt::format("the request of {} {} goes before that of {} {}{}",
                     task_name(catalog, why_not.difference.task), describe_request(why_not.request),
                     task_name(catalog, why_not.difference.other_task),
                     describe_request(why_not.other_request),
                     why_not.request.priority == why_not.other_request.priority
                         ? ", as the later one of equal priority"
                         : "");
}

/// " beside ARM, which this event starts": what makes the event choose between requests.
std::string describe_cause(const CompiledCatalog& catalog, const EventRecord& record) {
  if (record.verb != Verb::start) return {};
  return fmt::format(" beside {}, which this event starts", task_name(catalog, record.task));
}

/// The first objective in which the alternative of an answer loses.
std::string describe_loss(const CompiledCatalog& catalog, const ExplainedRecord& record,
                          const WhyNot& why_not, std::span<const TaskId> in_question,
                          const State& state) {
  const Configuration& chosen = record.explanation.chosen;
  const Difference& difference = why_not.difference;
  const GroupId group = record.search->group;
  const Figures figures = figures_of(catalog, group, state, chosen, why_not);
  switch (difference.criterion) {
    case Criterion::requests:
      return fmt::format("{} requests would be satisfied, not {}{}", figures.other,
                         chosen.objective.satisfied,
                         describe_lost_requests(catalog, record, why_not, in_question, state));
    case Criterion::request_order: {
      const std::string rivalry = describe_rivalry(catalog, record, why_not);
      return fmt::format("{} would not run{}{}{}; {}", task_name(catalog, difference.task),
                         describe_cause(catalog, record), rivalry.empty() ? "" : ": ", rivalry,
                         describe_order(catalog, why_not));
    }
    case Criterion::canonical: {
      const LocalTask task = difference.task - catalog.group_tasks[group];
      return fmt::format(
          "all objectives would be equal; for {}, {} comes before {} in the canonical order",
          task_name(catalog, difference.task),
          value_name(catalog, difference.task, chosen.assignment[task]),
          value_name(catalog, difference.task, why_not.alternative->assignment[task]));
    }
    default:
      return fmt::format("{} would be {}, not {}", figures.name, figures.other, figures.chosen);
  }
}

/// The same where the alternative is what somebody expected.
std::string describe_decision(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected) {
  const WhyNot& why_not = unexpected.why_unmet.why_not;
  const Difference& difference = why_not.difference;
  switch (difference.criterion) {
    case Criterion::request_order:
      if (difference.other_task == none) {
        return fmt::format("as {} {}; with what is expected, it would not run",
                           task_name(catalog, difference.task),
                           why_not.request.priority > 0 ? "comes back" : "goes on");
      }
      return fmt::format(
          "by the order of requests: {} is served; with what is expected, {} at best, and {}",
          task_name(catalog, difference.task), task_name(catalog, difference.other_task),
          describe_order(catalog, why_not));
    case Criterion::canonical:
      return fmt::format("by the canonical order of {}, since all objectives are equal",
                         task_name(catalog, difference.task));
    default:
      break;
  }
  const ExplainedRecord& event = *unexpected.why_unmet.event;
  const State& before = *unexpected.why_unmet.before;
  const Figures figures =
      figures_of(catalog, unexpected.group, before, event.explanation.chosen, why_not);
  return fmt::format("by {}: {}; with what is expected, {} at best{}", figures.naming,
                     figures.chosen, figures.other,
                     difference.criterion == Criterion::requests
                         ? describe_lost_requests(catalog, event, why_not, unexpected.tasks, before)
                         : "");
}

/// `condition`: what would differ in the alternative ("if it ran").
Sentences describe_against(const CompiledCatalog& catalog, const ExplainedRecord& record,
                           const std::string& subject, const std::string& condition,
                           const WhyNot& why_not, std::span<const TaskId> tasks, TaskId it,
                           const State& state) {
  if (why_not.is_cut) {
    return {subject + ": a search limit was reached before the reason was found", {}};
  }
  if (why_not.alternative) {
    return {fmt::format("{}: {}, {}", subject, condition,
                        describe_loss(catalog, record, why_not, tasks, state)),
            {}};
  }
  std::vector<std::string> reasons = describe_reasons(catalog, record, why_not.conflict, tasks, it);
  if (reasons.empty()) return {subject + ": the event leaves no other choice", {}};
  if (reasons.size() == 1) return {fmt::format("{}: {}", subject, reasons.front()), {}};
  return {subject + ":", std::move(reasons)};
}

/// Whether all of these reasons are among the others.
bool includes_all(std::span<const Reason> all, std::span<const Reason> some) {
  return std::all_of(some.begin(), some.end(), [&all](const Reason& reason) {
    return std::find(all.begin(), all.end(), reason) != all.end();
  });
}

/// Adds why behaviors were not chosen that suit their task better, unless that is told already.
void add_better(const CompiledCatalog& catalog, const ExplainedRecord& record, const Why& why,
                const State& state, Sentences& text) {
  const TaskId first = catalog.group_tasks[record.search->group];
  for (const BetterBehavior& better : why.better) {
    const WhyNot& why_not = better.why_not;
    if (!why_not.conflict.empty() && includes_all(why.why_not.conflict, why_not.conflict)) continue;
    const std::uint32_t chosen = record.explanation.chosen.assignment[better.task - first];
    const auto values = catalog.values[better.task];
    const std::string subject = fmt::format(
        "{} would suit {} better ({}, {} {})",
        behavior_name(catalog, values[better.value_index].behavior),
        task_name(catalog, better.task), format_percent(values[better.value_index].suitability),
        behavior_name(catalog, values[chosen].behavior),
        format_percent(values[chosen].suitability));
    Sentences told = describe_against(catalog, record, subject, "but with it", why_not,
                                      std::span(&better.task, 1), none, state);
    if (text.more.empty()) text.first += ';';
    text.more.push_back(std::move(told.first));
    for (const std::string& line : told.more) text.more.push_back("  " + line);
  }
}

/// Of some tasks those that can start without a request, and run in the alternative of an answer,
/// but not in the answer that the event chose: nothing that runs requires them.
std::vector<TaskId> unneeded_tasks(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                   const WhyNot& why_not, std::span<const TaskId> tasks) {
  std::vector<TaskId> unneeded;
  if (!why_not.alternative) return unneeded;
  const TaskId first = catalog.group_tasks[record.search->group];
  for (const TaskId task : tasks) {
    if (catalog.tasks[task].start_on_request != 0 ||
        record.explanation.chosen.assignment[task - first] != none ||
        why_not.alternative->assignment[task - first] == none) {
      continue;
    }
    unneeded.push_back(task);
  }
  return unneeded;
}

/// Of a task that is in the queue, or a behavior of one.
Sentences describe_due(const CompiledCatalog& catalog, const EventRecord& record, const Why& why) {
  const std::string task = task_name(catalog, why.queued_task);
  const std::string subject =
      why.behavior == none
          ? fmt::format("why {} does not run: it", task)
          : fmt::format("why {} is not active: {}", behavior_name(catalog, why.behavior), task);
  const std::string time = format_time(*why.due);
  if (why.why_not.conflict.empty()) {
    return {fmt::format("{} starts by itself at {} s", subject, time), {}};
  }
  return {fmt::format("{} tries to start at {} s, but", subject, time),
          describe_reasons(catalog, record, why.why_not.conflict, tasks_of(catalog, why))};
}

Sentences describe_decided(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected) {
  const ExplainedRecord& event = *unexpected.why_unmet.event;
  const WhyNot& why_not = unexpected.why_unmet.why_not;
  Sentences text;
  if (why_not.is_cut) {
    const bool is_proven = event.search->result.status == SearchStatus::optimal;
    text.first = fmt::format("decided at {}: {}", place_of(catalog, event),
                             is_proven ? "a search limit was reached before the reason was found"
                                       : "a search limit was reached, so it is not proven best");
    return text;
  }
  if (!why_not.alternative) {
    text.more = describe_reasons(catalog, event, why_not.conflict, unexpected.tasks);
    text.first =
        fmt::format("decided at {}: no answer meets the expectation{}", place_of(catalog, event),
                    text.more.empty() ? ", since the event leaves no other choice" : ":");
    return text;
  }
  const std::vector<TaskId> unneeded = unneeded_tasks(catalog, event, why_not, unexpected.tasks);
  text.first = fmt::format("decided at {}{} {}:", place_of(catalog, event),
                           unneeded.empty()
                               ? std::string()
                               : fmt::format(", where nothing that ran required {},",
                                             list_with_or(names_in_sentence(catalog, unneeded))),
                           describe_decision(catalog, unexpected));
  std::size_t count = 0;
  for (const TaskId task :
       differing_tasks(catalog, unexpected.group, event.explanation.chosen.assignment,
                       why_not.alternative->assignment)) {
    if (++count > most_differences) continue;
    const TaskId first = catalog.group_tasks[unexpected.group];
    text.more.push_back(
        fmt::format("{}: {} instead of {}", task_name(catalog, task),
                    value_text(catalog, task, event.explanation.chosen.assignment[task - first]),
                    value_text(catalog, task, why_not.alternative->assignment[task - first])));
  }
  if (count > most_differences) {
    text.more.push_back(fmt::format("and {} more", count - most_differences));
  }
  return text;
}

/// Which running task requires another one, or none.
TaskId find_requirer(const CompiledCatalog& catalog, const State& state, TaskId task) {
  for (const std::uint32_t index : state.running()) {
    const TaskId other = catalog.task_ids[index];
    const auto requirements = catalog.requirements[state.behavior(other)];
    if (std::any_of(
            requirements.begin(), requirements.end(),
            [task](const CompiledRequirement& required) { return required.task == task; })) {
      return other;
    }
  }
  return none;
}

/// "DRIVE does (robot.yaml:11), requested with priority 1 at 0.000 s"
std::string describe_rival(const CompiledCatalog& catalog, const BlockedStart::Rival& rival,
                           const State& state) {
  std::string text = fmt::format("{} does{}", task_name(catalog, rival.task),
                                 place_in_catalog(catalog, rival.line));
  if (const Request* const request = state.find_request(rival.task)) {
    text += request->priority == 0 ? ", which started by itself"
                                   : fmt::format(", requested with priority {}", request->priority);
    if (request->time) text += fmt::format(" at {} s", format_time(*request->time));
  } else if (const TaskId requirer = find_requirer(catalog, state, rival.task); requirer != none) {
    text += fmt::format(", which {} requires", task_name(catalog, requirer));
  }
  return text;
}

}  // namespace

std::string place_of(const CompiledCatalog& catalog, const EventRecord& event) {
  return fmt::format("event {} at {} s ({})", event.index, format_time(event.time),
                     describe_event(catalog, event, nullptr));
}

std::string describe_blocked(const CompiledCatalog& catalog, const BlockedStart& start,
                             const State& state) {
  const bool are_requested = std::all_of(
      start.rivals.begin(), start.rivals.end(), [&state](const BlockedStart::Rival& rival) {
        const Request* const request = state.find_request(rival.task);
        return request != nullptr && request->priority > 0;
      });
  return fmt::format(
      "{} starts by itself only while no task that it excludes runs{}; {}; a reactive start never "
      "stops {}",
      task_name(catalog, start.task), are_requested ? " on request" : "",
      join(start.rivals, ", and ",
           [&](const BlockedStart::Rival& rival) { return describe_rival(catalog, rival, state); }),
      start.rivals.size() == 1 ? "it" : "them");
}

bool is_over(const Reason& reason, const State& state) {
  switch (reason.kind) {
    case Reason::Kind::unavailable:
      return !state.is_denied(reason.behavior);
    case Reason::Kind::situation:
      return state.fits(reason.behavior);
    case Reason::Kind::faulty:
      return !state.is_faulty(reason.behavior);
    default:
      return false;
  }
}

Sentences describe_displacement(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                const Displacement& displaced, const State& state) {
  Sentences text =
      describe_against(catalog, record, task_name(catalog, displaced.task) + " stops", "if it ran",
                       displaced.why_not, std::span(&displaced.task, 1), displaced.task, state);
  const bool is_start = record.verb == Verb::start && record.origin == Origin::script;
  const auto stopped =
      std::find_if(record.stopped_tasks.begin(), record.stopped_tasks.end(),
                   [&](const StoppedTask& stop) { return stop.task == displaced.task; });
  const bool are_equal = stopped != record.stopped_tasks.end() && record.priority > 0 &&
                         stopped->priority == record.priority;
  if (is_start && are_equal && !displaced.why_not.alternative) {
    const std::string order =
        fmt::format("both have priority {}, and the later request goes first", record.priority);
    if (text.more.empty()) {
      text.first += "; " + order;
    } else {
      text.more.push_back(order);
    }
  }
  return text;
}

std::vector<TaskId> tasks_of(const CompiledCatalog& catalog, const Why& why) {
  if (why.queued_task != none) return {why.queued_task};
  if (why.behavior == none) return {why.task};
  std::vector<TaskId> tasks;
  for (const ValueId value : catalog.performs[why.behavior]) {
    tasks.push_back(catalog.task_of(value));
  }
  return tasks;
}

Sentences describe_why(const CompiledCatalog& catalog, const ExplainedRecord& record,
                       const Why& why, const State& state) {
  if (why.due) return describe_due(catalog, record, why);
  const std::vector<TaskId> tasks = tasks_of(catalog, why);
  const std::vector<TaskId> unneeded = unneeded_tasks(catalog, record, why.why_not, tasks);
  if (why.behavior != none) {
    const std::string condition =
        unneeded.empty() ? std::string()
                         : fmt::format("nothing that runs requires {}; ",
                                       list_with_or(names_in_sentence(catalog, unneeded)));
    Sentences text = describe_against(
        catalog, record,
        fmt::format("why {} is {}active", behavior_name(catalog, why.behavior),
                    why.is_active ? "" : "not "),
        condition + (why.is_active ? "without it" : "with it"), why.why_not, tasks, none, state);
    add_better(catalog, record, why, state, text);
    return text;
  }
  const std::string name = task_name(catalog, why.task);
  std::string condition;
  if (why.why_not.alternative) {
    const TaskId first = catalog.group_tasks[record.search->group];
    const std::uint32_t place = why.why_not.alternative->assignment[why.task - first];
    if (!unneeded.empty()) condition = "nothing that runs requires it; ";
    condition +=
        place == none ? "if it did not run" : "with " + value_name(catalog, why.task, place);
  }
  const std::string subject =
      why.chosen == none
          ? fmt::format("why {} does not run{}", name,
                        state.is_suspended(why.task) ? ", whose request waits" : "")
          : fmt::format("why {} has {}", name, printable(catalog.name_of_behavior(why.chosen)));
  Sentences text =
      describe_against(catalog, record, subject, condition, why.why_not, tasks, none, state);
  add_better(catalog, record, why, state, text);
  return text;
}

std::string describe_alternative(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                 std::size_t place, const State& state) {
  const std::vector<Configuration>& list = record.explanation.alternatives;
  const GroupId group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const Configuration& configuration = list[place];
  const ObjectiveValues& objective = configuration.objective;
  std::string text = fmt::format(
      "requests {} of {}, suitability {}, supporting tasks running {}, changes {}:",
      objective.satisfied, objective.requests,
      shorten_number(exact_suitability(catalog, state, group, configuration.assignment)),
      supporting_text(objective), objective.changes);
  bool is_first = true;
  for (LocalTask task(0); task < configuration.assignment.size(); ++task) {
    const std::uint32_t value = configuration.assignment[task];
    if (value == (place == 0 ? none : list.front().assignment[task])) continue;
    text += fmt::format(
        "{} {} {}",
        !is_first    ? ","
        : place == 0 ? ""
                     : " as 1, but",
        task_name(catalog, first + task),
        value == none ? "not running" : "= " + value_name(catalog, first + task, value));
    is_first = false;
  }
  return is_first ? text + " nothing runs" : text;
}

std::vector<TaskId> differing_tasks(const CompiledCatalog& catalog, GroupId group,
                                    const Assignment& one, const Assignment& other) {
  std::vector<TaskId> tasks;
  const TaskId first = catalog.group_tasks[group];
  for (LocalTask task(0); task < one.size(); ++task) {
    if (one[task] != other[task]) tasks.push_back(first + task);
  }
  std::sort(tasks.begin(), tasks.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].catalog_index < catalog.tasks[b].catalog_index;
  });
  return tasks;
}

std::vector<std::string> notes_of(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected,
                                  const State& state) {
  std::vector<std::string> notes;
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  const std::vector<Reason>& reasons = why_unmet.kind == WhyUnmet::Kind::rejected
                                           ? why_unmet.event->conflict
                                           : why_unmet.why_not.conflict;
  if (std::any_of(reasons.begin(), reasons.end(),
                  [&state](const Reason& reason) { return is_over(reason, state); })) {
    notes.emplace_back("this has changed since, but no later event has decided it anew");
  }
  for (const TaskId task : unexpected.tasks) {
    if (!state.is_running(task) || !state.is_faulty(state.behavior(task))) continue;
    std::string note = describe_late_fault(catalog, state.behavior(task));
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) {
      notes.push_back(std::move(note));
    }
  }
  return notes;
}

Sentences describe_unmet(const CompiledCatalog& catalog, const UnexpectedTasks& unexpected,
                         const State& state) {
  static const EventRecord nothing{};
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  switch (why_unmet.kind) {
    case WhyUnmet::Kind::undecided: {
      Sentences text;
      text.more = describe_reasons(catalog, nothing, why_unmet.why_not.conflict, unexpected.tasks);
      text.first = fmt::format("no event so far has started {}, or what requires it{}",
                               list_with_or(names_in_sentence(catalog, unexpected.tasks)),
                               text.more.empty() ? "" : ", and it cannot start by itself:");
      return text;
    }
    case WhyUnmet::Kind::blocked: {
      // That these exclude each other is told; what remains are behaviors that are unavailable.
      Sentences text;
      for (const Reason& reason : why_unmet.why_not.conflict) {
        if (reason.behavior != none) {
          text.more.push_back(describe_reason(catalog, nothing, reason));
        }
      }
      text.first = join(why_unmet.blocked, "; ", [&](const BlockedStart& start) {
        return describe_blocked(catalog, start, state);
      });
      return text;
    }
    case WhyUnmet::Kind::due:
      return {fmt::format("{} is due to start by itself at {} s",
                          task_name(catalog, why_unmet.queued_task), format_time(why_unmet.due)),
              {}};
    case WhyUnmet::Kind::rejected:
      return {place_of(catalog, *why_unmet.event) + " was rejected:",
              describe_rejection(catalog, *why_unmet.event)};
    case WhyUnmet::Kind::decided:
      return describe_decided(catalog, unexpected);
  }
  return {};
}

}  // namespace cbc
