#include "core/script/runner.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/script/expectation.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

void SearchEffort::merge(const SearchEffort& other) {
  events += other.events;
  solutions.merge(other.solutions);
  nodes.merge(other.nodes);
  propagations.merge(other.propagations);
  nanoseconds.merge(other.nanoseconds);
}

void SearchTotals::add(const EventRecord& record) {
  if (record.search == nullptr || !record.search->elapsed) return;
  SearchEffort effort;
  effort.events = 1;
  effort.solutions.add(record.search->result.solutions);
  effort.nodes.add(record.search->result.nodes);
  effort.propagations.add(record.search->result.propagations);
  effort.nanoseconds.add(static_cast<std::uint64_t>(record.search->elapsed->count()));
  all_.merge(effort);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (kinds[kind].verb == record.verb && kinds[kind].origin == record.origin) {
      by_kind_[kind].merge(effort);
    }
  }
}

void SearchTotals::merge(const SearchTotals& other) {
  all_.merge(other.all_);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    by_kind_[kind].merge(other.by_kind_[kind]);
}

namespace {

std::string how_it_runs(const CompiledCatalog& catalog, const State& state, TaskId task) {
  if (!state.is_running(task)) return "it does not run";
  return fmt::format("it runs with {}", quote(catalog.name_of_behavior(state.behavior(task))));
}

/// `nothing`: what to say where there is none.
std::string names_or(const std::vector<std::uint32_t>& numbers, const Texts& names,
                     std::string_view nothing) {
  if (numbers.empty()) return std::string(nothing);
  return join(numbers, ", ", [&](std::uint32_t number) { return quote(names[number]); });
}

/// Longer lists say only what differs.
constexpr std::size_t most_names = 8;
/// And of that no more than this.
constexpr std::size_t most_differing = 20;

/// Adds "missing: 'A', 'B'" if there are any.
void add_names(std::string& text, std::string_view label, const CompiledCatalog& catalog,
               std::vector<std::uint32_t> behaviors) {
  if (behaviors.empty()) return;
  const std::size_t count = behaviors.size();
  behaviors.resize(std::min(count, most_differing));
  text += fmt::format("; {}: {}", label, names_or(behaviors, catalog.behavior_names, "none"));
  if (count > most_differing) text += fmt::format(" and {} more", count - most_differing);
}

void check_running(const Expectation::Running& expected, const CompiledCatalog& catalog,
                   const State& state, std::vector<std::string>& mismatches) {
  const TaskId task = catalog.task_ids[expected.task];
  const auto& behaviors = expected.behaviors;
  const bool holds = behaviors.empty()
                         ? state.is_running(task)
                         : std::any_of(behaviors.begin(), behaviors.end(), [&](std::uint32_t one) {
                             return state.behavior(task) == catalog.behavior_ids[one];
                           });
  if (holds) return;
  std::vector<std::string> names;
  names.reserve(behaviors.size());
  for (const std::uint32_t one : behaviors) names.push_back(quote(catalog.behavior_names[one]));
  const std::string wanted = names.empty() ? "" : " with " + list_with_or(names);
  mismatches.push_back(fmt::format("expected task {} to run{}, but {}",
                                   quote(catalog.task_names[expected.task]), wanted,
                                   how_it_runs(catalog, state, task)));
}

void check_stopped(const std::vector<std::uint32_t>& stopped, const CompiledCatalog& catalog,
                   const State& state, std::vector<std::string>& mismatches) {
  std::vector<std::uint32_t> running;
  for (const std::uint32_t index : stopped) {
    if (state.is_running(catalog.task_ids[index])) running.push_back(index);
  }
  if (running.size() <= most_names / 2) {
    for (const std::uint32_t index : running) {
      mismatches.push_back(fmt::format("expected task {} not to run, but {}",
                                       quote(catalog.task_names[index]),
                                       how_it_runs(catalog, state, catalog.task_ids[index])));
    }
    return;
  }
  const std::size_t count = running.size();
  running.resize(std::min(count, most_differing));
  std::string text = fmt::format(
      "expected {} not to run, but {} of them do: {}", quantity(stopped.size(), "task"), count,
      join(running, ", ", [&](std::uint32_t index) { return quote(catalog.task_names[index]); }));
  if (count > most_differing) text += fmt::format(" and {} more", count - most_differing);
  mismatches.push_back(std::move(text));
}

using Numbers = std::vector<std::uint32_t>;

/// The tasks or behaviors that are expected and that are found, in order. `is_found`: of an id.
template <typename Id, typename IsFound>
std::pair<Numbers, Numbers> sets_of(Numbers expected, View<Id> ids, const IsFound& is_found) {
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  Numbers found;
  for (std::uint32_t number = 0; number < ids.size(); ++number) {
    if (is_found(ids[number])) found.push_back(number);
  }
  return {std::move(expected), std::move(found)};
}

void check_suspended(const Numbers& tasks, const CompiledCatalog& catalog, const State& state,
                     std::vector<std::string>& mismatches) {
  const auto [expected, found] =
      sets_of(tasks, catalog.task_ids, [&](TaskId task) { return state.is_suspended(task); });
  if (found == expected) return;
  mismatches.push_back(fmt::format("expected the request of {} to be suspended, but found {}",
                                   names_or(expected, catalog.task_names, "no task"),
                                   names_or(found, catalog.task_names, "no task")));
}

void check_failed(const Numbers& behaviors, const CompiledCatalog& catalog, const State& state,
                  std::vector<std::string>& mismatches) {
  const auto [expected, found] = sets_of(behaviors, catalog.behavior_ids, [&](BehaviorId behavior) {
    return state.has_failed(behavior);
  });
  if (found == expected) return;
  mismatches.push_back(fmt::format("expected {} to have failed, but found {}",
                                   names_or(expected, catalog.behavior_names, "none"),
                                   names_or(found, catalog.behavior_names, "none")));
}

void check_active(const Numbers& behaviors, const CompiledCatalog& catalog, const State& state,
                  std::vector<std::string>& mismatches) {
  const auto [expected, active] =
      sets_of(behaviors, catalog.behavior_ids,
              [&](BehaviorId behavior) { return state.is_active(behavior); });
  if (active == expected) return;
  if (active.size() + expected.size() > most_names) {
    Numbers missing;
    Numbers surplus;
    std::set_difference(expected.begin(), expected.end(), active.begin(), active.end(),
                        std::back_inserter(missing));
    std::set_difference(active.begin(), active.end(), expected.begin(), expected.end(),
                        std::back_inserter(surplus));
    std::string text = fmt::format("expected {}, but found {}",
                                   quantity(expected.size(), "active behavior"), active.size());
    add_names(text, "missing", catalog, std::move(missing));
    add_names(text, "not expected", catalog, std::move(surplus));
    mismatches.push_back(std::move(text));
    return;
  }
  mismatches.push_back(fmt::format("expected the active behaviors to be {}, but found {}",
                                   names_or(expected, catalog.behavior_names, "none"),
                                   names_or(active, catalog.behavior_names, "none")));
}

}  // namespace

