#include "verify/engine/fault_tree.h"

#include <algorithm>
#include <span>

#include "runtime/base/text.h"
#include "runtime/solver/objective.h"

namespace cbc {
namespace {

using TreeNode = FaultTree::Node;
/// The tasks below a task, itself included, with the values that can be part of an assignment as
/// far as requirements alone tell.
class Cone {
 public:
  Cone(const CompiledCatalog& catalog, TaskId top, const std::vector<bool>& ruled_out)
      : catalog_(catalog), values_(catalog.tasks.size()), is_in_(catalog.tasks.size(), false) {
    const std::uint32_t group = catalog.tasks[top].group;
    const std::span<const TaskId> order = catalog.topological_order.subspan(
        catalog.group_tasks[group], catalog.group_tasks[group + 1] - catalog.group_tasks[group]);
    for (const TaskId task : order) {
      for (const Value& value : catalog.values[task]) {
        const auto& required = catalog.requirements[value.behavior];
        if (!ruled_out[value.behavior] &&
            std::all_of(required.begin(), required.end(),
                        [this](const auto& rule) { return can_run(rule.task); })) {
          values_[task].push_back(&value);
        }
      }
    }
    if (!can_run(top)) return;
    is_in_[top] = true;
    for (std::size_t place = order.size(); place-- > 0;) {
      const TaskId task = order[place];
      if (!is_in_[task]) continue;
      tasks_.push_back(task);
      for (const Value* value : values_[task]) {
        for (const CompiledRequirement& rule : catalog.requirements[value->behavior]) {
          is_in_[rule.task] = true;
        }
      }
    }
  }

  /// Each before what its behaviors require; so the top comes first. Empty if it cannot run.
  [[nodiscard]] const std::vector<TaskId>& tasks() const { return tasks_; }
  [[nodiscard]] bool contains(TaskId task) const { return is_in_[task]; }
  [[nodiscard]] const std::vector<const Value*>& values(TaskId task) const { return values_[task]; }

  /// The task and all below it.
  [[nodiscard]] std::vector<TaskId> below(TaskId task) const {
    std::vector<TaskId> found{task};
    std::vector<bool> is_found(catalog_.tasks.size(), false);
    is_found[task] = true;
    for (std::size_t next = 0; next < found.size(); ++next) {
      for (const Value* value : values_[found[next]]) {
        for (const CompiledRequirement& rule : catalog_.requirements[value->behavior]) {
          if (is_found[rule.task]) continue;
          is_found[rule.task] = true;
          found.push_back(rule.task);
        }
      }
    }
    return found;
  }

 private:
  [[nodiscard]] bool can_run(TaskId task) const { return !values_[task].empty(); }

  const CompiledCatalog& catalog_;
  std::vector<std::vector<const Value*>> values_;  ///< by task
  std::vector<bool> is_in_;                        ///< by task
  std::vector<TaskId> tasks_;
};

/// Marks the tasks of a cone that an exclusivity may stop: it can happen that the top needs them
/// and a task that they exclude at once. It errs on the side of too many.
///
/// If one choice of behaviors needs both `a` and `b`, follow the requirements from the top down to
/// each of them. The last task that both paths have is `a`, with `b` below it, or the other way
/// round; or its behavior requires two tasks, with `a` at or below one and `b` at or below the
/// other.
class ExclusionMarks {
 public:
  ExclusionMarks(const CompiledCatalog& catalog, const Cone& cone, std::vector<bool>& marks)
      : catalog_(catalog), cone_(cone), marks_(marks), columns_(catalog.tasks.size(), none) {}

  void find() {
    number_columns();
    if (lists_.empty()) return;
    find_reach();
    for (const TaskId task : cone_.tasks()) {
      if (columns_[task] != none) compare_with_tasks_below(task);
      for (const Value* value : cone_.values(task)) {
        const auto& required = catalog_.requirements[value->behavior];
        if (required.size() < 2) continue;
        for (const std::vector<TaskId>& list : lists_) compare(required, list);
      }
    }
  }

 private:
  /// Tasks of the cone that exclude others of it get a bit each.
  void number_columns() {
    for (std::size_t clique = 0; clique < catalog_.cliques.size(); ++clique) {
      std::vector<TaskId> list;
      for (const TaskId task : catalog_.cliques[clique]) {
        if (cone_.contains(task)) list.push_back(task);
      }
      if (list.size() < 2) continue;
      for (const TaskId task : list) {
        if (columns_[task] == none) columns_[task] = column_count_++;
      }
      lists_.push_back(std::move(list));
    }
  }

