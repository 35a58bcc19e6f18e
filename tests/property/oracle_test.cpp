// The oracle itself against small examples, computed by hand from the definition.
#include "oracle.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "enumeration.h"

namespace cbc::oracle::oracle_test {
namespace {

using nlohmann::ordered_json;

constexpr Microseconds one_second = 1'000'000;

// Percentages are whole here.
Millionths percent(int value) { return Millionths{value} * 10'000; }

Task on_request(const std::string& name) {
  Task task;
  task.name = name;
  return task;
}

Task automatic(const std::string& name) {
  Task task = on_request(name);
  task.start_on_request = false;
  return task;
}

Task reactive(const std::string& name) {
  Task task = automatic(name);
  task.reactive_start = true;
  return task;
}

Behavior behavior(const std::string& name, std::size_t task, int suitability = 100) {
  Behavior result;
  result.name = name;
  result.performs.push_back({task, percent(suitability)});
  return result;
}

Behavior behavior(const std::string& name, std::size_t task, int suitability, std::size_t required,
                  int minimum = 0) {
  Behavior result = behavior(name, task, suitability);
  result.requirements.push_back({required, percent(minimum)});
  return result;
}

Event start(std::size_t task, int priority = 1) {
  Event event;
  event.verb = Verb::start;
  event.subject = task;
  event.priority = priority;
  return event;
}

Event start_with(std::size_t task, int priority, Parameters parameters) {
  Event event = start(task, priority);
  event.parameters = std::move(parameters);
  return event;
}

Event with_subject(Verb verb, std::size_t subject) {
  Event event;
  event.verb = verb;
  event.subject = subject;
  return event;
}

Event stop(std::size_t task) { return with_subject(Verb::stop, task); }
Event fault(std::size_t behavior) { return with_subject(Verb::fault, behavior); }

Event finish(std::size_t behavior, Cause cause) {
  Event event = with_subject(Verb::finish, behavior);
  event.cause = cause;
  return event;
}

Event wait_for(Microseconds time) {
  Event event;
  event.wait = time;
  return event;
}

ordered_json run(const Catalog& catalog, const std::vector<Event>& events) {
  Script script;
  script.events = events;
  return run_oracle(catalog, script, nullptr);
}

// For example "-A1 replaced(2), +B1 required, +C1 requested(1) failed".
std::string changes(const ordered_json& event) {
  std::string result;
  for (const ordered_json& change : event["changes"]) {
    result += result.empty() ? "" : ", ";
    result += change["op"] == "activate" ? "+" : "-";
    result += change["behavior"].get<std::string>() + " " + change["cause"].get<std::string>();
    result += change["priority"].is_null() ? "" : "(" + change["priority"].dump() + ")";
    result += change["success"] == true ? "" : " failed";
  }
  return result;
}

TEST(NearestDouble, RoundsToNearest) {
  EXPECT_EQ(nearest_double(0, 7), 0.0);
  EXPECT_EQ(nearest_double(1, 1), 1.0);
  EXPECT_EQ(nearest_double(72, 100), 0.72);
  EXPECT_EQ(nearest_double(1, 3), 1.0 / 3.0);
  EXPECT_EQ(nearest_double(999'999, 1'000'000), 0.999999);
  // Halfway between two doubles: to the even one.
  const Integer two_to_53 = Integer(1) << 53;
  EXPECT_EQ(nearest_double(two_to_53 + 1, 1), 9007199254740992.0);
  EXPECT_EQ(nearest_double(two_to_53 + 3, 1), 9007199254740996.0);
  EXPECT_EQ(nearest_double((two_to_53 + 1) * 3 + 1, 3), 9007199254740994.0);
}

TEST(Parameters, NullEmptyAndAbsentAreAlike) {
  const auto parse = [](const char* text) { return ordered_json::parse(text); };
  EXPECT_TRUE(same_parameters(parse("null"), parse("{}")));
  EXPECT_TRUE(same_parameters(parse(R"({"a": "1", "b": {"c": null}})"), parse(R"({"a": "1"})")));
  EXPECT_TRUE(same_parameters(parse(R"({"a": "1", "b": "2"})"), parse(R"({"b": "2", "a": "1"})")));
  EXPECT_FALSE(same_parameters(parse(R"({"a": ["1", "2"]})"), parse(R"({"a": ["2", "1"]})")));
  EXPECT_FALSE(same_parameters(parse(R"({"a": "1"})"), parse(R"({"a": "1.0"})")));
}

TEST(Facts, GroupsAndLevels) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B"), automatic("C"), on_request("D")};
  catalog.behaviors = {behavior("A1", 0, 100, 2), behavior("B1", 1), behavior("C1", 2)};
  catalog.exclusivity = {{1, 3, 1}};
  const CatalogFacts facts(catalog);
  EXPECT_EQ(facts.groups, (std::vector<std::vector<std::size_t>>{{0, 2}, {1, 3}}));
  EXPECT_EQ(facts.level_of, (std::vector<std::size_t>{1, 0, 0}));
  EXPECT_EQ(facts.excludes[1], std::set<std::size_t>{3});
}

TEST(Oracle, StartsWhatIsRequired) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S"), automatic("U")};
  catalog.behaviors = {behavior("A1", 0, 90, 1), behavior("S1", 1, 70), behavior("S2", 1, 80),
                       behavior("U1", 2)};
  const ordered_json events = run(catalog, {start(0, 2)});
  ASSERT_EQ(events.size(), 1U);
  const ordered_json expected = ordered_json::parse(R"({
    "index": 1, "time": 0.0, "origin": "script", "verb": "start", "name": "A", "priority": 2,
    "outcome": "accepted",
    "changes": [
      {"op": "activate", "behavior": "S2", "tasks": ["S"], "cause": "required", "priority": null,
       "success": true},
      {"op": "activate", "behavior": "A1", "tasks": ["A"], "cause": "requested", "priority": 2,
       "success": true}],
    "stopped_tasks": [],
    "objective": {"satisfied": 1, "requests": 1, "suitability": 0.72, "idle": 0.5, "changes": 2},
    "search": {"status": "optimal", "group": 0, "space": "3", "protection": 2},
    "running": {"A": "A1", "S": "S2"}, "requests": {"A": 2}, "queue": {}})");
  EXPECT_EQ(events[0].dump(1), expected.dump(1));
}

TEST(Oracle, ComparesPerformancesExactly) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S"), automatic("U")};
  catalog.behaviors = {behavior("A1", 0, 100, 1, 72), behavior("S1", 1, 90, 2),
                       behavior("U1", 2, 80)};
  EXPECT_EQ(run(catalog, {start(0)})[0]["outcome"], "accepted");
  catalog.behaviors[0].requirements[0].minimum += 1;
  EXPECT_EQ(run(catalog, {start(0)})[0]["outcome"], "rejected");
  catalog.behaviors[0].requirements[0].minimum = 0;
  catalog.tasks[1].minimum = percent(72);
  EXPECT_EQ(run(catalog, {start(0)})[0]["outcome"], "accepted");
  catalog.tasks[1].minimum += 1;
  EXPECT_EQ(run(catalog, {start(0)})[0]["outcome"], "rejected");
}

TEST(Oracle, PerformanceCountsASharedTaskOnce) {
  // A requires S and U, S requires U: Performance(A) = 1 * 1 * 50 %.
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S"), automatic("U")};
  catalog.tasks[0].minimum = percent(50);
  catalog.behaviors = {behavior("A1", 0, 100, 1), behavior("S1", 1, 100, 2), behavior("U1", 2, 50)};
  catalog.behaviors[0].requirements.push_back({2, 0});
  EXPECT_EQ(run(catalog, {start(0)})[0]["outcome"], "accepted");
}

TEST(Oracle, ProtectsHigherPriorities) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B")};
  catalog.behaviors = {behavior("A1", 0), behavior("B1", 1)};
  catalog.exclusivity = {{0, 1}};
  const ordered_json events = run(catalog, {start(0, 2), start(1, 1), start(1, 2), start(1, 1)});
  EXPECT_EQ(events[1]["outcome"], "rejected");
  EXPECT_EQ(
      events[1]["search"],
      ordered_json({{"status", "infeasible"}, {"group", 0}, {"space", "1"}, {"protection", 1}}));
  EXPECT_EQ(changes(events[2]), "-A1 displaced(2), +B1 requested(2)");
  EXPECT_EQ(events[2]["stopped_tasks"].dump(), R"([{"task":"A","cause":"interrupted"}])");
  EXPECT_EQ(events[2]["objective"]["requests"], 2);
  EXPECT_EQ(events[2]["objective"]["satisfied"], 1);
  // Its own request is higher: rejected before any search.
  EXPECT_EQ(events[3]["outcome"], "rejected");
  EXPECT_TRUE(events[3]["search"].is_null());
}

