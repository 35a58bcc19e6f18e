#include "compiled/compile.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "compiled/count_constraints.h"
#include "compiled/log_cost.h"
#include "graph/graph.h"

namespace cbc {
namespace {

/// log_cost with a memory: catalogs have few different degrees.
class Costs {
 public:
  std::int64_t of(Millionths degree) {
    const auto [entry, is_new] = known_.try_emplace(degree, 0);
    if (is_new) entry->second = log_cost(degree);
    return entry->second;
  }

 private:
  std::unordered_map<Millionths, std::int64_t> known_;
};

/// A stable order of `count` items by `key`, and where each key begins.
struct Grouping {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
};

Grouping group_by(const std::vector<std::uint32_t>& key, std::size_t keys) {
  Grouping grouping;
  grouping.begin.assign(keys + 1, 0);
  for (const std::uint32_t k : key) ++grouping.begin[k + 1];
  std::partial_sum(grouping.begin.begin(), grouping.begin.end(), grouping.begin.begin());
  grouping.order.resize(key.size());
  std::vector<std::uint32_t> next = grouping.begin;
  for (std::uint32_t item = 0; item < key.size(); ++item) grouping.order[next[key[item]]++] = item;
  return grouping;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> position(order.size());
  for (std::uint32_t place = 0; place < order.size(); ++place) position[order[place]] = place;
  return position;
}

class Compiler {
 public:
  explicit Compiler(const Catalog& catalog) : catalog_(catalog) {}

  CompiledCatalog run() && {
    add_names();
    add_groups();
    add_tasks();
    add_behaviors();
    add_values();
    add_arcs();
    add_cliques();
    add_levels();
    out_.group_constraints = count_constraints(out_);
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::size_t task_count() const { return catalog_.tasks.size(); }
  [[nodiscard]] std::size_t behavior_count() const { return catalog_.behaviors.size(); }
  [[nodiscard]] const Behavior& behavior(BehaviorId id) const {
    return catalog_.behaviors[out_.behaviors[id].catalog_index];
  }

  void add_names() {
    out_.file = catalog_.file;
    for (const Task& task : catalog_.tasks) {
      out_.task_names.push_back(task.name);
      out_.task_parameters.push_back(task.parameters);
    }
    for (const Behavior& one : catalog_.behaviors) out_.behavior_names.push_back(one.name);
  }

  void add_groups() {
    Edges edges;
    for (const Behavior& one : catalog_.behaviors) {
      const TaskIndex first = one.performs.front().task;
      for (const Performance& performance : one.performs)
        edges.emplace_back(first, performance.task);
      for (const Requirement& requirement : one.requirements)
        edges.emplace_back(first, requirement.task);
    }
    for (const ExclusivityList& list : catalog_.exclusivity) {
      for (const TaskIndex task : list.tasks) edges.emplace_back(list.tasks.front(), task);
    }
    group_of_task_ = connected_components(task_count(), edges);
    const std::size_t groups =
        task_count() == 0 ? 0 : *std::max_element(group_of_task_.begin(), group_of_task_.end()) + 1;

    Grouping by_group = group_by(group_of_task_, groups);
    out_.group_tasks = std::move(by_group.begin);
    task_order_ = std::move(by_group.order);
    out_.task_ids = inverse(task_order_);

    std::vector<std::uint32_t> group_of_behavior;
    for (const Behavior& one : catalog_.behaviors) {
      group_of_behavior.push_back(group_of_task_[one.performs.front().task]);
    }
    by_group = group_by(group_of_behavior, groups);
    out_.group_behaviors = std::move(by_group.begin);
    behavior_order_ = std::move(by_group.order);
    out_.behavior_ids = inverse(behavior_order_);
  }

  void add_tasks() {
    for (const TaskIndex index : task_order_) {
      const Task& from = catalog_.tasks[index];
      CompiledTask task;
      task.catalog_index = index;
      task.group = group_of_task_[index];
      task.minimum_performance = from.minimum_performance;
      task.minimum_cost = costs_.of(from.minimum_performance);
      task.minimum_line = from.minimum_performance_range.begin.line;
      task.timeout = from.timeout.value_or(0);
      task.start_on_request = from.start_on_request;
      task.reactive_start = from.reactive_start;
      task.keep_running = from.execution_goal == ExecutionGoal::keep_running;
      task.has_performance_rules = from.minimum_performance > 0;
      out_.tasks.push_back(task);
    }
  }

  void add_behaviors() {
    for (const BehaviorIndex index : behavior_order_) {
      const Behavior& from = catalog_.behaviors[index];
      CompiledBehavior to;
      to.catalog_index = index;
      to.timeout = from.timeout.value_or(0);
      out_.behaviors.push_back(to);
      add_requirements(from);
    }
  }

  /// Sorted by task; of requirements of the same task the strongest is enough.
  void add_requirements(const Behavior& from) {
    std::vector<CompiledRequirement> row;
    for (const Requirement& requirement : from.requirements) {
      CompiledRequirement to;
      to.task = out_.task_ids[requirement.task];
      to.minimum_performance = requirement.minimum_performance;
      to.minimum_cost = costs_.of(requirement.minimum_performance);
      to.line = requirement.range.begin.line;
      row.push_back(to);
    }
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) {
      return a.task != b.task ? a.task < b.task : a.minimum_performance > b.minimum_performance;
    });
    row.erase(std::unique(row.begin(), row.end(),
                          [](const auto& a, const auto& b) { return a.task == b.task; }),
              row.end());
    out_.requirements.items.insert(out_.requirements.items.end(), row.begin(), row.end());
    out_.requirements.close_row();
  }

