// What no assignment that satisfies all constraints contains: the dead features of a feature model
// (D. Benavides, S. Segura and A. Ruiz-Cortés, "Automated analysis of feature models 20 years
// later: a literature review", Information Systems 35 (2010)). A value is live if some assignment
// has it; then all other values of that assignment are live, too. Most assignments are put together
// without a search; where that fails, the solver decides. Tasks come from the lowest level up, so
// that a behavior that requires a dead task is dead without a search.
//
// Propagation alone would find only some of what is dead. A decision diagram of all assignments
// would answer all questions at once, but may be far too large. Effort is counted in steps and not
// in seconds, so that every machine has the same findings; what stays open at the limit is reported
// as undecided.

#include "core/check/proofs.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// A decision takes about as long as looking at this many values.
constexpr std::uint64_t effort_of_a_node = 50;
/// So many tasks in a bound of a performance take about as long as one value.
constexpr std::uint64_t performance_tasks_in_effort = 4;
constexpr std::uint64_t most_effort_of_search = 100'000'000;

SearchOptions search_options(std::uint64_t max_nodes, bool any_solution) {
  SearchOptions options;
  options.max_nodes = max_nodes;
  options.any_solution = any_solution;
  // The cost bound is about the objective, which does not matter for any solution.
  if (any_solution) options.easy_nodes = UINT64_MAX;
  return options;
}

}  // namespace

std::vector<Reason> constraints_on(const CompiledCatalog& catalog, const RelevantTasks& relevant) {
  std::vector<Reason> constraints;
  for (const TaskId task : relevant.tasks()) {
    add_exclusions(catalog, task, relevant, most_constraints + 1, constraints);
    add_minimum(catalog, task, constraints);
  }
  for (const BehaviorId behavior : relevant.behaviors()) {
    add_requirements(catalog, behavior, constraints);
  }
  return constraints;
}

AssignmentSearch::AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes,
                                   std::function<bool()> is_stopped)
    : catalog_(std::move(catalog)),
      tasks_(catalog_.tasks.begin(), catalog_.tasks.end()),
      any_(catalog_, search_options(max_nodes, true), no_ranks_),
      best_(catalog_, search_options(max_nodes, false), no_ranks_),
      domains_(catalog_.words.back(), 0),
      is_stopped_(std::move(is_stopped)),
      effort_left_(most_effort_of_search) {
  catalog_.tasks = tasks_;
  for (ValueId value(0); value < catalog_.values.items.size(); ++value) {
    const Bit bit = bit_of(value);
    domains_[bit.word] |= bit.mask;
    const auto fitting = catalog_.fitting_values_of(catalog_.values.items[value].behavior);
    if (!fitting.empty()) conditions_.push_back({value, fitting});
  }
}

AssignmentSearch::Bit AssignmentSearch::bit_of(ValueId value) const {
  const TaskId task = catalog_.task_of(value);
  const std::uint32_t place = value - catalog_.values.begin[task];
  return {catalog_.words[task] + place / 64, std::uint64_t{1} << (place % 64)};
}

void AssignmentSearch::rule_out(ValueId value) {
  const Bit bit = bit_of(value);
  domains_[bit.word] &= ~bit.mask;
}

Feasibility AssignmentSearch::find(ValueId value, std::span<const TaskId> closed,
                                   Assignment& solution, std::span<const std::uint32_t> situation) {
  const TaskId task = catalog_.task_of(value);
  open_group(catalog_.tasks[task].group);
  for (const TaskId other : closed) close(other);
  close(task);
  allow(value);
  if (!situation.empty()) close_misfits(situation);
  must_run(task);
  return solve(any_, solution);
}

Feasibility AssignmentSearch::find_running(std::span<const TaskId> tasks,
                                           std::span<const std::uint32_t> situation,
                                           Assignment& solution) {
  open_group(catalog_.tasks[tasks.front()].group);
  if (!situation.empty()) close_misfits(situation);
  for (const TaskId task : tasks) must_run(task);
  return solve(any_, solution);
}

