#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/catalog.h"
#include "compile/compile.h"
#include "compiled/compiled_catalog.h"

namespace cbc::test {

/// The arrays of a compiled catalog, to be changed at will.
class EditableCatalog {
 public:
  explicit EditableCatalog(const CompiledCatalog& catalog);

  /// A catalog of copies of the arrays that are as long as they are, so that a sanitizer sees what
  /// reads beyond them. Names and the source that do not lie in the texts are empty.
  [[nodiscard]] CompiledCatalog catalog() const;

  /// A number in the arrays, or a character.
  struct Number {
    std::string_view field;
    void* place = nullptr;
    std::size_t bytes = 0;

    [[nodiscard]] std::uint64_t get() const;
    void set(std::uint64_t value) const;
  };
  /// All of them.
  [[nodiscard]] std::vector<Number> numbers();

  /// Calls visit(name, vector) for each array.
  template <typename Visit>
  void for_each_array(Visit visit) {
    visit("texts.begin", arrays.texts.begin);
    visit("texts", arrays.texts.items);
    visit("task_ids", arrays.task_ids);
    visit("behavior_ids", arrays.behavior_ids);
    visit("behavior_packages", arrays.behavior_packages);
    visit("parameters.begin", arrays.parameters.begin);
    visit("parameters", arrays.parameters.items);
    visit("allowed_values", arrays.allowed_values);
    visit("tasks_by_name", arrays.tasks_by_name);
    visit("behaviors_by_name", arrays.behaviors_by_name);
    visit("group_tasks", arrays.group_tasks);
    visit("group_behaviors", arrays.group_behaviors);
    visit("topological_order", arrays.topological_order);
    visit("tasks", arrays.tasks);
    visit("values.begin", arrays.values.begin);
    visit("values", arrays.values.items);
    visit("value_tasks", arrays.value_tasks);
    visit("words", arrays.words);
    visit("arcs.begin", arrays.arcs.begin);
    visit("arcs", arrays.arcs.items);
    visit("incoming.begin", arrays.incoming.begin);
    visit("incoming", arrays.incoming.items);
    visit("task_cliques.begin", arrays.task_cliques.begin);
    visit("task_cliques", arrays.task_cliques.items);
    visit("behaviors", arrays.behaviors);
    visit("requirements.begin", arrays.requirements.begin);
    visit("requirements", arrays.requirements.items);
    visit("requirement_lines", arrays.requirement_lines);
    visit("performs.begin", arrays.performs.begin);
    visit("performs", arrays.performs.items);
    visit("cliques.begin", arrays.cliques.begin);
    visit("cliques", arrays.cliques.items);
    visit("clique_lines", arrays.clique_lines);
    visit("masks", arrays.masks);
  }

  CatalogArrays arrays;        ///< but for `file`
  std::size_t file_begin = 0;  ///< of the source, in the characters of the texts
  std::size_t file_size = 0;
};

/// The catalog that the arrays describe, without what they do not say (ranges but for lines).
[[nodiscard]] Catalog describe_compiled(const CompiledCatalog& catalog);

/// The first array in which two catalogs differ, or nothing. Texts are compared where they are
/// used: their places do not count.
[[nodiscard]] std::string difference(const CompiledCatalog& a, const CompiledCatalog& b);

}  // namespace cbc::test