  void add_values() {
    std::vector<std::vector<Value>> values(task_count());
    for (BehaviorId id = 0; id < behavior_count(); ++id) {
      for (const Performance& performance : behavior(id).performs) {
        Value value;
        value.behavior = id;
        value.suitability = performance.suitability;
        value.cost = costs_.of(performance.suitability);
        values[out_.task_ids[performance.task]].push_back(value);
      }
    }
    std::vector<std::vector<ValueId>> performs(behavior_count());
    out_.words.push_back(0);
    for (TaskId task = 0; task < task_count(); ++task) {
      std::stable_sort(values[task].begin(), values[task].end(),
                       [](const auto& a, const auto& b) { return a.suitability > b.suitability; });
      for (const Value& value : values[task]) {
        performs[value.behavior].push_back(static_cast<ValueId>(out_.values.items.size()));
        out_.values.items.push_back(value);
        out_.value_tasks.push_back(task);
      }
      out_.values.close_row();
      out_.words.push_back(out_.words.back() +
                           static_cast<std::uint32_t>((values[task].size() + 63) / 64));
    }
    for (const std::vector<ValueId>& row : performs) {
      out_.performs.items.insert(out_.performs.items.end(), row.begin(), row.end());
      out_.performs.close_row();
    }
  }

  void add_arcs() {
    std::vector<std::uint32_t> arc_to(task_count(), none);
    std::vector<std::vector<std::uint32_t>> incoming(task_count());
    for (TaskId task = 0; task < task_count(); ++task) {
      const std::uint32_t words = out_.words[task + 1] - out_.words[task];
      const auto values = out_.values[task];
      const auto first = static_cast<std::uint32_t>(out_.arcs.items.size());
      for (std::size_t place = 0; place < values.size(); ++place) {
        for (const CompiledRequirement& requirement : out_.requirements[values[place].behavior]) {
          std::uint32_t& number = arc_to[requirement.task];
          if (number == none || number < first) {
            number = static_cast<std::uint32_t>(out_.arcs.items.size());
            const auto mask = static_cast<std::uint32_t>(out_.masks.size());
            out_.arcs.items.push_back(Arc{task, requirement.task, mask});
            out_.masks.resize(out_.masks.size() + words, 0);
            incoming[requirement.task].push_back(number);
          }
          out_.masks[out_.arcs.items[number].mask + place / 64] |= std::uint64_t{1} << (place % 64);
          if (requirement.minimum_performance > 0) out_.tasks[task].has_performance_rules = true;
        }
      }
      out_.arcs.close_row();
    }
    for (const std::vector<std::uint32_t>& row : incoming) {
      out_.incoming.items.insert(out_.incoming.items.end(), row.begin(), row.end());
      out_.incoming.close_row();
    }
  }

  void add_cliques() {
    struct Clique {
      std::vector<TaskId> tasks;
      std::uint32_t line = 0;
      auto operator<=>(const Clique&) const = default;
    };
    std::vector<Clique> cliques;
    for (const ExclusivityList& list : catalog_.exclusivity) {
      Clique clique;
      clique.line = list.range.begin.line;
      for (const TaskIndex task : list.tasks) clique.tasks.push_back(out_.task_ids[task]);
      std::sort(clique.tasks.begin(), clique.tasks.end());
      clique.tasks.erase(std::unique(clique.tasks.begin(), clique.tasks.end()), clique.tasks.end());
      if (clique.tasks.size() > 1) cliques.push_back(std::move(clique));
    }
    std::sort(cliques.begin(), cliques.end());
    cliques.erase(std::unique(cliques.begin(), cliques.end(),
                              [](const auto& a, const auto& b) { return a.tasks == b.tasks; }),
                  cliques.end());

    std::vector<std::vector<std::uint32_t>> cliques_of(task_count());
    for (const Clique& clique : cliques) {
      for (const TaskId task : clique.tasks) {
        cliques_of[task].push_back(static_cast<std::uint32_t>(out_.cliques.size()));
      }
      out_.cliques.items.insert(out_.cliques.items.end(), clique.tasks.begin(), clique.tasks.end());
      out_.cliques.close_row();
      out_.clique_lines.push_back(clique.line);
    }
    for (const std::vector<std::uint32_t>& row : cliques_of) {
      out_.task_cliques.items.insert(out_.task_cliques.items.end(), row.begin(), row.end());
      out_.task_cliques.close_row();
    }
  }

  void add_levels() {
    Edges edges;
    for (const Arc& arc : out_.arcs.items) edges.emplace_back(arc.source, arc.target);
    for (const TaskId task : reverse_topological_order(task_count(), edges)) {
      for (const Value& value : out_.values[task]) {
        std::uint32_t& level = out_.behaviors[value.behavior].level;
        for (const CompiledRequirement& requirement : out_.requirements[value.behavior]) {
          level = std::max(level, out_.tasks[requirement.task].level + 1);
        }
        out_.tasks[task].level = std::max(out_.tasks[task].level, level);
      }
    }
  }

  const Catalog& catalog_;
  CompiledCatalog out_;
  Costs costs_;
  std::vector<std::uint32_t> group_of_task_;   ///< by TaskIndex
  std::vector<TaskIndex> task_order_;          ///< by TaskId
  std::vector<BehaviorIndex> behavior_order_;  ///< by BehaviorId
};

}  // namespace

CompiledCatalog compile(const Catalog& catalog) { return Compiler(catalog).run(); }

}  // namespace cbc
