#include "explanation_check.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "demand.h"
#include "enumeration.h"
#include "oracle.h"
#include "partial_performance.h"

namespace cbc::oracle {
namespace {

using nlohmann::ordered_json;
using Holds = std::function<bool(const Assignment&)>;
using Wanted = std::function<bool(const Assignment&)>;

// Judges the reasons of an event, or of one that has not happened.
class Reasons {
 public:
  Reasons(const CatalogFacts& facts, const Answer& answer, Statistics& statistics)
      : facts_(facts),
        answer_(answer),
        statistics_(statistics),
        tasks_(facts.groups[answer.problem.group]) {}

  // Each assignment that is wanted, and asked for, is ruled out by a reason, and each reason is the
  // only one to rule out some of them. One more reason may say that the event stops its tasks: if
  // and only if what is not asked for is not ruled out by the others.
  void check(const ordered_json& conflict, const Wanted& wanted) {
    std::vector<Holds> reasons;
    bool names_event = false;
    for (const ordered_json& reason : conflict) {
      statistics_.count("reason: " + reason["kind"].get<std::string>());
      if (is_event(reason)) {
        demand(!names_event && &reason == &conflict.back(), "the event twice, or not at the end");
        names_event = true;
      } else {
        reasons.push_back(read_reason(reason));
      }
    }
    statistics_.count(conflict.empty() ? "no other choice" : "explained by reasons");
    std::vector<bool> needed(reasons.size(), false);
    bool needs_event = false;
    Assignment values = answer_.before.values;
    const std::function<void(std::size_t)> enumerate = [&](std::size_t place) {
      if (place == tasks_.size()) {
        if (wanted(values) && is_asked_for(values)) {
          judge(reasons, values, needed);
        } else if (wanted(values) && answer_.trigger.verb != Verb::start) {
          needs_event =
              needs_event || std::all_of(reasons.begin(), reasons.end(),
                                         [&](const Holds& holds) { return holds(values); });
        }
        return;
      }
      values[tasks_[place]] = none;
      enumerate(place + 1);
      for (const std::size_t behavior : facts_.behaviors_of[tasks_[place]]) {
        values[tasks_[place]] = behavior;
        enumerate(place + 1);
      }
    };
    enumerate(0);
    for (std::size_t i = 0; i < needed.size(); ++i) {
      demand(needed[i], "superfluous: " + conflict[i].dump());
    }
    demand(names_event == needs_event, "wrong about the event as a reason");
  }

 private:
  // Whether a reason says that the event stops its tasks.
  bool is_event(const ordered_json& reason) const {
    const Trigger& trigger = answer_.trigger;
    if (trigger.verb == Verb::stop && reason.at("kind") == "stopped") {
      demand(task_of(reason.at("task")) == trigger.subject, "not the task of the event");
      return true;
    }
    if (trigger.verb == Verb::finish && trigger.cause == Cause::goal_achieved &&
        reason.at("kind") == "finished") {
      demand(behavior_of(reason.at("behavior")) == trigger.subject, "not the finished behavior");
      return true;
    }
    return false;
  }

  std::size_t task_of(const ordered_json& name) const {
    for (std::size_t task = 0; task < facts_.catalog.tasks.size(); ++task) {
      if (name == facts_.catalog.tasks[task].name) {
        return task;
      }
    }
    throw std::runtime_error("no such task: " + name.dump());
  }
  std::size_t behavior_of(const ordered_json& name) const {
    for (std::size_t b = 0; b < facts_.catalog.behaviors.size(); ++b) {
      if (name == facts_.catalog.behaviors[b].name) {
        return b;
      }
    }
    throw std::runtime_error("no such behavior: " + name.dump());
  }

  // Whether an assignment is what the event alone asks for.
  bool is_asked_for(const Assignment& values) const {
    const Trigger& trigger = answer_.trigger;
    if (trigger.verb == Verb::start) {
      return values[trigger.subject] != none;
    }
    if (trigger.verb == Verb::stop) {
      return values[trigger.subject] == none;
    }
    return trigger.cause != Cause::goal_achieved ||
           std::all_of(answer_.finished_tasks.begin(), answer_.finished_tasks.end(),
                       [&](std::size_t task) { return values[task] == none; });
  }

