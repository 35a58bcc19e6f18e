#include "compiled/catalog_arrays.h"

#include <memory>
#include <utility>

namespace cbc {
namespace {

template <typename T>
Rows<T> view(const GrowingRows<T>& rows) {
  return {rows.begin, rows.items};
}

}  // namespace

CompiledCatalog to_catalog(CatalogArrays made) {
  const auto arrays = std::make_shared<const CatalogArrays>(std::move(made));
  CompiledCatalog catalog;
  catalog.storage = arrays;
  catalog.texts = Texts(view(arrays->texts));
  catalog.file = catalog.texts[arrays->task_count + arrays->behavior_count];
  catalog.task_names = catalog.texts.part(0, arrays->task_count);
  catalog.behavior_names = catalog.texts.part(arrays->task_count, arrays->behavior_count);
  catalog.task_ids = arrays->task_ids;
  catalog.behavior_ids = arrays->behavior_ids;
  catalog.behavior_packages = arrays->behavior_packages;
  catalog.parameters = view(arrays->parameters);
  catalog.allowed_values = arrays->allowed_values;
  catalog.tasks_by_name = arrays->tasks_by_name;
  catalog.behaviors_by_name = arrays->behaviors_by_name;
  catalog.group_tasks = arrays->group_tasks;
  catalog.group_behaviors = arrays->group_behaviors;
  catalog.topological_order = arrays->topological_order;
  catalog.tasks = arrays->tasks;
  catalog.values = view(arrays->values);
  catalog.value_tasks = arrays->value_tasks;
  catalog.words = arrays->words;
  catalog.arcs = view(arrays->arcs);
  catalog.incoming = view(arrays->incoming);
  catalog.task_cliques = view(arrays->task_cliques);
  catalog.behaviors = arrays->behaviors;
  catalog.requirements = view(arrays->requirements);
  catalog.requirement_lines = arrays->requirement_lines;
  catalog.performs = view(arrays->performs);
  catalog.cliques = view(arrays->cliques);
  catalog.clique_lines = arrays->clique_lines;
  catalog.masks = arrays->masks;
  return catalog;
}

}  // namespace cbc