/// The assignments with the best product of all suitabilities run nothing that lowers it beside the
/// task and what it requires, so their product is the best performance.
AssignmentSearch::Best AssignmentSearch::best_performance(TaskId task, bool ignore_minimum) {
  open_group(catalog_.tasks[task].group);
  must_run(task);
  CompiledTask& compiled = tasks_[task];
  const CompiledTask before = compiled;
  if (ignore_minimum) {
    compiled.minimum_performance = 0;
    compiled.minimum_cost = 0;
    // Its values may have been ruled out by the minimum.
    for (const Value& value : catalog_.values[task]) {
      allow(static_cast<ValueId>(&value - catalog_.values.items.data()));
    }
  }
  Best best;
  Assignment solution;
  best.exists = solve(best_, solution);
  compiled = before;
  if (best.exists == Feasibility::yes) best.factors = factors_of(task, solution);
  return best;
}

/// The problem of a group with all values that are not ruled out.
void AssignmentSearch::open_group(GroupId group) {
  const TaskId first = catalog_.group_tasks[group];
  const TaskId end = catalog_.group_tasks[group + 1];
  problem_.group = group;
  problem_.domains.assign(domains_.begin() + catalog_.words[first],
                          domains_.begin() + catalog_.words[end]);
  problem_.may_stop.assign(end - first, 1);
  problem_.present.assign(end - first, none);
}

std::uint32_t AssignmentSearch::first_word() const {
  return catalog_.words[catalog_.group_tasks[problem_.group]];
}

void AssignmentSearch::allow(ValueId value) {
  const Bit bit = bit_of(value);
  problem_.domains[bit.word - first_word()] |= bit.mask;
}

void AssignmentSearch::must_run(TaskId task) {
  problem_.may_stop[task - catalog_.group_tasks[problem_.group]] = 0;
}

void AssignmentSearch::close(TaskId task) {
  const std::uint32_t first = first_word();
  std::fill(problem_.domains.begin() + (catalog_.words[task] - first),
            problem_.domains.begin() + (catalog_.words[task + 1] - first), 0);
}

void AssignmentSearch::close_misfits(std::span<const std::uint32_t> situation) {
  const ValueId end(catalog_.values.begin[catalog_.group_tasks[problem_.group + 1]]);
  const ValueId begin(catalog_.values.begin[catalog_.group_tasks[problem_.group]]);
  std::uint64_t effort = 0;
  const auto is_before = [](const Condition& one, ValueId value) { return one.value < value; };
  auto condition = std::lower_bound(conditions_.begin(), conditions_.end(), begin, is_before);
  for (; condition != conditions_.end() && condition->value < end; ++condition) {
    effort += condition->fitting.size();
    if (!CompiledCatalog::find_misfit(condition->fitting, situation)) continue;
    const Bit bit = bit_of(condition->value);
    problem_.domains[bit.word - first_word()] &= ~bit.mask;
  }
  spend(effort);
}

/// A solution that a limit left unproven is no answer where the best one is sought.
Feasibility AssignmentSearch::solve(Solver& solver, Assignment& solution) {
  if (is_stopped()) effort_left_ = 0;
  if (effort_left_ == 0) return Feasibility::unknown;
  const SearchResult result = solver.solve(problem_, solution);
  spend(result.nodes * effort_of_a_node + problem_.may_stop.size() +
        result.performance_effort / performance_tasks_in_effort);
  switch (result.status) {
    case SearchStatus::optimal:
      return Feasibility::yes;
    case SearchStatus::feasible:
      return &solver == &any_ ? Feasibility::yes : Feasibility::unknown;
    case SearchStatus::infeasible:
      return Feasibility::no;
    case SearchStatus::unknown:
      break;
  }
  return Feasibility::unknown;
}

std::vector<Millionths> AssignmentSearch::factors_of(TaskId task,
                                                     const Assignment& solution) const {
  const TaskId first = catalog_.group_tasks[problem_.group];
  std::vector<TaskId> closure{task};
  std::vector<Millionths> factors;
  for (std::size_t next = 0; next < closure.size(); ++next) {
    const Value& value = catalog_.values[closure[next]][solution[closure[next] - first]];
    factors.push_back(value.suitability);
    for (const CompiledRequirement& requirement : catalog_.requirements[value.behavior]) {
      if (std::find(closure.begin(), closure.end(), requirement.task) == closure.end()) {
        closure.push_back(requirement.task);
      }
    }
  }
  return factors;
}

