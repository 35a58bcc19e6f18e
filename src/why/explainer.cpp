#include "why/explainer.h"

#include <algorithm>
#include <utility>

#include "why/conflict.h"

namespace cbc {
namespace {

/// Whether each of the ways needs a task that nobody has requested, and that starts on request
/// only: the simplest conflict set of all. Empty if not.
std::vector<Reason> missing_requests(const CompiledCatalog& catalog,
                                     const Circumstances& circumstances,
                                     std::span<const Demands> ways) {
  std::vector<Reason> reasons;
  for (const Demands& way : ways) {
    const auto missing = std::find_if(way.begin(), way.end(), [&](const Demand& demand) {
      return demands_run(demand, demand.task) && demand.task != circumstances.trigger.task &&
             !circumstances.state.is_running(demand.task) &&
             !circumstances.state.is_suspended(demand.task) &&
             catalog.tasks[demand.task].start_on_request != 0;
    });
    if (missing == way.end()) return {};
    const bool is_known = std::any_of(reasons.begin(), reasons.end(), [&](const Reason& reason) {
      return reason.task == missing->task;
    });
    if (is_known) continue;
    Reason& reason = reasons.emplace_back();
    reason.kind = Reason::Kind::on_request;
    reason.task = missing->task;
  }
  return reasons;
}

/// Of a task with an active request.
RankedRequest ranked_request(const Circumstances& circumstances, TaskId task) {
  if (task == circumstances.trigger.task) {
    return {circumstances.trigger.priority, circumstances.trigger.time};
  }
  const Request& request = *circumstances.state.find_own_request(task);
  return {request.priority, request.time};
}

/// The objectives outside a group, where all requests are satisfied and nothing changes.
ObjectiveValues objectives_elsewhere(const CompiledCatalog& catalog, const State& state,
                                     GroupId group) {
  ObjectiveValues values;
  values.requests = state.request_count();
  values.idle_total = state.idle_total();
  values.idle_running = state.idle_running();
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    if (state.is_counted(task)) --values.requests;
    if (state.is_running(task) && catalog.tasks[task].start_on_request == 0) {
      --values.idle_running;
    }
  }
  values.satisfied = values.requests;
  return values;
}

}  // namespace

void Explainer::explain(const Circumstances& circumstances, const Assignment& solution,
                        const Questions& questions, Explanation& explanation) {
  load(circumstances, solution, explanation.chosen);
  if (questions.displaced) explain_displaced(circumstances, explanation);
  for (const Subject& subject : questions.why) {
    if (!is_in_group(subject, circumstances.trigger.group)) continue;
    if (subject.is_task) {
      explain_task(circumstances, catalog_.task_ids[subject.catalog_index], explanation);
    } else {
      explain_behavior(circumstances, catalog_.behavior_ids[subject.catalog_index], explanation);
    }
  }
  if (questions.alternatives > 0) {
    explanation.alternatives = search_.list_best(solution, questions.alternatives);
    explanation.is_list_cut = search_.is_cut();
  }
}

WhyNot Explainer::ask(const Circumstances& circumstances, const Assignment& solution,
                      std::span<const Demands> ways, Configuration& chosen) {
  load(circumstances, solution, chosen);
  return why_not(circumstances, chosen, ways);
}

void Explainer::load(const Circumstances& circumstances, const Assignment& solution,
                     Configuration& chosen) {
  search_.load(*circumstances.problem,
               objectives_elsewhere(catalog_, circumstances.state, circumstances.trigger.group));
  chosen = search_.comparison().evaluate(solution);
}

void Explainer::explain_queued(const State& state, Explanation& explanation) const {
  for (Why& why : explanation.why) {
    if (why.task == none ? why.is_active : why.chosen != none) continue;
    if (why.task == none && !state.is_available(why.behavior)) continue;
    const TaskId task = why.task == none ? queued_task(state, why.behavior) : why.task;
    if (task == none || !state.queue().has(catalog_.tasks[task].catalog_index)) continue;
    why.queued_task = task;
    why.due = state.queue().due(catalog_.tasks[task].catalog_index);
    why.why_not = {};
    why.why_not.conflict = hindrances_to_reactive_start(catalog_, state, task);
  }
}

/// The first task of a behavior that is in the queue, or none.
TaskId Explainer::queued_task(const State& state, BehaviorId behavior) const {
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    if (state.queue().has(catalog_.tasks[task].catalog_index)) return task;
  }
  return none;
}

