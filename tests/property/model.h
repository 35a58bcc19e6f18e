// Plain data: a catalog and an event script, as the oracle and the generator see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace cbc::oracle {

using Microseconds = std::int64_t;

// A percentage, exact to four decimals: 100 % is one million.
using Millionths = std::int64_t;
inline constexpr Millionths whole_degree = 1'000'000;

// Tasks and behaviors are numbered in catalog order. As the value of a task, none is "not
// running".
inline constexpr std::size_t none = static_cast<std::size_t>(-1);

enum class Improve { at_events, at_once, when_started };
enum class Retry { at_events, when_started, after_repair };

struct Task {
  std::string name;
  bool listed = true;  // in the `tasks:` section; if not, only behaviors name it
  bool start_on_request = true;
  bool reactive_start = false;
  bool keep_running = false;
  std::optional<Microseconds> timeout;
  Millionths minimum = 0;
  bool requestable = true;
  int reactive_priority = 0;
  Improve improve = Improve::at_events;
  bool resume = false;

  bool operator==(const Task&) const = default;
};

struct Performance {
  std::size_t task = 0;
  Millionths suitability = whole_degree;

  bool operator==(const Performance&) const = default;
};

struct Requirement {
  std::size_t task = 0;
  Millionths minimum = 0;

  bool operator==(const Requirement&) const = default;
};

// A situation variable. Values are numbered in their order; the first one is the initial value.
struct Variable {
  std::string name;
  std::vector<std::string> values;  // none: true and false, in this order

  bool is_boolean() const { return values.empty(); }
  std::size_t value_count() const { return is_boolean() ? 2 : values.size(); }

  bool operator==(const Variable&) const = default;
};

// What a behavior asks of a variable: one of these values.
struct Condition {
  std::size_t variable = 0;
  std::vector<std::size_t> values;

  bool operator==(const Condition&) const = default;
};

struct Behavior {
  std::string name;
  std::vector<Performance> performs;
  std::vector<Requirement> requirements;
  std::optional<Microseconds> timeout;
  std::vector<Condition> situation = {};  // at most one condition for each variable
  Retry retry = Retry::at_events;

  bool operator==(const Behavior&) const = default;
};

// What `default_values` says; an empty field is a key that is absent.
struct Defaults {
  std::optional<bool> start_on_request;
  std::optional<bool> reactive_start;
  std::optional<bool> keep_running;
  std::optional<Microseconds> timeout;
  std::optional<Millionths> suitability;
};

// The attributes of the tasks and behaviors are complete without the defaults, which matter only
// when the catalog is written as YAML.
struct Catalog {
  Defaults defaults;
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<std::vector<std::size_t>> exclusivity;
  // How many tasks of each list may run; lists that are not named here: 1.
  std::vector<std::size_t> at_most = {};
  std::vector<Variable> variables = {};

  std::size_t most(std::size_t list) const { return list < at_most.size() ? at_most[list] : 1; }
  // Whether it says something that only the third edition of the definition knows.
  bool has_further_keys() const {
    for (const Task& task : tasks) {
      if (!task.requestable || task.reactive_priority != 0 || task.resume ||
          task.improve != Improve::at_events) {
        return true;
      }
    }
    for (const Behavior& behavior : behaviors) {
      if (behavior.retry != Retry::at_events) return true;
    }
    for (std::size_t list = 0; list < exclusivity.size(); ++list) {
      const std::set<std::size_t> members(exclusivity[list].begin(), exclusivity[list].end());
      if (most(list) > 1 && members.size() > 1) return true;
    }
    return false;
  }
};

enum class Verb { start, stop, finish, situation, fault, repair, wait, reconsider };

enum class Cause {
  goal_achieved,
  situation_change,
  time_out,
  wrong_progress,
  process_failure,
  interrupted
};

// Any YAML value whose scalars are text or null.
using Parameters = nlohmann::ordered_json;

// What an event changes of the situation.
struct Situation {
  std::vector<std::pair<std::size_t, bool>> own;               // behavior, its own answer
  std::vector<std::pair<std::size_t, std::size_t>> variables;  // variable, value

  bool empty() const { return own.empty() && variables.empty(); }
};

struct Event {
  Verb verb = Verb::wait;
  std::optional<Microseconds> at;        // at most one of at and wait
  std::optional<Microseconds> wait;      // since the event before
  std::size_t subject = none;            // start, stop: a task; finish, fault, repair: a behavior
  std::optional<int> priority;           // start, stop
  std::optional<Parameters> parameters;  // start
  Cause cause = Cause::goal_achieved;    // finish
  std::size_t performed_task = none;     // finish: whatever performs this task, not the subject
  Situation situation;
};

struct Script {
  std::optional<Microseconds> reactive_delay;
  Situation situation;  // before the first event
  std::vector<Event> events;
};

inline const char* to_string(Verb verb) {
  switch (verb) {
    case Verb::start:
      return "start";
    case Verb::stop:
      return "stop";
    case Verb::finish:
      return "finish";
    case Verb::situation:
      return "situation";
    case Verb::fault:
      return "fault";
    case Verb::repair:
      return "repair";
    case Verb::wait:
      return "wait";
    case Verb::reconsider:
      return "reconsider";
  }
  return "";
}

inline const char* to_string(Cause cause) {
  switch (cause) {
    case Cause::goal_achieved:
      return "goal_achieved";
    case Cause::situation_change:
      return "situation_change";
    case Cause::time_out:
      return "time_out";
    case Cause::wrong_progress:
      return "wrong_progress";
    case Cause::process_failure:
      return "process_failure";
    case Cause::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace cbc::oracle