  static void judge(const std::vector<Holds>& reasons, const Assignment& values,
                    std::vector<bool>& needed) {
    std::size_t violated = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < reasons.size() && violated < 2; ++i) {
      if (!reasons[i](values)) {
        ++violated;
        last = i;
      }
    }
    demand(violated > 0, "the reasons leave a solution");
    if (violated == 1) {
      needed[last] = true;
    }
  }

  // What a reason says of an assignment. It must be true of the catalog, or of the moment.
  Holds read_reason(const ordered_json& reason) const {
    const std::string kind = reason.at("kind");
    if (kind == "exclusive") {
      const std::size_t a = task_of(reason.at("tasks").at(0));
      const std::size_t b = task_of(reason.at("tasks").at(1));
      demand(facts_.excludes[a].contains(b), "not exclusive");
      return [=](const Assignment& values) { return values[a] == none || values[b] == none; };
    }
    if (kind == "unavailable" || kind == "situation" || kind == "faulty" || kind == "finished") {
      return read_condition(kind, behavior_of(reason.at("behavior")));
    }
    const std::size_t task = task_of(reason.at("task"));
    const bool has_finished = contains(answer_.finished_tasks, task);
    const bool is_subject = answer_.trigger.verb != Verb::finish && task == answer_.trigger.subject;
    if (kind == "protected") {
      const std::optional<Request>& request = answer_.before.requests[task];
      demand(request && reason.at("priority") == request->priority, "not the request");
      demand(!has_finished && !is_subject &&
                 (answer_.trigger.reactive || request->priority > answer_.level),
             "not protected");
      return [=](const Assignment& values) { return values[task] != none; };
    }
    if (kind == "on_request") {
      demand(answer_.before.values[task] == none && !is_subject &&
                 facts_.catalog.tasks[task].start_on_request,
             "it can start by itself");
      return [=](const Assignment& values) { return values[task] == none; };
    }
    return read_constraint(reason, kind, task);
  }

  Holds read_condition(const std::string& kind, std::size_t behavior) const {
    if (kind == "faulty" || kind == "finished") {
      const bool is_own = answer_.trigger.verb == Verb::finish &&
                          answer_.trigger.subject == behavior &&
                          answer_.trigger.cause != Cause::goal_achieved &&
                          answer_.trigger.cause != Cause::situation_change;
      demand(answer_.excluded.contains(behavior) && is_own == (kind == "finished"),
             "not excluded for this");
      return [=](const Assignment& values) { return !contains(values, behavior); };
    }
    // A behavior that does not fit may not be kept either.
    const bool fits = facts_.fits(behavior, answer_.variables);
    const bool has_finished =
        answer_.trigger.verb == Verb::finish && answer_.trigger.subject == behavior;
    const bool was_active = contains(answer_.before.values, behavior) && !has_finished;
    const bool is_denied = !answer_.own[behavior] && (fits || !was_active);
    demand(is_denied == (kind == "unavailable"), "the other kind");
    demand(is_denied || !fits, "available");
    return [this, behavior, fits](const Assignment& values) {
      for (std::size_t task = 0; task < values.size(); ++task) {
        const bool is_kept = fits && answer_.before.values[task] == behavior &&
                             !contains(answer_.finished_tasks, task);
        if (values[task] == behavior && !is_kept) {
          return false;
        }
      }
      return true;
    };
  }

  Holds read_constraint(const ordered_json& reason, const std::string& kind,
                        std::size_t task) const {
    demand(kind == "requires" || kind == "performance", "unknown kind: " + kind);
    if (!reason.contains("behavior")) {
      const Millionths minimum = facts_.catalog.tasks[task].minimum;
      demand(kind == "performance" && minimum > 0, "no minimum");
      return [=, this](const Assignment& values) {
        return values[task] == none || reaches_with_what_runs(facts_, values, task, minimum);
      };
    }
    const std::size_t behavior = behavior_of(reason.at("behavior"));
    const auto& requirements = facts_.catalog.behaviors[behavior].requirements;
    const auto requirement = std::find_if(requirements.begin(), requirements.end(),
                                          [&](const Requirement& one) { return one.task == task; });
    demand(requirement != requirements.end(), "no such requirement");
    if (kind == "requires") {
      return [=](const Assignment& values) {
        return !contains(values, behavior) || values[task] != none;
      };
    }
    const Millionths minimum = requirement->minimum;
    demand(minimum > 0, "no minimum");
    return [=, this](const Assignment& values) {
      return !contains(values, behavior) || values[task] == none ||
             reaches_with_what_runs(facts_, values, task, minimum);
    };
  }