bool Explainer::is_in_group(const Subject& subject, GroupId group) const {
  if (subject.is_task)
    return catalog_.tasks[catalog_.task_ids[subject.catalog_index]].group == group;
  return catalog_.group_of(catalog_.behavior_ids[subject.catalog_index]) == group;
}

void Explainer::explain_displaced(const Circumstances& circumstances, Explanation& explanation) {
  for (const LocalTask task : circumstances.problem->requests) {
    const TaskId id = catalog_.group_tasks[circumstances.trigger.group] + task;
    if (circumstances.state.is_suspended(id)) continue;  // it did not run before
    if (explanation.chosen.assignment[task] != none) continue;
    const Demands runs{{Demand::Kind::run, id, none}};
    explanation.displaced.push_back(
        {id, why_not(circumstances, explanation.chosen, std::span(&runs, 1))});
  }
}

void Explainer::explain_task(const Circumstances& circumstances, TaskId task,
                             Explanation& explanation) {
  const TaskId first = catalog_.group_tasks[catalog_.tasks[task].group];
  const std::uint32_t index = explanation.chosen.assignment[task - first];
  const Demands otherwise{{index == none ? Demand::Kind::run : Demand::Kind::has_not, task, index}};
  Why why;
  why.task = task;
  why.chosen = index == none ? none : catalog_.values[task][index].behavior;
  if (catalog_.values[task].empty()) {
    Reason& reason = why.why_not.conflict.emplace_back();
    reason.kind = Reason::Kind::no_behavior;
    reason.task = task;
  } else {
    why.why_not = why_not(circumstances, explanation.chosen, std::span(&otherwise, 1));
  }
  if (index != none) {
    explain_better(circumstances, task, index, explanation.chosen, why.better);
  }
  explanation.why.push_back(std::move(why));
}

/// A behavior is active if one of its tasks has it, and inactive if none has it.
void Explainer::explain_behavior(const Circumstances& circumstances, BehaviorId behavior,
                                 Explanation& explanation) {
  const TaskId first = catalog_.group_tasks[catalog_.group_of(behavior)];
  std::vector<Demands> with;
  Demands without;
  Why why;
  why.behavior = behavior;
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t index = value - catalog_.values.begin[task];
    if (explanation.chosen.assignment[task - first] == index) {
      why.is_active = true;
      explain_better(circumstances, task, index, explanation.chosen, why.better);
    }
    with.push_back({{Demand::Kind::has, task, index}});
    without.push_back({Demand::Kind::has_not, task, index});
  }
  why.why_not = why_not(circumstances, explanation.chosen,
                        why.is_active ? std::span<const Demands>(&without, 1) : with);
  explanation.why.push_back(std::move(why));
}

/// `index`: the value that the task has.
void Explainer::explain_better(const Circumstances& circumstances, TaskId task, std::uint32_t index,
                               const Configuration& chosen, std::vector<BetterBehavior>& better) {
  const auto values = catalog_.values[task];
  for (std::uint32_t other = 0; values[other].suitability > values[index].suitability; ++other) {
    const Demands has_it{{Demand::Kind::has, task, other}};
    better.push_back({task, other, why_not(circumstances, chosen, std::span(&has_it, 1))});
  }
}

WhyNot Explainer::why_not(const Circumstances& circumstances, const Configuration& chosen,
                          std::span<const Demands> ways) {
  WhyNot answer;
  answer.conflict = missing_requests(catalog_, circumstances, ways);
  if (!answer.conflict.empty()) return answer;
  answer.alternative = search_.find_best(ways);
  if (search_.is_cut()) {
    answer.is_cut = true;
  } else if (answer.alternative) {
    answer.difference = search_.comparison().compare(chosen, *answer.alternative);
    if (answer.difference.criterion == Criterion::request_order) {
      answer.request = ranked_request(circumstances, answer.difference.task);
      if (answer.difference.other_task != none) {
        answer.other_request = ranked_request(circumstances, answer.difference.other_task);
      }
    }
  } else if (auto reasons = find_conflict_with(catalog_, circumstances, ways)) {
    answer.conflict = std::move(*reasons);
  } else {
    answer.is_cut = true;
  }
  return answer;
}

}  // namespace cbc
