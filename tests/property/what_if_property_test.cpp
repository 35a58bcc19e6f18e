// Random catalogs and missions, and a random moment of each: every move that could happen next does
// what it does as one more event at the end of the mission, run from the beginning. CBC_SEED and
// CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/report/event_json.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "generator.h"
#include "random_cases.h"
#include "solve/engine/what_if.h"
#include "yaml_text.h"

namespace cbc::oracle::what_if_property_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t default_cases = 600;

/// What an event did. Without what depends on the way to it: its number, the time, which may be a
/// microsecond later, and the effort of the search.
Json plain_event(const CompiledCatalog& catalog, const ExplainedRecord& record, const Step* step,
                 const State& state) {
  std::string text;
  append_event(text, catalog, record, step, state, {});
  Json event = Json::parse(text);
  event.erase("index");
  event.erase("time");
  event["queue"] = event["queue"].size();
  if (event["search"].is_object()) {
    event["search"].erase("nodes");
    event["search"].erase("solutions");
  }
  return event;
}

/// An event of a run.
struct Happened {
  Microseconds time = 0;
  Origin origin = Origin::script;
  std::optional<std::size_t> step;  ///< place of the scripted one
  Json event;
};

class Recorder final : public RunListener {
 public:
  Recorder(const CompiledCatalog& catalog, const cbc::Script& script)
      : catalog_(catalog), script_(script) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    Happened& entry = events.emplace_back();
    entry.time = record.time;
    entry.origin = record.origin;
    if (step != nullptr) entry.step = static_cast<std::size_t>(step - script_.steps.data());
    entry.event = plain_event(catalog_, record, step, state);
  }

  std::vector<Happened> events;

 private:
  const CompiledCatalog& catalog_;
  const cbc::Script& script_;
};

std::vector<Happened> run(const CompiledCatalog& catalog, const cbc::Script& script,
                          const CoordinatorOptions& options) {
  Recorder recorder(catalog, script);
  const RunResult result = run_script(catalog, script, options, recorder, {.rejections = true});
  demand(result.status == Coordinator::Status::ok, "a run ended early");
  return recorder.events;
}

bool follows(const Happened& event) {
  return event.origin == Origin::fault || event.origin == Origin::situation;
}

/// The mission up to a moment, to which an event can be added.
struct Prefix {
  cbc::Script script;
  std::size_t events = 0;            ///< that happen up to the moment
  std::optional<Microseconds> time;  ///< of an event that is added; empty: at once
};

/// Empty if the next event comes at the same instant from the clock, between which and the moment
/// no event of a script can be.
std::optional<Prefix> prefix_of(const cbc::Script& script, const std::vector<Happened>& events,
                                std::optional<std::uint64_t> after) {
  Prefix prefix{script, events.size(), {}};
  if (!after) return prefix;
  std::size_t count = *after;
  while (count > 0 && count < events.size() && follows(events[count])) ++count;
  prefix.events = count;
  std::size_t steps = 0;
  for (std::size_t place = 0; place < count; ++place) {
    if (events[place].step) steps = *events[place].step + 1;
  }
  prefix.script.steps.resize(steps);
  if (count == 0) return prefix;
  std::size_t last = count - 1;
  while (follows(events[last])) --last;
  if (events[last].origin == Origin::script) return prefix;
  if (count < events.size() && events[count].time == events[last].time) return std::nullopt;
  prefix.time = events[last].time + 1;
  return prefix;
}

/// The events that a step at the end of the mission adds; of those at the same instant only what
/// follows from it, unless it is a wait.
std::vector<Json> add_step(const CompiledCatalog& catalog, const Prefix& prefix, Step step,
                           const CoordinatorOptions& options) {
  cbc::Script script = prefix.script;
  if (!step.time) step.time = prefix.time;
  const bool is_wait = step.verb == cbc::Verb::wait;
  script.steps.push_back(std::move(step));
  const std::vector<Happened> events = run(catalog, script, options);
  std::vector<Json> added;
  for (std::size_t place = prefix.events; place < events.size(); ++place) {
    const Happened& event = events[place];
    if (is_wait && event.step) continue;
    const bool is_part = is_wait || event.step || (!added.empty() && follows(event));
    if (!is_part) break;
    added.push_back(event.event);
  }
  return added;
}

