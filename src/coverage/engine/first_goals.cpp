#include "coverage/engine/first_goals.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

namespace cbc {
namespace {

constexpr std::size_t most_of_a_kind = 3;
/// More tasks that a goal guards make no difference: chains of thousands would take too long.
constexpr std::size_t most_guarded = 50;

int importance(Goal::Kind kind) {
  switch (kind) {
    case Goal::Kind::exclusion_decided:
    case Goal::Kind::requirement_decided:
    case Goal::Kind::minimum_decided:
      return 0;
    case Goal::Kind::behavior_failed:
    case Goal::Kind::behavior_ceased_to_fit:
    case Goal::Kind::timeout_fired:
    case Goal::Kind::failure_remembered:
    case Goal::Kind::improved_at_once:
      return 1;
    case Goal::Kind::higher_displaced:
    case Goal::Kind::lower_rejected:
    case Goal::Kind::equal_displaced:
    case Goal::Kind::reactive_started:
    case Goal::Kind::reactive_gave_way:
    case Goal::Kind::reactive_returned:
    case Goal::Kind::request_suspended:
    case Goal::Kind::request_resumed:
      return 2;
    default:
      return 3;
  }
}

/// The tasks that behaviors with a requirement perform, by what they require.
class Dependents {
 public:
  explicit Dependents(const CompiledCatalog& catalog)
      : catalog_(catalog), direct_(catalog.tasks.size()) {
    for (BehaviorId behavior(0); behavior < catalog.behaviors.size(); ++behavior) {
      for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
        add_tasks(behavior, direct_[requirement.task]);
      }
    }
  }

  /// How many tasks the goal is about, or may stop with these.
  [[nodiscard]] std::size_t guarded_by(const Goal& goal) const {
    std::set<TaskId> tasks;
    if (goal.task != none) tasks.insert(goal.task);
    if (goal.other_task != none) tasks.insert(goal.other_task);
    if (goal.behavior != none) add_tasks(goal.behavior, tasks);
    if (goal.variable != none) {
      for (BehaviorId behavior(0); behavior < catalog_.behaviors.size(); ++behavior) {
        const auto values = catalog_.fitting_values_of(behavior);
        const bool names_it = std::any_of(values.begin(), values.end(), [&](const auto& value) {
          return value.variable == goal.variable;
        });
        if (names_it) add_tasks(behavior, tasks);
      }
    }
    std::vector<TaskId> open(tasks.begin(), tasks.end());
    while (!open.empty() && tasks.size() < most_guarded) {
      const TaskId task = open.back();
      open.pop_back();
      for (const TaskId dependent : direct_[task]) {
        if (tasks.insert(dependent).second) open.push_back(dependent);
      }
    }
    return std::min(tasks.size(), most_guarded);
  }

 private:
  void add_tasks(BehaviorId behavior, std::set<TaskId>& tasks) const {
    for (const ValueId value : catalog_.performs[behavior]) {
      tasks.insert(catalog_.task_of(value));
    }
  }

  const CompiledCatalog& catalog_;
  std::vector<std::set<TaskId>> direct_;  ///< by task
};

}  // namespace

std::vector<std::uint32_t> first_goals(const CatalogCoverage& coverage, std::size_t count) {
  const Dependents dependents(coverage.catalog());
  struct Candidate {
    int importance = 0;
    std::size_t guarded = 0;
    std::uint32_t goal = 0;
    bool is_taken = false;
  };
  std::vector<Candidate> candidates;
  for (std::uint32_t goal = 0; goal < coverage.goals().size(); ++goal) {
    if (!coverage.is_missed(goal)) continue;
    const Goal& missed = coverage.goals()[goal];
    candidates.push_back({importance(missed.kind), dependents.guarded_by(missed), goal});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.importance, b.guarded) < std::tuple(b.importance, a.guarded);
  });
  std::vector<std::uint32_t> first;
  std::array<std::size_t, Goal::kinds> of_kind{};
  for (const bool takes_all : {false, true}) {
    for (Candidate& candidate : candidates) {
      std::size_t& same =
          of_kind.at(static_cast<std::size_t>(coverage.goals()[candidate.goal].kind));
      if (first.size() == count || candidate.is_taken) continue;
      if (!takes_all && same == most_of_a_kind) continue;
      ++same;
      candidate.is_taken = true;
      first.push_back(candidate.goal);
    }
  }
  return first;
}

}  // namespace cbc
