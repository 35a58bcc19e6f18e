// Each pair of tasks is a problem: both have to run. The solver decides it, exactly; all tasks of a
// solution run together, so one solution answers for many pairs. Where conditions of behaviors
// matter, each combination of the values that matter is a problem of its own. Why two tasks never
// run together is a minimal conflict set, in the order of the chain between them.
//
// To pass exclusions up the requirements, as planning graphs do with mutual exclusions (A. L. Blum
// and M. L. Furst, "Fast planning through planning graph analysis", Artificial Intelligence 90
// (1997)), would need no search. But that finds only some of the pairs: three choices may be
// impossible together of which any two are possible.

#include "core/check/together.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace cbc {
namespace {

/// Goes through the situations that differ in some variables; the others keep their first values.
class Situations {
 public:
  Situations(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& variables)
      : catalog_(catalog), variables_(variables), values_(catalog.variables.size(), 0) {}

  /// By variable, its value.
  [[nodiscard]] const std::vector<std::uint32_t>& values() const { return values_; }

  /// False after the last one.
  [[nodiscard]] bool advance() {
    for (const std::uint32_t variable : variables_) {
      if (++values_[variable] < catalog_.variables[variable].value_count) return true;
      values_[variable] = 0;
    }
    return false;
  }

 private:
  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t>& variables_;
  std::vector<std::uint32_t> values_;
};

/// Appends the conditions of a behavior, one for each variable that it names.
void add_conditions(const CompiledCatalog& catalog, BehaviorId behavior,
                    std::vector<Reason>& reasons) {
  std::uint32_t last = none;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable == std::exchange(last, fitting.variable)) continue;
    Reason reason;
    reason.kind = Reason::Kind::situation;
    reason.behavior = behavior;
    reason.variable = fitting.variable;
    reason.value = none;
    reasons.push_back(reason);
  }
}

bool is_met(const CompiledCatalog& catalog, const Reason& condition, std::uint32_t value) {
  const std::span<const FittingValue> fitting = catalog.fitting_values_of(condition.behavior);
  return std::binary_search(fitting.begin(), fitting.end(),
                            FittingValue{condition.behavior, condition.variable, value});
}

/// Solves demands in all situations, with only some reasons in force.
class ConflictInSituations {
 public:
  ConflictInSituations(const CompiledCatalog& catalog, const Demands& demands,
                       std::uint64_t& effort_left)
      : catalog_(catalog),
        nothing_present_(most_in_a_group(catalog.group_tasks), none),
        effort_left_(effort_left) {
    for (const Demand& demand : demands) {
      const GroupId group = catalog.tasks[demand.task].group;
      auto part = std::find_if(parts_.begin(), parts_.end(),
                               [group](const Part& one) { return one.group == group; });
      if (part == parts_.end()) part = parts_.insert(part, {group, {}, nullptr});
      part->demands.push_back(demand);
    }
    for (Part& part : parts_) {
      part.problem =
          std::make_unique<ConflictSearch>(catalog_, part.group, nothing_present_, part.demands);
    }
  }

  [[nodiscard]] std::vector<Reason> find() {
    const std::vector<Reason> candidates = all_reasons();
    if (candidates.size() > most_constraints) return {};
    std::vector<bool> is_used(candidates.size(), false);
    if (has_solution(candidates, &is_used)) return {};
    // Most of them have no part in the proofs, so it need not be found which of them are needed.
    std::vector<Reason> used;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (is_used[i]) used.push_back(candidates[i]);
    }
    std::vector<Reason> minimal = minimal_conflict_set(
        used, [this](std::span<const Reason> some) { return has_solution(some, nullptr); });
    return effort_left_ == 0 ? std::vector<Reason>{} : minimal;
  }

 private:
  /// The demands on one group of the catalog.
  struct Part {
    GroupId group;
    Demands demands;
    std::unique_ptr<ConflictSearch> problem;
  };

  [[nodiscard]] std::vector<Reason> all_reasons() const {
    std::vector<Reason> reasons;
    for (const Part& part : parts_) {
      RelevantTasks relevant(catalog_, part.group);
      for (const Demand& demand : part.demands) relevant.add(demand.task);
      relevant.close();
      for (const TaskId task : relevant.tasks()) {
        add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
        add_minimum(catalog_, task, reasons);
      }
      for (const BehaviorId behavior : relevant.behaviors()) {
        add_requirements(catalog_, behavior, reasons);
        add_conditions(catalog_, behavior, reasons);
      }
    }
    return reasons;
  }

  /// Also true if that is not known. `is_used`: which of the reasons the proofs of the contrary
  /// use.
  [[nodiscard]] bool has_solution(std::span<const Reason> reasons, std::vector<bool>* is_used) {
    std::vector<std::uint32_t> variables;
    for (const Reason& reason : reasons) {
      if (reason.kind == Reason::Kind::situation) variables.push_back(reason.variable);
    }
    std::sort(variables.begin(), variables.end());
    variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
    return ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> values) {
             for (const Part& part : parts_) {
               const Feasibility answer = solve(part, reasons, values, is_used);
               if (answer != Feasibility::yes) return answer;
             }
             return Feasibility::yes;
           }) != Feasibility::no;
  }

  [[nodiscard]] Feasibility solve(const Part& part, std::span<const Reason> reasons,
                                  std::span<const std::uint32_t> values,
                                  std::vector<bool>* is_used) {
    std::vector<Reason> in_force;
    std::vector<std::size_t> places;
    for (std::size_t place = 0; place < reasons.size(); ++place) {
      const Reason& reason = reasons[place];
      const GroupId group = reason.behavior != none ? catalog_.group_of(reason.behavior)
                                                    : catalog_.tasks[reason.task].group;
      if (group != part.group) continue;
      if (reason.kind == Reason::Kind::situation &&
          is_met(catalog_, reason, values[reason.variable])) {
        continue;
      }
      in_force.push_back(reason);
      places.push_back(place);
    }
    if (effort_left_ == 0) return Feasibility::unknown;
    const std::uint64_t before = part.problem->effort();
    const Feasibility answer = part.problem->solve(in_force, effort_left_);
    const std::uint64_t effort = part.problem->effort() - before + reasons.size();
    effort_left_ -= std::min(effort, effort_left_);
    if (answer == Feasibility::no && is_used != nullptr) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (part.problem->is_used()[i] != 0) (*is_used)[places[i]] = true;
      }
    }
    return answer;
  }

  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t> nothing_present_;
  std::vector<Part> parts_;
  std::uint64_t& effort_left_;
};

}  // namespace

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

