// Partial evaluation by hand: all that an event would otherwise compute and that depends on the
// catalog alone is computed here, once. Names become numbers, so that the tasks of a group, and the
// values of a task, are next to each other, and everything about them is a range of flat arrays, in
// which rows of different lengths follow one another. The compiler fills in what the catalog says;
// what follows from it (levels, arcs, inverse relations) comes from runtime/compiled/derive.cpp,
// with which compiled files are verified, too.
//
// To solve on the symbolic catalog would spare the second form. But then each event would work out
// the same things again, and a robot would have to parse YAML. To compile further, into a table of
// the best answers, is out of the question: there are as many problems as states and events.

#include "core/compile/compile.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "runtime/base/disjoint_sets.h"
#include "runtime/base/natural.h"

namespace cbc {
namespace {

class Compiler {
 public:
  Compiler(const Catalog& catalog, KnownCosts& costs) : catalog_(catalog), costs_(costs) {}

  CompiledCatalog run() && {
    add_names();
    add_groups();
    add_tasks();
    add_behaviors();
    add_values();
    add_cliques();
    add_limits();
    add_situation();
    add_rules();
    derive_rest(out_);
    return to_catalog(std::move(out_));
  }

 private:
  [[nodiscard]] std::size_t task_count() const { return catalog_.tasks.size(); }
  [[nodiscard]] std::size_t behavior_count() const { return catalog_.behaviors.size(); }

  void add_names() {
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
    DisjointSets connected(task_count());
    std::vector<TaskIndex> first_tasks;
    for (const Behavior& one : catalog_.behaviors) {
      const TaskIndex first = first_tasks.emplace_back(one.performs.front().task);
      for (const Performance& performance : one.performs) connected.join(first, performance.task);
      for (const Requirement& required : one.requirements) connected.join(first, required.task);
    }
    for (const ExclusivityList& list : catalog_.exclusivity) {
      for (const TaskIndex task : list.tasks) connected.join(list.tasks.front(), task);
    }
    derive_groups(out_, connected, first_tasks);
  }

  void add_tasks() {
    out_.tasks.resize(task_count());
    for (TaskIndex index = 0; index < task_count(); ++index) {
      const Task& from = catalog_.tasks[index];
      CompiledTask& task = out_.tasks[out_.task_ids[index]];
      task.minimum_performance = from.minimum_performance;
      task.minimum_cost = costs_.of(from.minimum_performance);
      task.minimum_line = from.minimum_performance_range.begin.line;
      task.timeout = from.timeout.value_or(0);
      task.start_on_request = from.start_on_request ? 1 : 0;
      task.reactive_start = from.reactive_start ? 1 : 0;
      task.keep_running = from.execution_goal == ExecutionGoal::keep_running ? 1 : 0;
    }
  }

