#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "cbc/units.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/base/text.h"
#include "runtime/compiled/task_rules.h"

/// A catalog that was read from YAML, and questions about it as a whole.
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
  std::optional<Range> entry;               ///< where its entry begins, if all of it was understood
};

/// A variable of the constraint problem: what can be done.
struct Task {
  std::string name;
  Range range;              ///< of the name, where the task first appears
  bool implicit = false;    ///< named by a behavior only, without an entry of its own
  bool is_unclear = false;  ///< an attribute could not be read, so checks leave it out
  ExecutionGoal execution_goal = ExecutionGoal::achieve_goal;
  bool start_on_request = true;
  bool reactive_start = false;
  std::optional<Microseconds> timeout;
  std::optional<Range> own_timeout_range;  ///< of a timeout that is not a default
  Millionths minimum_performance = 0;      ///< 0: none
  Range minimum_performance_range;
  TaskRules rules;
  std::optional<Range> own_resume_range;   ///< of a resume that is not a default
  std::optional<Range> own_improve_range;  ///< of an improve that is not a default
  Range improve_range;                     ///< of any
  Range reactive_priority_range;
  std::vector<Parameter> parameters;
};

/// A task that a behavior can perform, and how well; see docs/semantics.md, "Tasks and behaviors".
struct Performance {
  TaskIndex task = 0;
  Millionths suitability = one_million;
  std::optional<Range> suitability_range;  ///< where the file says so
  Range range;                             ///< of the task name
};

/// While the behavior is active, `task` runs with at least this performance; see docs/semantics.md,
/// "Requirements".
struct Requirement {
  TaskIndex task = 0;
  Millionths minimum_performance = 0;  ///< 0: none
  Range minimum_performance_range;
  Range range;                 ///< of the task name
  std::optional<Range> entry;  ///< where its entry begins, if all of it was understood
};

/// A part of the situation that behaviors share; see docs/semantics.md, "Situation variables".
struct Variable {
  std::string name;
  Range range;
  bool is_boolean = false;          ///< declared without values: they are "true" and "false"
  std::vector<std::string> values;  ///< at least two; the first one is the initial one
};

/// Values of a variable in which a behavior fits.
struct Condition {
  std::uint32_t variable = 0;         ///< place in Catalog::variables
  std::vector<std::uint32_t> values;  ///< places in its values, ascending
  Range range;                        ///< of the name of the variable
};

/// A value of the constraint problem: how something is done.
struct Behavior {
  std::string name;
  Range range;
  std::string package;
  std::optional<Microseconds> timeout;
  Range timeout_range;
  Retry retry = Retry::at_events;
  Range retry_range;
  std::vector<Performance> performs;      ///< at least one; tasks differ
  std::vector<Requirement> requirements;  ///< in the order of the file; a task may stand twice
  std::vector<Condition> situation;       ///< one for each variable that it names
  std::optional<Range> situation_range;   ///< from the first to the last, if there are any
};

/// Tasks of which at most one runs at a time, or at most so many.
struct ExclusivityList {
  std::uint32_t at_most = 1;
  Range at_most_range;
  std::vector<TaskIndex> tasks;  ///< in the order of the file; a task may stand twice
  std::vector<Range> ranges;     ///< of each name
  Range range;
  std::optional<Range> entry;  ///< where its entry begins, if all of it was understood
  bool is_complete = true;     ///< false: names that could not be understood are left out
};

/// A catalog as it was written, understood and checked: names resolved, defaults filled in.
struct Catalog {
  std::string file;
  bool has_task_section = false;
  bool gives_goals = false;  ///< an execution_goal is given, for a task or by default
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<ExclusivityList> exclusivity;
  std::vector<Variable> variables;
};

/// What a behavior is called in messages; its name may be missing in the file.
[[nodiscard]] inline std::string describe(const Behavior& behavior) {
  return behavior.name.empty() ? "a behavior" : "behavior " + quote(behavior.name);
}

/// What a behavior requires of a task, which it requires: of several entries the first of the
/// strongest.
[[nodiscard]] const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task);

/// Whether two parameters may be set to the same.
[[nodiscard]] inline bool allow_the_same(const Parameter& a, const Parameter& b) {
  return a.allowed_values == b.allowed_values && a.allowed_is_list == b.allowed_is_list;
}

/// The tasks of a list, each once, ascending.
[[nodiscard]] std::vector<TaskIndex> distinct_tasks(const ExclusivityList& list);

/// Whether two catalogs have the same meaning: the same tasks and behaviors in the same order with
/// the same attributes, requirements that ask for the same, and lists that exclude the same. Lists
/// count only for the pairs of tasks that they exclude; equal entries of a parameter one after
/// another count as one.
[[nodiscard]] bool same_meaning(const Catalog& a, const Catalog& b);

/// Finds exclusivity lists by which two tasks exclude each other. Each pair is looked up once, in
/// the lists of the task that has fewer, so that no catalog makes it quadratic.
class Exclusions {
 public:
  explicit Exclusions(const Catalog& catalog);

  /// Places in Catalog::exclusivity of the lists that have a task and let one task run, ascending.
  [[nodiscard]] const std::vector<std::size_t>& lists_of(TaskIndex task) const {
    return lists_[task];
  }

  /// Place in Catalog::exclusivity of the first list that has both tasks.
  [[nodiscard]] std::optional<std::size_t> find(TaskIndex a, TaskIndex b);

  /// A list that excludes `task` from the first of the behavior's tasks, if there are such lists
  /// for all of them; so a behavior that requires the task is never active.
  [[nodiscard]] std::optional<std::size_t> find_for_all(const Behavior& behavior, TaskIndex task);

 private:
  std::vector<std::vector<std::size_t>> lists_;  // of each task, ascending
  std::unordered_map<std::uint64_t, std::optional<std::size_t>> known_;
};

/// Reports each set of tasks that require one another, by a shortest cycle through the first one.
void check_requirement_cycles(const Catalog& catalog, Reporter& reporter);

/// By behavior and requirement, whether the requirement is part of a cycle.
[[nodiscard]] std::vector<std::vector<bool>> requirements_in_cycles(const Catalog& catalog);

/// Reports each requirement of a task that excludes all the tasks of its behavior.
void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter);

}  // namespace cbc
