#include "coordinator/conflict.h"

#include <algorithm>
#include <cstdint>

#include "coordinator/relaxed_problem.h"

namespace cbc {
namespace {

/// With more possible reasons than this, finding a minimal set takes too long.
constexpr std::size_t most_candidates = 20'000;

/// All that may speak against the event. Tasks that neither the event nor a protected task can come
/// to need are left out: they can stay not running.
class Candidates {
 public:
  Candidates(const CompiledCatalog& catalog, const State& state, const Trigger& trigger,
             std::span<const BehaviorId> failed)
      : catalog_(catalog),
        state_(state),
        trigger_(trigger),
        failed_(failed),
        first_task_(catalog.group_tasks[trigger.group]),
        is_relevant_(catalog.group_tasks[trigger.group + 1] - first_task_, 0) {}

  std::vector<Reason> collect() && {
    find_relevant_tasks();
    for (const TaskId task : relevant_) {
      add_exclusions(task);
      add_state(task);
      add_minimum(task);
    }
    for (const BehaviorId behavior : relevant_behaviors()) add_behavior(behavior);
    return std::move(reasons_);
  }

 private:
  [[nodiscard]] bool is_full() const { return reasons_.size() > most_candidates; }

  [[nodiscard]] bool is_protected(TaskId task) const {
    return task != trigger_.task && cbc::is_protected(state_, trigger_, task, trigger_.priority);
  }

  void find_relevant_tasks() {
    for (TaskId task = first_task_; task < first_task_ + is_relevant_.size(); ++task) {
      if (task == trigger_.task || is_protected(task)) reach(task);
    }
    // NOLINTNEXTLINE(modernize-loop-convert): the list grows
    for (std::size_t next = 0; next < relevant_.size(); ++next) {
      for (const Arc& arc : catalog_.arcs[relevant_[next]]) reach(arc.target);
    }
    std::sort(relevant_.begin(), relevant_.end());
  }

  void reach(TaskId task) {
    if (is_relevant_[task - first_task_] != 0) return;
    is_relevant_[task - first_task_] = 1;
    relevant_.push_back(task);
  }

  void add_exclusions(TaskId task) {
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      for (const TaskId other : catalog_.cliques[clique]) {
        if (is_full()) return;
        if (other <= task || is_relevant_[other - first_task_] == 0) continue;
        Reason reason;
        reason.kind = Reason::Kind::exclusive;
        reason.task = task;
        reason.other_task = other;
        reason.line = catalog_.clique_lines[clique];
        reasons_.push_back(reason);
      }
    }
  }

  void add_state(TaskId task) {
    if (task == trigger_.task) return;
    Reason reason;
    reason.task = task;
    if (is_protected(task)) {
      reason.kind = Reason::Kind::is_protected;
      reason.priority = state_.request(task).priority;
      reasons_.push_back(reason);
    } else if (!state_.is_running(task) && catalog_.tasks[task].start_on_request) {
      reason.kind = Reason::Kind::on_request;
      reasons_.push_back(reason);
    }
  }

  void add_minimum(TaskId task) {
    const CompiledTask& compiled = catalog_.tasks[task];
    if (compiled.minimum_performance == 0) return;
    Reason reason;
    reason.kind = Reason::Kind::performance;
    reason.task = task;
    reason.minimum_performance = compiled.minimum_performance;
    reason.line = compiled.minimum_line;
    reasons_.push_back(reason);
  }

  [[nodiscard]] std::vector<BehaviorId> relevant_behaviors() const {
    std::vector<BehaviorId> behaviors;
    for (const TaskId task : relevant_) {
      for (const Value& value : catalog_.values[task]) behaviors.push_back(value.behavior);
    }
    std::sort(behaviors.begin(), behaviors.end());
    behaviors.erase(std::unique(behaviors.begin(), behaviors.end()), behaviors.end());
    return behaviors;
  }

  void add_behavior(BehaviorId behavior) {
    Reason reason;
    reason.behavior = behavior;
    if (std::find(failed_.begin(), failed_.end(), behavior) != failed_.end()) {
      reason.kind = Reason::Kind::faulty;
      reasons_.push_back(reason);
    } else if (!state_.is_available(behavior)) {
      reason.kind = Reason::Kind::unavailable;
      reasons_.push_back(reason);
    }
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      reason.task = requirement.task;
      reason.line = requirement.line;
      reason.kind = Reason::Kind::requires_task;
      reasons_.push_back(reason);
      if (requirement.minimum_performance == 0) continue;
      reason.kind = Reason::Kind::performance;
      reason.minimum_performance = requirement.minimum_performance;
      reasons_.push_back(reason);
      reason.minimum_performance = 0;
    }
  }

  const CompiledCatalog& catalog_;
  const State& state_;
  const Trigger& trigger_;
  const std::span<const BehaviorId> failed_;
  const TaskId first_task_;
  std::vector<std::uint8_t> is_relevant_;  ///< by task of the group
  std::vector<TaskId> relevant_;
  std::vector<Reason> reasons_;
};

/// Halves what may be left out (QuickXplain, Junker 2004): the reasons of `candidates` that are
/// needed beside `given` to leave no solution. `has_grown`: `given` has new reasons since it was
/// last found to leave a solution.
void minimize(RelaxedProblem& problem, std::vector<Reason>& given,
              std::span<const Reason> candidates, bool has_grown, std::vector<Reason>& needed) {
  if (has_grown && !problem.has_solution(given)) return;
  if (candidates.size() == 1) {
    needed.push_back(candidates.front());
    return;
  }
  const std::span<const Reason> first = candidates.first(candidates.size() / 2);
  const std::span<const Reason> second = candidates.subspan(first.size());
  const std::size_t given_before = given.size();
  const std::size_t needed_before = needed.size();

  given.insert(given.end(), first.begin(), first.end());
  minimize(problem, given, second, true, needed);
  given.resize(given_before);

  given.insert(given.end(), needed.begin() + static_cast<std::ptrdiff_t>(needed_before),
               needed.end());
  minimize(problem, given, first, given.size() > given_before, needed);
  given.resize(given_before);
}

}  // namespace

std::vector<Reason> find_conflict(const CompiledCatalog& catalog, const State& state,
                                  const Trigger& trigger, std::span<const BehaviorId> failed) {
  const bool is_start = trigger.kind == Trigger::Kind::start;
  if (is_start && catalog.values[trigger.task].empty()) {
    Reason reason;
    reason.kind = Reason::Kind::no_behavior;
    reason.task = trigger.task;
    return {reason};
  }
  const std::vector<Reason> candidates = Candidates(catalog, state, trigger, failed).collect();
  if (candidates.empty() || candidates.size() > most_candidates) return {};

  std::vector<std::uint32_t> present;
  for (TaskId task = catalog.group_tasks[trigger.group];
       task < catalog.group_tasks[trigger.group + 1]; ++task) {
    present.push_back(state.place(task));
  }
  RelaxedProblem problem(catalog, trigger.group, present, trigger.task, is_start);
  if (problem.has_solution(candidates)) return {};
  std::vector<Reason> given;
  std::vector<Reason> needed;
  minimize(problem, given, candidates, false, needed);
  return needed;
}

}  // namespace cbc
