#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "cbc/event.h"
#include "cbc/units.h"
#include "runtime/base/id.h"
#include "runtime/compiled/task_rules.h"

/// A catalog as the solver, the coordinator and all reports use it: flat arrays of numbers, which
/// stand in compiled files as they are in memory. Their meaning: docs/semantics.md, "Catalog".
namespace cbc {

/// Number of a task or a behavior in a compiled catalog: group by group, and within a group in
/// catalog order, so that everything that one event touches lies side by side.
using TaskId = Id<struct KindOfTask>;
using BehaviorId = Id<struct KindOfBehavior>;
/// Place of a (task, behavior) pair in CompiledCatalog::values.
using ValueId = Id<struct KindOfValue>;
/// Number of a group, in the order of their first task.
using GroupId = Id<struct KindOfGroup>;
/// Place of a task among those of its group.
using LocalTask = Id<struct KindOfLocalTask>;
/// Place of a text in CompiledCatalog::texts.
using TextId = std::uint32_t;

[[nodiscard]] constexpr TaskId operator+(TaskId first, LocalTask task) {
  return TaskId(std::uint32_t{first} + std::uint32_t{task});
}
[[nodiscard]] constexpr LocalTask operator-(TaskId task, TaskId first) {
  return LocalTask(std::uint32_t{task} - std::uint32_t{first});
}

/// Rows of different lengths in one array: row i is items[begin[i]] up to items[begin[i + 1]]. Rows
/// of characters are texts.
template <typename T>
struct Rows {
  using Row = std::conditional_t<std::is_same_v<T, char>, std::string_view, std::span<const T>>;

  std::span<const std::uint32_t> begin;
  std::span<const T> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] Row operator[](std::size_t row) const {
    return Row(items.data() + begin[row], begin[row + 1] - begin[row]);
  }
};

/// Some texts that lie side by side among others.
class Texts {
 public:
  Texts() = default;
  Texts(const Rows<char>& rows, std::size_t first, std::size_t count)
      : rows_(rows), first_(first), count_(count) {}

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::string_view operator[](std::size_t place) const {
    return rows_[first_ + place];
  }

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

 private:
  Rows<char> rows_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

// The structs below stand in compiled files as they are here; flags are 0 or 1.

struct CompiledTask {
  std::uint32_t catalog_index = 0;
  GroupId group;
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
  BehaviorId behavior;
  Millionths suitability = 0;
  std::int64_t cost = 0;  ///< log_cost(suitability)
};

struct CompiledRequirement {
  TaskId task;
  Millionths minimum_performance = 0;  ///< 0: none
  std::int64_t minimum_cost = 0;       ///< log_cost(minimum_performance)
};

/// An edge of the requirement graph: some values of the source task require the target.
struct Arc {
  TaskId source;
  TaskId target;
  std::uint32_t mask = 0;  ///< first word, in CompiledCatalog::masks, of the values that require it
};

/// A parameter that a task declares, and what it may be set to.
struct CompiledParameter {
  TextId name = 0;
  std::uint32_t allowed_is_list = 0;  ///< a list ([0, 30], [LEFT, RIGHT]), not a type name
  std::uint32_t first_allowed = 0;    ///< in CompiledCatalog::allowed_values
  std::uint32_t allowed_count = 0;
};

/// A situation variable. Its first value is the initial one.
struct CompiledVariable {
  TextId name = 0;
  std::uint32_t is_boolean = 0;   ///< declared without values: they are "true" and "false"
  std::uint32_t first_value = 0;  ///< in CompiledCatalog::variable_values
  std::uint32_t value_count = 0;
};

/// That a behavior fits where a variable has a value. Values of the same variable are alternatives;
/// a behavior fits if each variable that it names has one of them.
struct FittingValue {
  BehaviorId behavior;
  std::uint32_t variable = 0;
  std::uint32_t value = 0;  ///< counts the values of the variable

  [[nodiscard]] auto operator<=>(const FittingValue&) const = default;
};

/// Tasks of which at most so many run at a time, two or more; those of which one runs are cliques.
struct CompiledLimit {
  std::uint32_t most = 0;
  std::uint32_t line = 0;  ///< of its list
};

/// The arrays of a catalog: views of arrays in CompiledCatalog, vectors in GrowingCatalog. Most of
/// them follow from the others; see compiled/derive.h.
template <template <typename> class List, template <typename> class ListOfRows>
struct CatalogArrays {
  /// The names of the tasks in catalog order, those of the behaviors, the source as it was named,
  /// and then others.
  ListOfRows<char> texts;

