// Each pair of tasks is a problem: both have to run. The solver decides it, exactly; all tasks of a
// solution run together, so one solution answers for many pairs. Why two tasks never run together
// is a minimal conflict set, in the order of the chain between them.
//
// To pass exclusions up the requirements, as planning graphs do with mutual exclusions (A. L. Blum
// and M. L. Furst, "Fast planning through planning graph analysis", Artificial Intelligence 90
// (1997)), would need no search. But that finds only some of the pairs: three choices may be
// impossible together of which any two are possible.

#include "ask/together.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace cbc {

std::vector<std::uint32_t> variables_of(const CompiledCatalog& catalog,
                                        std::span<const TaskId> tasks) {
  if (catalog.variables.empty()) return {};
  std::vector<std::uint32_t> variables;
  for (const TaskId task : tasks) {
    RelevantTasks relevant(catalog, catalog.tasks[task].group);
    relevant.add(task);
    relevant.close();
    for (const BehaviorId behavior : relevant.behaviors()) {
      for (const FittingValue& value : catalog.fitting_values_of(behavior)) {
        variables.push_back(value.variable);
      }
    }
  }
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

namespace {

/// Reasons that may be examined for the table of all pairs.
constexpr std::uint64_t most_effort_of_all_pairs = 400'000'000;

Demand runs(TaskId task) { return {Demand::Kind::run, task, none}; }

std::uint64_t key_of(TaskId a, TaskId b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

/// Takes the requirements that lead down from a task, and the conditions of behaviors, out of
/// `reasons`, each after what leads to it.
std::vector<Reason> take_requirements_below(const CompiledCatalog& catalog, TaskId task,
                                            std::vector<Reason>& reasons) {
  std::vector<Reason> taken;
  std::vector<TaskId> open{task};
  for (std::size_t next = 0; next < open.size(); ++next) {
    const TaskId above = open[next];
    const auto is_of_it = [&](const Reason& reason) {
      if (reason.kind != Reason::Kind::requires_task && reason.kind != Reason::Kind::situation) {
        return false;
      }
      return catalog.can_perform(reason.behavior, above);
    };
    const auto rest = std::stable_partition(
        reasons.begin(), reasons.end(), [&](const Reason& reason) { return !is_of_it(reason); });
    std::stable_sort(rest, reasons.end(), [&catalog](const Reason& one, const Reason& other) {
      return catalog.behaviors[one.behavior].catalog_index <
             catalog.behaviors[other.behavior].catalog_index;
    });
    for (auto reason = rest; reason != reasons.end(); ++reason) {
      if (reason->kind == Reason::Kind::requires_task) open.push_back(reason->task);
      taken.push_back(*reason);
    }
    reasons.erase(rest, reasons.end());
  }
  return taken;
}

/// Puts a set of reasons why two tasks do not run together into the order of a chain.
std::vector<Reason> chain_of(const CompiledCatalog& catalog, TaskId a, TaskId b,
                             std::vector<Reason> reasons) {
  std::vector<Reason> chain = take_requirements_below(catalog, a, reasons);
  const std::vector<Reason> end = take_requirements_below(catalog, b, reasons);
  chain.insert(chain.end(), reasons.begin(), reasons.end());
  chain.insert(chain.end(), end.begin(), end.end());
  return chain;
}

}  // namespace

std::string_view name_of(Together together) {
  static constexpr std::array<std::string_view, 6> names{"possible",
                                                         "excluded",
                                                         "excluded_indirectly",
                                                         "excluded_in_each_situation",
                                                         "excluded_by_situation",
                                                         "undecided"};
  return names[static_cast<std::size_t>(together)];
}

TogetherSearch::TogetherSearch(AssignmentSearch& search, const SituationSpace& space,
                               const Liveness& liveness, Effort& effort)
    : search_(search),
      ask_(search, space),
      space_(space),
      liveness_(liveness),
      catalog_(search.catalog()),
      effort_(effort) {}

std::optional<std::uint32_t> TogetherSearch::find_list(TaskId a, TaskId b) const {
  const auto of_b = catalog_.task_cliques[b];
  for (const std::uint32_t clique : catalog_.task_cliques[a]) {
    if (std::find(of_b.begin(), of_b.end(), clique) != of_b.end()) return clique;
  }
  return std::nullopt;
}

Together TogetherSearch::decide(TaskId a, TaskId b) {
  if (find_list(a, b)) return Together::excluded;
  if (is_dead(a) || is_dead(b)) return Together::excluded_indirectly;
  Feasibility answer = decide_by_constraints(a, b);
  if (answer == Feasibility::no) return Together::excluded_indirectly;
  if (answer == Feasibility::yes && !variables_of(catalog_, std::array{a, b}).empty()) {
    answer = ask_.find(asked_of(catalog_, std::array{runs(a), runs(b)}));
    if (answer == Feasibility::no) return why_not_in_situations(a, b);
  }
  return answer == Feasibility::yes ? Together::possible : Together::undecided;
}

Feasibility TogetherSearch::can_run(TaskId task) {
  if (is_dead(task)) return Feasibility::no;
  // Of what is not dead it may be open whether it can run.
  if (variables_of(catalog_, {&task, 1}).empty()) return Feasibility::yes;
  return ask_.find({{catalog_.tasks[task].group, {runs(task)}}});
}

Feasibility TogetherSearch::decide_by_constraints(TaskId a, TaskId b) {
  const GroupId group = catalog_.tasks[a].group;
  if (group != catalog_.tasks[b].group) {
    const bool is_certain = liveness_.of_task(a) == Liveness::State::live &&
                            liveness_.of_task(b) == Liveness::State::live;
    return is_certain ? Feasibility::yes : Feasibility::unknown;
  }
  if (compatible_.contains(key_of(a, b))) return Feasibility::yes;
  Assignment solution;
  const Feasibility answer = search_.find(group, std::array{runs(a), runs(b)}, solution);
  if (answer == Feasibility::yes) note_running(catalog_.group_tasks[group], solution);
  return answer;
}

/// Of tasks that run together in no situation: whether there is one in which either can run.
Together TogetherSearch::why_not_in_situations(TaskId a, TaskId b) {
  const GroupDemands of_a{catalog_.tasks[a].group, {runs(a)}};
  const GroupDemands of_b{catalog_.tasks[b].group, {runs(b)}};
  // In doubt, the weaker statement is the true one.
  return ask_.find({of_a, of_b}) == Feasibility::no ? Together::excluded_by_situation
                                                    : Together::excluded_in_each_situation;
}

/// All tasks of a solution run together, not only those that were asked for.
void TogetherSearch::note_running(TaskId first_of_group, const Assignment& solution) {
  std::vector<TaskId> running;
  for (LocalTask task(0); task < solution.size(); ++task) {
    if (solution[task] != none) running.push_back(first_of_group + task);
  }
  for (std::size_t a = 0; a < running.size(); ++a) {
    for (std::size_t b = a + 1; b < running.size(); ++b) {
      compatible_.insert(key_of(running[a], running[b]));
    }
  }
}

TogetherSearch::Witness TogetherSearch::find_witness(TaskId a, TaskId b) {
  const Asked question = asked_of(catalog_, std::array{runs(a), runs(b)});
  if (ask_.find(question) != Feasibility::yes) return {};
  const auto behavior_of = [&](TaskId task) {
    const GroupId group = catalog_.tasks[task].group;
    const Assignment& solution = ask_.assignment(group == question.front().group ? 0 : 1);
    return catalog_.values[task][solution[task - catalog_.group_tasks[group]]].behavior;
  };
  return {behavior_of(a), behavior_of(b)};
}

std::vector<Reason> TogetherSearch::find_reasons(TaskId a, TaskId b, bool with_conditions) {
  const Asked question = asked_of(catalog_, std::array{runs(a), runs(b)});
  RelaxedQuestions relaxed(space_, effort_);
  relaxed.add(question);
  return chain_of(catalog_, a, b,
                  relaxed.conflict(constraints_on(catalog_, question, with_conditions)));
}

std::size_t TogetherTable::count(Together together) const {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(),
                    [together](const TaskPair& pair) { return pair.together == together; }));
}

