#include "conflict_check.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "demand.h"
#include "partial_performance.h"

namespace cbc::oracle {
namespace {

using nlohmann::ordered_json;

// The state before an event

struct Moment {
  Assignment values;
  std::vector<std::optional<int>> requests;  // priorities
  std::vector<bool> own;
  std::vector<std::size_t> variables;  // the value of each
  std::vector<bool> faulty;
};

// An event and what is needed to judge it.
struct Rejection {
  const ordered_json& event;
  const Moment& before;
  bool starts = false;  // or stops
  bool reactive = false;
  std::size_t subject = none;
  int priority = 0;
};

// Reasons

enum class Kind {
  priority,
  no_behavior,
  makes_worse,
  is_protected,
  exclusive,
  on_request,
  requirement,
  performance,
  unavailable,
  situation,
  faulty
};

// The keys of an entry besides kind and message.
struct Form {
  Kind kind = Kind::priority;
  std::string_view name;
  std::set<std::string_view> keys;
};

const std::vector<Form>& forms() {
  static const std::vector<Form> all = {
      {Kind::priority, "priority", {"task", "priority"}},
      {Kind::no_behavior, "no_behavior", {"task"}},
      {Kind::makes_worse, "makes_worse", {"task"}},
      {Kind::is_protected, "protected", {"task", "priority"}},
      {Kind::exclusive, "exclusive", {"tasks", "line"}},
      {Kind::on_request, "on_request", {"task"}},
      {Kind::requirement, "requires", {"behavior", "task", "line"}},
      {Kind::performance, "performance", {"behavior", "task", "line"}},
      {Kind::performance, "performance", {"task", "line"}},
      {Kind::unavailable, "unavailable", {"behavior"}},
      {Kind::situation, "situation", {"behavior"}},
      {Kind::faulty, "faulty", {"behavior"}},
  };
  return all;
}

struct Reason {
  Kind kind = Kind::priority;
  std::size_t task = none;
  std::size_t other_task = none;
  std::size_t behavior = none;
  int priority = 0;
  Millionths minimum = 0;
  std::vector<std::pair<std::size_t, std::size_t>> best;  // tasks and behaviors
};

class Checker {
 public:
  Checker(const CatalogFacts& facts, const Script& script, Statistics* statistics)
      : facts_(facts), statistics_(statistics) {
    for (std::size_t task = 0; task < facts.catalog.tasks.size(); ++task) {
      tasks_[facts.catalog.tasks[task].name] = task;
    }
    for (std::size_t behavior = 0; behavior < facts.catalog.behaviors.size(); ++behavior) {
      behaviors_[facts.catalog.behaviors[behavior].name] = behavior;
    }
    now_.values.assign(tasks_.size(), none);
    now_.requests.resize(tasks_.size());
    now_.own.resize(behaviors_.size(), true);
    now_.variables.resize(facts.catalog.variables.size(), 0);
    now_.faulty.resize(behaviors_.size(), false);
    for (const auto& [behavior, own] : script.situation.own) {
      now_.own[behavior] = own;
    }
    for (const auto& [variable, value] : script.situation.variables) {
      now_.variables[variable] = value;
    }
  }

  // Checks an event against the state before it, then follows it.
  void handle(const ordered_json& event) {
    if (event.at("outcome") == "rejected") {
      check_rejection(event);
    } else {
      demand(event.at("conflict") == ordered_json::array(), "a conflict without a rejection");
    }
    follow(event);
  }

 private:
  void follow(const ordered_json& event) {
    const auto& verb = event.at("verb").get_ref<const std::string&>();
    if (verb == "situation") {
      for (const auto& [name, value] : event.at("situation").items()) {
        if (const auto behavior = behaviors_.find(name); behavior != behaviors_.end()) {
          now_.own[behavior->second] = value.get<bool>();
        } else {
          set_variable(name, value);
        }
      }
    } else if (verb == "fault" || verb == "repair") {
      now_.faulty[behavior_of(event.at("name"))] = verb == "fault";
    }
    now_.values.assign(tasks_.size(), none);
    for (const auto& [name, behavior] : event.at("running").items()) {
      now_.values[tasks_.at(name)] = behavior_of(behavior);
    }
    now_.requests.assign(tasks_.size(), std::nullopt);
    for (const auto& [name, priority] : event.at("requests").items()) {
      now_.requests[tasks_.at(name)] = priority.get<int>();
    }
  }

