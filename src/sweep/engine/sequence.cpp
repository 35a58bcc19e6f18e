#include "sweep/engine/sequence.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/catalog/allowed_values.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/support/json.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"

namespace cbc {

std::uint64_t Histogram::round_down(std::uint64_t number) {
  constexpr int kept = 10;
  const int width = static_cast<int>(std::bit_width(number));
  if (width <= kept) return number;
  const int dropped = width - kept;
  return (number >> dropped) << dropped;
}

/// The number at a rank, from 1, in ascending order.
std::uint64_t Histogram::at_rank(std::uint64_t rank) const {
  std::uint64_t passed = 0;
  for (const auto& [number, count] : counts_) {
    passed += count;
    if (passed >= rank) return number;
  }
  return 0;
}

namespace {

SweepKind kind_of(const EventRecord& record) {
  switch (record.origin) {
    case Origin::timeout:
      return SweepKind::timeout;
    case Origin::reactive:
      return SweepKind::reactive;
    case Origin::fault:
      return SweepKind::lost;
    case Origin::script:
    case Origin::situation:
      break;
  }
  switch (record.verb) {
    case Verb::start:
      return SweepKind::start;
    case Verb::stop:
      return SweepKind::stop;
    case Verb::finish:
      if (record.cause == FinishCause::goal_achieved) return SweepKind::success;
      return record.cause == FinishCause::situation_change ? SweepKind::situation_change
                                                           : SweepKind::failure;
    case Verb::fault:
      return SweepKind::fault;
    case Verb::repair:
      return SweepKind::repair;
    default:  // a sweep has no events with other verbs
      return SweepKind::situation;
  }
}

void count_outcome(OutcomeCounts& counts, const EventRecord& record) {
  switch (record.outcome) {
    case Outcome::accepted:
      ++counts.accepted;
      if (record.search != nullptr && record.search->is_escalated) ++counts.escalated;
      break;
    case Outcome::rejected:
      ++counts.rejected;
      break;
    case Outcome::unchanged:
      ++counts.unchanged;
      break;
  }
}

}  // namespace

std::string_view name_of(SweepKind kind) {
  static constexpr std::array<std::string_view, sweep_kinds> names{
      "start",      "stop",  "finish_success", "finish_failure", "finish_situation_change",
      "situation",  "fault", "repair",         "timeout",        "reactive_start",
      "finish_lost"};
  return names[static_cast<std::size_t>(kind)];
}

void SweepCounts::add(const CompiledCatalog& catalog, const EventRecord& record) {
  const SweepKind kind = kind_of(record);
  count_outcome(events[static_cast<std::size_t>(kind)], record);
  if (kind == SweepKind::start) {
    TaskCounts& task = tasks[catalog.tasks[record.task].catalog_index];
    ++(record.outcome == Outcome::accepted ? task.starts : task.rejected);
  }
  for (const Change& change : record.changes) {
    if (!change.is_activation || change.cause == ChangeCause::undone) continue;
    BehaviorCounts& behavior = behaviors[catalog.behaviors[change.behavior].catalog_index];
    ++(change.success ? behavior.activations : behavior.failures);
  }
  const auto place_of_task = [&](TaskId task) {
    return task == none ? none : catalog.tasks[task].catalog_index;
  };
  for (const Reason& reason : record.conflict) {
    const std::uint32_t behavior =
        reason.behavior == none ? none : catalog.behaviors[reason.behavior].catalog_index;
    ++reasons[{reason.kind, behavior, place_of_task(reason.task),
               place_of_task(reason.other_task)}];
  }
}

void SweepCounts::add(const SweepCounts& other) {
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) events[kind].add(other.events[kind]);
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    tasks[task].starts += other.tasks[task].starts;
    tasks[task].rejected += other.tasks[task].rejected;
    tasks[task].runs += other.tasks[task].runs;
  }
  for (std::size_t behavior = 0; behavior < behaviors.size(); ++behavior) {
    behaviors[behavior].activations += other.behaviors[behavior].activations;
    behaviors[behavior].failures += other.behaviors[behavior].failures;
  }
  for (const auto& [reason, count] : other.reasons) reasons[reason] += count;
}

namespace {

/// A value that a parameter may have, as JSON; empty where none is known.
std::string draw_value(const Parameter& parameter, RandomSource& random) {
  std::string json;
  if (parameter.allowed_values.empty()) return json;
  if (parameter.allowed_is_list) {
    const auto size = static_cast<std::uint32_t>(parameter.allowed_values.size());
    const std::string& text = parameter.allowed_values[random.below(size)];
    append_shortest(json, text);
    return json;
  }
  const std::string& type = parameter.allowed_values.front();
  if (type == "string" || type == "text") {
    append_text(json, random.below(2) == 0 ? "a" : "b");
  } else if (type == "integer" || type == "int" || type == "number" || type == "float") {
    append_value(json, random.below(10));
  } else if (type == "boolean" || type == "bool") {
    append_value(json, random.below(2) == 0);
  }
  return json;
}

std::optional<Parameters> parameters_from(const std::string& json) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(json, "", diagnostics);
  if (document == nullptr) return std::nullopt;
  Reporter reporter("", diagnostics);
  return read_parameters(document->root(), reporter);
}