TEST(Oracle, StopTakesDownWhatNeedsTheTask) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S")};
  catalog.behaviors = {behavior("A1", 0, 100, 1), behavior("S1", 1)};
  // S has no request, so its stop has priority 0, and A is protected.
  Event forced = stop(1);
  forced.priority = 1;
  const ordered_json events = run(catalog, {start(0), stop(1), forced, stop(1)});
  EXPECT_EQ(events[1]["outcome"], "rejected");
  EXPECT_EQ(events[1]["priority"], 0);
  EXPECT_EQ(changes(events[2]), "-A1 displaced(1), -S1 requested");
  EXPECT_EQ(events[3]["outcome"], "unchanged");
}

TEST(Oracle, RecentRequestsDecideBetweenEqualNumbers) {
  // X needs S, which excludes A, or U, which excludes B: one of A and B has to stop.
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B"), on_request("X"), automatic("S"),
                   automatic("U")};
  catalog.behaviors = {behavior("A1", 0),        behavior("B1", 1), behavior("X1", 2, 100, 3),
                       behavior("X2", 2, 50, 4), behavior("S1", 3), behavior("U1", 4)};
  catalog.exclusivity = {{3, 0}, {4, 1}};
  const ordered_json a_last = run(catalog, {start(1), start(0), start(2)});
  EXPECT_EQ(a_last[2]["running"].dump(), R"({"A":"A1","X":"X2","U":"U1"})");
  const ordered_json b_last = run(catalog, {start(0), start(1), start(2)});
  EXPECT_EQ(b_last[2]["running"].dump(), R"({"B":"B1","X":"X1","S":"S1"})");
  const ordered_json a_higher = run(catalog, {start(0, 2), start(1), start(2, 3)});
  EXPECT_EQ(a_higher[2]["running"].dump(), R"({"A":"A1","X":"X2","U":"U1"})");
}