  void find_reach() {
    words_ = column_count_ / 64 + 1;
    reach_.resize(catalog_.tasks.size());
    for (auto task = cone_.tasks().rbegin(); task != cone_.tasks().rend(); ++task) {
      std::vector<std::uint64_t>& reach = reach_[*task];
      reach.assign(words_, 0);
      const std::uint32_t column = columns_[*task];
      if (column != none) reach[column / 64] |= std::uint64_t{1} << (column % 64);
      for (const Value* value : cone_.values(*task)) {
        for (const CompiledRequirement& rule : catalog_.requirements[value->behavior]) {
          for (std::size_t word = 0; word < words_; ++word) reach[word] |= reach_[rule.task][word];
        }
      }
    }
  }

  [[nodiscard]] bool reaches(TaskId task, TaskId other) const {
    const std::uint32_t column = columns_[other];
    return (reach_[task][column / 64] >> (column % 64) & 1) != 0;
  }

  void compare_with_tasks_below(TaskId task) {
    for (const std::vector<TaskId>& list : lists_) {
      if (std::find(list.begin(), list.end(), task) == list.end()) continue;
      for (const TaskId other : list) {
        if (other != task && reaches(task, other)) marks_[task] = marks_[other] = true;
      }
    }
  }

  /// Two required tasks may reach two different tasks of the list.
  void compare(std::span<const CompiledRequirement> required, const std::vector<TaskId>& list) {
    for (std::size_t i = 0; i < required.size(); ++i) {
      for (std::size_t j = i + 1; j < required.size(); ++j) {
        mark_pairs(required[i].task, required[j].task, list);
      }
    }
  }

  void mark_pairs(TaskId left, TaskId right, const std::vector<TaskId>& list) {
    for (const TaskId a : list) {
      if (!reaches(left, a)) continue;
      for (const TaskId b : list) {
        if (a != b && reaches(right, b)) marks_[a] = marks_[b] = true;
      }
    }
  }

  const CompiledCatalog& catalog_;
  const Cone& cone_;
  std::vector<bool>& marks_;
  std::vector<std::uint32_t> columns_;  ///< by task: its bit, or none
  std::uint32_t column_count_ = 0;
  std::vector<std::vector<TaskId>> lists_;  ///< the exclusivity lists, within the cone
  std::size_t words_ = 0;
  std::vector<std::vector<std::uint64_t>> reach_;  ///< by task: bits of itself and those below it
};

/// The minimum performances in a cone that some choice of behaviors may miss.
class Minimums {
 public:
  Minimums(const CompiledCatalog& catalog, const Cone& cone)
      : cone_(cone), may_fail_(catalog.tasks.size(), false) {
    std::vector<Millionths> strongest(catalog.tasks.size(), 0);
    for (const TaskId task : cone.tasks()) {
      strongest[task] = std::max(strongest[task], catalog.tasks[task].minimum_performance);
      for (const Value* value : cone.values(task)) {
        for (const CompiledRequirement& rule : catalog.requirements[value->behavior]) {
          strongest[rule.task] = std::max(strongest[rule.task], rule.minimum_performance);
        }
      }
    }
    for (const TaskId task : cone.tasks()) {
      may_fail_[task] = strongest[task] > 0 && is_missed_at_worst(task, strongest[task]);
    }
  }

  /// Whether a minimum performance of the task may not be reached.
  [[nodiscard]] bool may_fail(TaskId task) const { return may_fail_[task]; }

  /// Marks the tasks whose behavior makes a difference to such a minimum.
  void mark(std::vector<bool>& marks) const {
    for (const TaskId task : cone_.tasks()) {
      if (!may_fail_[task]) continue;
      for (const TaskId below : cone_.below(task)) {
        if (least_suitability(below) < one_million) marks[below] = true;
      }
    }
  }

 private:
  /// With everything below, each with its least suitable behavior.
  [[nodiscard]] bool is_missed_at_worst(TaskId task, Millionths minimum) const {
    ExactProduct worst;
    for (const TaskId below : cone_.below(task)) worst.multiply(least_suitability(below));
    ExactProduct limit;
    limit.multiply(minimum);
    return ExactProduct::compare(worst, limit) < 0;
  }

  [[nodiscard]] Millionths least_suitability(TaskId task) const {
    return cone_.values(task).back()->suitability;  // values are in rank order
  }

  const Cone& cone_;
  std::vector<bool> may_fail_;  ///< by task
};

/// Enumerates the choices of behaviors for the tangled tasks that the top needs, depth first from
/// the top down.
class WaySearch {
 public:
  /// `tangled`: by task, whether its behavior must be chosen; of the others none can break a
  /// constraint.
  WaySearch(const CompiledCatalog& catalog, const Cone& cone, const std::vector<bool>& tangled,
            const Minimums& minimums, const FaultTreeLimits& limits)
      : catalog_(catalog),
        cone_(cone),
        minimums_(minimums),
        limits_(limits),
        needed_(catalog.tasks.size(), 0),
        chosen_(catalog.tasks.size(), nullptr),
        running_(catalog.cliques.size(), 0) {
    for (const TaskId task : cone.tasks()) {
      if (tangled[task]) tasks_.push_back(task);
    }
  }

