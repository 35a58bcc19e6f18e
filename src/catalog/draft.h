#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "catalog/catalog.h"
#include "cbc/diagnostic.h"
#include "cbc/units.h"
#include "diagnostic/reporter.h"
#include "yaml/document.h"

/// A catalog as it stands in the file: entry by entry, names not resolved, defaults not applied.
/// The texts are views of the document.
namespace cbc::draft {

struct Name {
  std::string_view text;
  Range range;
};

struct Flag {
  bool value = false;
  Range range;
};

struct TaskAttributes {
  std::optional<ExecutionGoal> execution_goal;
  std::optional<Flag> start_on_request;
  std::optional<Flag> reactive_start;
  std::optional<Microseconds> timeout;
};

struct Task {
  Name name;
  TaskAttributes attributes;
  Millionths minimum_performance = 0;
  Range minimum_performance_range;
  std::vector<Parameter> parameters;
};

struct Performance {
  Name task;
  std::optional<Millionths> suitability;
};

struct Requirement {
  Name task;
  Millionths minimum_performance = 0;
};

struct Behavior {
  Name name;  ///< empty if it is missing
  std::optional<std::string_view> package;
  std::optional<Microseconds> timeout;
  std::optional<Millionths> suitability;
  std::vector<Performance> performs;
  std::vector<Requirement> requirements;
};

struct ExclusivityList {
  std::vector<Name> tasks;
  Range range;
};

struct Catalog {
  TaskAttributes task_defaults;
  std::optional<std::string_view> default_package;
  std::optional<Millionths> default_suitability;
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<ExclusivityList> exclusivity;
  /// A section that defines tasks could not be read at all, so unknown tasks say nothing.
  bool lacks_a_section = false;
  /// Entries that define tasks of which the names could not be read.
  std::size_t nameless_tasks = 0;
};

/// Reads what stands in the file and reports what is wrong with it, entry by entry.
[[nodiscard]] Catalog read(const yaml::Node& root, Reporter& reporter);

}  // namespace cbc::draft
