#include "bench/scenario.h"

#include <chrono>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/script/runner.h"

namespace cbc::bench {
namespace {

[[nodiscard]] Coordinator::Status happen(Coordinator& coordinator, const Moment& moment) {
  return moment.event ? coordinator.handle(*moment.event) : coordinator.settle();
}

void demand_ok(bool is_ok, const Moment& moment) {
  if (!is_ok) throw std::runtime_error("the coordinator failed at event " + moment.name);
}

std::optional<Microseconds> next_due(const State& state) {
  std::optional<Microseconds> due;
  for (const Timers* timers : {&state.timeouts(), &state.queue()}) {
    if (!timers->empty() && (!due || timers->first_due() < *due)) due = timers->first_due();
  }
  return due;
}

std::string name_of(const EventRecord& record, const CompiledCatalog& catalog) {
  std::string name = fmt::format(
      "{:02}_{}", record.index,
      record.origin == Origin::script ? cbc::name_of(record.verb) : cbc::name_of(record.origin));
  if (record.task != none) name += '_' + std::string(catalog.name_of_task(record.task));
  if (record.behavior != none) name += '_' + std::string(catalog.name_of_behavior(record.behavior));
  return name;
}

Trigger trigger_of(const EventRecord& record) {
  Trigger trigger;
  trigger.kind = record.verb == Verb::start  ? Trigger::Kind::start
                 : record.verb == Verb::stop ? Trigger::Kind::stop
                                             : Trigger::Kind::finish;
  trigger.group = record.search->group;
  trigger.task = record.task;
  trigger.behavior = record.behavior;
  trigger.cause = record.cause;
  trigger.priority = record.priority;
  trigger.is_reactive = record.origin == Origin::reactive;
  return trigger;
}

/// Goes through a script as the runner does, but stops at every instant at which the clock may
/// bring about something.
class Planner final : public EventListener {
 public:
  explicit Planner(Scenario& scenario)
      : scenario_(scenario),
        catalog_(*scenario.mission->catalog),
        coordinator_(catalog_, scenario.options, *this) {}

  void run() {
    const Script& script = scenario_.mission->script;
    coordinator_.begin(script.situation.availability);
    Microseconds now = 0;
    for (const Step& step : script.steps) {
      if (step.time) now = *step.time;
      for (auto due = next_due(coordinator_.state()); due && *due < now;
           due = next_due(coordinator_.state())) {
        add(*due, std::nullopt);
      }
      if (!step.expect) add(now, event_of(step));
    }
    for (auto due = next_due(coordinator_.state()); due && *due <= now;
         due = next_due(coordinator_.state())) {
      add(*due, std::nullopt);
    }
  }

  void on_event(const EventRecord& record) override {
    Moment& moment = scenario_.moments.back();
    if (moment.name.empty()) moment.name = name_of(record, catalog_);
    if (!record.search) return;
    if (++moment.coordinations > 1) return;
    moment.search = *record.search;
    moment.trigger = trigger_of(record);
  }

 private:
  void add(Microseconds time, const std::optional<Event>& event) {
    scenario_.moments.emplace_back();
    scenario_.moments.back().time = time;
    scenario_.moments.back().event = event;
    demand_ok(coordinator_.advance_to(time) == Coordinator::Status::ok &&
                  happen(coordinator_, scenario_.moments.back()) == Coordinator::Status::ok,
              scenario_.moments.back());
  }

  Scenario& scenario_;
  const CompiledCatalog& catalog_;
  Coordinator coordinator_;
};

}  // namespace

std::uint32_t Scenario::coordinations() const {
  std::uint32_t count = 0;
  for (const Moment& moment : moments) count += moment.coordinations;
  return count;
}

std::shared_ptr<const Scenario> plan(std::shared_ptr<const Mission> mission, std::uint64_t m) {
  auto scenario = std::make_shared<Scenario>();
  scenario->options.search.max_solutions = m;
  scenario->options.reactive_delay = mission->script.reactive_delay;
  scenario->options.timeouts = mission->script.timeouts;
  scenario->mission = std::move(mission);
  Planner(*scenario).run();
  return scenario;
}

Batch::Batch(const Scenario& scenario, std::uint32_t size) {
  for (std::uint32_t i = 0; i < size; ++i) {
    coordinators_.emplace_back(*scenario.mission->catalog, scenario.options, listener_);
    coordinators_.back().begin(scenario.mission->script.situation.availability);
  }
}

double Batch::take(const Moment& moment) {
  bool is_ok = true;
  for (Coordinator& coordinator : coordinators_) {
    is_ok &= coordinator.advance_to(moment.time) == Coordinator::Status::ok;
  }
  const auto begin = std::chrono::steady_clock::now();
  for (Coordinator& coordinator : coordinators_) {
    is_ok &= happen(coordinator, moment) == Coordinator::Status::ok;
  }
  const auto end = std::chrono::steady_clock::now();
  demand_ok(is_ok, moment);
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace cbc::bench
