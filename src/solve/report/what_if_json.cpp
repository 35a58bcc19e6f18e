#include <functional>
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
  const CompiledCatalog& catalog;
  const PossibleMove& move;
  MoveEffects effects;
};

/// The behaviors that perform some tasks after a move.
constexpr auto with_behaviors = [](const std::vector<TaskId>& tasks, const Described& of) {
  return [&tasks, &of](const auto& put) {
    for (const TaskId task : tasks) put(task, of.move.after().behavior(task));
  };
};

/// An event of a move, which is the context.
struct EventOfMove {
  void write(JsonWriter& json, const PossibleMove::Event& of, const Described& in) const {
    const EventWithState event_with_state{
        {in.catalog, of.record, of.after}, of.step, {}, {in.catalog, of.after}};
    event.write(json, event_with_state, static_cast<const Decision&>(event_with_state));
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    event.put_schema(json, definitions);
  }
};

constexpr auto move = object(
    "move", "Something that could happen next, and what it would do.",
    member(
        "started", map(task, behavior),
        "The tasks that would run, but do not run now, in catalog order, each with its behavior.",
        [](const Described& of) { return with_behaviors(of.effects.started, of); }),
    member(
        "stopped", tasks, "The tasks that run now, but would not, in catalog order.",
        [](const Described& of) -> const auto& { return of.effects.stopped; }),
    member("changed", map(task, behavior),
           "The tasks that would go on running with another behavior, in catalog order, each with "
           "that behavior.",
           [](const Described& of) { return with_behaviors(of.effects.changed, of); }),
    member(
        "events", list(EventOfMove()).at_least(1),
        "The event as it would be in a run; the first one has the outcome. Those of origin fault "
        "and situation that would follow from it at once come behind it.",
        [](const Described& of) { return of.move.events; }));

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
  json::what_if::move.write(
      json, json::what_if::Described{of_.catalog, move, effects_of(of_.catalog, move)},
      json::what_if::Described{of_.catalog, move, {}});
}

std::string WhatIfJson::finish() {
  return json::document(json::what_if::report, json::what_if::Report{of_, moves_}, of_.catalog);
}

std::string what_if_schema() {
  return json::schema("what-if", "What could happen next in a mission", json::what_if::report);
}

}  // namespace cbc
