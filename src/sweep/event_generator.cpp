#include "sweep/event_generator.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "compiled/parameters.h"
#include "diagnostic/reporter.h"
#include "script/parameters.h"
#include "yaml/document.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

/// A value that a parameter may have; null where none is known.
Json draw_value(const Parameter& parameter, RandomSource& random) {
  if (parameter.allowed_values.empty()) return nullptr;
  if (parameter.allowed_is_list) {
    const auto size = static_cast<std::uint32_t>(parameter.allowed_values.size());
    const std::string& text = parameter.allowed_values[random.below(size)];
    Json number = Json::parse(text, nullptr, false);
    return number.is_number() ? number : Json(text);
  }
  const std::string& type = parameter.allowed_values.front();
  if (type == "string" || type == "text") return random.below(2) == 0 ? "a" : "b";
  if (type == "integer" || type == "int" || type == "number" || type == "float") {
    return random.below(10);
  }
  if (type == "boolean" || type == "bool") return random.below(2) == 0;
  return nullptr;
}

std::optional<Parameters> parameters_from(const Json& json) {
  Diagnostics diagnostics;
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const auto document = yaml::parse(text, "", diagnostics);
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

/// Half of the events follow at once, the others after milliseconds to minutes, or just when
/// something falls due.
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
  // Waiting for what falls due in a year is no use.
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

/// A few tasks of each sequence are started again and again, in every sequence other ones.
void EventGenerator::draw_start(Step& step) {
  const std::uint32_t offset = below(below(catalog_.tasks.size()) + 1);
  step.verb = Verb::start;
  step.subject =
      static_cast<std::uint32_t>((std::uint64_t{first_task_} + offset) % catalog_.tasks.size());
  step.priority = draw_priority();
  if (below(16) == 0) draw_parameters(step);
}

void EventGenerator::draw_parameters(Step& step) {
  Json given = Json::object();
  for (const Parameter& parameter : parameters_of(catalog_, step.subject)) {
    Json value = draw_value(parameter, random_);
    if (!value.is_null()) given[parameter.name] = std::move(value);
  }
  if (!given.empty()) step.parameters = parameters_from(given);
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

/// The more is broken, the more likely is it that something is mended.
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
  step.situation = {{unavailable_[place], true}};
  take_out(unavailable_, place);
}

/// Rather what is active than what is not. What becomes unavailable while active finishes, as a
/// robot would report it; most of the time, as robots may be late.
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
  step.situation = {{behavior, false}};
  put_in(unavailable_, behavior);
  if (state.is_active(catalog_.behavior_ids[behavior]) && below(4) != 0) lost_ = behavior;
}

std::uint32_t EventGenerator::any_active(const State& state) {
  const std::uint32_t task = running_[below(running_.size())];
  return catalog_.behaviors[state.behavior(catalog_.task_ids[task])].catalog_index;
}

std::int32_t EventGenerator::draw_priority() {
  return 1 +
         static_cast<std::int32_t>(random_.below(static_cast<std::uint32_t>(shape_.priorities)));
}

}  // namespace cbc