Feasibility ask_in_situations(const CompiledCatalog& catalog,
                              const std::vector<std::uint32_t>& variables,
                              const InSituation& question) {
  constexpr std::size_t most_situations = 10'000;
  Situations situations(catalog, variables);
  for (std::size_t asked = 0; asked < most_situations; ++asked) {
    const Feasibility answer = question(situations.values());
    if (answer != Feasibility::no) return answer;
    if (!situations.advance()) return Feasibility::no;
  }
  return Feasibility::unknown;
}

std::vector<Reason> conflict_in_all_situations(const CompiledCatalog& catalog,
                                               const Demands& demands, std::uint64_t& effort_left) {
  return ConflictInSituations(catalog, demands, effort_left).find();
}

namespace {

/// Reasons that may be examined in total.
constexpr std::uint64_t most_effort_of_all_pairs = 400'000'000;

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
      const auto values = catalog.performs[reason.behavior];
      return std::any_of(values.begin(), values.end(),
                         [&](ValueId value) { return catalog.task_of(value) == above; });
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

TogetherSearch::TogetherSearch(AssignmentSearch& search, const Liveness& liveness)
    : search_(search),
      liveness_(liveness),
      catalog_(search.catalog()),
      nothing_present_(most_in_a_group(catalog_.group_tasks), none),
      effort_left_(most_effort_of_all_pairs) {}

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
  if (answer == Feasibility::yes) {
    const std::vector<std::uint32_t> variables = variables_of(catalog_, std::array{a, b});
    if (!variables.empty()) answer = decide_by_situations(a, b, variables);
    if (answer == Feasibility::no) return why_not_in_situations(a, b, variables);
  }
  return answer == Feasibility::yes ? Together::possible : Together::undecided;
}

Feasibility TogetherSearch::can_run(TaskId task) {
  if (is_dead(task)) return Feasibility::no;
  const std::vector<std::uint32_t> variables = variables_of(catalog_, {&task, 1});
  // Of what is not dead it may be open whether it can run.
  if (variables.empty()) return Feasibility::yes;
  return ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> situation) {
    return find_alone(task, situation);
  });
}

Feasibility TogetherSearch::decide_by_constraints(TaskId a, TaskId b) {
  const GroupId group = catalog_.tasks[a].group;
  if (group != catalog_.tasks[b].group) {
    const bool is_certain = liveness_.of_task(a) == Liveness::State::live &&
                            liveness_.of_task(b) == Liveness::State::live;
    return is_certain ? Feasibility::yes : Feasibility::unknown;
  }
  if (compatible_.contains(key_of(a, b))) return Feasibility::yes;
  const Feasibility answer = find(a, b, {});
  if (answer == Feasibility::yes) note_running(catalog_.group_tasks[group]);
  return answer;
}

/// Looks at all situations. `variables`: those that matter.
Feasibility TogetherSearch::decide_by_situations(TaskId a, TaskId b,
                                                 const std::vector<std::uint32_t>& variables) {
  return ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> situation) {
    return find(a, b, situation);
  });
}