TEST(Oracle, TiesAreDecidedByRank) {
  Catalog catalog;
  catalog.tasks = {on_request("A")};
  catalog.behaviors = {behavior("A1", 0, 80), behavior("A2", 0, 90), behavior("A3", 0, 90)};
  const ordered_json events = run(
      catalog, {start(0), finish(1, Cause::situation_change), finish(1, Cause::wrong_progress)});
  EXPECT_EQ(changes(events[0]), "+A2 requested(1)");
  // A2 and A3 are one activation each; the behavior that has just finished has the first rank.
  EXPECT_EQ(changes(events[1]), "+A2 requested(1)");
  EXPECT_EQ(changes(events[2]), "+A3 requested(1)");
}

TEST(Oracle, FinishEscalatesOneLevelAtATime) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S")};
  catalog.behaviors = {behavior("A1", 0, 100, 1), behavior("S1", 1)};
  const ordered_json events = run(catalog, {start(0, 3), finish(1, Cause::process_failure)});
  EXPECT_EQ(events[1]["search"]["protection"], 3);
  EXPECT_EQ(changes(events[1]), "-A1 displaced(3)");
  EXPECT_EQ(events[1]["stopped_tasks"].dump(),
            R"([{"task":"A","cause":"interrupted"},{"task":"S","cause":"process_failure"}])");
}

TEST(Oracle, ABehaviorOfSeveralTasks) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B")};
  catalog.behaviors = {behavior("A1", 0), behavior("B1", 1), behavior("AB", 0)};
  catalog.behaviors[2].performs.push_back({1, percent(100)});
  const ordered_json apart =
      run(catalog, {start(0, 2), start(1), finish(1, Cause::interrupted), start(1, 3)});
  EXPECT_EQ(changes(apart[0]), "+A1 requested(2)");
  // AB for both tasks would be two changes.
  EXPECT_EQ(changes(apart[1]), "+B1 requested(1)");
  // AB for B alone is one change, for both two.
  EXPECT_EQ(changes(apart[2]), "+AB requested(1)");
  EXPECT_EQ(apart[2]["running"].dump(), R"({"A":"A1","B":"AB"})");
  EXPECT_EQ(changes(apart[3]), "");

  const ordered_json together = run(catalog, {start(1), finish(1, Cause::interrupted), start(0),
                                              finish(2, Cause::goal_achieved)});
  EXPECT_EQ(changes(together[1]), "+AB requested(1)");
  // A joins AB, which is active: no change at all.
  EXPECT_EQ(changes(together[2]), "");
  EXPECT_EQ(together[2]["running"].dump(), R"({"A":"AB","B":"AB"})");
  EXPECT_EQ(together[3]["stopped_tasks"].dump(),
            R"([{"task":"A","cause":"goal_achieved"},{"task":"B","cause":"goal_achieved"}])");
}