  const CatalogFacts& facts_;
  const Answer& answer_;
  Statistics& statistics_;
  const std::vector<std::size_t>& tasks_;
};

// The explanations of one event.
class Check {
 public:
  Check(const CatalogFacts& facts, const Answer& answer, const ordered_json& event,
        Statistics& statistics)
      : facts_(facts),
        answer_(answer),
        event_(event),
        statistics_(statistics),
        tasks_(facts.groups[answer.problem.group]),
        solutions_(solve_all(facts, answer.problem)) {}

  void check_alternatives(std::size_t most) {
    const ordered_json& list = event_["alternatives"]["configurations"];
    demand(event_["alternatives"]["limit_reached"] == false, "a limit was reached");
    std::vector<const Solution*> worthwhile;
    for (const Solution& solution : solutions_) {
      if (!has_needless_task(solution.values)) {
        worthwhile.push_back(&solution);
      }
    }
    demand(list.size() == std::min(most, worthwhile.size()), "wrong number of alternatives");
    for (std::size_t i = 0; i < list.size(); ++i) {
      check_configuration(list[i], *worthwhile[i]);
    }
    if (worthwhile.size() < solutions_.size()) {
      statistics_.count("alternatives: some are left out");
    }
    statistics_.count(list.size() < most ? "alternatives: all" : "alternatives: the best");
  }

  void check_why() {
    std::size_t next = 0;
    for (const std::size_t task : tasks_) {
      const ordered_json& why = event_["why"].at(next++);
      if (answer_.queued.contains(task)) {
        check_queued(task, why);
      } else {
        check_task(task, why);
      }
    }
    for (std::size_t b = 0; b < facts_.catalog.behaviors.size(); ++b) {
      if (facts_.group_of_behavior(b) == answer_.problem.group) {
        check_behavior(b, event_["why"].at(next++));
      }
    }
    demand(next == event_["why"].size(), "more explanations than asked for");
  }

  // Requests that are not satisfied are displaced, and explained as any task that does not run.
  void check_displaced() {
    std::size_t next = 0;
    for (const ActiveRequest& request : running_requests()) {
      if (answer_.solution.values[request.task] != none) {
        continue;
      }
      const auto place = std::find(tasks_.begin(), tasks_.end(), request.task) - tasks_.begin();
      const ordered_json& why = event_["why"].at(static_cast<std::size_t>(place));
      const ordered_json& displaced = event_["displaced"].at(next++);
      if (why.contains("due")) {
        check_task(request.task, displaced);
      } else {
        demand(displaced == why, "a displaced task is explained in two ways");
      }
      statistics_.count("displaced");
    }
    demand(next == event_["displaced"].size(), "a task that is not displaced");
  }

 private:
  const std::string& name_of_task(std::size_t task) const {
    return facts_.catalog.tasks[task].name;
  }
  ordered_json name_of_value(std::size_t value) const {
    return value == none ? ordered_json() : ordered_json(facts_.catalog.behaviors[value].name);
  }

  // Of the tasks outside the group, too.
  Integer suitability_of_all(const Assignment& values) const {
    Integer product = 1;
    for (std::size_t task = 0; task < values.size(); ++task) {
      product *= values[task] == none ? whole_degree : facts_.suitability(values[task], task);
    }
    return product;
  }

  std::pair<std::size_t, std::size_t> idle_of_all(const Assignment& values) const {
    std::size_t all = 0;
    std::size_t running = 0;
    for (std::size_t task = 0; task < values.size(); ++task) {
      if (!facts_.catalog.tasks[task].start_on_request) {
        ++all;
        running += values[task] == none ? 0U : 1U;
      }
    }
    return {all - running, all};
  }

