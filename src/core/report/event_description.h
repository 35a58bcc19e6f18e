#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/compile/compile.h"
#include "core/report/event_json.h"
#include "core/report/explanation_json.h"
#include "core/report/search_stats.h"
#include "core/script/state_json.h"
#include "core/support/json_description.h"
#include "core/words/suitability.h"
#include "core/words/words.h"

// The description of an event.

namespace cbc::json {

/// The tasks that run after an event, what they were requested with, and what is in the queue.
struct Running {
  Running(const CompiledCatalog& of, const State& after)
      : catalog(of), state(after), tasks(after.running()) {}

  const CompiledCatalog& catalog;
  const State& state;
  std::vector<std::uint32_t> tasks;  ///< by their places in the catalog
};

inline constexpr auto state_after = group(
    member("running",
           named("running", "The running tasks, in catalog order, each with its behavior.",
                 map(text, behavior)),
           "",
           [](const Running& of) {
             return [&of](const auto& put) {
               for (const std::uint32_t place : of.tasks) {
                 put(of.catalog.task_names[place], of.state.behavior(of.catalog.task_ids[place]));
               }
             };
           }),
    member("requests", map(text, priority),
           "After the event: the running tasks that have a request, with its priority (0: the task "
           "started by itself), in catalog order.",
           [](const Running& of) {
             return [&of](const auto& put) {
               for (const std::uint32_t place : of.tasks) {
                 const TaskId id = of.catalog.task_ids[place];
                 if (!of.state.has_request(id)) continue;
                 put(of.catalog.task_names[place], of.state.request(id).priority);
               }
             };
           }),
    optional("suspended", map(text, priority),
             "After the event: the tasks whose request is suspended, with its priority, in catalog "
             "order. Only where the catalog has one of the keys requestable, reactive_priority, "
             "improve, resume, retry and at_most.",
             [](const Running& of) {
               const auto write = [&of](const auto& put) {
                 for (const TaskId id : of.catalog.task_ids) {
                   if (!of.state.is_suspended(id)) continue;
                   put(of.catalog.name_of_task(id), of.state.find_own_request(id)->priority);
                 }
               };
               return of.catalog.has_further_keys() ? std::optional(write) : std::nullopt;
             }),
    optional("failed", behaviors,
             "After the event: the behaviors that have failed, and are not tried again at any "
             "event, in catalog order. Where `suspended` is.",
             [](const Running& of) {
               const auto failed = [&of] {
                 std::vector<BehaviorId> ids;
                 for (const BehaviorId id : of.catalog.behavior_ids) {
                   if (of.state.has_failed(id)) ids.push_back(id);
                 }
                 return ids;
               };
               return of.catalog.has_further_keys() ? std::optional(failed()) : std::nullopt;
             }),
    member("queue", map(text, nullable(positive_seconds)),
           "After the event: the scheduled reactive tasks, with the times when they are due, in "
           "seconds on the clock; null for a task that is not scheduled, but waits for a change of "
           "its group; in catalog order.",
           [](const Running& of) {
             return [&of](const auto& put) {
               for (const auto& [place, time] : queue_of(of.catalog, of.state)) {
                 put(of.catalog.task_names[place], time);
               }
             };
           }));

/// All that is said of an event.
struct EventWithState : Decision {
  const Step* step;  ///< the scripted one, or null
  const EventAdditions& adds;
  Running running;
};

inline constexpr auto finish_cause =
    named("finish_cause",
          "goal_achieved is success; situation_change is a change of the situation; the others are "
          "failures.",
          words(FinishCause::interrupted));

/// The subject of an event.
struct SubjectName {
  [[nodiscard]] static bool has(const EventRecord& record) {
    return record.task != none || record.behavior != none;
  }
  void write(JsonWriter& json, const EventRecord& record, const Decision& in) const {
    if (record.behavior != none) {
      behavior.write(json, record.behavior, in);
    } else if (record.verb == Verb::finish) {
      json.put(nullptr);
    } else {
      task.write(json, record.task, in);
    }
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    nullable(text).put_schema(json, definitions);
  }
};

inline constexpr auto what_happened = group(
    member("index", integer(1), "Number of the event, from 1, counting all events.",
           &EventRecord::index),
    member("time", seconds,
           "Time on the clock of the coordinator, in seconds from 0, exact to the microsecond.",
           &EventRecord::time),
    member("origin", words(Origin::repair),
           "Where the event comes from: the script or the input stream; the clock, as a timeout or "
           "a reactive start; fault: a behavior that a rejected event could not activate again; "
           "situation: an active behavior that does not fit the situation any more, or a group "
           "that is reconsidered after it; repair: the latter after a repair.",
           &EventRecord::origin),
    member("verb", words(Verb::reconsider),
           "What the event requests or reports; reconsider: a group is decided anew.",
           &EventRecord::verb),
    optional("task", task, "For finish, if a task was given in place of a behavior: the task.",
             [](const EventRecord& of) { return of.verb == Verb::finish ? of.task : none; }),
    optional(
        "name", SubjectName(),
        "The task that the event is about, such as that of start; of finish, fault and repair the "
        "behavior. null for a finish that names a task which nothing performs.",
        std::identity()),
    optional("priority", priority,
             "For start and stop: the priority; higher is stronger. 0 for a reactive start, and by "
             "default for a stop of a task without a request.",
             [](const EventRecord& of) {
               return form_of(of.verb).has_priority ? &of.priority : nullptr;
             }),
    optional(
        "cause", finish_cause, "For finish: why the behavior ended.",
        [](const EventRecord& of) { return form_of(of.verb).has_cause ? &of.cause : nullptr; }));

inline constexpr auto event_situation =
    named("situation",
          "Maps behaviors to whether they can be activated, and situation variables to values.",
          situation);
inline constexpr auto event_variables = named(
    "variables",
    "Values of situation variables: true or false for those declared without values, texts for the "
    "others.",
    situation);

/// What a script says of its events.
inline constexpr auto what_was_said = group(
    optional("parameters", free_object, "For start: the parameters, if any, unchanged.",
             [](const EventWithState& of) {
               return of.step != nullptr && of.step->parameters ? &of.step->parameters->json
                                                                : nullptr;
             }),
    optional("situation", event_situation,
             "For situation: which behaviors can be activated from now on, and which cannot, and "
             "new values of situation variables.",
             [](const EventWithState& of) {
               const bool is_there = of.step != nullptr && of.record.verb == Verb::situation;
               return is_there ? std::optional(entries_of(of.step->situation, of.catalog))
                               : std::nullopt;
             }),
    optional(
        "variables", event_variables,
        "For situation, of a catalog with situation variables: the values of all of them after "
        "the event.",
        [](const EventWithState& of) {
          const bool is_there = of.step != nullptr && of.record.verb == Verb::situation &&
                                !of.catalog.variables.empty();
          return is_there ? std::optional(entries_of(of.state.variables(), of.catalog))
                          : std::nullopt;
        }));

inline constexpr auto change =
    object(
        "change", "One activation or deactivation of a behavior.",
        member("op", WordList<2>{{"deactivate", "activate"}}, "", &Change::is_activation),
        member("behavior", behavior, "", &Change::behavior),
        member("tasks", tasks.at_least(1),
               "The tasks that the behavior performs from now on (activation) or performed until "
               "now (deactivation), in catalog order.",
               [](const Change& of, const Decision& in) { return in.record.tasks_of(of); }),
        member("cause", words(ChangeCause::undone),
               "For an activation: requested (its task has a request of priority 1 or higher), "
               "resumed (its request was suspended), reactive (it starts by itself, or has a "
               "request of priority 0), required (no request). For a deactivation: "
               "requested (a stop event stops its task), replaced (its task continues with another "
               "behavior), displaced (its task had a request), released (its task had none). For "
               "both: restarted (to apply other parameters), undone (rolls back an earlier change "
               "of the same event).",
               &Change::cause),
        member("priority", nullable(priority),
               "The highest priority of the requests of its tasks: after the event for an "
               "activation, before it for a deactivation. Null if there is no request, and for "
               "undone.",
               &Change::priority),
        member("success", boolean,
               "false: the activation failed because the behavior was faulty, and the event was "
               "solved again.",
               &Change::success))
        .related(R"([
      {"if": {"properties": {"op": {"const": "activate"}}},
       "then": {"properties": {"cause": {"enum": ["requested", "resumed", "reactive", "required", "restarted", "undone"]}}},
       "else": {"properties": {"cause": {"enum": ["requested", "replaced", "displaced", "released", "restarted", "undone"]},
         "success": {"const": true}}}},
      {"if": {"properties": {"op": {"const": "activate"},
         "cause": {"enum": ["requested", "resumed", "restarted"]}}},
       "then": {"properties": {"priority": {"type": "integer", "minimum": 1}}}},
      {"if": {"properties": {"cause": {"const": "reactive"}}},
       "then": {"properties": {"priority": {"type": "integer"}}}},
      {"if": {"properties": {"cause": {"const": "displaced"}}},
       "then": {"properties": {"priority": {"type": "integer"}}}},
      {"if": {"properties": {"cause": {"enum": ["required", "released", "undone"]}}},
       "then": {"properties": {"priority": {"type": "null"}}}}])");