TEST(Oracle, RestartsForOtherParameters) {
  Catalog catalog;
  catalog.tasks = {on_request("A")};
  catalog.behaviors = {behavior("A1", 0), behavior("A2", 0, 50)};
  const ordered_json events =
      run(catalog, {start_with(0, 1, {{"p", "1"}}), start_with(0, 2, {{"p", "2"}}), start(0, 2),
                    start_with(0, 2, {{"p", "2"}}), fault(0), start_with(0, 2, {{"p", "3"}})});
  EXPECT_EQ(changes(events[1]), "-A1 restarted(1), +A1 restarted(2)");
  EXPECT_EQ(events[1]["objective"]["changes"], 0);
  EXPECT_EQ(changes(events[2]), "");
  EXPECT_EQ(changes(events[3]), "");
  EXPECT_EQ(changes(events[5]), "-A1 restarted(2), +A1 restarted(2) failed, +A2 requested(2)");
}

TEST(Oracle, FailedActivationsAreSolvedAgain) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), automatic("S"), automatic("U")};
  catalog.behaviors = {behavior("A1", 0, 100, 1), behavior("A2", 0, 50, 2), behavior("S1", 1),
                       behavior("U1", 2)};
  const ordered_json events = run(catalog, {fault(0), start(0)});
  EXPECT_EQ(changes(events[1]),
            "+S1 required, +A1 requested(1) failed, -S1 undone, +U1 required, +A2 requested(1)");
  EXPECT_EQ(events[1]["outcome"], "accepted");
  EXPECT_EQ(events[1]["objective"]["changes"], 2);
}

TEST(Oracle, RejectedAndTakenBack) {
  // B displaces A and what A needs; it fails, and so does the return to them.
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B"), automatic("S")};
  catalog.behaviors = {behavior("A1", 0, 100, 2), behavior("B1", 1), behavior("S1", 2)};
  catalog.exclusivity = {{0, 1}};
  const ordered_json sound = run(catalog, {start(0), fault(1), start(1)});
  EXPECT_EQ(changes(sound[2]),
            "-A1 displaced(1), -S1 released, +B1 requested(1) failed, +S1 undone, +A1 undone");
  EXPECT_EQ(sound[2]["outcome"], "rejected");
  EXPECT_EQ(sound[2]["running"].dump(), R"({"A":"A1","S":"S1"})");
  EXPECT_EQ(sound.size(), 3U);

  const ordered_json events =
      run(catalog, {start(0), fault(0), fault(1), fault(2), start(1), wait_for(0)});
  EXPECT_EQ(changes(events[4]),
            "-A1 displaced(1), -S1 released, +B1 requested(1) failed, "
            "+S1 undone failed, +A1 undone failed");
  EXPECT_EQ(events[4]["running"].dump(), R"({"A":"A1","S":"S1"})");
  EXPECT_EQ(events[5]["origin"], "fault");
  EXPECT_EQ(events[5]["name"], "A1");
  EXPECT_EQ(events[5]["cause"], "process_failure");
  EXPECT_EQ(changes(events[5]), "-S1 released");
  EXPECT_EQ(events[6]["origin"], "fault");
  EXPECT_EQ(events[6]["name"], "S1");
  EXPECT_EQ(events[6]["outcome"], "unchanged");
  EXPECT_EQ(events[7]["verb"], "wait");
}

TEST(Oracle, TimeoutsAndReactiveStarts) {
  Catalog catalog;
  catalog.tasks = {on_request("MOVE"), reactive("HOVER")};
  catalog.tasks[0].timeout = 2 * one_second;
  catalog.behaviors = {behavior("M1", 0), behavior("H1", 1)};
  catalog.exclusivity = {{0, 1}};
  Event move = start(0, 2);
  move.at = one_second;
  Event stop_hover = stop(1);
  stop_hover.at = 4 * one_second;
  const ordered_json events = run(catalog, {move, stop_hover, wait_for(one_second)});
  ASSERT_EQ(events.size(), 6U);
  EXPECT_EQ(events[0]["origin"], "reactive");
  EXPECT_EQ(events[0]["time"], 0.08);
  EXPECT_EQ(changes(events[0]), "+H1 reactive(0)");
  EXPECT_EQ(changes(events[1]), "-H1 displaced(0), +M1 requested(2)");
  EXPECT_EQ(events[1]["queue"].dump(), "{}");
  EXPECT_EQ(events[2]["origin"], "timeout");
  EXPECT_EQ(events[2]["time"], 3.0);
  EXPECT_EQ(events[2]["queue"].dump(), R"({"HOVER":3.08})");
  EXPECT_EQ(events[3]["time"], 3.08);
  // After its own stop, a reactive task does not come back.
  EXPECT_EQ(changes(events[4]), "-H1 requested(0)");
  EXPECT_EQ(events[4]["queue"].dump(), "{}");
  EXPECT_EQ(events[5]["verb"], "wait");
}