/// Of tasks that run together in no situation: whether there is one in which either can run.
Together TogetherSearch::why_not_in_situations(TaskId a, TaskId b,
                                               const std::vector<std::uint32_t>& variables) {
  const Feasibility have_common =
      ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> situation) {
        const Feasibility answer = find_alone(a, situation);
        return answer == Feasibility::no ? answer : find_alone(b, situation);
      });
  // In doubt, the weaker statement is the true one.
  return have_common == Feasibility::no ? Together::excluded_by_situation
                                        : Together::excluded_in_each_situation;
}

Feasibility TogetherSearch::find_alone(TaskId task, std::span<const std::uint32_t> situation) {
  return search_.find_running({&task, 1}, situation, solution_);
}

/// Whether both tasks run in an assignment. If so, its behaviors are the witness.
Feasibility TogetherSearch::find(TaskId a, TaskId b, std::span<const std::uint32_t> situation) {
  const auto behavior_of = [this](TaskId task) {
    const TaskId first = catalog_.group_tasks[catalog_.tasks[task].group];
    return catalog_.values[task][solution_[task - first]].behavior;
  };
  const std::array<TaskId, 2> both{a, b};
  if (catalog_.tasks[a].group == catalog_.tasks[b].group) {
    const Feasibility answer = search_.find_running(both, situation, solution_);
    if (answer == Feasibility::yes) witness_ = {behavior_of(a), behavior_of(b)};
    return answer;
  }
  Witness witness;
  for (const TaskId& task : both) {
    const Feasibility answer = find_alone(task, situation);
    if (answer != Feasibility::yes) return answer;
    (task == a ? witness.a : witness.b) = behavior_of(task);
  }
  witness_ = witness;
  return Feasibility::yes;
}

/// All tasks of a solution run together, not only those that were asked for.
void TogetherSearch::note_running(TaskId first_of_group) {
  std::vector<TaskId> running;
  for (LocalTask task(0); task < solution_.size(); ++task) {
    if (solution_[task] != none) running.push_back(first_of_group + task);
  }
  for (std::size_t a = 0; a < running.size(); ++a) {
    for (std::size_t b = a + 1; b < running.size(); ++b) {
      compatible_.insert(key_of(running[a], running[b]));
    }
  }
}

TogetherSearch::Witness TogetherSearch::find_witness(TaskId a, TaskId b) {
  const std::vector<std::uint32_t> variables = variables_of(catalog_, std::array{a, b});
  witness_ = {};
  static_cast<void>(variables.empty() ? find(a, b, {}) : decide_by_situations(a, b, variables));
  return witness_;
}

Feasibility TogetherSearch::solve(ConflictSearch& problem, std::span<const Reason> reasons) {
  if (effort_left_ == 0) return Feasibility::unknown;
  const std::uint64_t before = problem.effort();
  const Feasibility answer = problem.solve(reasons, effort_left_);
  effort_left_ -= std::min(problem.effort() - before, effort_left_);
  return answer;
}

std::vector<Reason> TogetherSearch::find_reasons(TaskId a, TaskId b) {
  const GroupId group = catalog_.tasks[a].group;
  if (group != catalog_.tasks[b].group) return {};
  RelevantTasks relevant(catalog_, group);
  relevant.add(a);
  relevant.add(b);
  relevant.close();
  const std::vector<Reason> reasons = constraints_on(catalog_, relevant);
  if (reasons.size() > most_constraints) return {};

  ConflictSearch problem(catalog_, group, nothing_present_,
                         {{Demand::Kind::run, a, none}, {Demand::Kind::run, b, none}});
  if (solve(problem, reasons) != Feasibility::no) return {};
  // Most constraints have no part in the proof, so it need not be found which of them are needed.
  std::vector<Reason> used;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (problem.is_used()[i] != 0) used.push_back(reasons[i]);
  }
  std::vector<Reason> minimal = minimal_conflict_set(
      used, [&](std::span<const Reason> some) { return solve(problem, some) != Feasibility::no; });
  if (effort_left_ == 0) return {};
  return chain_of(catalog_, a, b, std::move(minimal));
}

std::vector<Reason> TogetherSearch::find_reasons_in_situations(TaskId a, TaskId b) {
  const Demands both{{Demand::Kind::run, a, none}, {Demand::Kind::run, b, none}};
  return chain_of(catalog_, a, b, conflict_in_all_situations(catalog_, both, effort_left_));
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
    return together.find_reasons_in_situations(pair.first, pair.second);
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
                  std::span<const NeverTogether> lists) {
  return std::any_of(lists.begin(), lists.end(), [&](const NeverTogether& list) {
    const auto has = [&](TaskId task) {
      return std::find(list.tasks.begin(), list.tasks.end(), catalog.name_of_task(task)) !=
             list.tasks.end();
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
  AssignmentSearch search(catalog, options.max_nodes);
  const Liveness liveness(search);
  TogetherSearch together(search, liveness);
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
