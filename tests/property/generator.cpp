#include "generator.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "enumeration.h"
#include "oracle.h"

namespace cbc::oracle {
namespace {

// Runs an oracle along with the script it writes.
class ScriptGenerator {
 public:
  ScriptGenerator(Random& random, const Catalog& catalog)
      : random_(random),
        facts_(std::make_shared<const CatalogFacts>(catalog)),
        unit_(usual_unit(catalog)),
        script_(generate_settings()),
        oracle_(facts_, script_, nullptr) {}

  Script generate() {
    const std::size_t length = 10 + random_.below(21);
    while (script_.events.size() < length) {
      if (script_.events.size() < 5 && random_.percent(60)) {
        emit_timed(start_event(random_.below(task_count())));
      } else {
        add_something();
      }
    }
    return std::move(script_);
  }

 private:
  Microseconds usual_unit(const Catalog& catalog) {
    std::vector<Microseconds> timeouts;
    for (const Task& task : catalog.tasks) {
      if (task.timeout) {
        timeouts.push_back(*task.timeout);
      }
    }
    return timeouts.empty() || random_.percent(50) ? pick_time_unit(random_)
                                                   : random_.pick(timeouts);
  }

  Script generate_settings() {
    Script script;
    if (random_.percent(50)) {
      const std::vector<Microseconds> delays = {80'000,    unit_,     unit_,         2 * unit_,
                                                unit_ / 2, unit_ / 4, unit_ * 3 / 2, 1};
      script.reactive_delay = random_.pick(delays);
    }
    if (random_.percent(40)) {
      for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
        if (random_.percent(15)) {
          script.situation.own.emplace_back(b, random_.percent(15));
        }
      }
      random_.shuffle(script.situation.own);
    }
    if (random_.percent(40)) {
      for (std::size_t v = 0; v < facts_->catalog.variables.size(); ++v) {
        if (random_.percent(60)) {
          script.situation.variables.emplace_back(v, pick_value(v));
        }
      }
    }
    return script;
  }

  void emit(const Event& event) {
    script_.events.push_back(event);
    oracle_.handle(event);
  }

  void emit_timed(Event event) {
    add_time(event);
    emit(event);
  }

  void add_time(Event& event) {
    const std::size_t way = random_.below(100);
    const std::optional<Microseconds> due = oracle_.next_due_time();
    if (way < 50) {
      return;
    }
    if (way < 72 && due && *due >= oracle_.now()) {
      if (random_.percent(50)) {
        event.at = *due;
      } else {
        event.wait = *due - oracle_.now();
      }
    } else if (way < 90) {
      event.wait = unit_ * random_.between(0, 3);
    } else if (way < 96) {
      event.at = oracle_.now() + unit_ * random_.between(0, 4);
    } else {
      event.wait = random_.between(0, 2 * unit_);
    }
  }

  void add_something() {
    if (!facts_->catalog.variables.empty() && random_.percent(14)) {
      return add_change_of_variables();
    }
    const std::size_t way = random_.below(100);
    if (way < 32) {
      emit_timed(start_event(random_.below(task_count())));
    } else if (way < 39) {
      add_restart();
    } else if (way < 46) {
      add_stop();
    } else if (way < 60) {
      add_finish();
    } else if (way < 65) {
      add_wait();
    } else if (way < 74) {
      add_situation();
    } else if (way < 77) {
      add_fault();
    } else if (way < 87) {
      add_repair();
    } else if (way < 91) {
      add_contested_event();
    } else {
      add_failing_event();
    }
  }

  // A start that makes the order of the requests decide, or a finish that must override higher
  // priorities, if there is one.
  void add_contested_event() {
    std::vector<Event> candidates;
    for (std::size_t task = 0; task < task_count(); ++task) {
      if (!facts_->catalog.tasks[task].requestable) {
        continue;
      }
      Event event;
      event.verb = Verb::start;
      event.subject = task;
      event.priority = static_cast<int>(random_.between(1, 4));
      candidates.push_back(event);
    }
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (is_active(b)) {
        Event event;
        event.verb = Verb::finish;
        event.subject = b;
        event.cause = random_.percent(50) ? Cause::process_failure : Cause::interrupted;
        candidates.push_back(event);
      }
    }
    random_.shuffle(candidates);
    for (const Event& event : candidates) {
      Statistics statistics;
      oracle_.preview(event, &statistics);
      if (statistics.of("decided by: f1, order of requests") != 0 ||
          statistics.of("escalation: 1") != 0 || statistics.of("escalation: 2") != 0 ||
          statistics.of("escalation: 3 or more") != 0) {
        emit(event);
        return;
      }
    }
  }