  void set_variable(const std::string& name, const ordered_json& value) {
    for (std::size_t v = 0; v < facts_.catalog.variables.size(); ++v) {
      const Variable& variable = facts_.catalog.variables[v];
      if (variable.name != name) {
        continue;
      }
      const auto& values = variable.values;
      now_.variables[v] = variable.is_boolean()
                              ? (value.get<bool>() ? 0U : 1U)
                              : static_cast<std::size_t>(std::find(values.begin(), values.end(),
                                                                   value.get<std::string>()) -
                                                         values.begin());
      return;
    }
    throw std::runtime_error("neither a behavior nor a situation variable: " + name);
  }

  void check_rejection(const ordered_json& event) {
    Rejection rejection{event, now_};
    rejection.starts = event.at("verb") == "start";
    demand(rejection.starts || event.at("verb") == "stop", "neither a start nor a stop");
    rejection.reactive = event.at("origin") == "reactive";
    rejection.subject = task_of(event.at("name"));
    rejection.priority = event.at("priority").get<int>();

    std::vector<Reason> reasons;
    for (const ordered_json& entry : event.at("conflict")) {
      reasons.push_back(read_reason(entry));
      try {
        check_truth(rejection, reasons.back());
      } catch (const std::exception& error) {
        throw std::runtime_error(entry.dump() + ": " + error.what());
      }
      count_kind(rejection, reasons.back(), entry["kind"].get<std::string>());
    }
    if (event.at("search").is_null()) {
      demand(reasons.size() == 1 && reasons.front().kind == Kind::priority,
             "rejected without a search, but not by one priority");
      return;
    }
    demand(event.at("search").at("status") == "infeasible", "rejected, but not infeasible");
    demand(!reasons.empty(), "rejected without a reason");
    const auto comes_alone = [](const Reason& reason) {
      return reason.kind == Kind::no_behavior || reason.kind == Kind::makes_worse;
    };
    if (reasons.size() == 1 && comes_alone(reasons.front())) {
      return;
    }
    for (const Reason& reason : reasons) {
      demand(reason.kind != Kind::priority && !comes_alone(reason),
             "a reason that comes alone, or before a search");
    }
    check_minimal(rejection, reasons);
    for (std::size_t place = 0; place < reasons.size(); ++place) {
      if (reasons[place].kind == Kind::performance) check_best(rejection, reasons, place);
    }
    count("conflict of " + (reasons.size() < 5 ? std::to_string(reasons.size()) : "5 or more"));
    count(std::string("conflict of a ") + (rejection.reactive ? "reactive start"
                                           : rejection.starts ? "start"
                                                              : "stop"));
  }

  std::size_t task_of(const ordered_json& name) const { return find(tasks_, name); }
  std::size_t behavior_of(const ordered_json& name) const { return find(behaviors_, name); }

  static std::size_t find(const std::map<std::string, std::size_t>& numbers,
                          const ordered_json& name) {
    const auto found = numbers.find(name.get<std::string>());
    demand(found != numbers.end(), "unknown name: " + name.dump());
    return found->second;
  }

