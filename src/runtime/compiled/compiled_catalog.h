#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "cbc/units.h"

namespace cbc {

/// -ln(degree / 10^6) in units of 2^-40, for degree in [1, 10^6]; 0 for degree 0 (which callers
/// treat apart).
///
/// It is built from the rounded logarithms of the prime factors, so equal products of degrees have
/// equal sums of costs, to the bit; sums of different products that are further apart than
/// log_cost_error for each factor other than 1 are in the right order. What is closer is decided
/// by exact products.
[[nodiscard]] std::int64_t log_cost(Millionths degree);

/// Bound on the error of one log_cost: at most 19 + 12 prime factors, each half a unit off.
inline constexpr std::int64_t log_cost_error = 16;

/// log_cost with a small memory: catalogs have few different degrees.
class KnownCosts {
 public:
  std::int64_t of(Millionths degree) {
    Entry& entry = entries_[(degree * 2654435769U) >> 24U];
    if (entry.degree != degree) entry = {degree, log_cost(degree)};
    return entry.cost;
  }

 private:
  struct Entry {
    Millionths degree = 0;  ///< what is not known yet says what is true of 0
    std::int64_t cost = 0;
  };
  std::array<Entry, 256> entries_{};
};

/// Place of a task, a behavior in a compiled catalog: group by group, and within a group in catalog
/// order, so that all that one event touches lies side by side.
using TaskId = std::uint32_t;
using BehaviorId = std::uint32_t;
/// Place of a (task, behavior) pair in CompiledCatalog::values.
using ValueId = std::uint32_t;
/// Place of a text in CompiledCatalog::texts.
using TextId = std::uint32_t;

inline constexpr std::uint32_t none = UINT32_MAX;

/// Rows of different lengths in one array: row i is items[begin[i]] up to items[begin[i + 1]].
template <typename T>
struct Rows {
  std::span<const std::uint32_t> begin;
  std::span<const T> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    return {items.data() + begin[row], items.data() + begin[row + 1]};
  }
};

/// Texts in one array of characters.
class Texts {
 public:
  Texts() = default;
  explicit Texts(const Rows<char>& rows) : rows_(rows) {}

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::string_view operator[](std::size_t place) const {
    const std::span<const char> row = rows_[place];
    return {row.data(), row.size()};
  }
  [[nodiscard]] const Rows<char>& rows() const { return rows_; }

  class Iterator {
   public:
    Iterator(const Texts& texts, std::size_t place) : texts_(&texts), place_(place) {}
    std::string_view operator*() const { return (*texts_)[place_]; }
    Iterator& operator++() {
      ++place_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return place_ == other.place_; }

   private:
    const Texts* texts_;
    std::size_t place_;
  };
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }
  /// `count` of them from `first` on.
  [[nodiscard]] Texts part(std::size_t first, std::size_t count) const {
    return Texts({rows_.begin.subspan(first, count + 1), rows_.items});
  }

 private:
  Rows<char> rows_;
};

// The structs below stand in compiled files as they are here; flags are 0 or 1.

struct CompiledTask {
  std::uint32_t catalog_index = 0;
  std::uint32_t group = 0;
  std::uint32_t level = 0;             ///< highest level of its behaviors
  Millionths minimum_performance = 0;  ///< 0: none
  std::int64_t minimum_cost = 0;       ///< log_cost(minimum_performance)
  Microseconds timeout = 0;            ///< 0: none
  std::uint32_t minimum_line = 0;      ///< of minimum_performance
  std::uint8_t start_on_request = 1;
  std::uint8_t reactive_start = 0;
  std::uint8_t keep_running = 0;
  std::uint8_t has_performance_rules = 0;  ///< a minimum, or a behavior that requires one
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
};

/// An edge of the requirement graph: some values of the source task require the target.
struct Arc {
  TaskId source = 0;
  TaskId target = 0;
  std::uint32_t mask = 0;  ///< first word, in CompiledCatalog::masks, of the values that require it
};