  std::size_t satisfied_of_all(const Solution& solution) const {
    return event_["objective"]["satisfied"].get<std::size_t>() + solution.satisfied_count -
           answer_.solution.satisfied_count;
  }

  // Whether a task of the group runs that nobody requested, and nothing that runs requires.
  // Those of tasks that run, or are started; of any priority.
  std::vector<ActiveRequest> running_requests() const {
    std::vector<ActiveRequest> requests = answer_.problem.requests;
    requests.insert(requests.end(), answer_.problem.unasked.begin(), answer_.problem.unasked.end());
    return requests;
  }

  bool has_needless_task(const Assignment& values) const {
    return std::any_of(tasks_.begin(), tasks_.end(), [&](std::size_t task) {
      const std::vector<ActiveRequest> requests = running_requests();
      const bool is_requested =
          std::any_of(requests.begin(), requests.end(),
                      [&](const ActiveRequest& request) { return request.task == task; });
      const bool is_required = std::any_of(values.begin(), values.end(), [&](std::size_t behavior) {
        if (behavior == none) {
          return false;
        }
        const auto& requirements = facts_.catalog.behaviors[behavior].requirements;
        return std::any_of(requirements.begin(), requirements.end(),
                           [&](const Requirement& one) { return one.task == task; });
      });
      return values[task] != none && !is_requested && !is_required;
    });
  }

  void check_configuration(const ordered_json& actual, const Solution& expected) const {
    ordered_json running = ordered_json::object();
    for (const std::size_t task : tasks_) {
      if (expected.values[task] != none) {
        running[name_of_task(task)] = name_of_value(expected.values[task]);
      }
    }
    const auto [idle, all] = idle_of_all(expected.values);
    const ordered_json objective = {
        {"satisfied", satisfied_of_all(expected)},
        {"requests", event_["objective"]["requests"]},
        {"suitability", nearest_double(suitability_of_all(expected.values),
                                       power_of_million(expected.values.size()))},
        {"idle", all == 0 ? 1.0 : static_cast<double>(idle) / static_cast<double>(all)},
        {"changes", expected.changes}};
    const ordered_json whole = {{"running", running}, {"objective", objective}};
    demand(actual == whole, "expected " + whole.dump() + ", found " + actual.dump());
  }

  // A task in Q: not why the event did not start it, but what hinders its start now.
  void check_queued(std::size_t task, const ordered_json& why) {
    demand(why.at("task") == name_of_task(task) && why.at("chosen").is_null(), "not the next task");
    check_start(task, why);
  }

  void check_start(std::size_t task, const ordered_json& why) {
    demand(why.at("due") == event_["queue"].at(name_of_task(task)), "not when it is due");
    demand(why.at("limit_reached") == false, "a limit was reached");
    demand(why.at("alternative").is_null() && why.at("loses").is_null(), "an alternative");
    demand(!why.at("message").get<std::string>().empty(), "no message");
    const bool can_start = answer_.queued.at(task);
    statistics_.count(can_start ? "queued: can start" : "queued: something hinders it");
    demand(why.at("conflict").empty() == can_start, "wrong about whether it can start");
    if (can_start || facts_.behaviors_of[task].empty()) {
      return;
    }
    Answer start;
    start.trigger.verb = Verb::start;
    start.trigger.subject = task;
    start.trigger.reactive = true;
    start.problem.group = answer_.problem.group;
    start.before = answer_.after;
    start.own = answer_.own;
    start.variables = answer_.variables;
    Reasons(facts_, start, statistics_).check(why["conflict"], [](const Assignment&) {
      return true;
    });
  }

  void check_task(std::size_t task, const ordered_json& why) {
    demand(!why.contains("due"), "due, but not in the queue");
    demand(why.at("task") == name_of_task(task), "not the next task");
    const std::size_t value = answer_.solution.values[task];
    demand(why.at("chosen") == name_of_value(value), "not the value of the task");
    if (facts_.behaviors_of[task].empty()) {
      demand(why.at("alternative").is_null(), "an alternative without a behavior");
      demand(why.at("conflict").size() == 1, "not the one reason");
      const ordered_json& reason = why["conflict"][0];
      demand(reason.at("kind") == "no_behavior" && reason.at("task") == why["task"],
             "not that no behavior performs the task");
      statistics_.count("reason: no_behavior");
      return;
    }
    check_why_not(why, [&](const Assignment& values) { return values[task] != value; });
  }