std::string find_mismatch(const Expectation& expectation, const CompiledCatalog& catalog,
                          const State& state, std::optional<Outcome> outcome) {
  std::vector<std::string> mismatches;
  if (expectation.outcome && outcome != expectation.outcome) {
    mismatches.push_back(fmt::format("expected outcome '{}', but {}", name_of(*expectation.outcome),
                                     outcome ? fmt::format("it is '{}'", name_of(*outcome))
                                             : "there was no start, stop or finish yet"));
  }
  for (const Expectation::Running& expected : expectation.running) {
    check_running(expected, catalog, state, mismatches);
  }
  check_stopped(expectation.stopped, catalog, state, mismatches);
  if (expectation.active) check_active(*expectation.active, catalog, state, mismatches);
  for (const std::uint32_t index : expectation.active_includes) {
    if (state.is_active(catalog.behavior_ids[index])) continue;
    mismatches.push_back(fmt::format("expected behavior {} to be active, but it is not",
                                     quote(catalog.behavior_names[index])));
  }
  if (expectation.suspended) check_suspended(*expectation.suspended, catalog, state, mismatches);
  if (expectation.failed) check_failed(*expectation.failed, catalog, state, mismatches);
  return join(mismatches, "; ");
}

void Runner::resume(const Snapshot& snapshot) {
  coordinator_.resume(snapshot);
  index_ = snapshot.events;
  outcome_ = snapshot.outcome;
}

