#include "compile/compile.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "compiled/compiled_catalog.h"
#include "support/graph.h"

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

namespace {

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
    add_topological_order();
    return to_catalog(std::move(out_));
  }

 private:
  [[nodiscard]] std::size_t task_count() const { return catalog_.tasks.size(); }
  [[nodiscard]] std::size_t behavior_count() const { return catalog_.behaviors.size(); }
  [[nodiscard]] const Behavior& behavior(BehaviorId id) const {
    return catalog_.behaviors[out_.behaviors[id].catalog_index];
  }

  void add_names() {
    out_.task_count = task_count();
    out_.behavior_count = behavior_count();
    for (const Task& task : catalog_.tasks) out_.texts.add_row(task.name);
    for (const Behavior& one : catalog_.behaviors) out_.texts.add_row(one.name);
    out_.tasks_by_name = sort_by_name(catalog_.tasks);
    out_.behaviors_by_name = sort_by_name(catalog_.behaviors);
    add_text(catalog_.file);
    for (const Behavior& one : catalog_.behaviors) {
      out_.behavior_packages.push_back(add_text(one.package));
    }
    for (const Task& task : catalog_.tasks) add_parameters(task.parameters);
  }

  template <typename Entry>
  static std::vector<std::uint32_t> sort_by_name(const std::vector<Entry>& entries) {
    std::vector<std::uint32_t> places(entries.size());
    std::iota(places.begin(), places.end(), 0U);
    std::sort(places.begin(), places.end(),
              [&](std::uint32_t a, std::uint32_t b) { return entries[a].name < entries[b].name; });
    return places;
  }

  TextId add_text(std::string_view text) {
    const auto [entry, is_new] =
        text_ids_.try_emplace(text, static_cast<TextId>(out_.texts.size()));
    if (is_new) out_.texts.add_row(text);
    return entry->second;
  }

  void add_parameters(const std::vector<Parameter>& parameters) {
    for (const Parameter& from : parameters) {
      CompiledParameter to;
      to.name = add_text(from.name);
      to.allowed_is_list = from.allowed_is_list ? 1 : 0;
      to.first_allowed = static_cast<std::uint32_t>(out_.allowed_values.size());
      to.allowed_count = static_cast<std::uint32_t>(from.allowed_values.size());
      for (const std::string& text : from.allowed_values) {
        out_.allowed_values.push_back(add_text(text));
      }
      out_.parameters.items.push_back(to);
    }
    out_.parameters.close_row();
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
      task.start_on_request = from.start_on_request ? 1 : 0;
      task.reactive_start = from.reactive_start ? 1 : 0;
      task.keep_running = from.execution_goal == ExecutionGoal::keep_running ? 1 : 0;
      task.has_performance_rules = from.minimum_performance > 0 ? 1 : 0;
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
    std::vector<const Requirement*>& row = requirement_row_;
    row.clear();
    for (const Requirement& requirement : from.requirements) row.push_back(&requirement);
    const auto task_of = [&](const Requirement* requirement) {
      return out_.task_ids[requirement->task];
    };
    std::sort(row.begin(), row.end(), [&](const Requirement* a, const Requirement* b) {
      if (task_of(a) != task_of(b)) return task_of(a) < task_of(b);
      if (a->minimum_performance != b->minimum_performance) {
        return a->minimum_performance > b->minimum_performance;
      }
      return a < b;  // the earlier one
    });
    row.erase(std::unique(row.begin(), row.end(),
                          [&](const Requirement* a, const Requirement* b) {
                            return task_of(a) == task_of(b);
                          }),
              row.end());
    for (const Requirement* requirement : row) {
      CompiledRequirement to;
      to.task = task_of(requirement);
      to.minimum_performance = requirement->minimum_performance;
      to.minimum_cost = costs_.of(requirement->minimum_performance);
      out_.requirements.items.push_back(to);
      out_.requirement_lines.push_back(requirement->range.begin.line);
    }
    out_.requirements.close_row();
  }

  void add_values() {
    std::vector<Value> values;  // by behavior
    std::vector<TaskId> tasks;  // of each of them
    for (BehaviorId id = 0; id < behavior_count(); ++id) {
      for (const Performance& performance : behavior(id).performs) {
        Value value;
        value.behavior = id;
        value.suitability = performance.suitability;
        value.cost = costs_.of(performance.suitability);
        values.push_back(value);
        tasks.push_back(out_.task_ids[performance.task]);
      }
    }
    const Grouping by_task = group_by(tasks, task_count());
    out_.values.begin = by_task.begin;
    for (const std::uint32_t place : by_task.order) {
      out_.values.items.push_back(values[place]);
      out_.value_tasks.push_back(tasks[place]);
    }
    out_.words.push_back(0);
    for (TaskId task = 0; task < task_count(); ++task) {
      const std::uint32_t first = by_task.begin[task];
      const std::uint32_t end = by_task.begin[task + 1];
      std::sort(out_.values.items.begin() + first, out_.values.items.begin() + end,
                [](const Value& a, const Value& b) {
                  return a.suitability != b.suitability ? a.suitability > b.suitability
                                                        : a.behavior < b.behavior;
                });
      out_.words.push_back(out_.words.back() + (end - first + 63) / 64);
    }
    std::vector<BehaviorId> behaviors;
    for (const Value& value : out_.values.items) behaviors.push_back(value.behavior);
    Grouping by_behavior = group_by(behaviors, behavior_count());
    out_.performs = {std::move(by_behavior.begin), std::move(by_behavior.order)};
  }

  void add_arcs() {
    std::vector<std::uint32_t> arc_to(task_count(), none);
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
          }
          out_.masks[out_.arcs.items[number].mask + place / 64] |= std::uint64_t{1} << (place % 64);
          if (requirement.minimum_performance > 0) out_.tasks[task].has_performance_rules = 1;
        }
      }
      out_.arcs.close_row();
    }
    std::vector<TaskId> targets;
    for (const Arc& arc : out_.arcs.items) targets.push_back(arc.target);
    Grouping by_target = group_by(targets, task_count());
    out_.incoming = {std::move(by_target.begin), std::move(by_target.order)};
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

    std::vector<std::uint32_t> clique_of;  // by place in the cliques
    for (const Clique& clique : cliques) {
      clique_of.insert(clique_of.end(), clique.tasks.size(),
                       static_cast<std::uint32_t>(out_.cliques.size()));
      out_.cliques.add_row(clique.tasks);
      out_.clique_lines.push_back(clique.line);
    }
    Grouping by_task = group_by(out_.cliques.items, task_count());
    out_.task_cliques.begin = std::move(by_task.begin);
    for (const std::uint32_t place : by_task.order) {
      out_.task_cliques.items.push_back(clique_of[place]);
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

  void add_topological_order() {
    out_.topological_order.resize(task_count());
    std::iota(out_.topological_order.begin(), out_.topological_order.end(), TaskId{0});
    std::stable_sort(out_.topological_order.begin(), out_.topological_order.end(),
                     [&](TaskId a, TaskId b) {
                       const CompiledTask& first = out_.tasks[a];
                       const CompiledTask& second = out_.tasks[b];
                       return first.group != second.group ? first.group < second.group
                                                          : first.level < second.level;
                     });
  }

  const Catalog& catalog_;
  CatalogArrays out_;
  std::unordered_map<std::string_view, TextId> text_ids_;  ///< but for names
  KnownCosts costs_;
  std::vector<const Requirement*> requirement_row_;  ///< of a behavior; kept for its memory
  std::vector<std::uint32_t> group_of_task_;         ///< by TaskIndex
  std::vector<TaskIndex> task_order_;                ///< by TaskId
  std::vector<BehaviorIndex> behavior_order_;        ///< by BehaviorId
};

}  // namespace

CompiledCatalog compile(const Catalog& catalog) { return Compiler(catalog).run(); }

}  // namespace cbc
