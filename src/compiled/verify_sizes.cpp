#include <fmt/format.h>

#include "compiled/verify_parts.h"

namespace cbc::verify {
namespace {

/// Without a jump for each number, so that many are compared at once.
bool is_ascending(std::span<const std::uint32_t> numbers) {
  unsigned descents = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    descents |= static_cast<unsigned>(numbers[i] < numbers[i - 1]);
  }
  return descents == 0;
}

/// `rows` of them in an array of `items`.
Fault find_row_fault(std::string_view what, std::span<const std::uint32_t> begin, std::size_t rows,
                     std::size_t items) {
  if (begin.size() != rows + 1) {
    return fmt::format("'{}' has {} begins of rows, expected {}", what, begin.size(), rows + 1);
  }
  if (begin.front() != 0) {
    return fmt::format("the first row of '{}' begins at {}, expected 0", what, begin.front());
  }
  if (!is_ascending(begin)) return fmt::format("a row of '{}' ends before it begins", what);
  if (begin.back() != items) {
    return fmt::format("the last row of '{}' ends at {}, expected {}", what, begin.back(), items);
  }
  return std::nullopt;
}

}  // namespace

Fault find_size_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t behaviors = catalog.behaviors.size();
  const std::size_t cliques = catalog.clique_lines.size();
  const Rows<char>& texts = catalog.texts.rows();

  struct Count {
    std::string_view what;
    std::size_t count;
  };
  // 32 bits count all that has a place; `none` is no place.
  const Count counts[] = {
      {"tasks", tasks},
      {"behaviors", behaviors},
      {"texts", texts.begin.size()},
      {"characters of texts", texts.items.size()},
      {"parameters", catalog.parameters.items.size()},
      {"allowed_values", catalog.allowed_values.size()},
      {"values", catalog.values.items.size()},
      {"arcs", catalog.arcs.items.size()},
      {"requirements", catalog.requirements.items.size()},
      {"cliques", cliques},
      {"tasks of cliques", catalog.cliques.items.size()},
      {"masks", catalog.masks.size()},
  };
  for (const auto& [what, count] : counts) {
    if (count >= none)
      return fmt::format("there are {} {}, expected less than {}", count, what, none);
  }

  struct Size {
    std::string_view what;
    std::size_t found;
    std::size_t expected;
  };
  const Size sizes[] = {
      {"task_ids", catalog.task_ids.size(), tasks},
      {"behavior_ids", catalog.behavior_ids.size(), behaviors},
      {"behavior_packages", catalog.behavior_packages.size(), behaviors},
      {"tasks_by_name", catalog.tasks_by_name.size(), tasks},
      {"behaviors_by_name", catalog.behaviors_by_name.size(), behaviors},
      {"topological_order", catalog.topological_order.size(), tasks},
      {"value_tasks", catalog.value_tasks.size(), catalog.values.items.size()},
      {"words", catalog.words.size(), tasks + 1},
      {"requirement_lines", catalog.requirement_lines.size(), catalog.requirements.items.size()},
      {"group_behaviors", catalog.group_behaviors.size(), catalog.group_tasks.size()},
  };
  for (const auto& [what, found, expected] : sizes) {
    if (found != expected) {
      return fmt::format("'{}' has {} entries, expected {}", what, found, expected);
    }
  }
  if (texts.begin.size() < tasks + behaviors + 1) {
    return fmt::format("there are {} begins of texts, expected {} for the names",
                       texts.begin.size(), tasks + behaviors + 1);
  }
  if (catalog.group_tasks.empty()) return "'group_tasks' is empty";

  struct RowArray {
    std::string_view what;
    std::span<const std::uint32_t> begin;
    std::size_t rows;
    std::size_t items;
  };
  const std::size_t groups = catalog.group_count();
  const RowArray arrays[] = {
      {"texts", texts.begin, texts.begin.size() - 1, texts.items.size()},
      {"group_tasks", catalog.group_tasks, groups, tasks},
      {"group_behaviors", catalog.group_behaviors, groups, behaviors},
      {"parameters", catalog.parameters.begin, tasks, catalog.parameters.items.size()},
      {"values", catalog.values.begin, tasks, catalog.values.items.size()},
      {"arcs", catalog.arcs.begin, tasks, catalog.arcs.items.size()},
      {"incoming", catalog.incoming.begin, tasks, catalog.incoming.items.size()},
      {"task_cliques", catalog.task_cliques.begin, tasks, catalog.task_cliques.items.size()},
      {"requirements", catalog.requirements.begin, behaviors, catalog.requirements.items.size()},
      {"performs", catalog.performs.begin, behaviors, catalog.performs.items.size()},
      {"cliques", catalog.cliques.begin, cliques, catalog.cliques.items.size()},
      // What is an inverse of another array has as many items.
      {"performs", catalog.performs.begin, behaviors, catalog.values.items.size()},
      {"incoming", catalog.incoming.begin, tasks, catalog.arcs.items.size()},
      {"task_cliques", catalog.task_cliques.begin, tasks, catalog.cliques.items.size()},
  };
  for (const auto& [what, begin, rows, items] : arrays) {
    if (auto fault = find_row_fault(what, begin, rows, items)) return fault;
  }
  return std::nullopt;
}

}  // namespace cbc::verify