/// Why a task stopped, as in the text.
struct StopWord {
  void write(JsonWriter& json, const StoppedTask& stopped, const Decision& in) const {
    json.put(stop_word(in.record, stopped));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.open("enum", '[');
    for (const std::string_view word : words_of<FinishCause>()) json.write(word);
    for (const ChangeCause cause :
         {ChangeCause::requested, ChangeCause::displaced, ChangeCause::released}) {
      json.write(name_of(cause));
    }
    json.close(']');
  }
};

/// Why the request of a task could not go on; null if it was not displaced.
inline constexpr auto displacement_of = [](const StoppedTask& stopped,
                                           const Decision& in) -> const Displacement* {
  const std::vector<Displacement>& displaced = in.record.explanation.displaced;
  const auto found =
      std::find_if(displaced.begin(), displaced.end(),
                   [&stopped](const Displacement& entry) { return entry.task == stopped.task; });
  return found == displaced.end() ? nullptr : &*found;
};

inline constexpr auto stopped_task =
    object(
        "stopped_task", "", member("task", task, "", &StoppedTask::task),
        member(
            "cause", StopWord(),
            "For the tasks of the finished behavior, the cause of the finish event. For others "
            "requested (this event stops the task), displaced (it had a request), or released (it "
            "had none).",
            std::identity()),
        optional(
            "conflict", list(pointed(reason)),
            "Of a task that had a request of priority 1 or higher: why it could not go on, a "
            "minimal set of reasons. Empty if the event alone rules it out, or if it could, but "
            "in a worse configuration.",
            [](const StoppedTask& of, const Decision& in) {
              using Reasons = std::vector<const Reason*>;
              if (of.priority.value_or(0) == 0) return std::optional<Reasons>();
              const Displacement* const displaced = displacement_of(of, in);
              if (displaced == nullptr) return std::optional(Reasons());
              return std::optional(
                  in_order(displaced->why_not.conflict, std::span(&of.task, 1), in));
            }),
        optional(
            "message", text,
            "Of a displaced task, unless a limit ended the search: why it could not go on, as a "
            "sentence for people.",
            [](const StoppedTask& of, const Decision& in) {
              const Displacement* const displaced = displacement_of(of, in);
              return displaced == nullptr ? std::nullopt
                                          : std::optional(message_of(describe_displacement(
                                                in.catalog, in.record, *displaced, in.state)));
            }))
        .related(R"([
      {"if": {"properties": {"cause": {"const": "released"}}},
       "then": {"properties": {"conflict": false, "message": false}}},
      {"if": {"properties": {"cause": {"const": "requested"}}},
       "then": {"properties": {"message": false}}}])");

