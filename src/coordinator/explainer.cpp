#include "coordinator/explainer.h"

#include <optional>
#include <utility>

namespace cbc {

Explainer::Explainer(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks,
                     ExplanationOptions options)
    : catalog_(catalog), options_(std::move(options)), search_(catalog, ranks) {}

void Explainer::explain(const Circumstances& circumstances, const Problem& problem,
                        const Assignment& solution, Explanation& explanation) {
  search_.load(problem, elsewhere(circumstances.state, problem.group));
  explanation.chosen = search_.comparison().evaluate(solution);
  if (options_.displaced) explain_displaced(circumstances, problem, explanation);
  for (const Subject& subject : options_.why) {
    if (!is_in_group(subject, problem.group)) continue;
    if (subject.is_task) {
      explain_task(circumstances, catalog_.task_ids[subject.place], explanation);
    } else {
      explain_behavior(circumstances, catalog_.behavior_ids[subject.place], explanation);
    }
  }
  if (options_.alternatives > 0) {
    explanation.alternatives = search_.list_best(solution, options_.alternatives);
    explanation.is_list_cut = search_.is_cut();
  }
}

bool Explainer::is_in_group(const Subject& subject, std::uint32_t group) const {
  if (subject.is_task) return catalog_.tasks[catalog_.task_ids[subject.place]].group == group;
  return catalog_.group_of(catalog_.behavior_ids[subject.place]) == group;
}

/// Requests outside the group are satisfied, and nothing changes there.
ObjectiveValues Explainer::elsewhere(const State& state, std::uint32_t group) const {
  ObjectiveValues values;
  values.requests = state.request_count();
  values.idle_total = state.idle_total();
  values.idle_running = state.idle_running();
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    if (state.has_request(task)) --values.requests;
    if (state.is_running(task) && catalog_.tasks[task].start_on_request == 0) {
      --values.idle_running;
    }
  }
  values.satisfied = values.requests;
  return values;
}

void Explainer::explain_displaced(const Circumstances& circumstances, const Problem& problem,
                                  Explanation& explanation) {
  for (const std::uint32_t task : problem.requests) {
    if (explanation.chosen.places[task] != none) continue;
    const TaskId id = catalog_.group_tasks[problem.group] + task;
    const Demands runs{{Demand::Kind::run, id, none}};
    explanation.displaced.push_back(
        {id, why_not(circumstances, explanation.chosen, std::span(&runs, 1))});
  }
}

void Explainer::explain_task(const Circumstances& circumstances, TaskId task,
                             Explanation& explanation) {
  const TaskId first = catalog_.group_tasks[catalog_.tasks[task].group];
  const std::uint32_t place = explanation.chosen.places[task - first];
  Demand otherwise;
  otherwise.kind = place == none ? Demand::Kind::run : Demand::Kind::has_not;
  otherwise.task = task;
  otherwise.place = place;
  const Demands demands{otherwise};
  Why why;
  why.task = task;
  why.chosen = place == none ? none : catalog_.values[task][place].behavior;
  if (catalog_.values[task].empty()) {
    Reason& reason = why.why_not.conflict.emplace_back();
    reason.kind = Reason::Kind::no_behavior;
    reason.task = task;
  } else {
    why.why_not = why_not(circumstances, explanation.chosen, std::span(&demands, 1));
  }
  explanation.why.push_back(std::move(why));
}

/// It is active if one of its tasks has it, and not active if none has it.
void Explainer::explain_behavior(const Circumstances& circumstances, BehaviorId behavior,
                                 Explanation& explanation) {
  const TaskId first = catalog_.group_tasks[catalog_.group_of(behavior)];
  std::vector<Demands> with;
  Demands without;
  Why why;
  why.behavior = behavior;
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t place = value - catalog_.values.begin[task];
    if (explanation.chosen.places[task - first] == place) why.is_active = true;
    with.push_back({{Demand::Kind::has, task, place}});
    without.push_back({Demand::Kind::has_not, task, place});
  }
  why.why_not = why_not(circumstances, explanation.chosen,
                        why.is_active ? std::span<const Demands>(&without, 1) : with);
  explanation.why.push_back(std::move(why));
}

WhyNot Explainer::why_not(const Circumstances& circumstances, const Configuration& chosen,
                          std::span<const Demands> ways) {
  WhyNot answer;
  answer.alternative = search_.find_best(ways);
  if (search_.is_cut()) {
    answer.is_cut = true;
  } else if (answer.alternative) {
    answer.difference = search_.comparison().compare(chosen, *answer.alternative);
  } else if (auto reasons = find_reasons(catalog_, circumstances, ways)) {
    answer.conflict = std::move(*reasons);
  } else {
    answer.is_cut = true;
  }
  return answer;
}

}  // namespace cbc
