// The hitting set tree of R. Reiter, "A theory of diagnosis from first principles", Artificial
// Intelligence 32 (1987), breadth first. A support is the set of active behaviors of an assignment
// that runs the task; a cut set hits every support. A node is a set; if it misses some support, its
// children add one behavior of that support each. So each minimal cut set is reached from its
// subsets. Nodes of one size are examined together: a cut set that has none of the smaller ones in
// it is minimal. (The rule that R. Greiner, B. A. Smith and R. W. Wilkerson corrected in volume 41
// (1989), which removes branches once a smaller support appears, is not used.)
//
// To test all sets of up to k behaviors would take a search for each. Here only sets of behaviors
// from supports are looked at, and a search is needed only where a set hits all supports that are
// known. Fault trees get their cut sets from a formula of what fails by what; here there is none,
// as a task may run in more ways than anybody could write down.

#include "verify/engine/cut_sets.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

namespace cbc {
namespace {

/// Ascending.
using BehaviorSet = std::vector<BehaviorId>;

/// Finds assignments that run a task.
class SupportSearch {
 public:
  SupportSearch(const CompiledCatalog& catalog, TaskId task, const std::vector<bool>& ruled_out)
      : catalog_(catalog), first_task_(catalog.group_tasks[catalog.tasks[task].group]) {
    problem_.group = catalog.tasks[task].group;
    const TaskId end = catalog.group_tasks[problem_.group + 1];
    problem_.domains.assign(catalog.words[end] - catalog.words[first_task_], 0);
    problem_.may_stop.assign(end - first_task_, 1);
    problem_.may_stop[task - first_task_] = 0;
    problem_.present.assign(end - first_task_, none);
    for (ValueId value(catalog.values.begin[first_task_]); value < catalog.values.begin[end];
         ++value) {
      if (!ruled_out[catalog.values.items[value].behavior]) flip(value);
    }
    full_domains_ = problem_.domains;
    set_budget(first_budget);
  }

  enum class Answer : std::uint8_t { found, impossible, stopped };

  /// Looks for an assignment without the behaviors of a set. `keep_on` is asked now and then.
  [[nodiscard]] Answer find_without(const BehaviorSet& absent,
                                    const std::function<bool()>& keep_on) {
    problem_.domains = full_domains_;
    for (const BehaviorId behavior : absent) {
      for (const ValueId value : catalog_.performs[behavior]) flip(value);
    }
    for (;;) {
      if (!keep_on()) return Answer::stopped;
      const SearchResult result = solver_->solve(problem_, assignment_);
      if (has_solution(result.status)) return Answer::found;
      if (result.status == SearchStatus::infeasible) return Answer::impossible;
      set_budget(2 * budget_);
    }
  }

  /// The active behaviors of the assignment that was found. A solution runs only what the task
  /// needs (solver/domains.h), so none of them is there in vain.
  [[nodiscard]] BehaviorSet support() const {
    BehaviorSet active;
    for (LocalTask task(0); task < assignment_.size(); ++task) {
      if (assignment_[task] == none) continue;
      active.push_back(catalog_.values[first_task_ + task][assignment_[task]].behavior);
    }
    std::sort(active.begin(), active.end());
    active.erase(std::unique(active.begin(), active.end()), active.end());
    return active;
  }

 private:
  static constexpr std::uint64_t first_budget = 10'000;

  /// A hard search begins anew with twice the decisions, which at most triples the effort, so that
  /// it can be stopped in between.
  void set_budget(std::uint64_t nodes) {
    budget_ = nodes;
    SearchOptions options;
    options.any_solution = true;
    options.max_nodes = nodes;
    options.easy_nodes = UINT64_MAX;  // bounds are about the objective, which does not matter here
    solver_.emplace(catalog_, options, no_ranks_);
  }

  void flip(ValueId value) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t place = value - catalog_.values.begin[task];
    const std::uint32_t word = catalog_.words[task] - catalog_.words[first_task_] + place / 64;
    problem_.domains[word] ^= std::uint64_t{1} << (place % 64);
  }

  const CompiledCatalog& catalog_;
  const TaskId first_task_;
  const std::vector<std::uint32_t> no_ranks_;
  Problem problem_;
  std::vector<std::uint64_t> full_domains_;
  std::uint64_t budget_ = 0;
  std::optional<Solver> solver_;
  Assignment assignment_;
};

/// The supports (sets of active behaviors) of the assignments that are known.
class KnownSupports {
 public:
  KnownSupports(const CompiledCatalog& catalog, GroupId group)
      : first_(catalog.group_behaviors[group]),
        users_(catalog.group_behaviors[group + 1] - first_) {}

  const BehaviorSet& add(BehaviorSet support) {
    const std::size_t number = supports_.size();
    for (const BehaviorId behavior : support) {
      std::vector<std::uint64_t>& users = users_[behavior - first_];
      users.resize(number / 64 + 1);
      users.back() |= std::uint64_t{1} << (number % 64);
    }
    return supports_.emplace_back(std::move(support));
  }

