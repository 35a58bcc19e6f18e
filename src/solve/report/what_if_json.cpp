#include <string>
#include <string_view>

#include "core/report/event_description.h"
#include "core/report/event_json.h"
#include "core/support/json.h"
#include "core/support/json_description.h"
#include "solve/report/what_if_report.h"

namespace cbc {
namespace json::what_if {

/// A move with what it does.
struct Described {
  const PossibleMove& move;
  const EventWithState& event;  ///< the first one of it
  MoveEffects effects;
};

/// The behaviors that perform some tasks after a move.
constexpr auto with_behaviors = [](const std::vector<TaskId>& tasks, const Described& of) {
  return [&tasks, &of](const auto& put) {
    for (const TaskId task : tasks) put(task, of.move.after().behavior(task));
  };
};

constexpr auto outcome = member(
    "outcome", words(Outcome::unchanged),
    "accepted, or rejected, in which case nothing changes. unchanged: there is nothing to decide.",
    [](const EventRecord& of) { return of.outcome; });

constexpr auto following =
    object("following", "An event that follows at once from another one.", what_happened, outcome)
        .related(relations_by_verb, R"([
      {"properties": {"verb": {"enum": ["finish", "reconsider"]},
         "origin": {"enum": ["fault", "situation", "repair"]}}}])");

constexpr auto event_of = [](const Described& of) -> const EventWithState& { return of.event; };

constexpr auto move =
    object(
        "move", "Something that could happen next, and what it would do.",
        part(event_of,
             group(part(record_of, what_happened), what_was_said, part(record_of, group(outcome)))),
        member("started", map(task, behavior),
               "The tasks that would run, but do not run now, in catalog order, each with its "
               "behavior.",
               [](const Described& of) { return with_behaviors(of.effects.started, of); }),
        member(
            "stopped", tasks, "The tasks that run now, but would not, in catalog order.",
            [](const Described& of) -> const auto& { return of.effects.stopped; }),
        member("changed", map(task, behavior),
               "The tasks that would go on with another behavior, in catalog order, each with "
               "that behavior.",
               [](const Described& of) { return with_behaviors(of.effects.changed, of); }),
        member("requested", map(task, priority),
               "The tasks that would go on with a request of another priority, in catalog order, "
               "each with that priority.",
               [](const Described& of) {
                 return [&of](const auto& put) {
                   for (const TaskId id : of.effects.requested) {
                     put(id, of.move.after().request(id).priority);
                   }
                 };
               }),
        member(
            "failed", behaviors,
            "The behaviors whose activation would be tried and fail, as they are faulty, in "
            "catalog order.",
            [](const Described& of) -> const auto& { return of.effects.failed; }),
        optional("suspended", map(task, priority),
                 "The tasks whose request would be suspended, in catalog order, each with its "
                 "priority. Only where the catalog has keys for it.",
                 [](const Described& of) {
                   const auto write = [&of](const auto& put) {
                     for (const TaskId id : of.effects.suspended) {
                       put(id, of.move.after().find_own_request(id)->priority);
                     }
                   };
                   return of.event.catalog.has_further_keys() ? std::optional(write) : std::nullopt;
                 }),
        optional("not_retried", behaviors,
                 "The behaviors that would have failed, and not be tried again at any event, in "
                 "catalog order. Where `suspended` is.",
                 [](const Described& of) {
                   return of.event.catalog.has_further_keys()
                              ? std::optional(of.effects.not_retried)
                              : std::nullopt;
                 }),
        member("queued", map(task, positive_seconds),
               "The reactive tasks that would come into the queue, in catalog order, each with "
               "the time when it is due.",
               [](const Described& of) {
                 return [&of](const auto& put) {
                   for (const TaskId id : of.effects.queued) {
                     put(id, of.move.after().queue().due(of.event.catalog.tasks[id].catalog_index));
                   }
                 };
               }),
        member("follows", list(following),
               "The events of origin fault, situation and repair that would follow at once. What "
               "the move "
               "would do includes what they do.",
               [](const Described& of) {
                 return [&of](const auto& put) {
                   for (const auto& event : of.move.events.subspan(1)) put(event.record);
                 };
               }),
        member("search", nullable(search), "How the answer was found; null if there was no search.",
               [](const Described& of) { return of.event.record.search; }),
        member(
            "conflict",
            list(pointed(
                restricted(reason, R"({"kind": {"not": {"enum": ["finished", "stopped"]}}})"))),
            "Why the move would be rejected: a minimal set of reasons, as in cbc.solve/1.",
            [](const Described& of) { return in_order(of.event.record.conflict, {}, of.event); }))
        .related(relations_by_verb, R"([
      {"if": {"properties": {"outcome": {"const": "rejected"}}},
       "else": {"properties": {"conflict": {"type": "array", "maxItems": 0}}}},
      {"if": {"properties": {"verb": {"enum": ["start", "stop", "finish"]}}},
       "else": {"properties": {"outcome": {"const": "unchanged"}, "search": {"type": "null"}}}},
      {"if": {"properties": {"outcome": {"const": "accepted"}, "verb": {"not": {"const": "stop"}}}},
       "then": {"properties": {"search": {"type": "object"}}}}])");

