#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// Rows that are being made.
template <typename T>
struct GrowingRows {
  std::vector<std::uint32_t> begin{0};
  std::vector<T> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    return {items.data() + begin[row], items.data() + begin[row + 1]};
  }
  void close_row() { begin.push_back(static_cast<std::uint32_t>(items.size())); }
  template <typename Row>
  void add_row(const Row& row) {
    items.insert(items.end(), row.begin(), row.end());
    close_row();
  }
};

/// The arrays of a compiled catalog while it is being made; see CompiledCatalog for what they hold.
struct CatalogArrays {
  std::size_t task_count = 0;
  std::size_t behavior_count = 0;
  GrowingRows<char> texts;

  std::vector<TaskId> task_ids;
  std::vector<BehaviorId> behavior_ids;
  std::vector<TextId> behavior_packages;
  GrowingRows<CompiledParameter> parameters;
  std::vector<TextId> allowed_values;
  std::vector<std::uint32_t> tasks_by_name;
  std::vector<std::uint32_t> behaviors_by_name;

  std::vector<std::uint32_t> group_tasks;
  std::vector<std::uint32_t> group_behaviors;
  std::vector<TaskId> topological_order;

  std::vector<CompiledTask> tasks;
  GrowingRows<Value> values;
  std::vector<TaskId> value_tasks;
  std::vector<std::uint32_t> words;
  GrowingRows<Arc> arcs;
  GrowingRows<std::uint32_t> incoming;
  GrowingRows<std::uint32_t> task_cliques;

  std::vector<CompiledBehavior> behaviors;
  GrowingRows<CompiledRequirement> requirements;
  std::vector<std::uint32_t> requirement_lines;
  GrowingRows<ValueId> performs;

  GrowingRows<TaskId> cliques;
  std::vector<std::uint32_t> clique_lines;
  std::vector<std::uint64_t> masks;
};

/// A catalog that uses the arrays, which it keeps.
[[nodiscard]] CompiledCatalog to_catalog(CatalogArrays made);

/// Does all that does not depend on the situation: groups, levels, constraint counts, costs, and
/// the flat arrays of the solver. `catalog` is one that read_catalog accepted (acyclic).
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog);

}  // namespace cbc