  Reason read_reason(const ordered_json& entry) const {
    std::set<std::string_view> keys;
    for (const auto& [key, value] : entry.items()) {
      keys.insert(key);
    }
    demand(keys.erase("kind") == 1 && keys.erase("message") == 1, "no kind or message");
    demand(keys.erase("best") == 0 || entry["kind"] == "performance", "not a performance");
    demand(!entry["message"].get<std::string>().empty(), "an empty message");
    const auto form = std::find_if(forms().begin(), forms().end(), [&](const Form& candidate) {
      return entry["kind"].get<std::string>() == candidate.name && keys == candidate.keys;
    });
    demand(form != forms().end(), "unknown kind, or wrong keys: " + entry.dump());

    Reason reason;
    reason.kind = form->kind;
    if (entry.contains("task")) {
      reason.task = task_of(entry["task"]);
    }
    if (entry.contains("tasks")) {
      demand(entry["tasks"].size() == 2, "not a pair");
      reason.task = task_of(entry["tasks"][0]);
      reason.other_task = task_of(entry["tasks"][1]);
    }
    if (entry.contains("behavior")) {
      reason.behavior = behavior_of(entry["behavior"]);
    }
    if (entry.contains("priority")) {
      reason.priority = entry["priority"].get<int>();
    }
    if (reason.kind == Kind::requirement || reason.kind == Kind::performance) {
      reason.minimum = minimum_of(reason);
    }
    if (entry.contains("best")) {
      for (const ordered_json& value : entry["best"]) {
        reason.best.emplace_back(task_of(value.at("task")), behavior_of(value.at("behavior")));
        const auto& [task, behavior] = reason.best.back();
        demand(std::llround(value.at("suitability").get<double>() * 10'000) ==
                   facts_.suitability(behavior, task),
               "not the suitability");
      }
    }
    return reason;
  }

  Millionths minimum_of(const Reason& reason) const {
    if (reason.behavior == none) {
      return facts_.catalog.tasks[reason.task].minimum;
    }
    for (const Requirement& requirement : facts_.catalog.behaviors[reason.behavior].requirements) {
      if (requirement.task == reason.task) {
        return requirement.minimum;
      }
    }
    throw std::runtime_error("the behavior does not require the task");
  }

  // Whether the catalog, or the state before the event, is what the reason says.
  void check_truth(const Rejection& rejection, const Reason& reason) const {
    const Moment& before = rejection.before;
    const bool is_subject = reason.task == rejection.subject;
    switch (reason.kind) {
      case Kind::priority:
        demand(is_subject, "not the task of the event");
        demand(before.requests[reason.task] == reason.priority, "not the priority of the request");
        demand(reason.priority > rejection.priority, "not a higher priority");
        return;
      case Kind::no_behavior:
        demand(is_subject && rejection.starts, "not the task of a start");
        demand(facts_.behaviors_of[reason.task].empty(), "the task has a behavior");
        return;
      case Kind::makes_worse:
        demand(is_subject && rejection.reactive && rejection.priority == 0,
               "not the task of a start that nobody asked for");
        return;
      case Kind::is_protected:
        demand(!is_subject, "the task of the event");
        demand(before.requests[reason.task] == reason.priority, "not the priority of the request");
        demand(rejection.reactive || reason.priority > rejection.priority, "not protected");
        return;
      case Kind::exclusive:
        demand(facts_.excludes[reason.task].contains(reason.other_task), "not exclusive");
        return;
      case Kind::on_request:
        demand(!is_subject, "the task of the event");
        demand(before.values[reason.task] == none, "the task is running");
        demand(facts_.catalog.tasks[reason.task].start_on_request, "it starts by itself");
        return;
      case Kind::requirement:
        return;  // known to exist
      case Kind::performance:
        demand(reason.minimum > 0, "no minimum");
        return;
      case Kind::unavailable:
        demand(!before.own[reason.behavior], "it may be activated by its own answer");
        return;
      case Kind::situation:
        demand(before.own[reason.behavior], "unavailable, too");
        demand(!facts_.fits(reason.behavior, before.variables), "it fits");
        return;
      case Kind::faulty:
        demand(before.faulty[reason.behavior], "not faulty");
        demand(has_failed(rejection, reason.behavior), "not activated in this event");
        return;
    }
  }

  enum class Failed { at_all, before_rejection };

  bool has_failed(const Rejection& rejection, std::size_t behavior,
                  Failed when = Failed::at_all) const {
    const ordered_json& changes = rejection.event.at("changes");
    auto end = changes.end();
    if (when == Failed::before_rejection) {  // without the last rollback
      while (end != changes.begin() && (end - 1)->at("cause") == "undone") {
        --end;
      }
    }
    return std::any_of(changes.begin(), end, [&](const ordered_json& change) {
      return change.at("op") == "activate" && change.at("success") == false &&
             behavior_of(change.at("behavior")) == behavior;
    });
  }

  // Calls `look` with each assignment of the relaxed problem.
  template <typename Look>
  void enumerate(const Rejection& rejection, Look look) const {
    const std::vector<std::size_t>& tasks = facts_.groups[facts_.group_of[rejection.subject]];
    std::vector<std::vector<std::size_t>> domains;
    for (const std::size_t task : tasks) {
      domains.push_back(facts_.behaviors_of[task]);
      if (task == rejection.subject && !rejection.starts) {
        domains.back().clear();
      }
      if (task != rejection.subject || !rejection.starts) {
        domains.back().push_back(none);
      }
    }
    demand(std::none_of(domains.begin(), domains.end(), [](const auto& d) { return d.empty(); }),
           "the task has no behavior, but the reason is another one");

    std::vector<std::size_t> digits(tasks.size(), 0);
    Assignment values = rejection.before.values;
    for (bool more = true; more;) {
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        values[tasks[i]] = domains[i][digits[i]];
      }
      look(values);
      more = false;
      for (std::size_t i = 0; i < tasks.size() && !more; ++i) {
        more = ++digits[i] < domains[i].size();
        if (!more) {
          digits[i] = 0;
        }
      }
    }
  }

