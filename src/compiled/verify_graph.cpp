#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "compiled/verify_parts.h"

namespace cbc::verify {
namespace {

/// What the tasks have from the requirements of their values: built for one task after the other,
/// and compared.
class Arcs {
 public:
  explicit Arcs(const CompiledCatalog& catalog)
      : catalog_(catalog), arc_to_(most_in_a_group(catalog.group_tasks), 0) {}

  /// To be called for each task in turn. The work is at most that of reading each bit of its masks.
  Fault find_fault(TaskId id) {
    const CompiledTask& task = catalog_.tasks[id];
    const std::size_t words = catalog_.words[id + 1] - catalog_.words[id];
    const std::size_t arcs = catalog_.arcs[id].size();
    if (arcs * words > catalog_.masks.size() - first_mask_) {
      return fmt::format("task {} has {} arcs, more than there are masks for", id, arcs);
    }
    masks_.assign(arcs * words, 0);
    const Summary summary = build(id, words);
    if (!summary.has_these_arcs) {
      return fmt::format("the arcs of task {} are not those of its values", id);
    }
    if (!std::equal(masks_.begin(), masks_.end(), catalog_.masks.subspan(first_mask_).begin())) {
      return fmt::format("the masks of task {} are not those of its values", id);
    }
    first_mask_ += masks_.size();
    if (task.level != summary.level) {
      return fmt::format("task {}: its level is {}, expected {}", id, task.level, summary.level);
    }
    if (task.has_performance_rules != summary.has_performance_rules) {
      return fmt::format("task {}: has_performance_rules is {}, expected {}", id,
                         task.has_performance_rules, summary.has_performance_rules);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t mask_count() const { return first_mask_; }

 private:
  struct Summary {
    bool has_these_arcs = false;  ///< if not, nothing else counts
    std::uint32_t level = 0;
    std::uint8_t has_performance_rules = 0;
  };

  /// Builds the masks of a task.
  Summary build(TaskId id, std::size_t words) {
    const CompiledTask& task = catalog_.tasks[id];
    const std::span<std::uint32_t> arc_to(arc_to_);
    const std::span<std::uint64_t> masks(masks_);
    const std::size_t first_mask = first_mask_;
    const TaskId first_task = catalog_.group_tasks[task.group];
    const std::uint32_t first = catalog_.arcs.begin[id];
    const std::uint32_t end = catalog_.arcs.begin[id + 1];
    std::uint32_t next = first;
    Summary summary;
    bool has_rules = task.minimum_performance > 0;
    const auto values = catalog_.values[id];
    for (std::size_t place = 0; place < values.size(); ++place) {
      const BehaviorId behavior = values[place].behavior;
      summary.level = std::max(summary.level, catalog_.behaviors[behavior].level);
      for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
        has_rules |= requirement.minimum_performance > 0;
        std::uint32_t& arc_end = arc_to[requirement.task - first_task];
        if (arc_end <= first) {
          if (next == end) return {};
          const Arc& arc = catalog_.arcs.items[next];
          if (arc.source != id || arc.target != requirement.task ||
              arc.mask != first_mask + (next - first) * words) {
            return {};
          }
          arc_end = ++next;
        }
        masks[(arc_end - 1 - first) * words + place / 64] |= std::uint64_t{1} << (place % 64);
      }
    }
    summary.has_these_arcs = next == end;
    summary.has_performance_rules = has_rules ? 1 : 0;
    return summary;
  }

  const CompiledCatalog& catalog_;
  std::vector<std::uint32_t> arc_to_;  ///< by task of the group: 1 + the last arc to it, or 0
  std::vector<std::uint64_t> masks_;   ///< of one task
  std::size_t first_mask_ = 0;         ///< of the next task
};

/// There are as many places in `incoming` as arcs, so each arc has one if none has two.
Fault find_incoming_fault(const CompiledCatalog& catalog) {
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    std::uint32_t next = 0;
    for (const std::uint32_t arc : catalog.incoming[task]) {
      if (arc >= catalog.arcs.items.size() || catalog.arcs.items[arc].target != task) {
        return fmt::format("'incoming' has arc {} at task {}, where it does not end", arc, task);
      }
      if (arc < next) return fmt::format("the incoming arcs of task {} do not ascend", task);
      next = arc + 1;
    }
  }
  return std::nullopt;
}

/// The tasks of a group are there, each once, as they ascend and are as many as the group has.
Fault find_order_fault(const CompiledCatalog& catalog) {
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    const TaskId first = catalog.group_tasks[group];
    const TaskId end = catalog.group_tasks[group + 1];
    for (std::uint32_t place = first; place < end; ++place) {
      const TaskId task = catalog.topological_order[place];
      if (task < first || task >= end) {
        return fmt::format("'topological_order' has task {} among those of group {}", task, group);
      }
      if (place == first) continue;
      const TaskId before = catalog.topological_order[place - 1];
      const std::uint32_t level = catalog.tasks[task].level;
      const std::uint32_t level_before = catalog.tasks[before].level;
      if (level < level_before || (level == level_before && task <= before)) {
        return fmt::format("'topological_order' has task {} after task {}", task, before);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Fault find_graph_fault(const CompiledCatalog& catalog) {
  Arcs arcs(catalog);
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (auto fault = arcs.find_fault(task)) return fault;
  }
  if (arcs.mask_count() != catalog.masks.size()) {
    return fmt::format("there are {} masks, expected {}", catalog.masks.size(), arcs.mask_count());
  }
  if (auto fault = find_incoming_fault(catalog)) return fault;
  return find_order_fault(catalog);
}

}  // namespace cbc::verify
