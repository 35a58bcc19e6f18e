#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/situation.h"
#include "core/compile/compile.h"
#include "core/support/json_description.h"
#include "runtime/compiled/compiled_catalog.h"

// Parts of catalogs, as JSON. The context of descriptions is the compiled catalog, or has it as its
// member `catalog`.

namespace cbc::json {

template <typename Context>
[[nodiscard]] const CompiledCatalog& catalog_in(const Context& context) {
  if constexpr (std::same_as<Context, CompiledCatalog>) {
    return context;
  } else if constexpr (requires { context.catalog(); }) {
    return context.catalog();
  } else {
    return context.catalog;
  }
}

/// A name in the catalog. `Names` says of what: it finds the name of a number, and the number of a
/// name.
template <typename Names>
struct Name {
  using Number = typename Names::Number;

  [[nodiscard]] static bool has(Number id) { return id != none; }
  void write(JsonWriter& json, Number id, const auto& context) const {
    json.put(text(id, context));
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json::text.put_schema(json, definitions);
  }
  void read(const auto& json, Number& id, const auto& context) const {
    id = find(json, json.text(), context);
  }
  /// As the name of a member.
  [[nodiscard]] std::string_view text(Number id, const auto& context) const {
    return Names::name(catalog_in(context), id);
  }
  void read_name(const auto& json, Number& id, const auto& context) const {
    id = find(json, json.name(), context);
  }

 private:
  [[nodiscard]] static Number find(const auto& json, std::string_view name, const auto& context) {
    const auto id = Names::find(catalog_in(context), name);
    if (!id) json.refuse_word(Names::what, name);
    return *id;
  }
};

struct TaskNames {
  using Number = TaskId;
  static constexpr std::string_view what = "task";
  static std::string_view name(const CompiledCatalog& catalog, TaskId task) {
    return catalog.name_of_task(task);
  }
  static std::optional<TaskId> find(const CompiledCatalog& catalog, std::string_view name) {
    const auto place = catalog.find_task(name);
    return place ? std::optional(catalog.task_ids[*place]) : std::nullopt;
  }
};
inline constexpr Name<TaskNames> task;

struct BehaviorNames {
  using Number = BehaviorId;
  static constexpr std::string_view what = "behavior";
  static std::string_view name(const CompiledCatalog& catalog, BehaviorId behavior) {
    return catalog.name_of_behavior(behavior);
  }
  static std::optional<BehaviorId> find(const CompiledCatalog& catalog, std::string_view name) {
    const auto place = catalog.find_behavior(name);
    return place ? std::optional(catalog.behavior_ids[*place]) : std::nullopt;
  }
};
inline constexpr Name<BehaviorNames> behavior;

inline constexpr auto tasks = list(task).unique();
inline constexpr auto behaviors = list(behavior).unique();

struct VariableNames {
  using Number = std::uint32_t;
  static std::string_view name(const CompiledCatalog& catalog, std::uint32_t variable) {
    return catalog.name_of_variable(variable);
  }
};
inline constexpr Name<VariableNames> variable;

/// A value of a situation variable: a text, or true or false if the variable was declared without
/// values.
struct PlainValue {
  void write(JsonWriter& json, VariableValue value, const auto& context) const {
    const CompiledCatalog& catalog = catalog_in(context);
    if (catalog.variables[value.variable].is_boolean != 0) {
      json.put(value.value == 0);
    } else {
      json.put(catalog.name_of_value(value));
    }
  }
  /// Whether a behavior is available, beside the values of variables.
  void write(JsonWriter& json, bool available, const auto& /*context*/) const {
    json.put(available);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_list("type", std::array<std::string_view, 2>{"string", "boolean"});
    json.write("minLength", 1);
  }
};
inline constexpr PlainValue plain_value;

/// Values of situation variables, and whether behaviors are available, by their names.
inline constexpr auto situation = map(text, plain_value);

/// The values of a condition.
struct ConditionValues {
  void write(JsonWriter& json, const NamedCondition& condition, const auto& /*context*/) const {
    json.begin('[');
    for (const std::string_view value : condition.values) {
      if (condition.is_boolean) {
        json.write(value == "true");
      } else {
        json.write(value);
      }
    }
    json.close(']');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    list(plain_value).at_least(1).put_schema(json, definitions);
  }
};

/// The values in which a behavior fits, by the variables that it names.
inline constexpr auto conditions = map(text, ConditionValues());

/// What a Map makes of conditions.
[[nodiscard]] inline auto by_variable(std::vector<NamedCondition> all) {
  return [all = std::move(all)](const auto& put) {
    for (const NamedCondition& condition : all) put(condition.variable, condition);
  };
}

/// A situation variable, by its place.
inline constexpr auto variable_with_values =
    object("situation_variable", "", member("variable", variable, "", std::identity()),
           member("values", list(plain_value).at_least(2).unique(),
                  "The first one is the initial value. [true, false]: declared without values.",
                  [](std::uint32_t index, const auto& context) {
                    return [index, &context](const auto& put) {
                      const auto values = catalog_in(context).variables[index].value_count;
                      for (std::uint32_t value = 0; value < values; ++value) {
                        put(VariableValue{index, value});
                      }
                    };
                  }));

inline constexpr auto constraints = object(
    "constraints", "",
    member("exclusive_pairs", count,
           "Distinct unordered pairs of different tasks that exclude one another.",
           &ConstraintCount::exclusive_pairs),
    member("requirements", count, "Distinct pairs of a behavior and a task that it requires.",
           &ConstraintCount::requirements),
    member("task_minimums", count, "Tasks with a minimum performance.",
           &ConstraintCount::task_minimums),
    optional("limits", count, "Lists of tasks of which several may run, if there are any.",
             [](const ConstraintCount& of) {
               return of.limits == 0 ? std::nullopt : std::optional(of.limits);
             }),
    member("total", count, "", &ConstraintCount::total));

inline constexpr auto search_space =
    member("search_space", matching("^[1-9][0-9]*$"),
           "The product of (1 + number of behaviors) over all tasks. A text, since it may exceed "
           "any number format.",
           &CatalogNumbers::search_space);

}  // namespace cbc::json
