#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "catalog/catalog.h"
#include "cbc/units.h"
#include "diagnostic/diagnostic.h"
#include "yaml/document.h"

/// A catalog as it stands in the file: entry by entry, names not resolved, defaults not applied.
/// The texts are views of the document.
namespace cbc::draft {

struct Name {
  std::string_view text;
  Range range;
};

/// A value and where it stands.
template <typename T>
struct Placed {
  T value{};
  Range range;
};
using Flag = Placed<bool>;
using Percent = Placed<Millionths>;
using Timeout = Placed<Microseconds>;

struct TaskAttributes {
  std::optional<ExecutionGoal> execution_goal;
  std::optional<Flag> start_on_request;
  std::optional<Flag> reactive_start;
  std::optional<Timeout> timeout;
  bool is_unclear = false;  ///< one of them could not be read
};

struct Task {
  Name name;
  TaskAttributes attributes;
  Percent minimum_performance;  ///< 0: none
  std::vector<Parameter> parameters;
  std::optional<Range> entry;  ///< where it begins, if it says no more than this
};

struct Performance {
  Name task;
  std::optional<Percent> suitability;
};

struct Requirement {
  Name task;
  Percent minimum_performance;  ///< 0: none
  std::optional<Range> entry;   ///< where it begins, if it says no more than this
};

struct Behavior {
  Name name;  ///< empty if it is missing
  std::optional<std::string_view> package;
  std::optional<Timeout> timeout;
  std::optional<Percent> suitability;
  std::vector<Performance> performs;
  std::vector<Requirement> requirements;
};

struct ExclusivityList {
  std::vector<Name> tasks;
  Range range;
  std::optional<Range> entry;  ///< where it begins, if it says no more than this
  bool is_complete = true;     ///< false: names that could not be read are left out
};

struct Catalog {
  TaskAttributes task_defaults;
  std::optional<std::string_view> default_package;
  std::optional<Percent> default_suitability;
  bool has_task_section = false;
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<ExclusivityList> exclusivity;
  /// A section that defines tasks could not be read, or not as a whole, so unknown tasks say
  /// nothing.
  bool lacks_a_section = false;
  /// Entries that define tasks of which the names could not be read.
  std::size_t nameless_tasks = 0;
  /// Errors in values that no other entry depends on: flags, timeouts, percentages, parameters.
  std::size_t value_errors = 0;
};

/// Reads what stands in the file and reports what is wrong with it, entry by entry.
[[nodiscard]] Catalog read(const yaml::Node& root, Reporter& reporter);

}  // namespace cbc::draft

namespace cbc {

/// Whether two catalogs say the same, wherever it stands in their files: the same tasks and
/// behaviors in the same order with the same attributes, requirements that ask for the same, and
/// lists that exclude the same. Lists count only for the pairs of tasks that they exclude; equal
/// entries of a parameter one after another count as one.
[[nodiscard]] bool same_meaning(const Catalog& a, const Catalog& b);

/// Finds exclusivity lists that two tasks share. Each pair is looked up once, in the lists of the
/// task that has fewer, so that no catalog makes it quadratic.
class Exclusions {
 public:
  explicit Exclusions(const Catalog& catalog);

  /// Places in Catalog::exclusivity of the lists that have a task, ascending.
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

/// A behavior that performs `task`, and one of its requirements.
struct CycleStep {
  TaskIndex task = 0;
  BehaviorIndex behavior = 0;
  std::size_t requirement = 0;  ///< place in Behavior::requirements
};

/// Tasks that require themselves in the end: each step's requirement is the task of the next step,
/// and that of the last step the task of the first.
using Cycle = std::vector<CycleStep>;

/// A shortest cycle for each set of tasks that require one another, in catalog order of its first
/// task. In sets so large that the search for the shortest takes too long it is a short one.
[[nodiscard]] std::vector<Cycle> find_requirement_cycles(const Catalog& catalog);

/// Reports each set of tasks that require one another, by one shortest cycle.
void check_requirement_cycles(const Catalog& catalog, Reporter& reporter);

/// Reports each requirement of a task that excludes all the tasks of its behavior.
void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter);

}  // namespace cbc
