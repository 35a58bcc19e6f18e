#include "unit/editable_catalog.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>

#include "core/catalog/allowed_values.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::test {
namespace {

class NumberList {
 public:
  template <typename T>
  void add(std::string_view field, T& number) {
    list.push_back({field, &number, sizeof(number)});
  }
  void add(std::string_view /*field*/, CompiledTask& task) {
    add("task.catalog_index", task.catalog_index);
    add("task.group", task.group);
    add("task.level", task.level);
    add("task.minimum_performance", task.minimum_performance);
    add("task.minimum_cost", task.minimum_cost);
    add("task.timeout", task.timeout);
    add("task.minimum_line", task.minimum_line);
    add("task.start_on_request", task.start_on_request);
    add("task.reactive_start", task.reactive_start);
    add("task.keep_running", task.keep_running);
    add("task.has_performance_rules", task.has_performance_rules);
  }
  void add(std::string_view /*field*/, CompiledBehavior& behavior) {
    add("behavior.catalog_index", behavior.catalog_index);
    add("behavior.level", behavior.level);
    add("behavior.timeout", behavior.timeout);
  }
  void add(std::string_view /*field*/, Value& value) {
    add("value.behavior", value.behavior);
    add("value.suitability", value.suitability);
    add("value.cost", value.cost);
  }
  void add(std::string_view /*field*/, CompiledRequirement& requirement) {
    add("requirement.task", requirement.task);
    add("requirement.minimum_performance", requirement.minimum_performance);
    add("requirement.minimum_cost", requirement.minimum_cost);
  }
  void add(std::string_view /*field*/, Arc& arc) {
    add("arc.source", arc.source);
    add("arc.target", arc.target);
    add("arc.mask", arc.mask);
  }
  void add(std::string_view /*field*/, CompiledParameter& parameter) {
    add("parameter.name", parameter.name);
    add("parameter.allowed_is_list", parameter.allowed_is_list);
    add("parameter.first_allowed", parameter.first_allowed);
    add("parameter.allowed_count", parameter.allowed_count);
  }
  void add(std::string_view /*field*/, CompiledVariable& variable) {
    add("variable.name", variable.name);
    add("variable.is_boolean", variable.is_boolean);
    add("variable.first_value", variable.first_value);
    add("variable.value_count", variable.value_count);
  }
  void add(std::string_view /*field*/, FittingValue& fitting) {
    add("fitting.behavior", fitting.behavior);
    add("fitting.variable", fitting.variable);
    add("fitting.value", fitting.value);
  }

  std::vector<EditableCatalog::Number> list;
};

/// The structs have no padding.
template <typename T>
bool is_same(std::span<const T> a, std::span<const T> b) {
  static_assert(std::has_unique_object_representations_v<T>);
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool is_same(const Texts& a, const Texts& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t place = 0; place < a.size(); ++place) {
    if (a[place] != b[place]) return false;
  }
  return true;
}

bool has_same_packages(const CompiledCatalog& a, const CompiledCatalog& b) {
  return std::equal(a.behavior_packages.begin(), a.behavior_packages.end(),
                    b.behavior_packages.begin(), b.behavior_packages.end(),
                    [&](TextId x, TextId y) { return a.texts[x] == b.texts[y]; });
}

bool has_same_parameters(const CompiledCatalog& a, const CompiledCatalog& b) {
  const auto is_same_parameter = [](const Parameter& x, const Parameter& y) {
    return x.name == y.name && x.allowed_is_list == y.allowed_is_list &&
           x.allowed_values == y.allowed_values;
  };
  for (std::uint32_t task = 0; task < a.task_names.size(); ++task) {
    const auto of_a = parameters_of(a, task);
    const auto of_b = parameters_of(b, task);
    if (!std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), is_same_parameter)) {
      return false;
    }
  }
  return true;
}

}  // namespace

EditableCatalog::EditableCatalog(const CompiledCatalog& catalog) {
  std::apply(
      [&](auto&... to) {
        std::apply([&](const auto&... from) { (to.assign(from.begin(), from.end()), ...); },
                   arrays_of(catalog));
      },
      arrays_of(arrays));
}

CompiledCatalog EditableCatalog::catalog() const {
  const auto copied = std::make_shared<const GrowingCatalog>(arrays);
  CompiledCatalog catalog;
  catalog.storage = copied;
  std::apply(
      [&](auto&... to) {
        std::apply([&](const auto&... from) { ((to = from), ...); }, arrays_of(*copied));
      },
      arrays_of(catalog));
  if (!find_fault(catalog)) catalog.set_names();
  return catalog;
}

std::uint64_t EditableCatalog::Number::get() const {
  std::uint64_t value = 0;
  std::memcpy(&value, place, bytes);
  return value;
}

void EditableCatalog::Number::set(std::uint64_t value) const { std::memcpy(place, &value, bytes); }

std::vector<EditableCatalog::Number> EditableCatalog::numbers() {
  NumberList numbers;
  for_each_array([&](std::string_view name, auto& array) {
    for (auto& item : array) numbers.add(name, item);
  });
  return std::move(numbers.list);
}

