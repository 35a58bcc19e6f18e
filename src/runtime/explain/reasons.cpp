#include "explain/reasons.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

namespace cbc {

std::string_view name_of(Reason::Kind kind) {
  static constexpr std::array<std::string_view, 10> names{
      "priority", "no_behavior", "protected",   "exclusive", "on_request",
      "requires", "performance", "unavailable", "faulty",    "finished"};
  return names[static_cast<std::size_t>(kind)];
}

RelevantTasks::RelevantTasks(const CompiledCatalog& catalog, std::uint32_t group)
    : catalog_(catalog),
      first_task_(catalog.group_tasks[group]),
      is_relevant_(catalog.group_tasks[group + 1] - first_task_, 0) {}

void RelevantTasks::add(TaskId task) {
  if (contains(task)) return;
  is_relevant_[task - first_task_] = 1;
  tasks_.push_back(task);
}

bool RelevantTasks::close(std::size_t most) {
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < tasks_.size(); ++next) {
    if (tasks_.size() > most) return false;
    for (const Arc& arc : catalog_.arcs[tasks_[next]]) add(arc.target);
  }
  std::sort(tasks_.begin(), tasks_.end());
  return true;
}

std::vector<BehaviorId> RelevantTasks::behaviors() const {
  std::vector<BehaviorId> behaviors;
  for (const TaskId task : tasks_) {
    for (const Value& value : catalog_.values[task]) behaviors.push_back(value.behavior);
  }
  std::sort(behaviors.begin(), behaviors.end());
  behaviors.erase(std::unique(behaviors.begin(), behaviors.end()), behaviors.end());
  return behaviors;
}

void add_exclusions(const CompiledCatalog& catalog, TaskId task, const RelevantTasks& relevant,
                    std::size_t most, std::vector<Reason>& reasons) {
  for (const std::uint32_t clique : catalog.task_cliques[task]) {
    for (const TaskId other : catalog.cliques[clique]) {
      if (reasons.size() >= most) return;
      if (other <= task || !relevant.contains(other)) continue;
      Reason reason;
      reason.kind = Reason::Kind::exclusive;
      reason.task = task;
      reason.other_task = other;
      reason.line = catalog.clique_lines[clique];
      reasons.push_back(reason);
    }
  }
}

void add_minimum(const CompiledCatalog& catalog, TaskId task, std::vector<Reason>& reasons) {
  const CompiledTask& compiled = catalog.tasks[task];
  if (compiled.minimum_performance == 0) return;
  Reason reason;
  reason.kind = Reason::Kind::performance;
  reason.task = task;
  reason.minimum_performance = compiled.minimum_performance;
  reason.line = compiled.minimum_line;
  reasons.push_back(reason);
}

void add_requirements(const CompiledCatalog& catalog, BehaviorId behavior,
                      std::vector<Reason>& reasons) {
  for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
    Reason reason;
    reason.kind = Reason::Kind::requires_task;
    reason.behavior = behavior;
    reason.task = requirement.task;
    reason.line = catalog.line_of(requirement);
    reasons.push_back(reason);
    if (requirement.minimum_performance == 0) continue;
    reason.kind = Reason::Kind::performance;
    reason.minimum_performance = requirement.minimum_performance;
    reasons.push_back(reason);
  }
}

namespace {

/// The domain words of a task among those of its group.
template <typename Words>
auto words_of(const CompiledCatalog& catalog, std::uint32_t group, Words& words, TaskId task) {
  const std::uint32_t first = catalog.words[catalog.group_tasks[group]];
  return std::span(words).subspan(catalog.words[task] - first,
                                  catalog.words[task + 1] - catalog.words[task]);
}

}  // namespace

void narrow(const CompiledCatalog& catalog, const Demand& demand, Problem& problem) {
  const auto words = words_of(catalog, problem.group, problem.domains, demand.task);
  std::uint8_t& may_stop = problem.may_stop[demand.task - catalog.group_tasks[problem.group]];
  const auto bit = [&] { return std::uint64_t{1} << (demand.place % 64); };
  switch (demand.kind) {
    case Demand::Kind::run:
      may_stop = 0;
      return;
    case Demand::Kind::stop:
      std::fill(words.begin(), words.end(), 0);
      return;
    case Demand::Kind::has: {
      may_stop = 0;
      const std::uint64_t kept = words[demand.place / 64] & bit();
      std::fill(words.begin(), words.end(), 0);
      words[demand.place / 64] = kept;
      return;
    }
    case Demand::Kind::has_not:
      words[demand.place / 64] &= ~bit();
      return;
  }
}

bool is_open(const CompiledCatalog& catalog, const Problem& problem, TaskId task) {
  std::uint32_t values = problem.may_stop[task - catalog.group_tasks[problem.group]];
  for (const std::uint64_t word : words_of(catalog, problem.group, problem.domains, task)) {
    values += static_cast<std::uint32_t>(std::popcount(word));
  }
  return values > 1;
}

namespace {

/// Halves what may be left out (QuickXplain, Junker 2004): the reasons of `candidates` that are
/// needed beside `given` to leave no solution. `has_grown`: `given` has new reasons since it was
/// last found to leave a solution.
void minimize(const HasSolution& has_solution, std::vector<Reason>& given,
              std::span<const Reason> candidates, bool has_grown, std::vector<Reason>& needed) {
  if (has_grown && !has_solution(given)) return;
  if (candidates.size() == 1) {
    needed.push_back(candidates.front());
    return;
  }
  const std::span<const Reason> first = candidates.first(candidates.size() / 2);
  const std::span<const Reason> second = candidates.subspan(first.size());
  const std::size_t given_before = given.size();
  const std::size_t needed_before = needed.size();

  given.insert(given.end(), first.begin(), first.end());
  minimize(has_solution, given, second, true, needed);
  given.resize(given_before);

  given.insert(given.end(), needed.begin() + static_cast<std::ptrdiff_t>(needed_before),
               needed.end());
  minimize(has_solution, given, first, given.size() > given_before, needed);
  given.resize(given_before);
}

}  // namespace

std::vector<Reason> minimal_set(std::span<const Reason> candidates,
                                const HasSolution& has_solution) {
  std::vector<Reason> given;
  std::vector<Reason> needed;
  if (!candidates.empty()) minimize(has_solution, given, candidates, false, needed);
  return needed;
}

}  // namespace cbc