  // Every assignment of the relaxed problem must be ruled out by a reason, and every reason must be
  // the only one to rule out some assignment.
  void check_minimal(const Rejection& rejection, const std::vector<Reason>& reasons) const {
    std::vector<bool> needed(reasons.size(), false);
    enumerate(rejection, [&](const Assignment& values) {
      const std::vector<std::size_t> violated = first_violated(rejection, reasons, values);
      if (violated.empty()) {
        throw std::runtime_error(
            "the reasons leave a solution: " +
            describe(values, facts_.groups[facts_.group_of[rejection.subject]]));
      }
      if (violated.size() == 1) {
        needed[violated.front()] = true;
      }
    });
    for (std::size_t i = 0; i < reasons.size(); ++i) {
      demand(needed[i], "superfluous: " + rejection.event["conflict"][i].dump());
    }
  }

  // All reasons that there may be in the group, in this state, and the faults of behaviors that the
  // event has not tried.
  std::vector<Reason> all_reasons(const Rejection& rejection) const {
    std::vector<Reason> all;
    const auto add = [&all](Kind kind, std::size_t task, std::size_t behavior = none,
                            Millionths minimum = 0, std::size_t other_task = none) {
      Reason& reason = all.emplace_back();
      reason.kind = kind;
      reason.task = task;
      reason.behavior = behavior;
      reason.minimum = minimum;
      reason.other_task = other_task;
    };
    const Moment& before = rejection.before;
    std::set<std::size_t> behaviors;
    for (const std::size_t task : facts_.groups[facts_.group_of[rejection.subject]]) {
      const Task& of_catalog = facts_.catalog.tasks[task];
      behaviors.insert(facts_.behaviors_of[task].begin(), facts_.behaviors_of[task].end());
      for (const std::size_t other : facts_.excludes[task]) {
        add(Kind::exclusive, task, none, 0, other);
      }
      if (of_catalog.minimum > 0) add(Kind::performance, task, none, of_catalog.minimum);
      if (task == rejection.subject) continue;
      const auto& request = before.requests[task];
      if (request && (rejection.reactive || *request > rejection.priority)) {
        add(Kind::is_protected, task);
      } else if (before.values[task] == none && of_catalog.start_on_request) {
        add(Kind::on_request, task);
      }
    }
    for (const std::size_t behavior : behaviors) {
      for (const Requirement& requirement : facts_.catalog.behaviors[behavior].requirements) {
        add(Kind::requirement, requirement.task, behavior);
        if (requirement.minimum > 0) {
          add(Kind::performance, requirement.task, behavior, requirement.minimum);
        }
      }
      if (has_failed(rejection, behavior, Failed::before_rejection) ||
          (before.faulty[behavior] && !contains(before.values, behavior))) {
        add(Kind::faulty, none, behavior);
      }
      if (!before.own[behavior]) add(Kind::unavailable, none, behavior);
      if (!facts_.fits(behavior, before.variables)) add(Kind::situation, none, behavior);
    }
    return all;
  }

  // How near to a minimum one can come: the best performance of its task, to a millionth.
  void check_best(const Rejection& rejection, const std::vector<Reason>& conflict,
                  std::size_t place) const {
    const Reason& minimum = conflict[place];
    std::vector<Reason> rest = conflict;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(place));
    std::vector<Reason> others;
    for (Reason& reason : all_reasons(rejection)) {
      if (reason.kind != Kind::performance || reason.task != minimum.task) {
        others.push_back(std::move(reason));
      }
    }
    auto best = find_best(rejection, minimum.task, rest, others);
    if (!best) {
      std::erase_if(others, [](const Reason& reason) {
        return reason.kind == Kind::exclusive || reason.kind == Kind::performance ||
               reason.kind == Kind::is_protected;
      });
      best = find_best(rejection, minimum.task, rest, others);
      count(best ? "best performance, with the behaviors that can be chosen"
                 : "best performance unknown");
    } else {
      count("best performance, where all else holds");
    }
    demand(best.has_value() == !minimum.best.empty(), "a best performance that is not known");
    if (!best) return;
    double told = 1;
    std::set<std::size_t> tasks;
    for (const auto& [task, behavior] : minimum.best) {
      told *= static_cast<double>(facts_.suitability(behavior, task)) / 1e6;
      demand(tasks.insert(task).second, "a task twice");
    }
    for (const auto& [task, behavior] : minimum.best) {
      for (const Requirement& requirement : facts_.catalog.behaviors[behavior].requirements) {
        demand(tasks.contains(requirement.task), "a required task is missing");
      }
    }
    demand(told < *best + 1e-9 && told > *best - 1.001e-6, "not the best performance");
    demand(told < static_cast<double>(minimum.minimum) / 1e6 + 1e-9, "it reaches the minimum");
  }