  /// One that has nothing of a set, or null.
  [[nodiscard]] const BehaviorSet* find_without(const BehaviorSet& absent) const {
    for (std::size_t word = 0; word * 64 < supports_.size(); ++word) {
      std::uint64_t hit = 0;
      for (const BehaviorId behavior : absent) {
        const std::vector<std::uint64_t>& users = users_[behavior - first_];
        if (word < users.size()) hit |= users[word];
      }
      const std::size_t number = word * 64 + static_cast<std::size_t>(std::countr_one(hit));
      if (hit != UINT64_MAX && number < supports_.size()) return &supports_[number];
    }
    return nullptr;
  }

 private:
  BehaviorId first_;
  std::vector<BehaviorSet> supports_;
  std::vector<std::vector<std::uint64_t>> users_;  ///< by behavior of the group: bits of supports_
};

/// Grows the tree level by level, and collects the cut sets.
class HittingSetTree {
 public:
  HittingSetTree(const CompiledCatalog& catalog, TaskId task, const std::vector<bool>& ruled_out,
                 const CutSetOptions& options)
      : options_(options),
        search_(catalog, task, ruled_out),
        known_(catalog, catalog.tasks[task].group) {}

  CutSets grow() {
    std::set<BehaviorSet> level{{}};  // in catalog order, as BehaviorIds of a group are
    for (std::uint32_t size = 0; size <= options_.order && !level.empty(); ++size) {
      progress_.size = size;
      std::set<BehaviorSet> next;
      for (const BehaviorSet& node : level) {
        if (!examine(node, next)) {
          result_.incomplete_size = size;
          return std::move(result_);
        }
      }
      level = std::move(next);
    }
    result_.complete = true;
    return std::move(result_);
  }

 private:
  /// False if the search is stopped.
  [[nodiscard]] bool examine(const BehaviorSet& node, std::set<BehaviorSet>& children) {
    ++progress_.examined;
    const BehaviorSet* support = known_.find_without(node);
    if (support == nullptr) {
      if (has_cut_set(node)) return true;
      ++result_.searches;
      switch (search_.find_without(node, [this] { return keeps_on(); })) {
        case SupportSearch::Answer::found:
          support = &known_.add(search_.support());
          break;
        case SupportSearch::Answer::impossible:
          add_cut_set(node);
          return true;
        case SupportSearch::Answer::stopped:
          return false;
      }
    }
    if (node.size() < options_.order) {
      for (const BehaviorId behavior : *support) {
        BehaviorSet child = node;
        child.insert(std::lower_bound(child.begin(), child.end(), behavior), behavior);
        children.insert(std::move(child));
      }
    }
    return true;
  }

  [[nodiscard]] bool keeps_on() const {
    return !options_.on_progress || options_.on_progress(progress_);
  }

  void add_cut_set(const BehaviorSet& node) {
    ++progress_.found;
    if (!node.empty()) by_first_[node.front()].push_back(result_.sets.size());
    result_.sets.push_back(node);
  }

  /// Whether a known cut set is part of the node.
  [[nodiscard]] bool has_cut_set(const BehaviorSet& node) const {
    for (auto first = node.begin(); first != node.end(); ++first) {
      const auto found = by_first_.find(*first);
      if (found == by_first_.end()) continue;
      for (const std::size_t place : found->second) {
        const BehaviorSet& cut_set = result_.sets[place];
        if (std::includes(first, node.end(), cut_set.begin(), cut_set.end())) return true;
      }
    }
    return false;
  }

  const CutSetOptions& options_;
  SupportSearch search_;
  KnownSupports known_;
  std::map<BehaviorId, std::vector<std::size_t>> by_first_;  ///< places of cut sets in result_
  CutSetProgress progress_;
  CutSets result_;
};

/// Whether a behavior fits in every respect that is fixed. `fixed`: by variable, its value or none.
bool may_fit(const CompiledCatalog& catalog, BehaviorId behavior,
             std::span<const std::uint32_t> fixed) {
  const auto all = catalog.fitting_values_of(behavior);
  for (auto next = all.begin(); next != all.end();) {
    const std::uint32_t variable = next->variable;
    bool fits = fixed[variable] == none;
    for (; next != all.end() && next->variable == variable; ++next) {
      fits |= next->value == fixed[variable];
    }
    if (!fits) return false;
  }
  return true;
}

}  // namespace

std::vector<bool> ruled_out_by(const CompiledCatalog& catalog,
                               const std::optional<SituationPart>& situation) {
  std::vector<bool> out(catalog.behaviors.size(), false);
  if (!situation) return out;
  std::vector<std::uint32_t> fixed(catalog.variables.size(), none);
  for (const VariableValue& one : situation->variables) fixed[one.variable] = one.value;
  for (BehaviorId behavior(0); behavior < out.size(); ++behavior) {
    out[behavior] = !may_fit(catalog, behavior, fixed);
  }
  for (const SituationPart::Own& own : situation->behaviors) {
    if (!own.available) out[own.behavior] = true;
  }
  return out;
}

CutSets find_cut_sets(const CompiledCatalog& catalog, TaskId task,
                      const std::vector<bool>& ruled_out, const CutSetOptions& options) {
  return HittingSetTree(catalog, task, ruled_out, options).grow();
}

}  // namespace cbc