std::size_t TogetherTable::count_forbidden() const {
  return static_cast<std::size_t>(std::count_if(
      pairs.begin(), pairs.end(), [](const TaskPair& pair) { return pair.is_forbidden; }));
}

namespace {

std::vector<Reason> reasons_of(const TaskPair& pair, const CompiledCatalog& catalog,
                               TogetherSearch& together) {
  if (pair.together == Together::excluded_indirectly) {
    return together.find_reasons(pair.first, pair.second);
  }
  if (pair.together == Together::excluded_in_each_situation ||
      pair.together == Together::excluded_by_situation) {
    return together.find_reasons(pair.first, pair.second, true);
  }
  if (pair.together != Together::excluded) return {};
  Reason reason;
  reason.kind = Reason::Kind::exclusive;
  reason.task = pair.first;
  reason.other_task = pair.second;
  reason.line = catalog.clique_lines[*together.find_list(pair.first, pair.second)];
  return {reason};
}

/// Whether a list of the settings has both tasks.
bool is_forbidden(const CompiledCatalog& catalog, const TaskPair& pair,
                  const std::vector<std::vector<std::string>>& lists) {
  return std::any_of(lists.begin(), lists.end(), [&](const std::vector<std::string>& list) {
    const auto has = [&](TaskId task) {
      return std::find(list.begin(), list.end(), catalog.name_of_task(task)) != list.end();
    };
    return has(pair.first) && has(pair.second);
  });
}

}  // namespace

std::size_t count_tasks_in_pairs(const CompiledCatalog& catalog) {
  const auto on_request = static_cast<std::size_t>(
      std::count_if(catalog.tasks.begin(), catalog.tasks.end(),
                    [](const CompiledTask& task) { return task.start_on_request != 0; }));
  return on_request > 0 ? on_request : catalog.tasks.size();
}

TogetherTable make_together_table(const CompiledCatalog& catalog, const TogetherOptions& options) {
  AssignmentSearch search(catalog, options.max_nodes, Effort(most_effort_of_assignments));
  const Liveness liveness(search);
  const SituationSpace space(search.catalog(), {}, {});
  Effort effort(most_effort_of_all_pairs);
  TogetherSearch together(search, space, liveness, effort);
  TogetherTable table;
  table.is_of_all_tasks =
      std::none_of(catalog.tasks.begin(), catalog.tasks.end(),
                   [](const CompiledTask& task) { return task.start_on_request != 0; });
  for (const TaskId task : catalog.task_ids) {
    if (catalog.tasks[task].start_on_request == 0 && !table.is_of_all_tasks) continue;
    const bool never_runs = together.can_run(task) == Feasibility::no;
    (never_runs ? table.never_run : table.tasks).push_back(task);
  }
  for (std::size_t a = 0; a < table.tasks.size(); ++a) {
    for (std::size_t b = a + 1; b < table.tasks.size(); ++b) {
      TaskPair pair{table.tasks[a], table.tasks[b], {}, {}, false};
      pair.together = together.decide(pair.first, pair.second);
      pair.is_forbidden = pair.together == Together::possible &&
                          is_forbidden(catalog, pair, options.never_together);
      pair.reasons = reasons_of(pair, catalog, together);
      table.pairs.push_back(std::move(pair));
    }
  }
  return table;
}

}  // namespace cbc