  // In catalog order.
  List<TaskId> task_ids;
  List<BehaviorId> behavior_ids;
  List<TextId> behavior_packages;
  ListOfRows<CompiledParameter> parameters;  ///< by task: those that it declares
  List<TextId> allowed_values;

  // Places in the catalog, sorted by name (as bytes).
  List<std::uint32_t> tasks_by_name;
  List<std::uint32_t> behaviors_by_name;

  // By group (docs/semantics.md, "Groups"), in the order of their first task.
  List<TaskId> group_tasks;          ///< first TaskId of each group, and the end
  List<BehaviorId> group_behaviors;  ///< first BehaviorId of each group, and the end
  /// The tasks, each after those that its behaviors require: by group, level and TaskId.
  List<TaskId> topological_order;

  // By task.
  List<CompiledTask> tasks;
  ListOfRows<Value> values;
  List<TaskId> value_tasks;            ///< by value
  List<std::uint32_t> words;           ///< first domain word of each task, and the end
  ListOfRows<Arc> arcs;                ///< to what its behaviors require
  ListOfRows<std::uint32_t> incoming;  ///< places in arcs.items of the arcs that end here
  ListOfRows<std::uint32_t> task_cliques;

  // By behavior.
  List<CompiledBehavior> behaviors;
  ListOfRows<CompiledRequirement> requirements;  ///< distinct tasks, the strongest minimum of each
  List<std::uint32_t> requirement_lines;         ///< by place in requirements.items
  ListOfRows<ValueId> performs;                  ///< its values

  ListOfRows<TaskId> cliques;        ///< distinct tasks of which at most one runs
  List<std::uint32_t> clique_lines;  ///< by clique: of its (first) list
  List<std::uint64_t> masks;

  // Situation variables, in catalog order.
  List<CompiledVariable> variables;
  List<TextId> variable_values;
  List<FittingValue> fitting_values;  ///< ascending

  List<TaskRules> task_rules;         ///< by task; empty if all are as in TaskRules
  List<Retry> retries;                ///< by behavior; empty if all are at_events
  List<std::uint32_t> improve_lines;  ///< by task, where there are rules: that of its `improve`
  List<std::uint32_t> retry_lines;    ///< by behavior, where there are retries
  List<CompiledLimit> limits;
  ListOfRows<TaskId> limited;             ///< by limit: its tasks
  ListOfRows<std::uint32_t> task_limits;  ///< by task: the limits that it is in
};

/// References to all arrays, in the order of compiled files: of rows the items, and then the
/// begins.
template <typename Catalog>
[[nodiscard]] auto arrays_of(Catalog& catalog) {
  return std::tie(catalog.texts.items, catalog.texts.begin, catalog.task_ids, catalog.behavior_ids,
                  catalog.behavior_packages, catalog.parameters.items, catalog.parameters.begin,
                  catalog.allowed_values, catalog.tasks_by_name, catalog.behaviors_by_name,
                  catalog.group_tasks, catalog.group_behaviors, catalog.topological_order,
                  catalog.tasks, catalog.values.items, catalog.values.begin, catalog.value_tasks,
                  catalog.words, catalog.arcs.items, catalog.arcs.begin, catalog.incoming.items,
                  catalog.incoming.begin, catalog.task_cliques.items, catalog.task_cliques.begin,
                  catalog.behaviors, catalog.requirements.items, catalog.requirements.begin,
                  catalog.requirement_lines, catalog.performs.items, catalog.performs.begin,
                  catalog.cliques.items, catalog.cliques.begin, catalog.clique_lines, catalog.masks,
                  catalog.variables, catalog.variable_values, catalog.fitting_values,
                  catalog.task_rules, catalog.retries, catalog.improve_lines, catalog.retry_lines,
                  catalog.limits, catalog.limited.items, catalog.limited.begin,
                  catalog.task_limits.items, catalog.task_limits.begin);
}

template <typename T>
using View = std::span<const T>;

/// Everything about a catalog that does not depend on the situation, in flat arrays that the
/// solver uses in place. They lie in memory that copies of this object share.
struct CompiledCatalog : CatalogArrays<View, Rows> {
  std::shared_ptr<const void> storage;