void take_out(std::vector<std::uint32_t>& items, std::size_t place) {
  items[place] = items.back();
  items.pop_back();
}

void put_in(std::vector<std::uint32_t>& items, std::uint32_t item) {
  if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
}

}  // namespace

EventGenerator::EventGenerator(const CompiledCatalog& catalog, const SweepShape& shape,
                               std::uint64_t seed, std::uint64_t sequence)
    : catalog_(catalog),
      shape_(shape),
      random_(seed, sequence),
      first_task_(below(std::max<std::size_t>(catalog.tasks.size(), 1))) {}

/// Half of the events follow immediately, the others after milliseconds to minutes, or exactly when
/// something is due.
Microseconds EventGenerator::draw_time(const Coordinator& coordinator) {
  constexpr std::array<std::uint32_t, 3> longest{1'000, 10'000, 100'000};  // ms
  const Microseconds now = coordinator.now();
  Microseconds time = now;
  const std::uint32_t choice = below(16);
  if (choice < 2) {
    time = coordinator.next_due().value_or(now);
  } else if (choice < 8) {
    time = now + Microseconds{1'000} * (1 + below(longest[below(longest.size())]));
  }
  // Something that is due in a year is not worth waiting for.
  return time - now <= Microseconds{longest.back()} * 1'000 && time <= longest_time ? time : now;
}

void EventGenerator::draw_event(const State& state, Step& step) {
  if (lost_ != none) {
    const std::uint32_t lost = std::exchange(lost_, none);
    if (state.is_active(catalog_.behavior_ids[lost])) {
      step.verb = Verb::finish;
      step.subject = lost;
      step.cause = FinishCause::situation_change;
      return;
    }
  }
  if (!catalog_.behaviors.empty() && random_.happens(shape_.faults)) {
    draw_surroundings(state, step);
    return;
  }
  running_ = state.running();
  const std::uint32_t choice = below(16);
  if (running_.empty() || choice < 8) {
    draw_start(step);
  } else if (choice < 14) {
    draw_finish(state, step);
  } else {
    draw_stop(step);
  }
}

/// A few tasks are started again and again, different ones in each sequence.
void EventGenerator::draw_start(Step& step) {
  const std::uint32_t offset = below(below(catalog_.tasks.size()) + 1);
  step.verb = Verb::start;
  step.subject =
      static_cast<std::uint32_t>((std::uint64_t{first_task_} + offset) % catalog_.tasks.size());
  step.priority = draw_priority();
  if (below(16) == 0) draw_parameters(step);
}

void EventGenerator::draw_parameters(Step& step) {
  std::vector<std::pair<std::string_view, std::string>> given;
  const std::vector<Parameter> declared = parameters_of(catalog_, step.subject);
  for (const Parameter& parameter : declared) {
    std::string value = draw_value(parameter, random_);
    if (value.empty()) continue;
    const auto known = std::find_if(given.begin(), given.end(),
                                    [&](const auto& one) { return one.first == parameter.name; });
    if (known == given.end()) {
      given.emplace_back(parameter.name, std::move(value));
    } else {
      known->second = std::move(value);
    }
  }
  if (given.empty()) return;
  std::string text;
  JsonWriter json(text);
  json.open('{');
  for (const auto& [name, value] : given) json.write_json(name, value);
  json.close('}');
  step.parameters = parameters_from(text);
}

void EventGenerator::draw_stop(Step& step) {
  step.verb = Verb::stop;
  step.subject = below(8) == 0 ? below(catalog_.tasks.size()) : running_[below(running_.size())];
  if (below(2) == 0) step.priority = draw_priority();
}

void EventGenerator::draw_finish(const State& state, Step& step) {
  constexpr std::array failures{FinishCause::wrong_progress, FinishCause::process_failure,
                                FinishCause::interrupted};
  step.verb = Verb::finish;
  step.subject = any_active(state);
  step.cause = random_.happens(shape_.failures) ? failures[below(failures.size())]
                                                : FinishCause::goal_achieved;
}

/// The more is broken, the more likely a repair is.
void EventGenerator::draw_surroundings(const State& state, Step& step) {
  const std::size_t broken = faulty_.size() + unavailable_.size();
  if (below(broken + 2 + catalog_.behaviors.size() / 16) < broken) {
    mend(step);
  } else {
    break_something(state, step);
  }
}

void EventGenerator::mend(Step& step) {
  std::uint32_t place = below(faulty_.size() + unavailable_.size());
  if (place < faulty_.size()) {
    step.verb = Verb::repair;
    step.subject = faulty_[place];
    take_out(faulty_, place);
    return;
  }
  place -= static_cast<std::uint32_t>(faulty_.size());
  step.verb = Verb::situation;
  step.situation.availability = {{unavailable_[place], true}};
  take_out(unavailable_, place);
}

/// Prefers active behaviors. An active behavior that becomes unavailable finishes next, as a robot
/// would report it; not always, since robots may be late.
void EventGenerator::break_something(const State& state, Step& step) {
  running_ = state.running();
  const std::uint32_t behavior =
      running_.empty() || below(2) == 0 ? below(catalog_.behaviors.size()) : any_active(state);
  if (below(2) == 0) {
    step.verb = Verb::fault;
    step.subject = behavior;
    put_in(faulty_, behavior);
    return;
  }
  step.verb = Verb::situation;
  if (!catalog_.variables.empty()) {
    step.situation.variables = {draw_variable(state)};
    return;
  }
  step.situation.availability = {{behavior, false}};
  put_in(unavailable_, behavior);
  if (state.is_active(catalog_.behavior_ids[behavior]) && below(4) != 0) lost_ = behavior;
}

/// Another value of some variable.
VariableValue EventGenerator::draw_variable(const State& state) {
  const std::uint32_t variable = below(catalog_.variables.size());
  const std::uint32_t value = below(catalog_.variables[variable].value_count - 1);
  return {variable, value < state.value_of(variable) ? value : value + 1};
}

std::uint32_t EventGenerator::any_active(const State& state) {
  const std::uint32_t task = running_[below(running_.size())];
  return catalog_.behaviors[state.behavior(catalog_.task_ids[task])].catalog_index;
}

std::int32_t EventGenerator::draw_priority() {
  return 1 +
         static_cast<std::int32_t>(random_.below(static_cast<std::uint32_t>(shape_.priorities)));
}

namespace {

CoordinatorOptions to_coordinator_options(const SweepSearch& search) {
  CoordinatorOptions options;
  options.search.max_solutions = search.max_solutions;
  options.search.max_nodes = search.max_nodes;
  options.tie_seed = search.tie_seed;
  options.max_clock_events = search.max_clock_events;
  return options;
}

class Sequence final : public EventListener {
 public:
  Sequence(const CompiledCatalog& catalog, const SweepSettings& settings, std::uint64_t sequence,
           SequenceListener& listener)
      : shape_(settings.shape),
        listener_(listener),
        generator_(catalog, settings.shape, settings.seed, sequence),
        coordinator_(catalog, to_coordinator_options(settings.search), *this) {}

  /// Steps are added to `record`, unless it is null, before they run.
  [[nodiscard]] SequenceEnd run(std::vector<Step>* record) {
    const Coordinator::Status status = take_all(record);
    return {status, coordinator_.internal_error()};
  }

  void on_event(const EventRecord& record) override {
    listener_.on_event(record, coordinator_.state());
  }

 private:
  [[nodiscard]] Coordinator::Status take_all(std::vector<Step>* record) {
    coordinator_.begin({});
    for (std::uint32_t event = 0; event < shape_.events; ++event) {
      const auto status = take_next(record);
      if (status != Coordinator::Status::ok) return status;
    }
    return coordinator_.settle();
  }

  [[nodiscard]] Coordinator::Status take_next(std::vector<Step>* record) {
    Step step;
    step.time = generator_.draw_time(coordinator_);
    if (record != nullptr) record->push_back(step);
    const auto status = coordinator_.advance_to(*step.time);
    if (status != Coordinator::Status::ok) return status;
    generator_.draw_event(coordinator_.state(), step);
    if (record != nullptr) record->back() = step;
    return coordinator_.handle(event_of(step));
  }

  const SweepShape shape_;
  SequenceListener& listener_;
  EventGenerator generator_;
  Coordinator coordinator_;
};

/// Counts the steps up to an event.
class StepCounter final : public SequenceListener {
 public:
  StepCounter(const std::vector<Step>& steps, std::uint64_t index) : steps_(steps), index_(index) {}
  void on_event(const EventRecord& record, const State& /*state*/) override {
    if (record.index == index_) count_ = steps_.size();
  }
  [[nodiscard]] std::size_t count() const { return count_ == 0 ? steps_.size() : count_; }

 private:
  const std::vector<Step>& steps_;
  const std::uint64_t index_;
  std::size_t count_ = 0;
};

}  // namespace

SequenceEnd run_sequence(const CompiledCatalog& catalog, const SweepSettings& settings,
                         std::uint64_t sequence, SequenceListener& listener) {
  return Sequence(catalog, settings, sequence, listener).run(nullptr);
}

std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog, const SweepSettings& settings,
                                    std::uint64_t sequence, std::uint64_t index) {
  std::vector<Step> steps;
  StepCounter counter(steps, index);
  static_cast<void>(Sequence(catalog, settings, sequence, counter).run(&steps));
  steps.resize(counter.count());
  return steps;
}

std::string options_for_script(const SweepSearch& search) {
  std::string text;
  if (search.max_solutions > 0) text += fmt::format(" --max-solutions {}", search.max_solutions);
  if (search.max_nodes > 0) text += fmt::format(" --max-nodes {}", search.max_nodes);
  if (search.tie_seed) text += fmt::format(" --tie-seed {}", *search.tie_seed);
  if (search.max_clock_events != SweepSearch{}.max_clock_events) {
    text += fmt::format(" --max-clock-events {}", search.max_clock_events);
  }
  return text;
}

}  // namespace cbc