namespace {

/// Values that may be taken in total.
constexpr std::uint64_t most_effort_of_direct = 200'000'000;

}  // namespace

/// Finds assignments without search, which is enough for most values of most catalogs: each task
/// that a value requires, directly or indirectly, runs with the first behavior that will do. An
/// assignment is extended as long as that is possible, so that a long chain of requirements is
/// walked once, and not once for each of its values.
class DirectAssignment {
 public:
  explicit DirectAssignment(const CompiledCatalog& catalog);

  /// The values of an assignment that has a value and satisfies all constraints; valid until the
  /// next call. Empty if none is found in this way. `is_dead`, `is_live`: by value.
  [[nodiscard]] const std::vector<ValueId>& find(ValueId value, const std::vector<bool>& is_dead,
                                                 const std::vector<bool>& is_live);

  /// Whether the assignment of the last call, if there is one, satisfies all constraints also with
  /// a value in addition, or in place of the one that its task has. If so, it is added.
  [[nodiscard]] bool extend(ValueId value);

 private:
  [[nodiscard]] bool is_running(TaskId task) const { return running_[task] == number_; }
  [[nodiscard]] bool take(ValueId value);
  [[nodiscard]] ValueId choose(TaskId task, const std::vector<bool>& is_dead,
                               const std::vector<bool>& is_live) const;

  const CompiledCatalog& catalog_;
  std::vector<ValueId> values_;
  std::uint64_t number_ = 0;            ///< of the present assignment
  std::vector<std::uint64_t> running_;  ///< by task: last assignment in which it runs
  std::vector<std::uint64_t> used_;     ///< by clique: last assignment in which a task of it runs
  std::uint64_t effort_left_;
};

DirectAssignment::DirectAssignment(const CompiledCatalog& catalog)
    : catalog_(catalog),
      running_(catalog.tasks.size(), 0),
      used_(catalog.cliques.size(), 0),
      effort_left_(most_effort_of_direct) {}

const std::vector<ValueId>& DirectAssignment::find(ValueId value, const std::vector<bool>& is_dead,
                                                   const std::vector<bool>& is_live) {
  values_.clear();
  ++number_;
  bool is_good = take(value);
  for (std::size_t next = 0; is_good && next < values_.size(); ++next) {
    const BehaviorId behavior = catalog_.values.items[values_[next]].behavior;
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      // Minimums are left to the search.
      is_good = requirement.minimum_performance == 0;
      if (is_good && !is_running(requirement.task)) {
        const ValueId chosen = choose(requirement.task, is_dead, is_live);
        is_good = chosen != none && take(chosen);
      }
      if (!is_good) break;
    }
  }
  if (!is_good) values_.clear();
  return values_;
}

bool DirectAssignment::extend(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  if (values_.empty() || catalog_.tasks[task].minimum_performance > 0) return false;
  for (const CompiledRequirement& requirement :
       catalog_.requirements[catalog_.values.items[value].behavior]) {
    if (requirement.minimum_performance > 0 || !is_running(requirement.task)) return false;
  }
  if (is_running(task)) return true;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    if (used_[clique] == number_) return false;
  }
  return take(value);
}

bool DirectAssignment::take(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  if (effort_left_ == 0 || catalog_.tasks[task].minimum_performance > 0) return false;
  --effort_left_;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    if (used_[clique] == number_) return false;
    used_[clique] = number_;
  }
  running_[task] = number_;
  values_.push_back(value);
  return true;
}

/// A value that is known to be live, or else one that may be live.
ValueId DirectAssignment::choose(TaskId task, const std::vector<bool>& is_dead,
                                 const std::vector<bool>& is_live) const {
  ValueId chosen = none;
  for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
       ++value) {
    if (is_live[value]) return value;
    if (chosen == none && !is_dead[value]) chosen = value;
  }
  return chosen;
}

namespace {

/// The state of several things as one: live if one is, dead if all are.
class Sum {
 public:
  void add(Liveness::State state) {
    is_live_ |= state == Liveness::State::live;
    is_undecided_ |= state == Liveness::State::undecided;
  }
  [[nodiscard]] Liveness::State state() const {
    if (is_live_) return Liveness::State::live;
    return is_undecided_ ? Liveness::State::undecided : Liveness::State::dead;
  }