TEST(Oracle, ScriptedEventsComeBeforeWhatIsDueThen) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), on_request("B")};
  catalog.tasks[0].timeout = one_second;
  catalog.tasks[1].timeout = one_second;
  catalog.behaviors = {behavior("A1", 0), behavior("B1", 1)};
  Event restart = start_with(0, 1, {{"p", "1"}});
  restart.at = one_second;
  const ordered_json events = run(catalog, {start(0), start(1), restart});
  // The restart comes first and puts off the timeout of A.
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(changes(events[2]), "-A1 restarted(1), +A1 restarted(1)");
  EXPECT_EQ(events[3]["origin"], "timeout");
  EXPECT_EQ(events[3]["name"], "B1");
}

TEST(Oracle, AReactiveStartStopsNoRequestedTask) {
  // R needs S, but S excludes B, which is requested.
  Catalog catalog;
  catalog.tasks = {reactive("R"), automatic("S"), on_request("B")};
  catalog.behaviors = {behavior("R1", 0, 100, 1), behavior("S1", 1), behavior("B1", 2)};
  catalog.exclusivity = {{1, 2}};
  const ordered_json events = run(catalog, {start(2), wait_for(one_second)});
  EXPECT_EQ(events[1]["origin"], "reactive");
  EXPECT_EQ(events[1]["outcome"], "rejected");
  EXPECT_EQ(events[1]["search"]["protection"], 0);
  EXPECT_EQ(events[1]["queue"].dump(), R"({"R":null})");
}

// TAKE_OFF and HOVER share no list, but what they require excludes one another.
Catalog controllers() {
  Catalog catalog;
  catalog.tasks = {on_request("TAKE_OFF"), reactive("HOVER"), automatic("PID"), automatic("DF")};
  catalog.behaviors = {behavior("TAKE_OFF_WITH_DF", 0, 100, 3),
                       behavior("HOVER_WITH_PID", 1, 100, 2), behavior("PID", 2),
                       behavior("DF", 3)};
  catalog.exclusivity = {{2, 3}};
  return catalog;
}

Event at(Microseconds time, Event event) {
  event.at = time;
  return event;
}

TEST(Oracle, AReactiveTaskWaitsUntilItCanStart) {
  const ordered_json events = run(
      controllers(),
      {start(0), at(5 * one_second, finish(0, Cause::goal_achieved)), at(6 * one_second, Event())});
  ASSERT_EQ(events.size(), 5U);
  EXPECT_EQ(events[1]["origin"], "reactive");
  EXPECT_EQ(events[1]["time"], 0.08);
  EXPECT_EQ(events[1]["outcome"], "rejected");
  EXPECT_EQ(events[1]["queue"].dump(), R"({"HOVER":null})");
  EXPECT_EQ(events[2]["queue"].dump(), R"({"HOVER":5.08})");
  EXPECT_EQ(events[3]["time"], 5.08);
  EXPECT_EQ(changes(events[3]), "+PID required, +HOVER_WITH_PID reactive(0)");
  EXPECT_EQ(events[3]["queue"].dump(), "{}");
}

TEST(Oracle, FurtherAttemptsOfAWaitingTaskAreNoEvents) {
  // The third event is accepted, so HOVER is tried again; after its stop, it is not.
  const ordered_json events =
      run(controllers(), {start(0), wait_for(one_second), start(0), wait_for(one_second), stop(1),
                          finish(0, Cause::goal_achieved), wait_for(one_second)});
  ASSERT_EQ(events.size(), 8U);
  EXPECT_EQ(events[3]["queue"].dump(), R"({"HOVER":1.08})");
  EXPECT_EQ(events[4]["index"], 5);
  EXPECT_EQ(events[4]["queue"].dump(), R"({"HOVER":null})");
  EXPECT_EQ(events[5]["outcome"], "unchanged");
  EXPECT_EQ(events[5]["queue"].dump(), "{}");
  EXPECT_EQ(events[7]["queue"].dump(), "{}");
}

