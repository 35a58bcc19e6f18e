#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "cbc/units.h"

namespace cbc {

/// Place of a task, a behavior in a compiled catalog: group by group, and within a group in catalog
/// order, so that all that one event touches lies side by side.
using TaskId = std::uint32_t;
using BehaviorId = std::uint32_t;
/// Place of a (task, behavior) pair in CompiledCatalog::values.
using ValueId = std::uint32_t;

inline constexpr std::uint32_t none = UINT32_MAX;

/// Rows of different lengths in one array: row i is items[begin[i]] up to items[begin[i + 1]].
template <typename T>
struct Rows {
  std::vector<std::uint32_t> begin{0};
  std::vector<T> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    return {items.data() + begin[row], items.data() + begin[row + 1]};
  }
  void close_row() { begin.push_back(static_cast<std::uint32_t>(items.size())); }
};

struct CompiledTask {
  std::uint32_t catalog_index = 0;
  std::uint32_t group = 0;
  std::uint32_t level = 0;             ///< highest level of its behaviors
  Millionths minimum_performance = 0;  ///< 0: none
  std::int64_t minimum_cost = 0;       ///< log_cost(minimum_performance)
  std::uint32_t minimum_line = 0;      ///< of minimum_performance
  Microseconds timeout = 0;            ///< 0: none
  bool start_on_request = true;
  bool reactive_start = false;
  bool keep_running = false;
  bool has_performance_rules = false;  ///< a minimum, or a behavior that requires one
};

struct CompiledBehavior {
  std::uint32_t catalog_index = 0;
  std::uint32_t level = 0;   ///< 0 if it requires nothing, else 1 + highest level it requires
  Microseconds timeout = 0;  ///< 0: that of the task
};

/// That a behavior performs a task. The values of a task are in rank order: best suitability
/// first, equal ones in catalog order.
struct Value {
  BehaviorId behavior = 0;
  Millionths suitability = 0;
  std::int64_t cost = 0;  ///< log_cost(suitability)
};

struct CompiledRequirement {
  TaskId task = 0;
  Millionths minimum_performance = 0;  ///< 0: none
  std::int64_t minimum_cost = 0;       ///< log_cost(minimum_performance)
  std::uint32_t line = 0;
};

/// An edge of the requirement graph: some values of the source task require the target.
struct Arc {
  TaskId source = 0;
  TaskId target = 0;
  std::uint32_t mask = 0;  ///< first word, in CompiledCatalog::masks, of the values that require it
};

/// Number of constraints, as the paper counts them.
struct ConstraintCount {
  std::uint64_t exclusive_pairs = 0;  ///< distinct unordered pairs of different tasks
  std::uint64_t requirements = 0;     ///< distinct (behavior, task)
  std::uint64_t task_minimums = 0;

  [[nodiscard]] std::uint64_t total() const {
    return exclusive_pairs + requirements + task_minimums;
  }
};

/// Everything about a catalog that does not depend on the situation, in flat arrays that the
/// solver uses in place.
struct CompiledCatalog {
  std::string file;

  // In catalog order.
  std::vector<std::string> task_names;
  std::vector<std::string> behavior_names;
  std::vector<TaskId> task_ids;
  std::vector<BehaviorId> behavior_ids;
  std::vector<std::vector<Parameter>> task_parameters;  ///< declared ones, as scripts may give them

  // By group, in the order of their first task.
  std::vector<std::uint32_t> group_tasks;      ///< first TaskId of each group, and the end
  std::vector<std::uint32_t> group_behaviors;  ///< first BehaviorId of each group, and the end
  std::vector<ConstraintCount> group_constraints;

  // By task.
  std::vector<CompiledTask> tasks;
  Rows<Value> values;
  std::vector<TaskId> value_tasks;   ///< by value
  std::vector<std::uint32_t> words;  ///< first domain word of each task, and the end
  Rows<Arc> arcs;                    ///< to what its behaviors require
  Rows<std::uint32_t> incoming;      ///< places in arcs.items of the arcs that end here
  Rows<std::uint32_t> task_cliques;

  // By behavior.
  std::vector<CompiledBehavior> behaviors;
  Rows<CompiledRequirement> requirements;  ///< distinct tasks, the strongest minimum of each
  Rows<ValueId> performs;                  ///< its values

  Rows<TaskId> cliques;                     ///< distinct tasks of which at most one runs
  std::vector<std::uint32_t> clique_lines;  ///< by clique: of its (first) list
  std::vector<std::uint64_t> masks;

  [[nodiscard]] std::size_t group_count() const { return group_constraints.size(); }
  [[nodiscard]] const std::string& name_of_task(TaskId task) const {
    return task_names[tasks[task].catalog_index];
  }
  [[nodiscard]] const std::string& name_of_behavior(BehaviorId behavior) const {
    return behavior_names[behaviors[behavior].catalog_index];
  }
  /// The task that a value is of.
  [[nodiscard]] TaskId task_of(ValueId value) const { return value_tasks[value]; }
  /// The group of a behavior, which is that of all its tasks.
  [[nodiscard]] std::uint32_t group_of(BehaviorId behavior) const {
    return tasks[task_of(performs[behavior].front())].group;
  }
};

/// Size of the largest group, by the first items of the groups and the end (group_tasks or
/// group_behaviors).
[[nodiscard]] inline std::size_t most_in_a_group(const std::vector<std::uint32_t>& begin) {
  std::size_t most = 0;
  for (std::size_t group = 0; group + 1 < begin.size(); ++group) {
    most = std::max<std::size_t>(most, begin[group + 1] - begin[group]);
  }
  return most;
}

/// Number of values in the group that has most of them.
[[nodiscard]] inline std::size_t most_values_in_a_group(const CompiledCatalog& catalog) {
  std::size_t most = 0;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    const std::uint32_t end = catalog.values.begin[catalog.group_tasks[group + 1]];
    most = std::max<std::size_t>(most, end - catalog.values.begin[catalog.group_tasks[group]]);
  }
  return most;
}

}  // namespace cbc
