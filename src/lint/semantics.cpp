#include "lint/semantics.h"

#include <algorithm>
#include <utility>

#include "cbc/rules.h"

namespace cbc {
namespace {

/// Reasons that may be looked at in all; past them questions stay open.
constexpr std::uint64_t most_effort = 400'000'000;

}  // namespace

Semantics::Semantics(const Catalog& catalog, AssignmentSearch& search, const Liveness& liveness,
                     std::uint64_t max_nodes, Reporter& reporter)
    : catalog_(catalog),
      search_(search),
      liveness_(liveness),
      max_nodes_(max_nodes),
      reporter_(reporter),
      behaviors_(compiled().behaviors.size()),
      tasks_(compiled().tasks.size()),
      nothing_present_(most_in_a_group(compiled().group_tasks), none),
      effort_left_(most_effort) {}

RelaxedProblem Semantics::relaxed(const Goal& goal) const {
  const Demand::Kind kind = goal.place == none ? Demand::Kind::run : Demand::Kind::has;
  const std::uint32_t group = compiled().tasks[goal.task].group;
  return {compiled(), group, nothing_present_, {{kind, goal.task, goal.place}}};
}

Feasibility Semantics::solve(RelaxedProblem& problem, std::span<const Reason> reasons) {
  if (effort_left_ == 0) return Feasibility::unknown;
  const std::uint64_t before = problem.effort();
  const Feasibility answer = problem.solve(reasons);
  effort_left_ -= std::min(problem.effort() - before, effort_left_);
  return answer;
}

Feasibility Semantics::solve(std::span<const Goal> goals, std::span<const Reason> reasons) {
  Feasibility answer = Feasibility::no;
  for (const Goal& goal : goals) {
    RelaxedProblem problem = relaxed(goal);
    const Feasibility one = solve(problem, reasons);
    if (one == Feasibility::yes) return one;
    if (one == Feasibility::unknown) answer = one;
  }
  return answer;
}

void Semantics::report_undecided(const Range& range, const std::string& question) {
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