/// The moves of a moment, as the program finds them.
struct Found {
  std::vector<Step> steps;
  std::vector<std::vector<Json>> of_steps;
  std::vector<Json> of_clock;
  std::optional<Microseconds> clock;  ///< when the clock makes its move
};

void count(const PossibleMove& move, const CompiledCatalog& catalog, Statistics& statistics) {
  const ExplainedRecord& record = move.events.front().record;
  const MoveEffects effects = effects_of(catalog, move);
  const bool changes =
      !effects.started.empty() || !effects.stopped.empty() || !effects.changed.empty();
  statistics.count(std::string(name_of(record.origin)) + ": " + std::string(name_of(record.verb)));
  statistics.count(std::string(name_of(record.outcome)));
  statistics.count(changes ? "changes what runs" : "changes nothing that runs");
  if (move.events.size() > 1) {
    statistics.count("followed at once by " +
                     std::string(name_of(move.events.back().record.origin)));
  }
}

/// Whether the tasks that a move affects are what it says, by the states before and after it.
void check_effects(const CompiledCatalog& catalog, const PossibleMove& move) {
  const MoveEffects effects = effects_of(catalog, move);
  for (const TaskId task : catalog.task_ids) {
    const bool was = move.before.is_running(task);
    const bool is = move.after().is_running(task);
    demand(contains(effects.started, task) == (!was && is), "a start is wrong");
    demand(contains(effects.stopped, task) == (was && !is), "a stop is wrong");
    demand(contains(effects.changed, task) ==
               (was && is && move.before.behavior(task) != move.after().behavior(task)),
           "a change of behavior is wrong");
    const auto priority = [task](const State& state) {
      return state.has_request(task) ? state.request(task).priority : -1;
    };
    demand(contains(effects.requested, task) ==
               (was && is && priority(move.before) != priority(move.after())),
           "a request is wrong");
    const auto is_due = [index = catalog.tasks[task].catalog_index](const State& state) {
      return state.queue().has(index);
    };
    demand(contains(effects.queued, task) == (!is_due(move.before) && is_due(move.after())),
           "the queue is wrong");
  }
  std::set<std::uint32_t> failed;
  for (const PossibleMove::Event& event : move.events) {
    for (const Change& change : event.record.changes) {
      if (!change.success) failed.insert(catalog.behaviors[change.behavior].catalog_index);
    }
  }
  std::set<std::uint32_t> told;
  for (const BehaviorId behavior : effects.failed) {
    told.insert(catalog.behaviors[behavior].catalog_index);
  }
  demand(told == failed, "a failure is wrong");
}

Found find_moves(const CompiledCatalog& catalog, const cbc::Script& script,
                 const MissionMoment& moment, const CoordinatorOptions& options,
                 Statistics& statistics) {
  State state(catalog);
  state.restore(moment.snapshot);
  Found found;
  found.steps = list_moves(catalog, state, choice_of(catalog, script));
  const auto take = [&](const PossibleMove& move) {
    check_effects(catalog, move);
    count(move, catalog, statistics);
    std::vector<Json> events;
    for (const PossibleMove::Event& event : move.events) {
      events.push_back(plain_event(catalog, event.record, event.step, event.after));
    }
    const ExplainedRecord& record = move.events.front().record;
    if (record.origin == Origin::script) {
      demand(!found.clock, "a step behind the clock");
      found.of_steps.push_back(std::move(events));
      return;
    }
    demand(found.clock.value_or(record.time) == record.time, "the clock at several instants");
    found.clock = record.time;
    std::move(events.begin(), events.end(), std::back_inserter(found.of_clock));
  };
  const RunResult result = try_moves(catalog, options, moment.snapshot, found.steps, take);
  demand(result.status == Coordinator::Status::ok, "the moves ended early");
  demand(found.of_steps.size() == found.steps.size(), "not a move for each step");
  return found;
}

