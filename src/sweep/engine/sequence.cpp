#include "sweep/engine/sequence.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include <fmt/format.h>

#include "core/script/runner.h"
#include "why/inquiry.h"

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
    case Origin::repair:
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
    case Verb::reconsider:
      return SweepKind::reconsider;
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
      "start",       "stop",      "finish_success", "finish_failure", "finish_situation_change",
      "situation",   "fault",     "repair",         "timeout",        "reactive_start",
      "finish_lost", "reconsider"};
  return names[static_cast<std::size_t>(kind)];
}

void SweepCounts::add(const CompiledCatalog& catalog, const ExplainedRecord& record) {
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
    ++reasons[{reason.kind, behavior, place_of_task(reason.task), place_of_task(reason.other_task),
               reason.kind == Reason::Kind::limited ? reason.line : 0}];
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

CoordinatorOptions coordinator_options(const SweepSearch& search) {
  CoordinatorOptions options;
  options.search.max_solutions = search.max_solutions;
  options.search.max_nodes = search.max_nodes;
  options.max_clock_events = search.max_clock_events;
  return options;
}

namespace {

class Sequence final : public EventListener {
 public:
  Sequence(const CompiledCatalog& catalog, const DrawnNames& names, const SweepSettings& settings,
           std::uint64_t sequence, SequenceListener& listener, bool explains_rejections)
      : shape_(settings.shape),
        listener_(listener),
        inquiry_(catalog, {.rejections = explains_rejections}),
        generator_(catalog, names, settings.shape, settings.seed, sequence),
        coordinator_(catalog, coordinator_options(settings.search), *this) {}

  /// Steps are added to `record`, unless it is null, before they run.
  [[nodiscard]] SequenceEnd run(std::vector<Step>* record) {
    const Coordinator::Status status = take_all(record);
    return {status, coordinator_.internal_error()};
  }

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    inquiry_.on_decision(record, circumstances, solution);
  }
  void on_event(const EventRecord& record) override {
    listener_.on_event(inquiry_.on_event(record, coordinator_.state()), coordinator_.state());
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
    auto status = coordinator_.advance_to(*step.time);
    if (status != Coordinator::Status::ok) return status;
    listener_.on_time(*step.time, coordinator_.state());
    generator_.draw_event(coordinator_.state(), step);
    if (record != nullptr) record->back() = step;
    status = coordinator_.handle(event_of(step));
    if (status == Coordinator::Status::ok) listener_.on_step(step, coordinator_.state());
    return status;
  }

  const SweepShape shape_;
  SequenceListener& listener_;
  Inquiry inquiry_;
  EventGenerator generator_;
  Coordinator coordinator_;
};

/// Counts the steps up to an event.
class StepCounter final : public SequenceListener {
 public:
  StepCounter(const std::vector<Step>& steps, std::uint64_t index) : steps_(steps), index_(index) {}
  void on_event(const ExplainedRecord& record, const State& /*state*/) override {
    if (record.index == index_) count_ = steps_.size();
  }
  [[nodiscard]] std::size_t count() const { return count_ == 0 ? steps_.size() : count_; }

 private:
  const std::vector<Step>& steps_;
  const std::uint64_t index_;
  std::size_t count_ = 0;
};

}  // namespace

SequenceEnd run_sequence(const CompiledCatalog& catalog, const DrawnNames& names,
                         const SweepSettings& settings, std::uint64_t sequence,
                         SequenceListener& listener) {
  return Sequence(catalog, names, settings, sequence, listener, true).run(nullptr);
}

std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog, const DrawnNames& names,
                                    const SweepSettings& settings, std::uint64_t sequence,
                                    std::uint64_t index) {
  std::vector<Step> steps;
  StepCounter counter(steps, index);
  static_cast<void>(Sequence(catalog, names, settings, sequence, counter, false).run(&steps));
  steps.resize(counter.count());
  return steps;
}

std::string options_for_script(const SweepSearch& search) {
  std::string text;
  if (search.max_solutions > 0) text += fmt::format(" --max-solutions {}", search.max_solutions);
  if (search.max_nodes > 0) text += fmt::format(" --max-nodes {}", search.max_nodes);
  if (search.max_clock_events != SweepSearch{}.max_clock_events) {
    text += fmt::format(" --max-clock-events {}", search.max_clock_events);
  }
  return text;
}

}  // namespace cbc