inline constexpr auto bound = object(
    "bound",
    "What the best answer reaches at most, over the whole catalog. Of a feasible "
    "answer.",
    member("satisfied", count, "No answer satisfies more requests.", &AnswerBound::satisfied),
    member("suitability", share,
           "The suitability of the best answer is not higher. It may be lower than that of "
           "this answer if the best one satisfies other requests.",
           &AnswerBound::suitability));

inline constexpr auto search =
    object(
        "search", "",
        member(
            "status", words(SearchStatus::unknown),
            "optimal: proven best. feasible: the best solution so far when a limit stopped the "
            "search. infeasible: proven to have no solution. unknown: a limit stopped the search "
            "before the first solution.",
            [](const SearchRecord& of) { return of.result.status; }),
        member("group", count,
               "The group that was searched: a set of tasks that constraints connect. Groups are "
               "numbered from 0, ordered by their first task.",
               &SearchRecord::group),
        member("space", large_number,
               "Number of configurations of the group before the search: the product of the domain "
               "sizes. A text, since it may exceed any number format.",
               [](const SearchRecord& of) { return cbc::search_space(of.domain_sizes); }),
        member(
            "protection", priority,
            "The protection level: tasks with a request of a higher priority were not allowed to "
            "stop. For a finish, the last level tried.",
            &SearchRecord::protection),
        member("solutions", count,
               "Number of solutions found, each better than the previous one (with "
               "--max-solutions, all of them).",
               [](const SearchRecord& of) { return of.result.solutions; }),
        member("nodes", count, "Number of decisions.",
               [](const SearchRecord& of) { return of.result.nodes; }),
        optional("bound", bound, "",
                 [](const SearchRecord& of, const Decision& in) {
                   return of.result.status == SearchStatus::feasible
                              ? std::optional(bound_of_answer(in.catalog, in.record, in.state))
                              : std::nullopt;
                 }),
        optional(
            "propagations", count,
            "How often the constraints of a changed task were applied to the others. With "
            "--stats.",
            [](const SearchRecord& of) { return of.elapsed ? &of.result.propagations : nullptr; }),
        optional("elapsed_us", number,
                 "Time of the search in microseconds, exact to the nanosecond. With --stats.",
                 [](const SearchRecord& of) {
                   return of.elapsed ? std::optional(to_microseconds(
                                           static_cast<std::uint64_t>(of.elapsed->count())))
                                     : std::nullopt;
                 }))
        .related(R"([
      {"dependentRequired": {"propagations": ["elapsed_us"], "elapsed_us": ["propagations"]}},
      {"if": {"properties": {"status": {"const": "feasible"}}},
       "then": {"properties": {"bound": true}, "required": ["bound"]},
       "else": {"properties": {"bound": false}}}])");

