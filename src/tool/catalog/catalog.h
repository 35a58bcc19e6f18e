#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text.h"
#include "cbc/units.h"
#include "diagnostic/diagnostic.h"

namespace cbc {

/// Place of a task in Catalog::tasks, of a behavior in Catalog::behaviors ("catalog order").
using TaskIndex = std::uint32_t;
using BehaviorIndex = std::uint32_t;

enum class ExecutionGoal : std::uint8_t { achieve_goal, keep_running };

/// A task parameter and what it may be set to.
struct Parameter {
  std::string name;
  std::vector<std::string> allowed_values;  ///< texts of the list, or of the single type name
  bool allowed_is_list = false;             ///< a list ([0, 30], [LEFT, RIGHT]), not a type name
  Range allowed_range;                      ///< of the first of them
  Range range;                              ///< of the name
  std::optional<Range> entry;  ///< where its entry begins, if it says no more than this
};

/// A variable of the constraint problem: what can be done.
struct Task {
  std::string name;
  Range range;              ///< of the name, where the task first appears
  bool implicit = false;    ///< named by a behavior only, without an entry of its own
  bool is_unclear = false;  ///< what it is like could not be read, so it is not to be judged
  ExecutionGoal execution_goal = ExecutionGoal::achieve_goal;
  bool start_on_request = true;
  bool reactive_start = false;
  std::optional<Microseconds> timeout;
  std::optional<Range> own_timeout_range;  ///< of a timeout that is not a default
  Millionths minimum_performance = 0;      ///< 0: none
  Range minimum_performance_range;
  std::vector<Parameter> parameters;
};

/// A task that a behavior can perform, and how well: sigma(b, x).
struct Performance {
  TaskIndex task = 0;
  Millionths suitability = one_million;
  std::optional<Range> suitability_range;  ///< where the file says so
  Range range;                             ///< of the task name
};

/// (b, t, k): where behavior b is assigned, t runs with at least performance k.
struct Requirement {
  TaskIndex task = 0;
  Millionths minimum_performance = 0;  ///< 0: none
  Range minimum_performance_range;
  Range range;                 ///< of the task name
  std::optional<Range> entry;  ///< where its entry begins, if it says no more than this
};

/// A value of the constraint problem: how something is done.
struct Behavior {
  std::string name;
  Range range;
  std::string package;
  std::optional<Microseconds> timeout;
  Range timeout_range;
  std::vector<Performance> performs;      ///< at least one; tasks differ
  std::vector<Requirement> requirements;  ///< in the order of the file; a task may stand twice
};

/// Tasks of which at most one runs.
struct ExclusivityList {
  std::vector<TaskIndex> tasks;  ///< in the order of the file; a task may stand twice
  std::vector<Range> ranges;     ///< of each name
  Range range;
  std::optional<Range> entry;  ///< where its entry begins, if it says no more than this
  bool is_complete = true;     ///< false: names that could not be understood are left out
};

/// A catalog as it was written, understood and checked: names resolved, defaults filled in.
struct Catalog {
  std::string file;
  bool has_task_section = false;
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<ExclusivityList> exclusivity;
};

/// What a behavior is called in messages; its name may be missing in the file.
[[nodiscard]] inline std::string describe(const Behavior& behavior) {
  return behavior.name.empty() ? "a behavior" : "behavior " + quote(behavior.name);
}

}  // namespace cbc