  // Some of the texts.
  std::string_view file;  ///< the source
  Texts task_names;       ///< in catalog order
  Texts behavior_names;

  /// Finds the names and the source among the texts; done when all arrays are there.
  void set_names() {
    task_names = Texts(texts, 0, tasks.size());
    behavior_names = Texts(texts, tasks.size(), behaviors.size());
    file = texts[tasks.size() + behaviors.size()];
  }

  /// Whether the catalog has one of the keys that tasks, behaviors and lists need not have.
  [[nodiscard]] bool has_further_keys() const {
    return !task_rules.empty() || !retries.empty() || !limits.empty();
  }
  [[nodiscard]] TaskRules rules_of(TaskId task) const {
    return task_rules.empty() ? TaskRules() : task_rules[task];
  }
  [[nodiscard]] Retry retry_of(BehaviorId behavior) const {
    return retries.empty() ? Retry::at_events : retries[behavior];
  }
  /// The limits that a task is in.
  [[nodiscard]] std::span<const std::uint32_t> limits_of(TaskId task) const {
    return limits.empty() ? std::span<const std::uint32_t>() : task_limits[task];
  }

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

  [[nodiscard]] std::string_view name_of_variable(std::uint32_t variable) const {
    return texts[variables[variable].name];
  }
  [[nodiscard]] std::string_view name_of_value(VariableValue value) const {
    return texts[variable_values[variables[value.variable].first_value + value.value]];
  }
  /// The situation variable with this name; its value with this text. They take time proportional
  /// to the number of variables, of values.
  [[nodiscard]] std::optional<std::uint32_t> find_variable(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> find_value(std::uint32_t variable,
                                                        std::string_view text) const;
  /// The values in which a behavior fits; those of one variable lie side by side.
  [[nodiscard]] std::span<const FittingValue> fitting_values_of(BehaviorId behavior) const;
  /// The first variable that a behavior names and whose value is none that it names; none if the
  /// behavior fits. `present`: the values of the variables.
  [[nodiscard]] std::optional<std::uint32_t> find_misfit(
      BehaviorId behavior, std::span<const std::uint32_t> present) const {
    return find_misfit(fitting_values_of(behavior), present);
  }
  /// The same for the values in which a behavior fits.
  [[nodiscard]] static std::optional<std::uint32_t> find_misfit(
      std::span<const FittingValue> fitting, std::span<const std::uint32_t> present);

  /// The task that a value is of.
  [[nodiscard]] TaskId task_of(ValueId value) const { return value_tasks[value]; }
  /// Whether a behavior performs a task, however well.
  [[nodiscard]] bool can_perform(BehaviorId behavior, TaskId task) const;
  /// The group of a behavior, which is that of all its tasks.
  [[nodiscard]] GroupId group_of(BehaviorId behavior) const {
    return tasks[task_of(performs[behavior].front())].group;
  }
  /// The line of the source that says so. `requirement` is one of requirements.
  [[nodiscard]] std::uint32_t line_of(const CompiledRequirement& requirement) const {
    return requirement_lines[static_cast<std::size_t>(&requirement - requirements.items.data())];
  }
};

/// Size of the largest group, by the first items of the groups and the end (group_tasks or
/// group_behaviors).
template <typename T>
[[nodiscard]] std::size_t most_in_a_group(std::span<const T> begin) {
  std::size_t most = 0;
  for (GroupId group(0); group + 1 < begin.size(); ++group) {
    most = std::max<std::size_t>(most, begin[group + 1] - begin[group]);
  }
  return most;
}

/// Number of values in the group that has most of them.
[[nodiscard]] inline std::size_t most_values_in_a_group(const CompiledCatalog& catalog) {
  std::size_t most = 0;
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    const std::uint32_t end = catalog.values.begin[catalog.group_tasks[group + 1]];
    most = std::max<std::size_t>(most, end - catalog.values.begin[catalog.group_tasks[group]]);
  }
  return most;
}

}  // namespace cbc