inline constexpr auto why =
    object(
        "why",
        "Why a task has its behavior or does not run, or why a behavior is active or not: where "
        "the "
        "best alternative is worse, or why there is none.",
        optional("task", task, "Present if --why names a task.",
                 [](const Why& of) { return of.behavior == none ? of.task : none; }),
        optional("chosen", nullable(behavior), "The behavior of the task; null if it does not run.",
                 [](const Why& of) { return of.behavior == none ? &of.chosen : nullptr; }),
        optional("behavior", behavior, "Present if --why names a behavior.", &Why::behavior),
        optional("active", boolean, "Whether the behavior is active.",
                 [](const Why& of) { return of.behavior != none ? &of.is_active : nullptr; }),
        optional(
            "due", positive_seconds,
            "Of a reactive task that is in the queue after the event, or a behavior of it: "
            "when it is due, in seconds on the clock. The conflict then says what would hinder "
            "its start; it is empty if nothing would.",
            &Why::due),
        part(&Why::why_not,
             why_not("The best configuration in which this is different; null if there is none, or "
                     "no answer.")),
        member("conflict",
               list(pointed(restricted(reason, R"({"kind": {"not": {"const": "priority"}}})"))),
               "Why there is no alternative: a minimal set of reasons. Empty if the start that the "
               "event asks for leaves no choice.",
               [](const Why& of, const Decision& in) {
                 return in_order(of.why_not.conflict, tasks_of(in.catalog, of), in);
               }),
        member("message", text, sentence,
               [](const Why& of, const Decision& in) {
                 return message_of(describe_why(in.catalog, in.record, of, in.state));
               }))
        .related(R"([
      {"oneOf": [{"properties": {"task": true}, "required": ["task"]},
        {"properties": {"behavior": true}, "required": ["behavior"]}]},
      {"dependentRequired": {"task": ["chosen"],
        "chosen": ["task"],
        "behavior": ["active"],
        "active": ["behavior"]}},
      {"if": {"properties": {"alternative": {"type": "null"}}},
       "then": {"properties": {"loses": {"type": "null"},
         "differences": {"type": "array", "maxItems": 0}}},
       "else": {"properties": {"limit_reached": {"const": false},
         "loses": {"type": "object"},
         "conflict": {"type": "array", "maxItems": 0}}}},
      {"if": {"properties": {"limit_reached": {"const": true}}},
       "then": {"properties": {"conflict": {"type": "array", "maxItems": 0}}}}])");

