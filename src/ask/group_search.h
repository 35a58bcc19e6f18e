#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

// Assignments of a group, with the solver that decides events.

namespace cbc {

/// Behaviors, ascending.
using BehaviorSet = std::vector<BehaviorId>;

/// The active behaviors of an assignment of the group of a task.
[[nodiscard]] BehaviorSet behaviors_of(const CompiledCatalog& catalog, TaskId task,
                                       const Assignment& assignment);

/// What an assignment is to do.
struct GroupDemand {
  explicit GroupDemand(const CompiledCatalog& catalog)
      : runs(catalog.tasks.size(), false), ruled_out(catalog.value_tasks.size(), false) {}

  /// No task runs with the behavior.
  void rule_out(const CompiledCatalog& catalog, BehaviorId behavior) {
    for (const ValueId value : catalog.performs[behavior]) ruled_out[value] = true;
  }

  [[nodiscard]] bool operator==(const GroupDemand&) const = default;

  std::vector<bool> runs;       ///< by TaskId: the tasks that have to run
  std::vector<bool> ruled_out;  ///< by ValueId: what no task runs with
};

/// Searches for assignments of a group that satisfy all constraints. Nothing runs before, and every
/// task may run.
class GroupSearch {
 public:
  enum class Wanted : std::uint8_t {
    any,  ///< some assignment
    best  ///< the best one, for a request of what has to run (docs/semantics.md, "Objectives")
  };
  enum class Answer : std::uint8_t { found, impossible, stopped };
  /// Asked now and then, with the number of decisions that may follow; false ends the search.
  using KeepOn = std::function<bool(std::uint64_t)>;

  /// The catalog must outlive this object.
  GroupSearch(const CompiledCatalog& catalog, GroupId group, Wanted wanted);

  /// Looks for an assignment that does what is demanded of the group.
  [[nodiscard]] Answer find(const GroupDemand& demand, const KeepOn& keep_on);

  /// Of the assignment that was found last: the value of each task of the group.
  [[nodiscard]] const Assignment& assignment() const { return assignment_; }
  /// Its active behaviors. A solution runs only what has to run and what that needs
  /// (solver/domains.h), so none of them is there in vain.
  [[nodiscard]] BehaviorSet active() const {
    return behaviors_of(catalog_, first_task_, assignment_);
  }

 private:
  void take(const GroupDemand& demand);
  void set_budget(std::uint64_t nodes);

  const CompiledCatalog& catalog_;
  const TaskId first_task_;
  const TaskId end_task_;
  const Wanted wanted_;
  const std::vector<std::uint32_t> no_ranks_;
  Problem problem_;
  std::uint64_t budget_ = 0;
  std::optional<Solver> solver_;
  Assignment assignment_;
};

}  // namespace cbc