  void add_behaviors() {
    out_.behaviors.resize(behavior_count());
    by_id_.resize(behavior_count());
    for (BehaviorIndex index = 0; index < behavior_count(); ++index) {
      const Behavior& from = catalog_.behaviors[index];
      const BehaviorId id = out_.behavior_ids[index];
      out_.behaviors[id].timeout = from.timeout.value_or(0);
      by_id_[id] = &from;
    }
    for (const Behavior* from : by_id_) add_requirements(*from);
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

  /// In rank order.
  void add_values() {
    std::vector<std::vector<Value>> rows(task_count());
    for (BehaviorId id(0); id < behavior_count(); ++id) {
      for (const Performance& performance : by_id_[id]->performs) {
        Value& value = rows[out_.task_ids[performance.task]].emplace_back();
        value.behavior = id;
        value.suitability = performance.suitability;
        value.cost = costs_.of(performance.suitability);
      }
    }
    for (std::vector<Value>& row : rows) {
      std::stable_sort(row.begin(), row.end(), [](const Value& a, const Value& b) {
        return a.suitability > b.suitability;
      });
      out_.values.add_row(row);
    }
  }

  void add_cliques() {
    struct Clique {
      std::vector<TaskId> tasks;
      std::uint32_t line = 0;
      bool operator<(const Clique& other) const {
        return std::tie(tasks, line) < std::tie(other.tasks, other.line);
      }
    };
    std::vector<Clique> cliques;
    for (const ExclusivityList& list : catalog_.exclusivity) {
      if (list.at_most > 1) continue;
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

    for (const Clique& clique : cliques) {
      out_.cliques.add_row(clique.tasks);
      out_.clique_lines.push_back(clique.line);
    }
  }

  void add_limits() {
    for (const ExclusivityList& list : catalog_.exclusivity) {
      if (list.at_most == 1) continue;
      std::vector<TaskId> tasks;
      for (const TaskIndex task : distinct_tasks(list)) tasks.push_back(out_.task_ids[task]);
      if (tasks.size() < 2) continue;
      std::sort(tasks.begin(), tasks.end());
      out_.limits.push_back({list.at_most, list.range.begin.line});
      out_.limited.add_row(tasks);
    }
    if (out_.limits.empty()) out_.limited.begin.clear();
  }

  /// Only where a key is used.
  void add_rules() {
    if (std::any_of(catalog_.tasks.begin(), catalog_.tasks.end(),
                    [](const Task& task) { return task.rules != TaskRules(); })) {
      out_.task_rules.resize(task_count());
      out_.improve_lines.resize(task_count());
      for (TaskIndex index = 0; index < task_count(); ++index) {
        const TaskId id = out_.task_ids[index];
        out_.task_rules[id] = catalog_.tasks[index].rules;
        out_.improve_lines[id] = catalog_.tasks[index].improve_range.begin.line;
      }
    }
    if (std::any_of(by_id_.begin(), by_id_.end(),
                    [](const Behavior* one) { return one->retry != Retry::at_events; })) {
      for (const Behavior* one : by_id_) {
        out_.retries.push_back(one->retry);
        out_.retry_lines.push_back(one->retry_range.begin.line);
      }
    }
  }

  void add_situation() {
    for (const Variable& from : catalog_.variables) {
      CompiledVariable to;
      to.name = add_text(from.name);
      to.is_boolean = from.is_boolean ? 1 : 0;
      to.first_value = static_cast<std::uint32_t>(out_.variable_values.size());
      to.value_count = static_cast<std::uint32_t>(from.values.size());
      for (const std::string& text : from.values) out_.variable_values.push_back(add_text(text));
      out_.variables.push_back(to);
    }
    for (BehaviorId id(0); id < behavior_count(); ++id) {
      for (const Condition& condition : by_id_[id]->situation) {
        for (const std::uint32_t value : condition.values) {
          out_.fitting_values.push_back({id, condition.variable, value});
        }
      }
    }
    std::sort(out_.fitting_values.begin(), out_.fitting_values.end());
  }

  const Catalog& catalog_;
  GrowingCatalog out_;
  std::unordered_map<std::string_view, TextId> text_ids_;  ///< except names
  KnownCosts& costs_;
  std::vector<const Requirement*> requirement_row_;  ///< of a behavior; kept for its memory
  std::vector<const Behavior*> by_id_;
};

}  // namespace

CompiledCatalog compile(const Catalog& catalog) {
  KnownCosts costs;
  return compile(catalog, costs);
}

CompiledCatalog compile(const Catalog& catalog, KnownCosts& costs) {
  return Compiler(catalog, costs).run();
}

std::string search_space(const std::vector<std::uint32_t>& domain_sizes) {
  Natural product;
  for (const std::uint32_t size : domain_sizes) {
    if (size != 1) product.multiply(size);
  }
  return product.digits();
}

namespace {

/// Counts the distinct pairs of tasks that share a clique.
class PairCounter {
 public:
  explicit PairCounter(const CompiledCatalog& catalog)
      : catalog_(catalog), seen_(catalog.tasks.size(), none) {}

  /// In one group. Tasks that are in the same cliques exclude the same tasks (and each other), so
  /// that these are counted once for all of them.
  std::uint64_t count(GroupId group) {
    tasks_.resize(catalog_.group_tasks[group + 1] - catalog_.group_tasks[group]);
    std::iota(tasks_.begin(), tasks_.end(), catalog_.group_tasks[group]);
    std::sort(tasks_.begin(), tasks_.end(), [this](TaskId a, TaskId b) {
      const auto first = catalog_.task_cliques[a];
      const auto second = catalog_.task_cliques[b];
      return std::lexicographical_compare(first.begin(), first.end(), second.begin(), second.end());
    });
    std::uint64_t ends_of_pairs = 0;
    for (auto alike = tasks_.begin(); alike != tasks_.end();) {
      const auto end = std::find_if_not(alike, tasks_.end(),
                                        [&](TaskId task) { return are_in_the_same(*alike, task); });
      ends_of_pairs += static_cast<std::uint64_t>(end - alike) * count_excluded(*alike);
      alike = end;
    }
    return ends_of_pairs / 2;
  }