 private:
  bool is_live_ = false;
  bool is_undecided_ = false;
};

}  // namespace

std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog) {
  std::vector<TaskId> order(catalog.tasks.size());
  std::iota(order.begin(), order.end(), TaskId(0));
  std::stable_sort(order.begin(), order.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].level < catalog.tasks[b].level;
  });
  return order;
}

Liveness::Liveness(AssignmentSearch& search)
    : catalog_(search.catalog()),
      is_live_(catalog_.values.items.size(), false),
      is_dead_(catalog_.values.items.size(), false) {
  DirectAssignment direct(catalog_);
  for (const TaskId task : tasks_by_level(catalog_)) {
    for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
         ++value) {
      if (!is_live_[value]) decide(value, direct, search);
    }
  }
}

/// Whether a value requires a task of which all values are known to be dead.
bool Liveness::requires_dead_task(ValueId value) const {
  const BehaviorId behavior = catalog_.values.items[value].behavior;
  const auto& requirements = catalog_.requirements[behavior];
  return std::any_of(requirements.begin(), requirements.end(),
                     [this](const CompiledRequirement& requirement) {
                       return of_task(requirement.task) == State::dead;
                     });
}

/// All other values of the assignment that is found are live, too.
void Liveness::decide(ValueId value, DirectAssignment& direct, AssignmentSearch& search) {
  if (direct.extend(value)) {
    is_live_[value] = true;
    return;
  }
  if (requires_dead_task(value)) {
    is_dead_[value] = true;
    search.rule_out(value);
    return;
  }
  const std::vector<ValueId>& values = direct.find(value, is_dead_, is_live_);
  for (const ValueId other : values) is_live_[other] = true;
  if (!values.empty()) return;

  const Feasibility answer = search.find(value, {}, solution_);
  if (answer == Feasibility::no) {
    is_dead_[value] = true;
    search.rule_out(value);
  } else if (answer == Feasibility::yes) {
    const TaskId first = catalog_.group_tasks[catalog_.tasks[catalog_.task_of(value)].group];
    for (LocalTask task(0); task < solution_.size(); ++task) {
      if (solution_[task] != none) {
        is_live_[catalog_.values.begin[first + task] + solution_[task]] = true;
      }
    }
  }
}

Liveness::State Liveness::of_behavior(BehaviorId behavior) const {
  Sum sum;
  for (const ValueId value : catalog_.performs[behavior]) sum.add(of_value(value));
  return sum.state();
}

Liveness::State Liveness::of_task(TaskId task) const {
  Sum sum;
  for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
       ++value) {
    sum.add(of_value(value));
  }
  return sum.state();
}

namespace {

/// Reasons that may be examined in total; past them, questions stay open.
constexpr std::uint64_t most_effort_of_reasons = 400'000'000;

}  // namespace

ProofContext::ProofContext(const Catalog& catalog, AssignmentSearch& search,
                           const Liveness& liveness, std::uint64_t max_nodes, Reporter& reporter)
    : catalog_(catalog),
      search_(search),
      liveness_(liveness),
      max_nodes_(max_nodes),
      reporter_(reporter),
      behaviors_(compiled().behaviors.size()),
      tasks_(compiled().tasks.size()),
      nothing_present_(most_in_a_group(compiled().group_tasks), none),
      effort_left_(most_effort_of_reasons) {}

ConflictSearch ProofContext::relaxed(const Goal& goal) const {
  const Demand::Kind kind = goal.value_index == none ? Demand::Kind::run : Demand::Kind::has;
  const GroupId group = compiled().tasks[goal.task].group;
  return {compiled(), group, nothing_present_, {{kind, goal.task, goal.value_index}}};
}

std::vector<ConflictSearch> ProofContext::relaxed(std::span<const Goal> goals) const {
  std::vector<ConflictSearch> problems;
  problems.reserve(goals.size());
  for (const Goal& goal : goals) problems.push_back(relaxed(goal));
  return problems;
}

Feasibility ProofContext::solve(ConflictSearch& problem, std::span<const Reason> reasons) {
  if (is_exhausted()) return Feasibility::unknown;
  const std::uint64_t before = problem.effort();
  if (search_.is_stopped()) effort_left_ = 0;
  const Feasibility answer = problem.solve(reasons, effort_left_);
  spend(problem.effort() - before);
  return answer;
}