  void check_behavior(std::size_t behavior, const ordered_json& why) {
    const auto is_active = [&](const Assignment& values) { return contains(values, behavior); };
    const bool was_chosen = is_active(answer_.solution.values);
    demand(why.at("behavior") == name_of_value(behavior), "not the next behavior");
    demand(why.at("active") == was_chosen, "wrong about being active");
    if (why.contains("due")) {
      check_due(behavior, was_chosen, why);
      return;
    }
    check_why_not(why, [&](const Assignment& values) { return is_active(values) != was_chosen; });
  }

  // An inactive behavior of tasks in Q: as the first of them.
  void check_due(std::size_t behavior, bool is_active, const ordered_json& why) {
    std::size_t first = none;
    for (const Performance& one : facts_.catalog.behaviors[behavior].performs) {
      const auto entry = event_["queue"].find(name_of_task(one.task));
      const bool is_queued = entry != event_["queue"].end() && !entry->is_null();
      if (is_queued && one.task < first) {
        first = one.task;
      }
    }
    demand(!is_active && first != none, "none of its tasks is in the queue");
    check_start(first, why);
    statistics_.count("queued: a behavior");
  }

  void check_why_not(const ordered_json& why, const Wanted& wanted) {
    demand(why.at("limit_reached") == false, "a limit was reached");
    demand(!why.at("message").get<std::string>().empty(), "no message");
    const auto best =
        std::find_if(solutions_.begin(), solutions_.end(),
                     [&](const Solution& solution) { return wanted(solution.values); });
    if (best == solutions_.end()) {
      demand(why["alternative"].is_null() && why["loses"].is_null(), "there is no alternative");
      demand(why["differences"].empty(), "differences from nothing");
      Reasons(facts_, answer_, statistics_).check(why["conflict"], wanted);
      return;
    }
    demand(why["conflict"].empty(), "a conflict, but there is an alternative");
    check_configuration(why["alternative"], *best);
    demand(why["loses"] == loss(*best),
           "expected " + loss(*best).dump() + ", found " + why["loses"].dump());
    check_differences(why["differences"], *best);
    statistics_.count("loses by: " + why["loses"]["objective"].get<std::string>());
  }

  void check_differences(const ordered_json& actual, const Solution& other) const {
    std::size_t found = 0;
    for (const std::size_t task : tasks_) {
      const std::size_t ours = answer_.solution.values[task];
      const std::size_t theirs = other.values[task];
      if (ours == theirs) {
        continue;
      }
      demand(found < actual.size(), "a difference is missing");
      const ordered_json& difference = actual[found++];
      demand(difference.at("task") == name_of_task(task), "not the next task that differs");
      check_value(difference.at("chosen"), task, ours);
      check_value(difference.at("alternative"), task, theirs);
    }
    demand(found == actual.size(), "more differences than there are");
  }

  void check_value(const ordered_json& actual, std::size_t task, std::size_t value) const {
    if (value == none) {
      demand(actual.is_null(), "it does not run");
      return;
    }
    demand(actual.at("behavior") == name_of_value(value), "not its behavior");
    const double millionths = actual.at("suitability").get<double>() * 10'000;
    demand(std::llround(millionths) == facts_.suitability(value, task), "not its suitability");
  }