Event change(std::size_t variable, std::size_t value) {
  Event event = with_subject(Verb::situation, none);
  event.situation.variables = {{variable, value}};
  return event;
}

TEST(Oracle, BehaviorsThatDoNotFitFinish) {
  // A and B are a group of their own each; of the group of C, the first finish replaces all.
  Catalog catalog;
  catalog.tasks = {on_request("A"), reactive("B"), on_request("C"), automatic("D")};
  catalog.behaviors = {behavior("D1", 3), behavior("C1", 2, 100, 3), behavior("B1", 1),
                       behavior("A1", 0), behavior("A2", 0, 50)};
  catalog.variables = {{"LIGHT", {"bright", "dark"}}, {"GPS", {}}};
  for (std::size_t b = 0; b < 4; ++b) {
    catalog.behaviors[b].situation = {{0, {0}}};
  }
  Event several = change(0, 1);
  several.situation.own = {{3, false}};
  several.situation.variables.emplace_back(1, 1);
  const ordered_json events =
      run(catalog, {start(0, 2), start(2), wait_for(one_second), several, change(0, 0)});
  ASSERT_EQ(events.size(), 9U);
  EXPECT_EQ(events[4]["situation"],
            ordered_json::parse(R"({"A1": false, "LIGHT": "dark", "GPS": false})"));
  EXPECT_EQ(events[4]["variables"].dump(), R"({"LIGHT":"dark","GPS":false})");
  for (const std::size_t i : {5U, 6U, 7U}) {
    EXPECT_EQ(events[i]["origin"], "situation");
    EXPECT_EQ(events[i]["cause"], "situation_change");
  }
  // Without D nothing can go on, however high the request of C.
  EXPECT_EQ(events[5]["name"], "D1");
  EXPECT_EQ(changes(events[5]), "-C1 displaced(1)");
  // A reactive task that stops so is tried again.
  EXPECT_EQ(events[6]["name"], "B1");
  EXPECT_EQ(events[6]["queue"].dump(), R"({"B":1.08})");
  EXPECT_EQ(changes(events[7]), "+A2 requested(2)");
  EXPECT_EQ(events[8]["variables"].dump(), R"({"LIGHT":"bright","GPS":false})");
}

TEST(Oracle, ABehaviorThatDoesNotFitIsNotChosen) {
  Catalog catalog;
  catalog.tasks = {on_request("A"), reactive("B")};
  catalog.behaviors = {behavior("A1", 0), behavior("A2", 0, 50), behavior("B1", 1)};
  catalog.variables = {{"LIGHT", {"bright", "dark", "dim"}}};
  catalog.behaviors[0].situation = {{0, {0, 2}}};
  catalog.behaviors[2].situation = {{0, {0, 2}}};
  Script script;
  script.situation.variables = {{0, 1}};
  script.events = {start(0), wait_for(one_second), change(0, 2), change(0, 0)};
  const ordered_json events = run_oracle(catalog, script, nullptr);
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(changes(events[0]), "+A2 requested(1)");
  EXPECT_EQ(events[1]["queue"].dump(), "{}");
  EXPECT_EQ(events[2]["queue"].dump(), R"({"B":1.08})");
  EXPECT_EQ(events[2]["running"].dump(), R"({"A":"A2"})");
}

TEST(Oracle, FinishesWhateverPerformsATask) {
  Catalog catalog;
  catalog.tasks = {on_request("A")};
  catalog.behaviors = {behavior("A1", 0)};
  Event of_task = finish(none, Cause::interrupted);
  of_task.performed_task = 0;
  const ordered_json events = run(catalog, {of_task, start(0), of_task});
  EXPECT_TRUE(events[0]["name"].is_null());
  EXPECT_EQ(events[0]["task"], "A");
  EXPECT_EQ(events[0]["outcome"], "unchanged");
  EXPECT_EQ(events[2]["name"], "A1");
  EXPECT_EQ(events[2]["task"], "A");
  EXPECT_EQ(events[2]["stopped_tasks"].dump(), R"([{"task":"A","cause":"interrupted"}])");
}

}  // namespace
}  // namespace cbc::oracle::oracle_test