namespace {

std::vector<Variable> variables_of(const CompiledCatalog& compiled) {
  std::vector<Variable> variables;
  for (std::uint32_t place = 0; place < compiled.variables.size(); ++place) {
    Variable& variable = variables.emplace_back();
    variable.name = compiled.name_of_variable(place);
    variable.is_boolean = compiled.variables[place].is_boolean != 0;
    for (std::uint32_t value = 0; value < compiled.variables[place].value_count; ++value) {
      variable.values.emplace_back(compiled.name_of_value({place, value}));
    }
  }
  return variables;
}

bool has_same_variables(const CompiledCatalog& a, const CompiledCatalog& b) {
  const std::vector<Variable> of_a = variables_of(a);
  const std::vector<Variable> of_b = variables_of(b);
  return std::equal(
      of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), [](const Variable& x, const Variable& y) {
        return x.name == y.name && x.is_boolean == y.is_boolean && x.values == y.values;
      });
}

}  // namespace

Catalog describe_compiled(const CompiledCatalog& compiled) {
  Catalog catalog;
  catalog.file = compiled.file;
  const auto index_of = [&](TaskId task) { return compiled.tasks[task].catalog_index; };
  for (const TaskId id : compiled.task_ids) {
    const CompiledTask& from = compiled.tasks[id];
    Task& to = catalog.tasks.emplace_back();
    to.name = compiled.name_of_task(id);
    to.execution_goal =
        from.keep_running != 0 ? ExecutionGoal::keep_running : ExecutionGoal::achieve_goal;
    to.start_on_request = from.start_on_request != 0;
    to.reactive_start = from.reactive_start != 0;
    if (from.timeout != 0) to.timeout = from.timeout;
    to.minimum_performance = from.minimum_performance;
    to.minimum_performance_range.begin.line = from.minimum_line;
    to.parameters = parameters_of(compiled, from.catalog_index);
    to.rules = compiled.rules_of(id);
    if (!compiled.improve_lines.empty()) to.improve_range.begin.line = compiled.improve_lines[id];
  }
  for (const BehaviorId id : compiled.behavior_ids) {
    Behavior& to = catalog.behaviors.emplace_back();
    to.name = compiled.name_of_behavior(id);
    to.package = compiled.texts[compiled.behavior_packages[catalog.behaviors.size() - 1]];
    if (compiled.behaviors[id].timeout != 0) to.timeout = compiled.behaviors[id].timeout;
    to.retry = compiled.retry_of(id);
    if (!compiled.retry_lines.empty()) to.retry_range.begin.line = compiled.retry_lines[id];
    for (const ValueId value : compiled.performs[id]) {
      Performance& performance = to.performs.emplace_back();
      performance.task = index_of(compiled.task_of(value));
      performance.suitability = compiled.values.items[value].suitability;
    }
    for (const CompiledRequirement& from : compiled.requirements[id]) {
      Requirement& requirement = to.requirements.emplace_back();
      requirement.task = index_of(from.task);
      requirement.minimum_performance = from.minimum_performance;
      requirement.range.begin.line = compiled.line_of(from);
    }
  }
  for (std::uint32_t clique = 0; clique < compiled.cliques.size(); ++clique) {
    ExclusivityList& list = catalog.exclusivity.emplace_back();
    list.range.begin.line = compiled.clique_lines[clique];
    for (const TaskId task : compiled.cliques[clique]) list.tasks.push_back(index_of(task));
  }
  for (std::uint32_t limit = 0; limit < compiled.limits.size(); ++limit) {
    ExclusivityList& list = catalog.exclusivity.emplace_back();
    list.range.begin.line = compiled.limits[limit].line;
    list.at_most = compiled.limits[limit].most;
    for (const TaskId task : compiled.limited[limit]) list.tasks.push_back(index_of(task));
  }
  catalog.variables = variables_of(compiled);
  for (const FittingValue& fitting : compiled.fitting_values) {
    std::vector<Condition>& conditions =
        catalog.behaviors[compiled.behaviors[fitting.behavior].catalog_index].situation;
    if (conditions.empty() || conditions.back().variable != fitting.variable) {
      conditions.emplace_back().variable = fitting.variable;
    }
    conditions.back().values.push_back(fitting.value);
  }
  return catalog;
}

std::string difference(const CompiledCatalog& a, const CompiledCatalog& b) {
  if (a.file != b.file) return "file";
  if (!is_same(a.task_names, b.task_names)) return "task_names";
  if (!is_same(a.behavior_names, b.behavior_names)) return "behavior_names";
  const std::set<std::string_view> with_texts{
      "texts",          "texts_begin", "behavior_packages", "parameters",
      "allowed_values", "variables",   "variable_values"};
  std::string_view different;
  const auto* name = first_array_name;
  const auto compare = [&](const auto& of_a, const auto& of_b) {
    if (!with_texts.contains(*name) && !is_same(of_a, of_b)) different = *name;
    ++name;
  };
  std::apply(
      [&](const auto&... of_a) {
        std::apply([&](const auto&... of_b) { (compare(of_a, of_b), ...); }, arrays_of(b));
      },
      arrays_of(a));
  if (!different.empty()) return std::string(different);
  if (!has_same_packages(a, b)) return "behavior_packages";
  if (!has_same_parameters(a, b)) return "parameters";
  if (!has_same_variables(a, b)) return "variables";
  return {};
}

}  // namespace cbc::test
