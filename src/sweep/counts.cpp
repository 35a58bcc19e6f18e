#include "sweep/counts.h"

namespace cbc {
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
    case Verb::situation:
    case Verb::wait:  // a sweep has none
      break;
  }
  return SweepKind::situation;
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

void add_outcomes(OutcomeCounts& counts, const OutcomeCounts& other) {
  counts.accepted += other.accepted;
  counts.escalated += other.escalated;
  counts.rejected += other.rejected;
  counts.unchanged += other.unchanged;
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
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    add_outcomes(events[kind], other.events[kind]);
  }
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

}  // namespace cbc
