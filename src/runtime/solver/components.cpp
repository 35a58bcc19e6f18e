// Component decomposition as in counting models (R. J. Bayardo and J. D. Pehoushek, "Counting
// models using connected components", AAAI 2000), for a best solution in place of a count:
// components are connected by shared terms of the objective, too. Components that are solved apart
// add up their search trees, where one search over all of them would multiply them.
//
// A decomposition that is fixed in advance, as in AND/OR search (R. Dechter and R. Mateescu,
// "AND/OR search spaces for graphical models", Artificial Intelligence 171 (2007)), need not be
// computed during the search. But what connects the tasks of a group are mostly choices that
// propagation takes away later, so components show only once some domains are fixed. Only hard
// searches pay for that.
#include "runtime/solver/components.h"

#include <algorithm>

namespace cbc {

Components::Components(const CompiledCatalog& catalog, const Domains& domains)
    : catalog_(catalog),
      domains_(domains),
      has_zeros_(catalog.group_count(), 0),
      clique_seen_(catalog.cliques.size(), 0),
      clique_task_(catalog.cliques.size()),
      limit_seen_(catalog.limits.size(), 0),
      limit_task_(catalog.limits.size()) {
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
    for (const Value& value : catalog.values[task]) {
      if (value.suitability == 0) has_zeros_[catalog.tasks[task].group] = 1;
    }
  }
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  const std::size_t behaviors = most_in_a_group(catalog.group_behaviors);
  depth_of_.resize(tasks, 0);
  opened_.resize(tasks, 0);
  open_.reserve(tasks);
  joined_to_.resize(tasks);
  behavior_seen_.resize(behaviors, 0);
  behavior_task_.resize(behaviors);
  reached_.resize(tasks, 0);
  reach_.reserve(tasks);
}

void Components::load(const Problem& problem) {
  depth_ = 0;
  std::fill_n(depth_of_.begin(), domains_.task_count(), 0);
  // A suitability of 0 makes the product of all components 0, so they are not independent.
  can_split_ = has_zeros_[problem.group] == 0;
}

bool Components::enter_component_of(LocalTask task) {
  if (!can_split_ || depth_ == deepest) return false;
  ++number_;
  find_open_tasks();
  join_by_cliques();
  join_by_behaviors();
  join_by_performance();
  const LocalTask root = root_of(task);
  const bool is_split = std::any_of(open_.begin(), open_.end(), [&](LocalTask other) {
    return domains_.needed(other) && root_of(other) != root;
  });
  if (!is_split) return false;
  ++depth_;
  for (const LocalTask other : open_) {
    if (root_of(other) == root) depth_of_[other] = depth_;
  }
  return true;
}

void Components::leave() {
  --depth_;
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    depth_of_[task] = std::min(depth_of_[task], depth_);
  }
}

/// Open: the needed tasks of the present component with several behaviors left, and the tasks that
/// may become needed through them.
void Components::find_open_tasks() {
  open_.clear();
  for (const LocalTask task : domains_.needed_tasks()) {
    if (domains_.count(task) > 1 && contains(task, depth_)) open(task);
  }
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < open_.size(); ++next) {
    const LocalTask task = open_[next];
    for (const Arc& arc : catalog_.arcs[domains_.first_task() + task]) {
      const LocalTask target = arc.target - domains_.first_task();
      if (is_fixed(target) || !may_use(task, arc)) continue;
      open(target);
      join(task, target);
    }
  }
}

void Components::open(LocalTask task) {
  if (is_open(task)) return;
  opened_[task] = number_;
  joined_to_[task] = task;
  open_.push_back(task);
}

/// The rivals of needed tasks are closed already; this is about tasks that may become needed.
void Components::join_by_cliques() {
  const auto join_by = [this](std::uint32_t list, LocalTask task, std::vector<std::uint64_t>& seen,
                              std::vector<LocalTask>& first) {
    if (seen[list] == number_) {
      join(task, first[list]);
    } else {
      seen[list] = number_;
      first[list] = task;
    }
  };
  for (const LocalTask task : open_) {
    const TaskId id = domains_.first_task() + task;
    for (const std::uint32_t clique : catalog_.task_cliques[id]) {
      join_by(clique, task, clique_seen_, clique_task_);
    }
    for (const std::uint32_t limit : catalog_.limits_of(id)) {
      join_by(limit, task, limit_seen_, limit_task_);
    }
  }
}

/// A behavior of several tasks counts as one change in f4, however many of them choose it.
void Components::join_by_behaviors() {
  for (const LocalTask task : open_) {
    for (const std::uint32_t index : domains_.indices(task)) {
      const BehaviorId behavior = domains_.value(task, index).behavior;
      if (catalog_.performs[behavior].size() == 1) continue;
      const std::uint32_t local = behavior - domains_.first_behavior();
      if (behavior_seen_[local] == number_) {
        join(task, behavior_task_[local]);
      } else {
        behavior_seen_[local] = number_;
        behavior_task_[local] = task;
      }
    }
  }
}

/// A minimum performance connects all tasks that it may depend on, also through fixed tasks.
void Components::join_by_performance() {
  for (const LocalTask task : domains_.needed_tasks()) {
    if (has_rules(task)) join_reach_of(task);
  }
  for (const LocalTask task : open_) {
    if (has_rules(task)) join_reach_of(task);
  }
}

void Components::join_reach_of(LocalTask task) {
  ++reach_number_;
  reach_.assign(1, task);
  reached_[task] = reach_number_;
  LocalTask first_open = none;
  for (std::size_t next = 0; next < reach_.size(); ++next) {
    const LocalTask member = reach_[next];
    if (is_open(member)) {
      if (first_open == none) first_open = member;
      join(first_open, member);
    }
    for (const Arc& arc : catalog_.arcs[domains_.first_task() + member]) {
      const LocalTask target = arc.target - domains_.first_task();
      if (reached_[target] == reach_number_ || !may_use(member, arc)) continue;
      reached_[target] = reach_number_;
      reach_.push_back(target);
    }
  }
}

void Components::join(LocalTask a, LocalTask b) { joined_to_[root_of(a)] = root_of(b); }

LocalTask Components::root_of(LocalTask task) {
  while (joined_to_[task] != task) {
    joined_to_[task] = joined_to_[joined_to_[task]];
    task = joined_to_[task];
  }
  return task;
}

}  // namespace cbc