  ordered_json loss(const Solution& other) const {
    Solution chosen = answer_.solution;
    // Where nothing runs that nobody asked for, f2 says the same.
    if (answer_.problem.unasked.empty()) chosen.asked = other.asked;
    const auto of = [](const char* objective, const ordered_json& ours,
                       const ordered_json& theirs) {
      return ordered_json{{"objective", objective}, {"chosen", ours}, {"alternative", theirs}};
    };
    switch (first_difference(chosen, other)) {
      case Criterion::satisfied:
        return of("requests", satisfied_of_all(chosen), satisfied_of_all(other));
      case Criterion::request_order:
        return order(answer_.problem.requests, chosen.satisfied, other.satisfied);
      case Criterion::suspended:
        return order(answer_.problem.suspended, chosen.resumed, other.resumed);
      case Criterion::unasked:
        return order(answer_.problem.unasked, chosen.unasked, other.unasked);
      case Criterion::asked:
        return of("asked", decimal(chosen.asked, tasks_.size()),
                  decimal(other.asked, tasks_.size()));
      case Criterion::suitability:
        return of("suitability", exact(chosen.values), exact(other.values));
      case Criterion::idle:
        return of("idle", idle_text(chosen.values), idle_text(other.values));
      case Criterion::changes:
        return of("changes", chosen.changes, other.changes);
      case Criterion::ranks:
        for (const std::size_t task : tasks_) {
          if (chosen.values[task] != other.values[task]) {
            return {{"objective", "canonical"},
                    {"task", name_of_task(task)},
                    {"chosen", name_of_value(chosen.values[task])},
                    {"alternative", name_of_value(other.values[task])}};
          }
        }
        break;
      case Criterion::nothing:
        break;
    }
    throw std::runtime_error("the chosen solution is its own alternative");
  }

  std::string idle_text(const Assignment& values) const {
    const auto [idle, all] = idle_of_all(values);
    return std::to_string(idle) + "/" + std::to_string(all);
  }

  // The first of the requests that only one of the two serves, for each of them.
  ordered_json order(const std::vector<ActiveRequest>& requests, const std::vector<bool>& ours,
                     const std::vector<bool>& theirs) const {
    std::vector<ordered_json> only(2);
    for (std::size_t i = requests.size(); i > 0; --i) {
      if (ours[i - 1] != theirs[i - 1]) {
        only[ours[i - 1] ? 0 : 1] = name_of_task(requests[i - 1].task);
      }
    }
    return {{"objective", "request_order"}, {"chosen", only[0]}, {"alternative", only[1]}};
  }

  // As a decimal number; of the group alone, where it is 0 outside.
  std::string exact(Assignment values) const {
    Assignment outside = values;
    for (const std::size_t task : tasks_) {
      outside[task] = none;
    }
    if (suitability_of_all(outside) == 0) {
      for (std::size_t task = 0; task < values.size(); ++task) {
        if (!contains(tasks_, task)) {
          values[task] = none;
        }
      }
    }
    return decimal(suitability_of_all(values), values.size());
  }

  static std::string decimal(const Integer& product, std::size_t factors) {
    const Integer whole = power_of_million(factors);
    if (product == 0 || product == whole) {
      return product == 0 ? "0" : "1";
    }
    std::string digits = Integer(whole + product).str();
    digits.erase(digits.find_last_not_of('0') + 1);
    return "0." + digits.substr(1);
  }

  const CatalogFacts& facts_;
  const Answer& answer_;
  const ordered_json& event_;
  Statistics& statistics_;
  const std::vector<std::size_t>& tasks_;
  std::vector<Solution> solutions_;  // all, the best first
};

}  // namespace

std::optional<std::string> check_explanations(const Catalog& catalog, const Script& script,
                                              const ordered_json& events, std::size_t most,
                                              Statistics& statistics) {
  const auto facts = std::make_shared<const CatalogFacts>(catalog);
  Oracle oracle(facts, script, nullptr);
  oracle.keep_answers();
  for (const Event& event : script.events) {
    oracle.handle(event);
  }
  oracle.finish();
  std::size_t accepted = 0;
  for (const ordered_json& event : events) {
    const auto answer = oracle.answers().find(event.at("index"));
    try {
      if (answer == oracle.answers().end()) {
        demand(event["why"].empty() && event["displaced"].empty() &&
                   event["alternatives"]["configurations"].empty(),
               "nothing was solved");
        continue;
      }
      ++accepted;
      Check check(*facts, answer->second, event, statistics);
      check.check_alternatives(most);
      check.check_why();
      check.check_displaced();
    } catch (const std::exception& error) {
      return std::string(error.what()) + "\n" + event.dump(1);
    }
  }
  if (accepted != oracle.answers().size()) {
    return "not all accepted events are there";
  }
  return std::nullopt;
}

}  // namespace cbc::oracle