  /// The inputs of each way; false if they are too many.
  [[nodiscard]] bool find(std::vector<std::vector<TreeNode>>& ways) {
    need(tasks_.front());
    stack_.push_back({});
    while (!stack_.empty()) {
      if (++steps_ > limits_.steps) return false;
      Choice& choice = stack_.back();
      const TaskId task = tasks_[choice.place];
      if (chosen_[task] != nullptr) take_back(task);
      if (choice.next == cone_.values(task).size()) {
        stack_.pop_back();
        continue;
      }
      take(task, cone_.values(task)[choice.next++]);
      if (conflicts_ > 0) continue;
      std::size_t place = choice.place + 1;
      while (place < tasks_.size() && needed_[tasks_[place]] == 0) ++place;
      if (place < tasks_.size()) {
        stack_.push_back({place});
      } else if (reaches_minimums()) {
        ways.push_back(inputs());
        inputs_ += ways.back().size();
        if (inputs_ > limits_.inputs) return false;
      }
    }
    return true;
  }

 private:
  struct Choice {
    std::size_t place = 0;  ///< of the task
    std::size_t next = 0;   ///< value to be tried
  };

  void need(TaskId task) {
    if (needed_[task]++ > 0) return;
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      if (++running_[clique] > 1) ++conflicts_;
    }
  }

  void take(TaskId task, const Value* value) {
    chosen_[task] = value;
    for (const CompiledRequirement& rule : catalog_.requirements[value->behavior]) need(rule.task);
  }

  void take_back(TaskId task) {
    for (const CompiledRequirement& rule : catalog_.requirements[chosen_[task]->behavior]) {
      if (--needed_[rule.task] > 0) continue;
      for (const std::uint32_t clique : catalog_.task_cliques[rule.task]) {
        if (--running_[clique] > 0) --conflicts_;
      }
    }
    chosen_[task] = nullptr;
  }

  [[nodiscard]] bool reaches_minimums() {
    return std::all_of(stack_.begin(), stack_.end(), [this](const Choice& choice) {
      const TaskId task = tasks_[choice.place];
      if (!reaches(task, catalog_.tasks[task].minimum_performance)) return false;
      const auto& required = catalog_.requirements[chosen_[task]->behavior];
      return std::all_of(required.begin(), required.end(), [this](const auto& rule) {
        return reaches(rule.task, rule.minimum_performance);
      });
    });
  }

  /// Where a minimum may fail, all tasks below that are not tangled have suitability 1.
  [[nodiscard]] bool reaches(TaskId task, Millionths minimum) {
    if (minimum == 0 || !minimums_.may_fail(task)) return true;
    std::vector<TaskId> counted{task};
    ExactProduct performance;
    for (std::size_t next = 0; next < counted.size(); ++next) {
      ++steps_;
      const Value& value = *chosen_[counted[next]];
      performance.multiply(value.suitability);
      for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
        if (chosen_[rule.task] == nullptr ||
            std::find(counted.begin(), counted.end(), rule.task) != counted.end()) {
          continue;
        }
        counted.push_back(rule.task);
      }
    }
    ExactProduct limit;
    limit.multiply(minimum);
    return ExactProduct::compare(performance, limit) >= 0;
  }