inline constexpr auto alternatives =
    object("alternatives", "With --alternatives: the best configurations.",
           member("limit_reached", boolean,
                  "The list is incomplete, since finding the rest would have taken too long.",
                  &Explanation::is_list_cut),
           member("configurations", list(configuration),
                  "The best configuration first; it is the chosen one. Empty if the event was not "
                  "accepted, or if a limit stopped its search.",
                  &Explanation::alternatives));

inline constexpr auto record_of = [](const auto& of) -> const EventRecord& { return of.record; };

/// Which members an event has by its verb, and what each origin makes.
inline constexpr std::string_view relations_by_verb = R"([
      {"$comment": "The members that an event of each verb has.",
       "if": {"properties": {"verb": {"enum": ["start", "stop"]}}},
       "then": {"properties": {"priority": true}, "required": ["priority"]},
       "else": {"properties": {"priority": false}}},
      {"if": {"properties": {"verb": {"enum": ["situation", "wait"]}}},
       "then": {"properties": {"name": false}},
       "else": {"properties": {"name": true}, "required": ["name"]}},
      {"$comment": "Only a finish that names a task may be about no behavior.",
       "if": {"properties": {"verb": {"const": "finish"}}, "required": ["task"]},
       "else": {"properties": {"task": false, "name": {"type": "string"}}}},
      {"if": {"properties": {"verb": {"const": "finish"}}},
       "then": {"properties": {"cause": true}, "required": ["cause"]},
       "else": {"properties": {"cause": false}}},
      {"if": {"properties": {"verb": {"const": "situation"}}},
       "then": {"properties": {"situation": true}, "required": ["situation"]},
       "else": {"properties": {"situation": false, "variables": false}}},
      {"if": {"properties": {"verb": {"const": "start"}, "origin": {"const": "script"}}},
       "then": {"properties": {"priority": {"type": "integer", "minimum": 1}}},
       "else": {"properties": {"parameters": false}}},
      {"$comment": "What each origin makes.",
       "if": {"properties": {"origin": {"const": "timeout"}}},
       "then": {"properties": {"verb": {"const": "finish"}, "cause": {"const": "time_out"}}}},
      {"if": {"properties": {"origin": {"const": "reactive"}}},
       "then": {"properties": {"verb": {"const": "start"}, "priority": {"const": 0}}}},
      {"if": {"properties": {"origin": {"const": "fault"}}},
       "then": {"properties": {"verb": {"const": "finish"}, "cause": {"const": "process_failure"}}}},
      {"if": {"properties": {"origin": {"const": "situation"}}},
       "then": {"properties": {"verb": {"const": "finish"}, "cause": {"const": "situation_change"}}}}])";