/// The moves are written one by one.
struct Moves {
  void write(JsonWriter& json, std::string_view moves, const auto& /*context*/) const {
    json.begin('[');
    json.put_json(moves);
    json.close(']');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    list(move).put_schema(json, definitions);
  }
};

struct Report {
  const WhatIfState& of;
  const std::string& moves;
};

constexpr auto behaviors_with = [](auto has) {
  return [has](const Report& all) {
    return [&all, has](const auto& put) {
      for (const BehaviorId id : all.of.catalog.behavior_ids) {
        if (has(all.of.state, id)) put(id);
      }
    };
  };
};

constexpr auto report = object(
    "",
    "The output of `cbc solve --what-if --format json` (schema cbc.what-if/1): a state of a "
    "mission, and what could happen next.",
    schema_member("cbc.what-if/1"),
    member("catalog", any_text,
           "The catalog, as given; for a compiled catalog, the name of its source.",
           [](const Report& all) { return all.of.catalog.file; }),
    member(
        "script", any_text, "The script, as given.",
        [](const Report& all) -> const auto& { return all.of.script.file; }),
    member("event", count,
           "Number of the last event before the state, as in cbc.solve/1; 0: there is none.",
           [](const Report& all) { return all.of.moment.snapshot.events; }),
    member("time", seconds, "The time of the state on the clock, in seconds from 0.",
           [](const Report& all) { return all.of.moment.snapshot.now; }),
    part([](const Report& all) { return Running(all.of.catalog, all.of.state); }, state_after),
    member("variables", event_variables, "The values of all situation variables.",
           [](const Report& all) { return entries_of(all.of.state.variables(), all.of.catalog); }),
    member("unavailable", behaviors,
           "The behaviors that cannot be activated as a script said so, in catalog order.",
           behaviors_with([](const State& state, BehaviorId id) { return state.is_denied(id); })),
    member("faulty", behaviors, "The faulty behaviors, in catalog order.",
           behaviors_with([](const State& state, BehaviorId id) { return state.is_faulty(id); })),
    member(
        "moves", Moves(),
        "What could happen next: first what could come from outside, then what the clock does "
        "if nothing comes.",
        [](const Report& all) -> const auto& { return all.moves; }));

}  // namespace json::what_if

void WhatIfJson::add(const PossibleMove& move) {
  JsonWriter json(moves_);
  moves_ += moves_.empty() ? "\n" : ",\n";
  const PossibleMove::Event& first = move.events.front();
  const EventAdditions no_additions;
  const json::EventWithState event{{of_.catalog, first.record, first.after},
                                   first.step,
                                   no_additions,
                                   {of_.catalog, first.after}};
  json::what_if::move.write(json,
                            json::what_if::Described{move, event, effects_of(of_.catalog, move)},
                            static_cast<const json::Decision&>(event));
}

std::string WhatIfJson::finish() {
  return json::document(json::what_if::report, json::what_if::Report{of_, moves_}, of_.catalog);
}

std::string what_if_schema() {
  return json::schema("what-if", "What could happen next in a mission", json::what_if::report);
}

}  // namespace cbc
