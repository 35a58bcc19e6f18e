#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "ask/ask.h"
#include "ask/conflict/reasons.h"
#include "ask/liveness.h"
#include "runtime/compiled/compiled_catalog.h"

/// Which tasks can run at the same time. A search decides, since exclusivity lists alone do not
/// tell: what two tasks require may exclude one another.
namespace cbc {

/// Whether two tasks can run at the same time.
enum class Together : std::uint8_t {
  possible,             ///< some assignment that satisfies all constraints runs both
  excluded,             ///< an exclusivity list has both
  excluded_indirectly,  ///< no assignment runs both, though no list has both
  /// Some assignment runs both, but with behaviors that fit in no common situation; there are
  /// situations in which either task can run.
  excluded_in_each_situation,
  excluded_by_situation,  ///< the same, and there is no situation in which either task can run
  undecided               ///< the search reached its limit
};

/// "possible", "excluded", "excluded_indirectly", "excluded_in_each_situation",
/// "excluded_by_situation", "undecided".
[[nodiscard]] std::string_view name_of(Together together);

/// Two tasks, and whether they can run at the same time.
struct TaskPair {
  TaskId first;  ///< the earlier one in the catalog
  TaskId second;
  Together together = Together::possible;
  /// Why not: of two tasks in a list this exclusion; otherwise a minimal set of constraints, in the
  /// order of the chain that they form, or nothing if it takes too long to find. A condition of a
  /// behavior is of the kind `situation`, without a value.
  std::vector<Reason> reasons;
  bool is_forbidden = false;  ///< possible, though the settings say that it must not be
};

/// All pairs of the tasks that start on request; of all tasks if none does.
struct TogetherTable {
  bool is_of_all_tasks = false;
  std::vector<TaskId> tasks;      ///< those that can run, in catalog order
  std::vector<TaskId> never_run;  ///< those that cannot, in catalog order
  std::vector<TaskPair> pairs;    ///< of `tasks`: by the first one, then by the second one

  [[nodiscard]] std::size_t count(Together together) const;
  [[nodiscard]] std::size_t count_forbidden() const;
};

/// How the pairs are decided.
struct TogetherOptions {
  std::uint64_t max_nodes = 100'000;  ///< decisions that the search for one answer may take
  /// Names of tasks of which the settings say that no two run together.
  std::vector<std::vector<std::string>> never_together = {};
};

/// The most tasks whose pairs are looked at: time and memory grow with the square of their number.
inline constexpr std::size_t most_tasks_in_pairs = 2'000;

/// The number of the tasks that the table would be about, those that never run included.
[[nodiscard]] std::size_t count_tasks_in_pairs(const CompiledCatalog& catalog);

/// The table of a catalog with at most `most_tasks_in_pairs` of these tasks.
[[nodiscard]] TogetherTable make_together_table(const CompiledCatalog& catalog,
                                                const TogetherOptions& options);

// The search behind the table of pairs, and behind the rules about tasks that run together.

/// The situation variables, ascending, that behaviors name with which some tasks, and what these
/// require, run. No others matter to the tasks.
[[nodiscard]] std::vector<std::uint32_t> variables_of(const CompiledCatalog& catalog,
                                                      std::span<const TaskId> tasks);

/// Answers questions about pairs of tasks, with every behavior available that fits in the
/// situation, which may be any.
///
/// Past the effort, answers are unknown and reasons are missing.
class TogetherSearch {
 public:
  /// All must outlive this object. `space`: of the catalog of the search. `effort`: for reasons.
  TogetherSearch(AssignmentSearch& search, const SituationSpace& space, const Liveness& liveness,
                 Effort& effort);

  /// `a` and `b` differ.
  [[nodiscard]] Together decide(TaskId a, TaskId b);

  /// Whether the constraints allow both, the situation aside. No list has both, and neither is
  /// dead.
  [[nodiscard]] Feasibility decide_by_constraints(TaskId a, TaskId b);

  /// Whether a task can run at all, in some situation.
  [[nodiscard]] Feasibility can_run(TaskId task);

  /// Place in CompiledCatalog::cliques of the first exclusivity list that has both tasks.
  [[nodiscard]] std::optional<std::uint32_t> find_list(TaskId a, TaskId b) const;

  /// Why two tasks never run together: a minimal set of constraints, in the order of the chain that
  /// they form. It begins with what `a` requires, then come exclusions and minimum performances,
  /// and last what `b` requires. Empty if it takes too long to find, or if the constraints allow
  /// both. `with_conditions`: those of behaviors are among the constraints.
  [[nodiscard]] std::vector<Reason> find_reasons(TaskId a, TaskId b, bool with_conditions = false);

  /// Behaviors with which both tasks run. They can run together.
  struct Witness {
    BehaviorId a = none;
    BehaviorId b = none;
  };
  [[nodiscard]] Witness find_witness(TaskId a, TaskId b);

 private:
  [[nodiscard]] bool is_dead(TaskId task) const {
    return liveness_.of_task(task) == Liveness::State::dead;
  }
  [[nodiscard]] Together why_not_in_situations(TaskId a, TaskId b);
  void note_running(TaskId first_of_group, const Assignment& solution);

  AssignmentSearch& search_;
  Ask ask_;
  const SituationSpace& space_;
  const Liveness& liveness_;
  const CompiledCatalog& catalog_;
  Effort& effort_;
  std::unordered_set<std::uint64_t> compatible_;  ///< pairs that the constraints allow
};

}  // namespace cbc