Feasibility ProofContext::solve(std::span<ConflictSearch> problems,
                                std::span<const Reason> reasons) {
  Feasibility answer = Feasibility::no;
  for (ConflictSearch& problem : problems) {
    const Feasibility one = solve(problem, reasons);
    if (one == Feasibility::yes) return one;
    if (one == Feasibility::unknown) answer = one;
  }
  return answer;
}

namespace {

/// The first list that has both tasks.
Range range_of_list(const Catalog& catalog, TaskIndex a, TaskIndex b) {
  for (const ExclusivityList& list : catalog.exclusivity) {
    const auto has = [&list](TaskIndex task) {
      return std::find(list.tasks.begin(), list.tasks.end(), task) != list.tasks.end();
    };
    if (has(a) && has(b)) return list.range;
  }
  return {};
}

}  // namespace

/// A condition of a behavior on a situation variable.
Note ProofContext::note_of_condition(const Reason& reason) const {
  const Behavior& fitting = behavior(reason.behavior);
  const auto condition =
      std::find_if(fitting.situation.begin(), fitting.situation.end(),
                   [&reason](const Condition& one) { return one.variable == reason.variable; });
  const Variable& variable = catalog_.variables[reason.variable];
  std::vector<std::string> values;
  for (const std::uint32_t value : condition->values) {
    values.push_back(quote(variable.values[value]));
  }
  return reporter_.note(condition->range, "behavior " + quote(fitting.name) + " fits only where " +
                                              quote(variable.name) + " is " + list_with_or(values));
}

Note ProofContext::note_of(const Reason& reason) const {
  if (reason.kind == Reason::Kind::situation) return note_of_condition(reason);
  const TaskIndex task_index = compiled().tasks[reason.task].catalog_index;
  const Task& required = task(reason.task);
  if (reason.kind == Reason::Kind::exclusive) {
    const TaskIndex other = compiled().tasks[reason.other_task].catalog_index;
    return reporter_.note(
        range_of_list(catalog_, task_index, other),
        quote(required.name) + " excludes " + quote(task(reason.other_task).name));
  }
  if (reason.behavior == none) {
    return reporter_.note(
        required.minimum_performance_range,
        quote(required.name) + " runs with at least " + format_percent(reason.minimum_performance));
  }
  const Requirement& requirement = strongest_requirement(behavior(reason.behavior), task_index);
  const std::string who = "behavior " + quote(behavior(reason.behavior).name);
  if (reason.kind == Reason::Kind::performance) {
    return reporter_.note(requirement.minimum_performance_range,
                          who + " requires " + quote(required.name) + " with at least " +
                              format_percent(reason.minimum_performance));
  }
  return reporter_.note(requirement.range, who + " requires " + quote(required.name));
}

std::vector<Note> ProofContext::notes_of(std::span<const Reason> constraints) const {
  struct Entry {
    bool requires_task = false;
    std::uint32_t level = 0;
    Note note;
  };
  std::vector<Entry> entries;
  for (const Reason& reason : constraints) {
    const std::uint32_t level =
        reason.behavior == none ? 0 : compiled().behaviors[reason.behavior].level;
    entries.push_back({reason.kind == Reason::Kind::requires_task, level, note_of(reason)});
  }
  // Requirements from the top down, then what they lead to; otherwise as in the file.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.requires_task != b.requires_task) return a.requires_task;
    return a.level != b.level ? a.level > b.level : a.note.range < b.note.range;
  });
  std::vector<Note> notes;
  notes.reserve(entries.size());
  for (Entry& entry : entries) notes.push_back(std::move(entry.note));
  return notes;
}

void ProofContext::report_undecided(const Range& range, const std::string& question) {
  if (search_.is_exhausted()) {
    if (!std::exchange(has_told_exhaustion_, true)) {
      reporter_.report(
          rule::undecided, range,
          question + " and other questions could not be decided: there is too much to search");
    }
    return;
  }
  reporter_.report(
      rule::undecided, range,
      question + " could not be decided with --max-nodes " + std::to_string(max_nodes_));
}

}  // namespace cbc
