#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/catalog.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"

/// The keys of each kind of mapping in a catalog.
namespace cbc::shape {

extern const yaml::Shape catalog;
extern const yaml::Shape default_values;
extern const yaml::Shape task_defaults;
extern const yaml::Shape behavior_defaults;
extern const yaml::Shape behavior;
extern const yaml::Shape performance;
extern const yaml::Shape requirement;
extern const yaml::Shape task;
extern const yaml::Shape parameter;
extern const yaml::Shape exclusivity_list;
extern const yaml::Shape variable;

}  // namespace cbc::shape

/// How catalogs are told from other YAML files, and those of an older format that is not supported.
namespace cbc {

/// Whether a file is a catalog: it has the key `behaviors`, or two other sections of a catalog with
/// values of the right kinds, or is one of the older format.
[[nodiscard]] bool is_catalog(const yaml::Node& root);

/// Whether a file would be a catalog but for misspelt keys.
[[nodiscard]] bool resembles_catalog(const yaml::Node& root);

/// The key that shows that a catalog has the format with capabilities, which is older than tasks.
/// Null if it does not.
[[nodiscard]] const yaml::Node* find_older_format(const yaml::Node& root);

}  // namespace cbc

/// A catalog as it stands in the file: entry by entry, without names resolved or defaults applied.
/// Only the reader of catalogs uses it. The texts are views of the document.
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
  std::optional<Range> entry;  ///< where it begins, if all of it was understood
};

struct Performance {
  Name task;
  std::optional<Percent> suitability;
};

struct Requirement {
  Name task;
  Percent minimum_performance;  ///< 0: none
  std::optional<Range> entry;   ///< where it begins, if all of it was understood
};

struct Behavior {
  Name name;  ///< empty if it is missing
  std::optional<std::string_view> package;
  std::optional<Timeout> timeout;
  std::optional<Percent> suitability;
  std::vector<Performance> performs;
  std::vector<Requirement> requirements;
  const yaml::Node* situation = nullptr;  ///< null: it fits always
};

struct ExclusivityList {
  std::vector<Name> tasks;
  Range range;
  std::optional<Range> entry;  ///< where it begins, if all of it was understood
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
  const yaml::Node* situation = nullptr;  ///< the section; null: there is none
  /// A section that defines tasks could not be read completely, so a task without a definition is
  /// no finding.
  bool lacks_a_section = false;
  /// Entries that define tasks whose names could not be read.
  std::size_t nameless_tasks = 0;
  /// Errors in values that no other entry depends on: flags, timeouts, percentages, parameters.
  std::size_t value_errors = 0;
};

/// The number of errors that left something of the file out. Where a key is unknown, the rest is
/// understood as if it were not there.
[[nodiscard]] std::size_t hiding_errors(const Reporter& reporter);

/// Reads the entries of a file, and reports what is wrong with each.
[[nodiscard]] Catalog read(const yaml::Node& root, Reporter& reporter);

}  // namespace cbc::draft