 private:
  [[nodiscard]] bool are_in_the_same(TaskId a, TaskId b) const {
    const auto first = catalog_.task_cliques[a];
    const auto second = catalog_.task_cliques[b];
    return std::equal(first.begin(), first.end(), second.begin(), second.end());
  }

  /// Number of tasks that share a clique with `task`.
  std::uint64_t count_excluded(TaskId task) {
    std::uint64_t count = 0;
    seen_[task] = task;
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      for (const TaskId other : catalog_.cliques[clique]) {
        if (seen_[other] == task) continue;
        seen_[other] = task;
        ++count;
      }
    }
    return count;
  }

  const CompiledCatalog& catalog_;
  std::vector<TaskId> seen_;   ///< by task: the last one that was found to exclude it
  std::vector<TaskId> tasks_;  ///< of a group, those in the same cliques side by side
};

void add(ConstraintCount& sum, const ConstraintCount& count) {
  sum.exclusive_pairs += count.exclusive_pairs;
  sum.requirements += count.requirements;
  sum.task_minimums += count.task_minimums;
  sum.limits += count.limits;
}

}  // namespace

CatalogSummary summarize(const CompiledCatalog& catalog) {
  CatalogSummary summary;
  PairCounter pairs(catalog);
  std::vector<std::uint32_t> all_sizes;
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    CatalogNumbers& numbers = summary.groups.emplace_back();
    const TaskId begin = catalog.group_tasks[group];
    const TaskId end = catalog.group_tasks[group + 1];
    const BehaviorId first_behavior = catalog.group_behaviors[group];
    const BehaviorId end_of_behaviors = catalog.group_behaviors[group + 1];
    numbers.tasks = end - begin;
    numbers.behaviors = end_of_behaviors - first_behavior;
    numbers.constraints.exclusive_pairs = pairs.count(group);
    for (BehaviorId behavior = first_behavior; behavior < end_of_behaviors; ++behavior) {
      numbers.constraints.requirements += catalog.requirements[behavior].size();
    }
    std::vector<std::uint32_t> sizes;
    for (TaskId task = begin; task < end; ++task) {
      numbers.levels = std::max(numbers.levels, 1 + catalog.tasks[task].level);
      if (catalog.tasks[task].minimum_performance > 0) ++numbers.constraints.task_minimums;
      numbers.constraints.limits += limits_from(catalog, task).size();
      sizes.push_back(static_cast<std::uint32_t>(1 + catalog.values[task].size()));
      numbers.task_names.emplace_back(catalog.name_of_task(task));
    }
    numbers.search_space = search_space(sizes);
    all_sizes.insert(all_sizes.end(), sizes.begin(), sizes.end());
    summary.total.levels = std::max(summary.total.levels, numbers.levels);
    add(summary.total.constraints, numbers.constraints);
  }
  summary.total.tasks = catalog.tasks.size();
  summary.total.behaviors = catalog.behaviors.size();
  summary.total.search_space = search_space(all_sizes);
  return summary;
}

std::vector<std::uint32_t> limits_from(const CompiledCatalog& catalog, TaskId task) {
  std::vector<std::uint32_t> limits;
  for (const std::uint32_t limit : catalog.limits_of(task)) {
    if (catalog.limited[limit].front() == task) limits.push_back(limit);
  }
  return limits;
}

std::vector<std::uint32_t> cliques_of_group(const CompiledCatalog& catalog, std::size_t group) {
  std::vector<std::uint32_t> cliques;
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    for (const std::uint32_t clique : catalog.task_cliques[task]) {
      if (catalog.cliques[clique].front() == task) cliques.push_back(clique);
    }
  }
  return cliques;
}

}  // namespace cbc