Snapshot Runner::snapshot() const {
  Snapshot snapshot = coordinator_.snapshot();
  snapshot.outcome = outcome_;
  return snapshot;
}

bool Runner::take(const Step& step) {
  if (step.time && !note(coordinator_.advance_to(*step.time))) return false;
  if (step.expect) {
    check(step);
    return true;
  }
  step_ = &step;
  return note(coordinator_.handle(event_of(step)));
}

void Runner::on_event(const EventRecord& record) {
  index_ = record.index;
  const bool is_scripted = record.origin == Origin::script;
  if (is_scripted && form_of(record.verb).is_decided) outcome_ = record.outcome;
  ++result_.events;
  if (record.outcome == Outcome::accepted) ++result_.accepted;
  if (record.outcome == Outcome::rejected) ++result_.rejected;
  if (result_.totals) result_.totals->add(record);
  const State& state = coordinator_.state();
  listener_.on_event(inquiry_.on_event(record, state), is_scripted ? step_ : nullptr, state);
}

bool Runner::note(Coordinator::Status status) {
  if (status == Coordinator::Status::ok) return true;
  result_.status = status;
  result_.internal_error = coordinator_.internal_error();
  return false;
}

void Runner::check(const Step& step) {
  const State& state = coordinator_.state();
  std::string mismatch = find_mismatch(*step.expect, catalog_, state, outcome_);
  if (mismatch.empty()) {
    ++result_.passed;
    listener_.on_success({index_, step});
  } else {
    ++result_.failed;
    result_.failures.push_back({step.range, mismatch});
    Failure failure{result_.failed, index_, step.range, std::move(mismatch), &step, &state, {}};
    if (inquiry_.keeps_moments() && failure.number <= most_explained) {
      failure.unexpected = find_unexpected(*step.expect);
    }
    listener_.on_failure(failure);
  }
}

std::vector<UnexpectedTasks> Runner::find_unexpected(const Expectation& expectation) {
  std::vector<UnexpectedTasks> unexpected;
  const State& state = coordinator_.state();
  for (ExpectedValues& expected : find_expected_values(expectation, catalog_, state)) {
    unexpected.push_back({expected.group, std::move(expected.tasks),
                          inquiry_.why_unmet(state, expected.group, expected.ways)});
  }
  return unexpected;
}

Event event_of(const Step& step) {
  Event event;
  event.verb = step.verb;
  event.subject = step.subject;
  event.priority = step.priority;
  if (step.parameters) event.parameters = step.parameters->canonical;
  event.cause = step.cause;
  event.is_by_task = step.is_by_task;
  event.situation = step.situation.availability;
  event.variables = step.situation.variables;
  return event;
}

CoordinatorOptions options_of(const Script& script, CoordinatorOptions options) {
  options.reactive_delay = script.reactive_delay;
  options.timeouts = script.timeouts;
  return options;
}

RunResult run_script(const CompiledCatalog& catalog, const Script& script,
                     const CoordinatorOptions& options, RunListener& listener,
                     Questions questions) {
  // Without expectations nobody asks.
  questions.failures =
      questions.failures && std::any_of(script.steps.begin(), script.steps.end(),
                                        [](const Step& step) { return step.expect.has_value(); });
  // When and why a task stopped is a part of why it does not run.
  questions.displaced |= questions.failures;
  Runner runner(catalog, options_of(script, options), listener, std::move(questions));
  runner.begin(script.situation);
  bool goes_on = true;
  for (const Step& step : script.steps) {
    goes_on = runner.take(step);
    if (!goes_on) break;
  }
  if (goes_on) static_cast<void>(runner.settle());
  listener.on_end(runner.coordinator().state());
  RunResult result = runner.result();
  result.script = &script;
  return result;
}

}  // namespace cbc
