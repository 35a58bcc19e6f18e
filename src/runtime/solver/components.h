#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"

namespace cbc {

/// Splits the undecided tasks into components: once most domains are fixed, a group often falls
/// into sets of tasks that no constraint and no objective connects any more. Each is solved apart.
///
/// Components nest: a component can be split again. The present one is the innermost that was
/// entered; at depth 0 it is the whole group.
class Components {
 public:
  Components(const CompiledCatalog& catalog, const Domains& domains);

  /// To be called after Domains::load.
  void load(const Problem& problem);

  /// Components do not nest deeper.
  static constexpr std::uint32_t deepest = 8;

  [[nodiscard]] std::uint32_t depth() const { return depth_; }
  /// Whether the task belongs to the component that was entered at `depth`.
  [[nodiscard]] bool contains(LocalTask task, std::uint32_t depth) const {
    return depth_of_[task] >= depth;
  }

  /// If the undecided tasks of the present component are in several, enters the one of `task`.
  /// All requests must be decided.
  [[nodiscard]] bool enter_component_of(LocalTask task);
  void leave();

 private:
  void find_open_tasks();
  void open(LocalTask task);
  void join_by_cliques();
  void join_by_behaviors();
  void join_by_performance();
  void join_reach_of(LocalTask task);
  void join(LocalTask a, LocalTask b);
  [[nodiscard]] LocalTask root_of(LocalTask task);
  [[nodiscard]] bool is_open(LocalTask task) const { return opened_[task] == number_; }
  [[nodiscard]] bool is_fixed(LocalTask task) const {
    return domains_.needed(task) && domains_.count(task) == 1;
  }
  /// Whether a behavior in the domain of the task requires the target of the arc.
  [[nodiscard]] bool may_use(LocalTask task, const Arc& arc) const {
    return domains_.any_within(task, &catalog_.masks[arc.mask]);
  }
  [[nodiscard]] bool has_rules(LocalTask task) const {
    return catalog_.tasks[domains_.first_task() + task].has_performance_rules;
  }

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  std::vector<std::uint8_t> has_zeros_;  ///< by group: a suitability of 0
  bool can_split_ = true;
  std::uint32_t depth_ = 0;
  std::vector<std::uint32_t> depth_of_;  ///< by task: of its innermost component
  std::uint64_t number_ = 0;             ///< of the present decomposition
  std::vector<std::uint64_t> opened_;    ///< by task
  std::vector<LocalTask> open_;          ///< see find_open_tasks
  std::vector<LocalTask> joined_to_;     ///< by task: towards the root of its component
  std::vector<std::uint64_t> clique_seen_;
  std::vector<LocalTask> clique_task_;
  std::vector<std::uint64_t> limit_seen_;
  std::vector<LocalTask> limit_task_;
  std::vector<std::uint64_t> behavior_seen_;  ///< by behavior of the group
  std::vector<LocalTask> behavior_task_;
  std::uint64_t reach_number_ = 0;
  std::vector<std::uint64_t> reached_;  ///< by task
  std::vector<LocalTask> reach_;
};

}  // namespace cbc
