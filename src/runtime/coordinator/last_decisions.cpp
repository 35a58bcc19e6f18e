#include "runtime/coordinator/last_decisions.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

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
    entry.request = Request{request.priority, request.event, {}, request.time};
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
  const auto found = decisions_.find(group);
  if (found != decisions_.end()) {
    const auto before = std::make_shared<State>(catalog_);
    before->restore(found->second.before);
    answer.before = before;
    answer.last_event = found->second.event.index;
  }
  answer.blocked = find_blocked(ways, answer.before.get());
  if (explains(answer.blocked, ways)) {
    answer.kind = WhyUnmet::Kind::blocked;
    answer.why_not.conflict = reasons_of(answer.blocked, ways);
    return answer;
  }
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
  if (found == decisions_.end()) {
    answer.why_not.conflict = reasons_why_unavailable(ways);
    return answer;
  }
  answer.kind = WhyUnmet::Kind::decided;
  answer.event = &found->second.event;
  answer.why_not = explain(found->second, *answer.before, ways);
  return answer;
}

/// Reactive tasks that would have to run, and those that could start by themselves since the last
/// decision, whose start would stop what is not to run. `before`: that decision; null: none.
std::vector<BlockedStart> LastDecisions::find_blocked(std::span<const Demands> ways,
                                                      const State* before) const {
  std::vector<BlockedStart> blocked;
  const auto add = [&](TaskId task) {
    const bool is_known =
        std::any_of(blocked.begin(), blocked.end(),
                    [task](const BlockedStart& other) { return other.task == task; });
    if (is_known || catalog_.tasks[task].reactive_start == 0 || state_.is_running(task) ||
        !state_.has_available_behavior(task)) {
      return;
    }
    std::vector<BlockedStart::Rival> rivals = running_rivals(task);
    if (!rivals.empty()) blocked.push_back({task, std::move(rivals)});
  };
  for (const Demands& way : ways) {
    for (const Demand& demand : way) {
      if (is_met(demand)) continue;
      if (!state_.is_running(demand.task)) {
        add(demand.task);
        continue;
      }
      if (before == nullptr) continue;
      for (const std::uint32_t clique : catalog_.task_cliques[demand.task]) {
        for (const TaskId rival : catalog_.cliques[clique]) {
          if (!before->has_available_behavior(rival)) add(rival);
        }
      }
    }
  }
  return blocked;
}

std::vector<BlockedStart::Rival> LastDecisions::running_rivals(TaskId task) const {
  std::vector<BlockedStart::Rival> rivals;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    for (const TaskId rival : catalog_.cliques[clique]) {
      const bool is_known =
          std::any_of(rivals.begin(), rivals.end(),
                      [rival](const BlockedStart::Rival& other) { return other.task == rival; });
      if (rival == task || is_known || !state_.is_running(rival)) continue;
      rivals.push_back({rival, catalog_.clique_lines[clique]});
    }
  }
  return rivals;
}

bool LastDecisions::is_met(const Demand& demand) const {
  const std::uint32_t index = state_.value_index(demand.task);
  switch (demand.kind) {
    case Demand::Kind::run:
      return index != none;
    case Demand::Kind::stop:
      return index == none;
    case Demand::Kind::has:
      return index == demand.value_index;
    case Demand::Kind::has_not:
      return index != demand.value_index;
  }
  return false;
}

/// Whether all that one of the ways lacks are starts that are blocked, and stops of their rivals.
bool LastDecisions::explains(std::span<const BlockedStart> blocked,
                             std::span<const Demands> ways) const {
  const auto is_explained = [&](const Demand& demand) {
    return is_met(demand) ||
           std::any_of(blocked.begin(), blocked.end(), [&](const BlockedStart& start) {
             return start.task == demand.task ||
                    std::any_of(start.rivals.begin(), start.rivals.end(),
                                [&](const BlockedStart::Rival& rival) {
                                  return rival.task == demand.task;
                                });
           });
  };
  return !blocked.empty() && std::any_of(ways.begin(), ways.end(), [&](const Demands& way) {
    return std::all_of(way.begin(), way.end(), is_explained);
  });
}

std::vector<Reason> LastDecisions::reasons_of(std::span<const BlockedStart> blocked,
                                              std::span<const Demands> ways) const {
  std::vector<Reason> reasons;
  const auto add = [&reasons](const Reason& reason) {
    if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
      reasons.push_back(reason);
    }
  };
  for (const BlockedStart& start : blocked) {
    for (const BlockedStart::Rival& rival : start.rivals) {
      Reason exclusion;
      exclusion.kind = Reason::Kind::exclusive;
      std::tie(exclusion.task, exclusion.other_task) = std::minmax(start.task, rival.task);
      exclusion.line = rival.line;
      add(exclusion);
      if (!state_.has_request(rival.task)) continue;
      Reason protection;
      protection.kind = Reason::Kind::is_protected;
      protection.task = rival.task;
      protection.priority = state_.request(rival.task).priority;
      protection.is_from_any_request = true;
      add(protection);
    }
  }
  // The behavior that should perform one of them may be unavailable as well.
  for (const Demands& way : ways) {
    for (const Demand& demand : way) {
      if (demand.kind != Demand::Kind::has || is_met(demand)) continue;
      const BehaviorId behavior = catalog_.values[demand.task][demand.value_index].behavior;
      if (!state_.is_available(behavior)) add(reason_of_unavailability(catalog_, state_, behavior));
    }
  }
  return reasons;
}

/// Of reactive tasks that should run.
std::vector<Reason> LastDecisions::reasons_why_unavailable(std::span<const Demands> ways) const {
  for (const Demands& way : ways) {
    for (const Demand& demand : way) {
      if (is_met(demand) || state_.is_running(demand.task) ||
          catalog_.tasks[demand.task].reactive_start == 0 ||
          state_.has_available_behavior(demand.task)) {
        continue;
      }
      return reasons_of_unavailability(catalog_, state_, demand.task);
    }
  }
  return {};
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
