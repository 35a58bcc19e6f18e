#include "sweep/engine/draw.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/catalog/allowed_values.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/support/json.h"
#include "core/yaml/document.h"

namespace cbc {
namespace {

using Name = DrawnNames::Name;

/// A number for a name (FNV-1a, 64 bits).
std::uint64_t number_of(std::string_view name) {
  std::uint64_t number = 0xcbf29ce484222325U;
  for (const char byte : name) {
    number = (number ^ static_cast<std::uint8_t>(byte)) * 0x100000001b3U;
  }
  return number;
}

/// The place in the list of the name that `point` chooses. There is at least one.
std::size_t choose(const std::vector<Name>& names, std::uint64_t point) {
  std::size_t first = 0;
  std::uint64_t least = UINT64_MAX;
  for (std::size_t place = 0; place < names.size(); ++place) {
    const std::uint64_t mixed = RandomSource::mix(names[place].number ^ point);
    if (mixed >= least) continue;
    least = mixed;
    first = place;
  }
  return first;
}

}  // namespace

DrawnNames::DrawnNames(const CompiledCatalog& catalog) : DrawnNames(catalog, nullptr) {}
DrawnNames::DrawnNames(const CompiledCatalog& catalog, const Translation& to_other)
    : DrawnNames(catalog, &to_other) {}

DrawnNames::DrawnNames(const CompiledCatalog& catalog, const Translation* to_other)
    : values_(catalog.variables.size()),
      all_tasks_(catalog.tasks.size()),
      all_behaviors_(catalog.behaviors.size()) {
  for (std::uint32_t place = 0; place < catalog.tasks.size(); ++place) {
    if (to_other != nullptr && to_other->tasks[catalog.task_ids[place]] == none) continue;
    all_tasks_[place] = {place, number_of(catalog.task_names[place])};
    if (catalog.rules_of(catalog.task_ids[place]).requestable != 0) {
      tasks_.push_back(all_tasks_[place]);
    }
  }
  for (std::uint32_t place = 0; place < catalog.behaviors.size(); ++place) {
    if (to_other != nullptr && to_other->behaviors[catalog.behavior_ids[place]] == none) continue;
    all_behaviors_[place] = {place, number_of(catalog.behavior_names[place])};
    behaviors_.push_back(all_behaviors_[place]);
  }
  for (std::uint32_t place = 0; place < catalog.variables.size(); ++place) {
    for (std::uint32_t value = 0; value < catalog.variables[place].value_count; ++value) {
      const bool is_missing = to_other != nullptr && (to_other->variables[place] == none ||
                                                      to_other->values[place][value] == none);
      if (is_missing) continue;
      values_[place].push_back({value, number_of(catalog.name_of_value({place, value}))});
    }
    if (values_[place].size() < 2) continue;
    variables_.push_back({place, number_of(catalog.name_of_variable(place))});
  }
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

/// Takes out the name that `point` chooses.
Name take_out(std::vector<Name>& names, std::uint64_t point) {
  const std::size_t place = choose(names, point);
  const Name taken = names[place];
  names[place] = names.back();
  names.pop_back();
  return taken;
}

void put_in(std::vector<Name>& names, const Name& name) {
  const bool is_there = std::any_of(names.begin(), names.end(),
                                    [&](const Name& one) { return one.place == name.place; });
  if (!is_there) names.push_back(name);
}

}  // namespace

EventGenerator::EventGenerator(const CompiledCatalog& catalog, const DrawnNames& names,
                               const SweepShape& shape, std::uint64_t seed, std::uint64_t sequence)
    : catalog_(catalog),
      names_(names),
      shape_(shape),
      sequence_(RandomSource(seed, sequence).next()),
      random_(sequence_, event_) {}

/// Half of the events follow immediately, the others after milliseconds to minutes, or exactly when
/// something is due.
Microseconds EventGenerator::draw_time(const Coordinator& coordinator) {
  constexpr std::array<std::uint32_t, 3> longest{1'000, 10'000, 100'000};  // ms
  random_ = RandomSource(sequence_, event_++);
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
  if (names_.tasks().empty()) return;  // a wait: two catalogs with no task in common
  if (lost_ != none) {
    const std::uint32_t lost = std::exchange(lost_, none);
    if (state.is_active(catalog_.behavior_ids[lost])) {
      step.verb = Verb::finish;
      step.subject = lost;
      step.cause = FinishCause::situation_change;
      return;
    }
  }
  if (!names_.behaviors().empty() && random_.happens(shape_.faults)) {
    draw_surroundings(state, step);
    return;
  }
  find_running(state);
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
  constexpr std::uint32_t favorites = 4;
  std::uint64_t point = random_.next();
  if (below(2) == 0) {
    point = RandomSource(sequence_, UINT64_MAX - below(below(favorites) + 1)).next();
  }
  step.verb = Verb::start;
  step.subject = names_.tasks()[choose(names_.tasks(), point)].place;
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
  const std::vector<Name>& names = below(8) == 0 ? names_.tasks() : running_;
  step.subject = names[choose(names, random_.next())].place;
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
  if (below(broken + 2 + names_.behaviors().size() / 16) < broken) {
    mend(step);
  } else {
    break_something(state, step);
  }
}

void EventGenerator::mend(Step& step) {
  const bool is_repair = below(faulty_.size() + unavailable_.size()) < faulty_.size();
  if (is_repair) {
    step.verb = Verb::repair;
    step.subject = take_out(faulty_, random_.next()).place;
    return;
  }
  step.verb = Verb::situation;
  step.situation.availability = {{take_out(unavailable_, random_.next()).place, true}};
}

/// Prefers active behaviors. An active behavior that becomes unavailable finishes next, as a robot
/// would report it; not always, since robots may be late.
void EventGenerator::break_something(const State& state, Step& step) {
  find_running(state);
  const std::uint64_t point = random_.next();
  const bool is_active_one = below(2) != 0 && !running_.empty();
  const Name behavior = is_active_one ? names_.behavior(any_active(state))
                                      : names_.behaviors()[choose(names_.behaviors(), point)];
  if (below(2) == 0) {
    step.verb = Verb::fault;
    step.subject = behavior.place;
    put_in(faulty_, behavior);
    return;
  }
  step.verb = Verb::situation;
  if (!names_.variables().empty()) {
    step.situation.variables = {draw_variable(state)};
    return;
  }
  step.situation.availability = {{behavior.place, false}};
  put_in(unavailable_, behavior);
  const bool is_active = state.is_active(catalog_.behavior_ids[behavior.place]);
  if (is_active && below(4) != 0) lost_ = behavior.place;
}

/// Another value of some variable.
VariableValue EventGenerator::draw_variable(const State& state) {
  const std::vector<Name>& variables = names_.variables();
  const std::uint32_t variable = variables[choose(variables, random_.next())].place;
  std::vector<Name> values = names_.values(variable);
  std::erase_if(values, [&](const Name& value) { return value.place == state.value_of(variable); });
  return {variable, values[choose(values, random_.next())].place};
}

/// The tasks that run with a behavior that events may be about.
void EventGenerator::find_running(const State& state) {
  running_.clear();
  for (const std::uint32_t task : state.running()) {
    const BehaviorId behavior = state.behavior(catalog_.task_ids[task]);
    const std::uint32_t performer = catalog_.behaviors[behavior].catalog_index;
    const bool is_drawn =
        names_.task(task).place != none && names_.behavior(performer).place != none;
    if (is_drawn) running_.push_back(names_.task(task));
  }
}

std::uint32_t EventGenerator::any_active(const State& state) {
  const std::uint32_t task = running_[choose(running_, random_.next())].place;
  return catalog_.behaviors[state.behavior(catalog_.task_ids[task])].catalog_index;
}

std::int32_t EventGenerator::draw_priority() {
  return 1 +
         static_cast<std::int32_t>(random_.below(static_cast<std::uint32_t>(shape_.priorities)));
}

}  // namespace cbc