/// `with_queue`: also in the number of reactive tasks in the queue.
void demand_equal(std::vector<Json> found, std::vector<Json> expected, bool with_queue,
                  const std::string& what) {
  if (!with_queue) {
    for (std::vector<Json>* const events : {&found, &expected}) {
      for (Json& event : *events) event.erase("queue");
    }
  }
  demand(found == expected, what + ": found " + Json(found).dump() +
                                ", but as part of the mission " + Json(expected).dump());
}

void check(const CompiledCatalog& catalog, const cbc::Script& script, Random& random,
           Statistics& statistics) {
  const CoordinatorOptions options = options_of(script, {});
  const std::vector<Happened> events = run(catalog, script, options);
  std::optional<std::uint64_t> after;
  if (random.percent(75)) after = random.below(events.size() + 1);
  const auto prefix = prefix_of(script, events, after);
  if (!prefix) return statistics.count("between two events of an instant");
  const MomentSearch search = find_moment(catalog, script, options, after);
  demand(search.moment.has_value(), "no moment");
  const MissionMoment& moment = *search.moment;
  demand(moment.snapshot.events == prefix->events, "the wrong event");
  demand(moment.event.has_value() == (prefix->events > 0), "an event, or none");
  statistics.count(!after ? "at the end" : prefix->time ? "after the clock" : "after the script");
  const Found found = find_moves(catalog, script, moment, options, statistics);
  Prefix from = *prefix;
  // A reactive start that is dropped at the instant of the moment is no event.
  const bool may_drop = from.time.has_value();
  // All that is due at the last instant has happened.
  if (!after) from.time = moment.snapshot.now + 1;
  for (std::size_t place = 0; place < found.steps.size(); ++place) {
    demand_equal(found.of_steps[place], add_step(catalog, from, found.steps[place], options),
                 !may_drop, "move " + std::to_string(place + 1));
  }
  Step wait;
  wait.time = found.clock.value_or(moment.snapshot.now + 1000 * second);
  demand_equal(found.of_clock, add_step(catalog, from, wait, options), !may_drop, "the clock");
  demand(!find_moment(catalog, script, options, events.size() + 1).moment,
         "a moment after the last one");
}

void run_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  const Case sample = generate_case(random);
  Random forms(~seed);
  const std::string catalog_text = catalog_yaml(sample.catalog, forms);
  const std::string script_text = script_yaml(sample.catalog, sample.script, forms);
  try {
    Diagnostics diagnostics;
    const auto catalog = read_catalog(catalog_text, "catalog.yaml", diagnostics);
    demand(catalog.has_value(), "the catalog is refused");
    const CompiledCatalog compiled = compile(*catalog);
    const auto document = yaml::parse(script_text, "script.yaml", diagnostics);
    demand(document != nullptr, "the script is no YAML");
    const auto script = read_script(*document, compiled, Severity::warning, diagnostics);
    demand(script.has_value(), "the script is refused");
    check(compiled, *script, random, results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        catalog_text + "--- script\n" + script_text + "--- " +
                                        error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"at the end", 150},
    {"after the clock", 40},
    {"after the script", 300},
    {"script: start", 5000},
    {"script: stop", 1000},
    {"script: finish", 1500},
    {"script: fault", 1000},
    {"script: repair", 400},
    {"script: situation", 2000},
    {"timeout: finish", 100},
    {"reactive: start", 100},
    {"accepted", 5000},
    {"rejected", 3000},
    {"changes what runs", 5000},
    {"changes nothing that runs", 5000},
    {"followed at once by situation", 100},
    {"followed at once by fault", 8},
};

TEST(WhatIfProperty, MovesDoWhatTheyDoInTheMission) {
  run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::what_if_property_test