  std::size_t task_count() const { return facts_->catalog.tasks.size(); }

  std::vector<std::size_t> tasks_where(bool running, bool requested) const {
    std::vector<std::size_t> result;
    for (std::size_t task = 0; task < task_count(); ++task) {
      const bool runs = oracle_.state().values[task] != none;
      if (runs == running && (!requested || oracle_.state().requests[task])) {
        result.push_back(task);
      }
    }
    return result;
  }

  template <typename Predicate>
  std::vector<std::size_t> behaviors_where(Predicate predicate) const {
    std::vector<std::size_t> result;
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (predicate(b)) {
        result.push_back(b);
      }
    }
    return result;
  }

  bool is_active(std::size_t behavior) const {
    const Assignment& values = oracle_.state().values;
    return std::find(values.begin(), values.end(), behavior) != values.end();
  }

  Event start_event(std::size_t task) {
    Event event;
    event.verb = Verb::start;
    // A task that runs already is tried again with another one, most of the time.
    if (oracle_.state().values[task] != none && random_.percent(70)) {
      const std::vector<std::size_t> idle = tasks_where(false, false);
      task = idle.empty() ? task : random_.pick(idle);
    }
    event.subject = task;
    if (random_.percent(70)) {
      event.priority = static_cast<int>(random_.between(1, random_.percent(45) ? 2 : 4));
    }
    if (random_.percent(30)) {
      event.parameters = pick_parameters();
    }
    return requestable(event);
  }

  // Another task in place of one that nobody may request; a stop where there is none.
  Event requestable(Event event) const {
    const std::vector<Task>& tasks = facts_->catalog.tasks;
    for (std::size_t tried = 0; tried < tasks.size(); ++tried) {
      if (tasks[event.subject].requestable) {
        return event;
      }
      event.subject = (event.subject + 1) % tasks.size();
    }
    Event stop;
    stop.verb = Verb::stop;
    stop.subject = event.subject;
    return stop;
  }

  Parameters pick_parameters() {
    using nlohmann::ordered_json;
    static const std::vector<ordered_json> choices = {
        ordered_json::object(),
        {{"p", "1"}},
        {{"p", "2"}},
        {{"p", "1"}, {"q", ordered_json::array({"1", "east"})}},
        {{"q", ordered_json::array({"1", "east"})}, {"p", "1"}},
        {{"p", "1"}, {"q", nullptr}},
        {{"p", nullptr}},
        {{"p", "1"}, {"q", ordered_json::object()}},
        {{"q", {{"r", nullptr}, {"s", ordered_json::array()}}}, {"p", "1"}},
        {{"p", "1"}, {"q", {{"r", "fast"}, {"s", ordered_json::array()}}}},
        {{"p", "1"}, {"q", {{"s", nullptr}, {"r", "fast"}}}},
        {{"q", ordered_json::array({"east", "1"})}, {"p", "1"}},
        {{"q", ordered_json::array({ordered_json::array({"1", "1", "1"})})}},
    };
    return random_.pick(choices);
  }

  Event restart_event(std::size_t task) {
    Event event = start_event(task);
    if (event.verb != Verb::start) {
      return event;
    }
    event.subject = task;
    event = requestable(event);
    task = event.subject;
    event.parameters = pick_parameters();
    const std::optional<Request>& request = oracle_.state().requests[task];
    if (request) {
      const auto raise = static_cast<int>(random_.percent(80) ? 0 : 1);
      event.priority = std::max(1, request->priority + raise);
    }
    return event;
  }

  void add_restart() {
    const std::vector<std::size_t> running = tasks_where(true, random_.percent(80));
    if (!running.empty()) {
      emit_timed(restart_event(random_.pick(running)));
    }
  }

  Event stop_event() {
    Event event;
    event.verb = Verb::stop;
    const std::vector<std::size_t> running = tasks_where(true, false);
    const std::vector<std::size_t> waiting(oracle_.waiting().begin(), oracle_.waiting().end());
    if (!waiting.empty() && random_.percent(15)) {
      event.subject = random_.pick(waiting);
      return event;
    }
    std::vector<std::size_t> suspended;
    for (std::size_t task = 0; task < task_count(); ++task) {
      if (oracle_.state().suspended[task]) {
        suspended.push_back(task);
      }
    }
    if (!suspended.empty() && random_.percent(30)) {
      event.subject = random_.pick(suspended);
      return event;
    }
    event.subject = running.empty() || random_.percent(12) ? random_.below(task_count())
                                                           : random_.pick(running);
    if (random_.percent(40)) {
      event.priority = static_cast<int>(random_.between(1, 4));
    }
    return event;
  }

  void add_stop() { emit_timed(stop_event()); }

  Event finish_event() {
    static const std::vector<Cause> causes = {Cause::goal_achieved,    Cause::goal_achieved,
                                              Cause::situation_change, Cause::time_out,
                                              Cause::wrong_progress,   Cause::process_failure,
                                              Cause::interrupted,      Cause::situation_change};
    Event event;
    event.verb = Verb::finish;
    event.cause = random_.pick(causes);
    if (random_.percent(25)) {
      const std::vector<std::size_t> running = tasks_where(true, false);
      event.performed_task = running.empty() || random_.percent(10) ? random_.below(task_count())
                                                                    : random_.pick(running);
      return event;
    }
    const std::vector<std::size_t> active =
        behaviors_where([&](std::size_t b) { return is_active(b); });
    event.subject = active.empty() || random_.percent(3)
                        ? random_.below(facts_->catalog.behaviors.size())
                        : random_.pick(active);
    return event;
  }

  void add_finish() {
    const bool nothing_runs = tasks_where(true, false).empty();
    if (facts_->catalog.behaviors.empty() || (nothing_runs && random_.percent(90))) {
      return;
    }
    Event event = finish_event();
    if (event.cause == Cause::situation_change && event.subject != none && random_.percent(60)) {
      Event change;
      change.verb = Verb::situation;
      change.situation.own.emplace_back(event.subject, false);
      emit_timed(change);
      emit(event);
      return;
    }
    emit_timed(event);
  }

  void add_wait() {
    Event event;
    event.verb = Verb::wait;
    add_time(event);
    if (!event.at && !event.wait) {
      event.wait = unit_ * random_.between(0, 4);
    }
    emit(event);
  }

  void add_situation() {
    const std::vector<std::size_t> unavailable =
        behaviors_where([&](std::size_t b) { return !oracle_.own(b); });
    Event event;
    event.verb = Verb::situation;
    const std::size_t behaviors = facts_->catalog.behaviors.size();
    std::vector<std::pair<std::size_t, bool>>& own = event.situation.own;
    if (!unavailable.empty() && random_.percent(65)) {
      own.emplace_back(random_.pick(unavailable), true);
    } else if (behaviors > 0) {
      const std::size_t behavior = random_.below(behaviors);
      own.emplace_back(behavior, random_.percent(20));
    }
    if (behaviors > 0 && random_.percent(30)) {
      const std::size_t other = random_.below(behaviors);
      if (own.empty() || own.front().first != other) {
        own.emplace_back(other, random_.percent(60));
      }
    }
    if (!own.empty()) {
      emit_timed(event);
    }
  }

  std::size_t pick_value(std::size_t variable) {
    return random_.below(facts_->catalog.variables[variable].value_count());
  }

  std::pair<std::size_t, std::size_t> pick_change() {
    const std::size_t variable = random_.below(facts_->catalog.variables.size());
    return {variable, pick_value(variable)};
  }

  // A variable with a value in which an active behavior does not fit, if there is one.
  std::pair<std::size_t, std::size_t> pick_disturbance() {
    std::vector<std::pair<std::size_t, std::size_t>> choices;
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      for (const Condition& condition : facts_->catalog.behaviors[b].situation) {
        const std::size_t count = facts_->catalog.variables[condition.variable].value_count();
        for (std::size_t value = 0; value < count && is_active(b); ++value) {
          if (std::find(condition.values.begin(), condition.values.end(), value) ==
              condition.values.end()) {
            choices.emplace_back(condition.variable, value);
          }
        }
      }
    }
    return choices.empty() ? pick_change() : random_.pick(choices);
  }

  // Of one variable or several, and now and then of behaviors at once.
  void add_change_of_variables() {
    Event event;
    event.verb = Verb::situation;
    const std::size_t variables = facts_->catalog.variables.size();
    const auto [changed, value] = random_.percent(50) ? pick_disturbance() : pick_change();
    for (std::size_t v = 0; v < variables; ++v) {
      if (v == changed) {
        event.situation.variables.emplace_back(v, value);
      } else if (random_.percent(35)) {
        event.situation.variables.emplace_back(v, pick_value(v));
      }
    }
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (!event.situation.own.empty() ? random_.percent(8) : random_.percent(4)) {
        event.situation.own.emplace_back(b, !oracle_.own(b) || random_.percent(30));
      }
    }
    emit_timed(event);
  }

  void emit_fault(std::size_t behavior) {
    Event event;
    event.verb = Verb::fault;
    event.subject = behavior;
    emit(event);
  }

  void emit_fault_once(std::size_t behavior) {
    if (!oracle_.faulty(behavior)) {
      emit_fault(behavior);
    }
  }

  void add_fault() {
    const std::vector<std::size_t> active =
        behaviors_where([&](std::size_t b) { return is_active(b) && !oracle_.faulty(b); });
    if (!active.empty()) {
      emit_fault(random_.pick(active));
    }
  }

  void add_repair() {
    const std::vector<std::size_t> faulty =
        behaviors_where([&](std::size_t b) { return oracle_.faulty(b) || oracle_.failed(b); });
    const std::size_t behaviors = facts_->catalog.behaviors.size();
    if (behaviors == 0 || (faulty.empty() && random_.percent(90))) {
      return;
    }
    Event event;
    event.verb = Verb::repair;
    event.subject = faulty.empty() ? random_.below(behaviors) : random_.pick(faulty);
    emit_timed(event);
  }

  Event event_to_fail() {
    const std::size_t way = random_.below(100);
    const std::vector<std::size_t> running = tasks_where(true, false);
    if (way < 25 && !running.empty()) {
      return restart_event(random_.pick(running));
    }
    if (way < 45 && !running.empty()) {
      return finish_event();
    }
    if (way < 52 && !running.empty()) {
      return stop_event();
    }
    Event event = start_event(random_.below(task_count()));
    if (random_.percent(50)) {
      event.priority = static_cast<int>(random_.between(3, 4));
    }
    return event;
  }

  // Looks at what an event would do, makes some of the behaviors concerned faulty, then does it.
  // Often looks again, at what it would do then.
  void add_failing_event() {
    const Event event = event_to_fail();
    const bool all_of_task = event.verb == Verb::start && random_.percent(45);
    const std::size_t chance_if_active = random_.percent(50) ? 90 : 20;
    if (all_of_task) {
      for (const std::size_t behavior : facts_->behaviors_of[event.subject]) {
        emit_fault_once(behavior);
      }
    }
    do {
      for (const std::size_t behavior : concerned(event)) {
        if (random_.percent(is_active(behavior) ? chance_if_active : 60)) {
          emit_fault_once(behavior);
        }
      }
    } while (random_.percent(45));
    emit_timed(event);
  }

  // The behaviors that the event would activate or deactivate.
  std::vector<std::size_t> concerned(const Event& event) const {
    std::set<std::string> names;
    for (const nlohmann::ordered_json& happened : oracle_.preview(event, nullptr)) {
      for (const nlohmann::ordered_json& change : happened["changes"]) {
        names.insert(change["behavior"].get<std::string>());
      }
    }
    return behaviors_where(
        [&](std::size_t b) { return names.contains(facts_->catalog.behaviors[b].name); });
  }

  Random& random_;
  std::shared_ptr<const CatalogFacts> facts_;
  Microseconds unit_;
  Script script_;
  Oracle oracle_;
};

}  // namespace

Script generate_script(Random& random, const Catalog& catalog) {
  return ScriptGenerator(random, catalog).generate();
}

Case generate_case(Random& random) {
  Case result;
  result.catalog = generate_catalog(random);
  result.script = generate_script(random, result.catalog);
  return result;
}

Case generate_case_with_keys(std::uint64_t seed) {
  Random random(seed);
  Case result;
  result.catalog = generate_catalog(random);
  add_further_keys(random, result.catalog);
  result.script = generate_script(random, result.catalog);
  return result;
}

Case generate_case(std::uint64_t seed) {
  Random random(seed);
  return generate_case(random);
}

}  // namespace cbc::oracle