  std::optional<double> find_best(const Rejection& rejection, std::size_t task,
                                  const std::vector<Reason>& rest,
                                  const std::vector<Reason>& others) const {
    std::optional<double> best;
    enumerate(rejection, [&](const Assignment& values) {
      if (values[task] == none || !first_violated(rejection, rest, values).empty() ||
          !first_violated(rejection, others, values).empty()) {
        return;
      }
      const ExactPerformance exact = performance(facts_, values, task);
      const double one = nearest_double(exact.product, power_of_million(exact.factors));
      best = std::max(best.value_or(0), one);
    });
    return best;
  }

  // At most two: more make no difference.
  std::vector<std::size_t> first_violated(const Rejection& rejection,
                                          const std::vector<Reason>& reasons,
                                          const Assignment& values) const {
    std::vector<std::size_t> violated;
    for (std::size_t i = 0; i < reasons.size() && violated.size() < 2; ++i) {
      if (!holds(rejection, reasons[i], values)) {
        violated.push_back(i);
      }
    }
    return violated;
  }

  bool holds(const Rejection& rejection, const Reason& reason, const Assignment& values) const {
    const auto runs = [&](std::size_t task) { return values[task] != none; };
    const auto assigned = [&] { return contains(values, reason.behavior); };
    switch (reason.kind) {
      case Kind::priority:
      case Kind::no_behavior:
      case Kind::makes_worse:
        return true;
      case Kind::is_protected:
        return runs(reason.task);
      case Kind::exclusive:
        return !runs(reason.task) || !runs(reason.other_task);
      case Kind::on_request:
        return !runs(reason.task);
      case Kind::requirement:
        return !assigned() || runs(reason.task);
      case Kind::performance:
        return !runs(reason.task) || (reason.behavior != none && !assigned()) ||
               reaches_with_what_runs(facts_, values, reason.task, reason.minimum);
      case Kind::unavailable:
        for (const Performance& performed : facts_.catalog.behaviors[reason.behavior].performs) {
          if (values[performed.task] == reason.behavior &&
              rejection.before.values[performed.task] != reason.behavior) {
            return false;
          }
        }
        return true;
      case Kind::situation:  // it is not active, or it would have finished
      case Kind::faulty:
        return !assigned();
    }
    return true;
  }

  std::string describe(const Assignment& values, const std::vector<std::size_t>& tasks) const {
    std::string result;
    for (const std::size_t task : tasks) {
      if (values[task] != none) {
        result += facts_.catalog.tasks[task].name + " = " +
                  facts_.catalog.behaviors[values[task]].name + "; ";
      }
    }
    return result.empty() ? "nothing runs" : result;
  }

  void count_kind(const Rejection& rejection, const Reason& reason, const std::string& kind) const {
    count("conflict: " + kind);
    if (reason.kind == Kind::performance && reason.behavior == none) {
      count("conflict: performance of a task alone");
    }
    if (reason.kind == Kind::is_protected && reason.priority == 0) {
      count("conflict: protected from a reactive start, by priority 0");
    }
    if (reason.kind == Kind::unavailable && contains(rejection.before.values, reason.behavior)) {
      count("conflict: unavailable, but active");
    }
    if (reason.kind == Kind::unavailable &&
        !facts_.fits(reason.behavior, rejection.before.variables)) {
      count("conflict: unavailable, and does not fit");
    }
  }

  void count(const std::string& what) const {
    if (statistics_ != nullptr) {
      statistics_->count(what);
    }
  }

  const CatalogFacts& facts_;
  Statistics* statistics_;
  std::map<std::string, std::size_t> tasks_;
  std::map<std::string, std::size_t> behaviors_;
  Moment now_;
};

}  // namespace

std::optional<ConflictFault> check_conflicts(const CatalogFacts& facts, const Script& script,
                                             const ordered_json& events, Statistics* statistics) {
  Checker checker(facts, script, statistics);
  for (std::size_t i = 0; i < events.size(); ++i) {
    try {
      checker.handle(events[i]);
    } catch (const std::exception& error) {
      return ConflictFault{i, error.what()};
    }
  }
  return std::nullopt;
}

}  // namespace cbc::oracle