inline constexpr auto event =
    object(
        "event", "An event, the answer, and the state after it.", part(record_of, what_happened),
        what_was_said,
        member("outcome", words(Outcome::unchanged),
               "accepted: the best configuration was found and applied. rejected: there is none, "
               "and nothing changed. unchanged: there was nothing to solve.",
               [](const EventWithState& of) { return of.record.outcome; }),
        unlisted(optional("note", text, "",
                          [](const EventWithState& of) {
                            const std::string note =
                                of.adds.note ? describe_note(of.catalog, of.record, of.state)
                                             : std::string();
                            return note.empty() ? std::nullopt : std::optional(note);
                          })),
        part(
            record_of,
            group(member("changes", list(change),
                         "The activations and deactivations, in the order in which they were "
                         "applied. For a rejected event, those that were tried until an activation "
                         "failed, and their rollback.",
                         &EventRecord::changes),
                  member("stopped_tasks", list(stopped_task),
                         "Tasks that ran before the event but not after it, in catalog order.",
                         &EventRecord::stopped_tasks))),
        part(&EventWithState::running, state_after),
        member("objective", nullable(objective),
               "The objective of the configuration after the event; null if none was found or "
               "searched for.",
               [](const EventWithState& of) {
                 return of.record.objective
                            ? std::optional(Objective{*of.record.objective,
                                                      total_suitability(of.catalog, of.state)})
                            : std::nullopt;
               }),
        member("search", nullable(search), "How the answer was found; null if there was no search.",
               [](const EventWithState& of) { return of.record.search; }),
        member(
            "conflict",
            list(pointed(
                restricted(reason, R"({"kind": {"not": {"enum": ["finished", "stopped"]}}})"))),
            "Why the event was rejected: a minimal set of reasons. Together they rule out every "
            "solution; without any one of them there is a solution. Empty if a limit stopped the "
            "search, or if finding the set would have taken too long.",
            [](const EventWithState& of) { return in_order(of.record.conflict, {}, of); }),
        optional(
            "why", list(why),
            "With --why: the answers about the named tasks and behaviors that are in the group "
            "of the event. Empty if the event was not accepted, or if a limit stopped its "
            "search.",
            [](const EventWithState& of) {
              return of.adds.why ? &of.record.explanation.why : nullptr;
            }),
        optional("alternatives", alternatives, "",
                 [](const EventWithState& of) {
                   return of.adds.alternatives ? &of.record.explanation : nullptr;
                 }))
        .related(relations_by_verb, R"([
      {"$comment": "What there is with each outcome.",
       "if": {"properties": {"verb": {"enum": ["start", "stop", "finish"]}}},
       "else": {"properties": {"outcome": {"const": "unchanged"}}}},
      {"if": {"properties": {"outcome": {"const": "accepted"}}},
       "then": {"properties": {"objective": {"type": "object"},
         "search": {"type": "object",
          "properties": {"status": {"enum": ["optimal", "feasible"]}}},
         "conflict": {"type": "array", "maxItems": 0}}},
       "else": {"properties": {"stopped_tasks": {"type": "array", "maxItems": 0},
         "objective": {"type": "null"},
         "why": {"type": "array", "maxItems": 0}}}},
      {"if": {"properties": {"outcome": {"const": "unchanged"}}},
       "then": {"properties": {"changes": {"type": "array", "maxItems": 0},
         "search": {"type": "null"},
         "conflict": {"type": "array", "maxItems": 0}}}},
      {"if": {"properties": {"outcome": {"const": "rejected"}, "search": {"type": "null"}}},
       "then": {"properties": {"conflict": {"type": "array",
          "minItems": 1,
          "maxItems": 1,
          "items": {"type": "object", "properties": {"kind": {"const": "priority"}}}}}}},
      {"if": {"properties": {"outcome": {"const": "rejected"}, "search": {"type": "object"}}},
       "then": {"properties": {"search": {"type": "object",
          "properties": {"status": {"enum": ["infeasible", "unknown"]}}},
         "conflict": {"type": "array",
          "items": {"type": "object",
           "properties": {"kind": {"not": {"const": "priority"}}}}}}}}])");

}  // namespace cbc::json