  [[nodiscard]] std::vector<TreeNode> inputs() const {
    std::vector<TreeNode> found;
    for (const Choice& choice : stack_) {
      const BehaviorId behavior = chosen_[tasks_[choice.place]]->behavior;
      found.push_back({TreeNode::Kind::fault, behavior});
      for (const CompiledRequirement& rule : catalog_.requirements[behavior]) {
        if (chosen_[rule.task] == nullptr) found.push_back({TreeNode::Kind::task, rule.task});
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  const CompiledCatalog& catalog_;
  const Cone& cone_;
  const Minimums& minimums_;
  const FaultTreeLimits limits_;
  std::vector<TaskId> tasks_;           ///< the tangled ones, each before those that it requires
  std::vector<std::uint32_t> needed_;   ///< by task: by how many of the chosen values
  std::vector<const Value*> chosen_;    ///< by task: null if none is chosen
  std::vector<std::uint32_t> running_;  ///< by clique: its needed tasks
  std::uint32_t conflicts_ = 0;         ///< needed tasks beyond the first of each clique
  std::vector<Choice> stack_;
  std::uint64_t steps_ = 0;
  std::uint64_t inputs_ = 0;
};

/// By task: whether its behavior, or that of a task below it, makes a difference to an exclusivity
/// or a minimum performance.
std::vector<bool> find_tangled(const CompiledCatalog& catalog, const Cone& cone,
                               const Minimums& minimums) {
  std::vector<bool> marks(catalog.tasks.size(), false);
  ExclusionMarks(catalog, cone, marks).find();
  minimums.mark(marks);
  for (auto task = cone.tasks().rbegin(); task != cone.tasks().rend(); ++task) {
    for (const Value* value : cone.values(*task)) {
      for (const CompiledRequirement& rule : catalog.requirements[value->behavior]) {
        if (marks[rule.task]) marks[*task] = true;
      }
    }
  }
  return marks;
}

/// Adds the gates of tasks that are not tangled, as far as others have them as inputs, and of their
/// behaviors.
class PlainGates {
 public:
  PlainGates(const CompiledCatalog& catalog, const Cone& cone, FaultTree& tree)
      : catalog_(catalog),
        cone_(cone),
        tree_(tree),
        is_input_(catalog.tasks.size(), false),
        has_gate_(catalog.behaviors.size(), false) {}

  void add() {
    if (tree_.gates.empty()) is_input_[tree_.task] = true;
    for (const FaultTree::Gate& gate : tree_.gates) {
      for (const TreeNode& input : gate.inputs) {
        if (input.kind == TreeNode::Kind::task) is_input_[input.number] = true;
      }
    }
    for (const TaskId task : cone_.tasks()) {
      if (is_input_[task]) add_task(task);
    }
  }

 private:
  void add_task(TaskId task) {
    FaultTree::Gate gate{{TreeNode::Kind::task, task}, true, {}};
    for (const Value* value : cone_.values(task)) {
      const bool is_leaf = catalog_.requirements[value->behavior].empty();
      gate.inputs.push_back(
          {is_leaf ? TreeNode::Kind::fault : TreeNode::Kind::behavior, value->behavior});
    }
    std::sort(gate.inputs.begin(), gate.inputs.end(),
              [](const TreeNode& a, const TreeNode& b) { return a.number < b.number; });
    tree_.gates.push_back(gate);
    for (const TreeNode& input : gate.inputs) {
      if (input.kind == TreeNode::Kind::behavior) add_behavior(input.number);
    }
  }

  void add_behavior(BehaviorId behavior) {
    if (has_gate_[behavior]) return;
    has_gate_[behavior] = true;
    FaultTree::Gate gate{
        {TreeNode::Kind::behavior, behavior}, false, {{TreeNode::Kind::fault, behavior}}};
    for (const CompiledRequirement& rule : catalog_.requirements[behavior]) {
      gate.inputs.push_back({TreeNode::Kind::task, rule.task});
      is_input_[rule.task] = true;
    }
    tree_.gates.push_back(std::move(gate));
  }

  const CompiledCatalog& catalog_;
  const Cone& cone_;
  FaultTree& tree_;
  std::vector<bool> is_input_;  ///< by task
  std::vector<bool> has_gate_;  ///< by behavior
};

void collect_faults(FaultTree& tree) {
  for (const FaultTree::Gate& gate : tree.gates) {
    for (const TreeNode& input : gate.inputs) {
      if (input.kind == TreeNode::Kind::fault) tree.faults.push_back(input.number);
    }
  }
  std::sort(tree.faults.begin(), tree.faults.end());
  tree.faults.erase(std::unique(tree.faults.begin(), tree.faults.end()), tree.faults.end());
}

}  // namespace

std::variant<FaultTree, std::string> make_fault_tree(const CompiledCatalog& catalog, TaskId task,
                                                     const std::vector<bool>& ruled_out,
                                                     const FaultTreeLimits& limits) {
  FaultTree tree;
  tree.task = task;
  const Cone cone(catalog, task, ruled_out);
  if (cone.tasks().empty()) return tree;
  const Minimums minimums(catalog, cone);
  const std::vector<bool> tangled = find_tangled(catalog, cone, minimums);
  if (tangled[task]) {
    std::vector<std::vector<TreeNode>> ways;
    if (!WaySearch(catalog, cone, tangled, minimums, limits).find(ways)) {
      return concat("exclusivity and minimum performances leave too many ways to run task ",
                    quote(catalog.name_of_task(task)), " for a fault tree");
    }
    if (ways.empty()) return tree;
    tree.ways = ways.size();
    FaultTree::Gate& top =
        tree.gates.emplace_back(FaultTree::Gate{{TreeNode::Kind::task, task}, true, {}});
    for (std::uint32_t way = 0; way < ways.size(); ++way) {
      top.inputs.push_back({TreeNode::Kind::way, way});
    }
    for (std::uint32_t way = 0; way < ways.size(); ++way) {
      tree.gates.push_back({{TreeNode::Kind::way, way}, false, std::move(ways[way])});
    }
  }
  PlainGates(catalog, cone, tree).add();
  collect_faults(tree);
  return tree;
}

}  // namespace cbc