/// A parameter that a task declares, and what it may be set to.
struct CompiledParameter {
  TextId name = 0;
  std::uint32_t allowed_is_list = 0;  ///< a list ([0, 30], [LEFT, RIGHT]), not a type name
  std::uint32_t first_allowed = 0;    ///< in CompiledCatalog::allowed_values
  std::uint32_t allowed_count = 0;
};

/// Everything about a catalog that does not depend on the situation, in flat arrays that the
/// solver uses in place. They lie in memory that copies of this object share.
struct CompiledCatalog {
  std::shared_ptr<const void> storage;

  /// The names of the tasks in catalog order, those of the behaviors, the source as it was named,
  /// and then others.
  Texts texts;
  std::string_view file;  ///< the source

  // In catalog order.
  Texts task_names;
  Texts behavior_names;
  std::span<const TaskId> task_ids;
  std::span<const BehaviorId> behavior_ids;
  std::span<const TextId> behavior_packages;
  Rows<CompiledParameter> parameters;  ///< by task: those that it declares
  std::span<const TextId> allowed_values;

  // Places in the catalog, sorted by name (as bytes).
  std::span<const std::uint32_t> tasks_by_name;
  std::span<const std::uint32_t> behaviors_by_name;

  // By group, in the order of their first task.
  std::span<const std::uint32_t> group_tasks;      ///< first TaskId of each group, and the end
  std::span<const std::uint32_t> group_behaviors;  ///< first BehaviorId of each group, and the end
  /// The tasks, each after those that its behaviors require: by group, level and TaskId.
  std::span<const TaskId> topological_order;

  // By task.
  std::span<const CompiledTask> tasks;
  Rows<Value> values;
  std::span<const TaskId> value_tasks;   ///< by value
  std::span<const std::uint32_t> words;  ///< first domain word of each task, and the end
  Rows<Arc> arcs;                        ///< to what its behaviors require
  Rows<std::uint32_t> incoming;          ///< places in arcs.items of the arcs that end here
  Rows<std::uint32_t> task_cliques;

  // By behavior.
  std::span<const CompiledBehavior> behaviors;
  Rows<CompiledRequirement> requirements;  ///< distinct tasks, the strongest minimum of each
  std::span<const std::uint32_t> requirement_lines;  ///< by place in requirements.items
  Rows<ValueId> performs;                            ///< its values

  Rows<TaskId> cliques;                         ///< distinct tasks of which at most one runs
  std::span<const std::uint32_t> clique_lines;  ///< by clique: of its (first) list
  std::span<const std::uint64_t> masks;

  [[nodiscard]] std::size_t group_count() const { return group_tasks.size() - 1; }
  [[nodiscard]] std::string_view name_of_task(TaskId task) const {
    return task_names[tasks[task].catalog_index];
  }
  [[nodiscard]] std::string_view name_of_behavior(BehaviorId behavior) const {
    return behavior_names[behaviors[behavior].catalog_index];
  }
  /// Place in the catalog of the task, the behavior with this name.
  [[nodiscard]] std::optional<std::uint32_t> find_task(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(std::string_view name) const;

  /// The task that a value is of.
  [[nodiscard]] TaskId task_of(ValueId value) const { return value_tasks[value]; }
  /// The group of a behavior, which is that of all its tasks.
  [[nodiscard]] std::uint32_t group_of(BehaviorId behavior) const {
    return tasks[task_of(performs[behavior].front())].group;
  }
  /// The line of the source that says so. `requirement` is one of requirements.
  [[nodiscard]] std::uint32_t line_of(const CompiledRequirement& requirement) const {
    return requirement_lines[static_cast<std::size_t>(&requirement - requirements.items.data())];
  }
};

/// Size of the largest group, by the first items of the groups and the end (group_tasks or
/// group_behaviors).
[[nodiscard]] inline std::size_t most_in_a_group(std::span<const std::uint32_t> begin) {
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
