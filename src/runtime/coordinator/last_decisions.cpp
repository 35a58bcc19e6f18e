#include "runtime/coordinator/last_decisions.h"

#include <algorithm>
#include <string_view>

namespace cbc {
namespace {

/// What happened, without what came of it.
void copy_event(const EventRecord& record, EventRecord& copy, SearchRecord& search) {
  copy.index = record.index;
  copy.time = record.time;
  copy.origin = record.origin;
  copy.verb = record.verb;
  copy.task = record.task;
  copy.behavior = record.behavior;
  copy.priority = record.priority;
  copy.cause = record.cause;
  copy.search = nullptr;
  if (record.search == nullptr) return;
  search = *record.search;
  copy.search = &search;
}

bool demands_stop(const Demand& demand, TaskId task) {
  return demand.task == task && demand.kind == Demand::Kind::stop;
}

}  // namespace

LastDecisions::LastDecisions(const CompiledCatalog& catalog,
                             const std::vector<std::uint32_t>& ranks, const State& state)
    : catalog_(catalog), state_(state), explainer_(catalog, ranks, {}) {}

void LastDecisions::note_answer(const EventRecord& record, const Circumstances& circumstances,
                                const Assignment& solution) {
  const GroupId group = circumstances.trigger.group;
  rejections_.erase(group);
  Decision& decision = decisions_[group];
  copy_event(record, decision.event, decision.search);
  decision.event.outcome = Outcome::accepted;
  decision.trigger = circumstances.trigger;
  decision.trigger.parameters = std::string_view();  // they decide nothing, and do not last
  decision.failed.assign(circumstances.failed.begin(), circumstances.failed.end());
  decision.elsewhere = objectives_elsewhere(catalog_, state_, group);
  decision.solution = solution;
  save_state(circumstances, decision.before);
}

void LastDecisions::note_rejection(const EventRecord& record, const Trigger& trigger) {
  Rejection& rejection = rejections_[trigger.group];
  copy_event(record, rejection.event, rejection.search);
  rejection.event.outcome = Outcome::rejected;
  rejection.event.conflict = record.conflict;
  rejection.kind = trigger.kind;
}

/// Only the group counts for the answer, and for the reasons against another one; what runs
/// elsewhere is a part of the suitability that is told.
void LastDecisions::save_state(const Circumstances& circumstances, Snapshot& before) const {
  const State& state = circumstances.state;
  const GroupId group = circumstances.trigger.group;
  before.running.clear();
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog_.task_ids[index];
    Snapshot::RunningTask& entry = before.running.emplace_back();
    entry.task = task;
    entry.value_index = state.value_index(task);
    if (catalog_.tasks[task].group != group || !state.has_request(task)) continue;
    const Request& request = state.request(task);
    entry.request = Request{request.priority, request.event, {}};
  }
  before.denied.clear();
  for (BehaviorId behavior = catalog_.group_behaviors[group];
       behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
    if (state.is_denied(behavior)) before.denied.push_back(behavior);
  }
  before.variables = state.variables();
}

WhyUnmet LastDecisions::why_unmet(GroupId group, std::span<const Demands> ways) {
  WhyUnmet answer;
  for (const Demands& way : ways) {
    for (const Demand& demand : way) {
      const std::uint32_t index = catalog_.tasks[demand.task].catalog_index;
      if (!demands_run(demand, demand.task) || !state_.queue().has(index)) continue;
      answer.kind = WhyUnmet::Kind::due;
      answer.queued_task = demand.task;
      answer.due = state_.queue().due(index);
      return answer;
    }
  }
  if (const Rejection* const rejection = find_rejection(group, ways)) {
    answer.kind = WhyUnmet::Kind::rejected;
    answer.event = &rejection->event;
    return answer;
  }
  const auto found = decisions_.find(group);
  if (found == decisions_.end()) return answer;
  answer.kind = WhyUnmet::Kind::decided;
  answer.event = &found->second.event;
  const auto before = std::make_shared<State>(catalog_);
  before->restore(found->second.before);
  answer.before = before;
  answer.why_not = explain(found->second, *before, ways);
  return answer;
}

/// A rejected start of a task that does not run but should, or a rejected stop of one that should
/// not.
const LastDecisions::Rejection* LastDecisions::find_rejection(GroupId group,
                                                              std::span<const Demands> ways) const {
  const auto found = rejections_.find(group);
  if (found == rejections_.end()) return nullptr;
  const TaskId task = found->second.event.task;
  if ((found->second.kind == Trigger::Kind::stop) != state_.is_running(task)) return nullptr;
  const bool is_demanded = std::any_of(ways.begin(), ways.end(), [&](const Demands& way) {
    return std::any_of(way.begin(), way.end(), [&](const Demand& demand) {
      return found->second.kind == Trigger::Kind::stop ? demands_stop(demand, task)
                                                       : demands_run(demand, task);
    });
  });
  return is_demanded ? &found->second : nullptr;
}

WhyNot LastDecisions::explain(Decision& decision, const State& before,
                              std::span<const Demands> ways) {
  WhyNot answer;
  if (decision.search.result.status != SearchStatus::optimal) {
    answer.is_cut = true;
    return answer;
  }
  ProblemBuilder builder(catalog_, before);
  builder.load(decision.trigger, decision.event.index);
  for (const BehaviorId behavior : decision.failed) builder.exclude(behavior);
  return explainer_.ask({before, decision.trigger, decision.search.protection, decision.failed},
                        decision.elsewhere, builder.build(decision.search.protection),
                        decision.solution, ways, decision.event.explanation.chosen);
}

}  // namespace cbc
