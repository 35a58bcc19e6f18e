#include "unit/editable_catalog.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>

#include "catalog/allowed_values.h"

namespace cbc::test {
namespace {

template <typename T>
std::vector<T> copy(std::span<const T> items) {
  return {items.begin(), items.end()};
}

template <typename T>
GrowingRows<T> copy(const Rows<T>& rows) {
  return {copy(rows.begin), copy(rows.items)};
}

template <typename T>
Rows<T> view(const GrowingRows<T>& rows) {
  return {rows.begin, rows.items};
}

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

  std::vector<EditableCatalog::Number> list;
};

/// The structs have no padding.
template <typename T>
bool is_same(std::span<const T> a, std::span<const T> b) {
  static_assert(std::has_unique_object_representations_v<T>);
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

template <typename T>
bool is_same(const Rows<T>& a, const Rows<T>& b) {
  return is_same(a.begin, b.begin) && is_same(a.items, b.items);
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

EditableCatalog::EditableCatalog(const CompiledCatalog& catalog)
    : file_begin(static_cast<std::size_t>(catalog.file.data() - catalog.texts.rows().items.data())),
      file_size(catalog.file.size()) {
  arrays.task_count = catalog.task_names.size();
  arrays.behavior_count = catalog.behavior_names.size();
  arrays.texts = copy(catalog.texts.rows());
  arrays.task_ids = copy(catalog.task_ids);
  arrays.behavior_ids = copy(catalog.behavior_ids);
  arrays.behavior_packages = copy(catalog.behavior_packages);
  arrays.parameters = copy(catalog.parameters);
  arrays.allowed_values = copy(catalog.allowed_values);
  arrays.tasks_by_name = copy(catalog.tasks_by_name);
  arrays.behaviors_by_name = copy(catalog.behaviors_by_name);
  arrays.group_tasks = copy(catalog.group_tasks);
  arrays.group_behaviors = copy(catalog.group_behaviors);
  arrays.topological_order = copy(catalog.topological_order);
  arrays.tasks = copy(catalog.tasks);
  arrays.values = copy(catalog.values);
  arrays.value_tasks = copy(catalog.value_tasks);
  arrays.words = copy(catalog.words);
  arrays.arcs = copy(catalog.arcs);
  arrays.incoming = copy(catalog.incoming);
  arrays.task_cliques = copy(catalog.task_cliques);
  arrays.behaviors = copy(catalog.behaviors);
  arrays.requirements = copy(catalog.requirements);
  arrays.requirement_lines = copy(catalog.requirement_lines);
  arrays.performs = copy(catalog.performs);
  arrays.cliques = copy(catalog.cliques);
  arrays.clique_lines = copy(catalog.clique_lines);
  arrays.masks = copy(catalog.masks);
}

CompiledCatalog EditableCatalog::catalog() const {
  const auto copied = std::make_shared<const CatalogArrays>(arrays);
  CompiledCatalog catalog;
  catalog.storage = copied;
  catalog.texts = Texts(view(copied->texts));
  if (file_begin + file_size <= copied->texts.items.size()) {
    catalog.file = {copied->texts.items.data() + file_begin, file_size};
  }
  if (copied->task_count + copied->behavior_count < copied->texts.begin.size()) {
    catalog.task_names = catalog.texts.part(0, copied->task_count);
    catalog.behavior_names = catalog.texts.part(copied->task_count, copied->behavior_count);
  }
  catalog.task_ids = copied->task_ids;
  catalog.behavior_ids = copied->behavior_ids;
  catalog.behavior_packages = copied->behavior_packages;
  catalog.parameters = view(copied->parameters);
  catalog.allowed_values = copied->allowed_values;
  catalog.tasks_by_name = copied->tasks_by_name;
  catalog.behaviors_by_name = copied->behaviors_by_name;
  catalog.group_tasks = copied->group_tasks;
  catalog.group_behaviors = copied->group_behaviors;
  catalog.topological_order = copied->topological_order;
  catalog.tasks = copied->tasks;
  catalog.values = view(copied->values);
  catalog.value_tasks = copied->value_tasks;
  catalog.words = copied->words;
  catalog.arcs = view(copied->arcs);
  catalog.incoming = view(copied->incoming);
  catalog.task_cliques = view(copied->task_cliques);
  catalog.behaviors = copied->behaviors;
  catalog.requirements = view(copied->requirements);
  catalog.requirement_lines = copied->requirement_lines;
  catalog.performs = view(copied->performs);
  catalog.cliques = view(copied->cliques);
  catalog.clique_lines = copied->clique_lines;
  catalog.masks = copied->masks;
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
  }
  for (const BehaviorId id : compiled.behavior_ids) {
    Behavior& to = catalog.behaviors.emplace_back();
    to.name = compiled.name_of_behavior(id);
    to.package = compiled.texts[compiled.behavior_packages[catalog.behaviors.size() - 1]];
    if (compiled.behaviors[id].timeout != 0) to.timeout = compiled.behaviors[id].timeout;
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
  return catalog;
}

std::string difference(const CompiledCatalog& a, const CompiledCatalog& b) {
  if (a.file != b.file) return "file";
  if (!is_same(a.task_names, b.task_names)) return "task_names";
  if (!is_same(a.behavior_names, b.behavior_names)) return "behavior_names";
  if (!is_same(a.task_ids, b.task_ids)) return "task_ids";
  if (!is_same(a.behavior_ids, b.behavior_ids)) return "behavior_ids";
  if (!is_same(a.tasks_by_name, b.tasks_by_name)) return "tasks_by_name";
  if (!is_same(a.behaviors_by_name, b.behaviors_by_name)) return "behaviors_by_name";
  if (!is_same(a.group_tasks, b.group_tasks)) return "group_tasks";
  if (!is_same(a.group_behaviors, b.group_behaviors)) return "group_behaviors";
  if (!is_same(a.topological_order, b.topological_order)) return "topological_order";
  if (!is_same(a.tasks, b.tasks)) return "tasks";
  if (!is_same(a.values, b.values)) return "values";
  if (!is_same(a.value_tasks, b.value_tasks)) return "value_tasks";
  if (!is_same(a.words, b.words)) return "words";
  if (!is_same(a.arcs, b.arcs)) return "arcs";
  if (!is_same(a.incoming, b.incoming)) return "incoming";
  if (!is_same(a.task_cliques, b.task_cliques)) return "task_cliques";
  if (!is_same(a.behaviors, b.behaviors)) return "behaviors";
  if (!is_same(a.requirements, b.requirements)) return "requirements";
  if (!is_same(a.requirement_lines, b.requirement_lines)) return "requirement_lines";
  if (!is_same(a.performs, b.performs)) return "performs";
  if (!is_same(a.cliques, b.cliques)) return "cliques";
  if (!is_same(a.clique_lines, b.clique_lines)) return "clique_lines";
  if (!is_same(a.masks, b.masks)) return "masks";
  if (!is_same(a.parameters.begin, b.parameters.begin)) return "parameters.begin";
  if (!has_same_packages(a, b)) return "behavior_packages";
  if (!has_same_parameters(a, b)) return "parameters";
  return {};
}

}  // namespace cbc::test
