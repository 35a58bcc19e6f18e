#include "lint_check.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "demand.h"

namespace cbc::oracle {
namespace {

// Calls for each constraint of a set.
void for_each(ConstraintSet set, const std::function<void(ConstraintSet)>& call) {
  for (; set != 0; set &= set - 1) call(set & ~(set - 1));
}

class Checker {
 public:
  Checker(const LintOracle& oracle, const Findings& findings, Statistics& statistics)
      : oracle_(oracle),
        facts_(oracle.facts()),
        catalog_(facts_.catalog),
        findings_(findings),
        statistics_(statistics) {}

  void check() {
    find_dead();
    check_exclusive_requirements();
    check_conflicts();
    check_minimums();
    check_dead_findings();
    check_explanations();
    check_repetitions();
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      check_redundancy(behavior);
      check_on_request(behavior);
    }
    count_all();
  }

 private:
  // Names for messages

  const std::string& name_of_task(std::size_t task) const { return catalog_.tasks[task].name; }
  const std::string& name_of_behavior(std::size_t behavior) const {
    return catalog_.behaviors[behavior].name;
  }
  std::string name_of(const RequirementEntry& entry) const {
    return "requirement " + std::to_string(entry.place + 1) + " of " +
           name_of_behavior(entry.behavior);
  }
  const Requirement& requirement(const RequirementEntry& entry) const {
    return catalog_.behaviors[entry.behavior].requirements[entry.place];
  }

  template <typename Action>
  void for_each_entry(const Action& action) const {
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      for (std::size_t i = 0; i < catalog_.behaviors[behavior].requirements.size(); ++i) {
        action(RequirementEntry{behavior, i});
      }
    }
  }

  // What is dead

  using Value = std::pair<std::size_t, std::size_t>;  // task, behavior

  std::vector<Value> values_of(std::size_t behavior) const {
    std::vector<Value> values;
    for (const Performance& performed : catalog_.behaviors[behavior].performs) {
      values.emplace_back(performed.task, behavior);
    }
    return values;
  }

  ConstraintSet all_of_task(std::size_t task) const { return oracle_.all(facts_.group_of[task]); }

  bool has_behaviors(std::size_t task) const { return !facts_.behaviors_of[task].empty(); }

  void find_dead() {
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      if (!oracle_.can_run(task, all_of_task(task))) dead_tasks_.insert(task);
      for (const std::size_t behavior : facts_.behaviors_of[task]) {
        if (!oracle_.can_have(task, behavior, all_of_task(task))) {
          dead_values_.insert({task, behavior});
        }
      }
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      const std::vector<Value> values = values_of(behavior);
      if (std::all_of(values.begin(), values.end(),
                      [this](const Value& value) { return dead_values_.contains(value); })) {
        dead_behaviors_.insert(behavior);
      }
    }
  }

  // The special cases

  bool share_a_list(std::size_t a, std::size_t b) const { return facts_.excludes[a].contains(b); }

  bool excludes_all_own(const RequirementEntry& entry) const {
    const std::vector<Performance>& performs = catalog_.behaviors[entry.behavior].performs;
    return std::all_of(performs.begin(), performs.end(), [&](const Performance& performed) {
      return share_a_list(performed.task, requirement(entry).task);
    });
  }

  bool is_first_of_its_task(const RequirementEntry& entry) const {
    for (std::size_t i = 0; i < entry.place; ++i) {
      if (requirement({entry.behavior, i}).task == requirement(entry).task) return false;
    }
    return true;
  }

  void check_exclusive_requirements() const {
    for_each_entry([this](const RequirementEntry& entry) {
      const bool found = std::find(findings_.exclusive.begin(), findings_.exclusive.end(), entry) !=
                         findings_.exclusive.end();
      demand(found == (is_first_of_its_task(entry) && excludes_all_own(entry)),
             "exclusive-requirement is wrong about " + name_of(entry));
    });
  }

  bool conflict(const RequirementEntry& a, const RequirementEntry& b) const {
    return share_a_list(requirement(a).task, requirement(b).task) && !excludes_all_own(a) &&
           !excludes_all_own(b);
  }

  // Each task that conflicts with one required before it is reported, whichever of several it is
  // said to conflict with.
  void check_conflicts() const {
    for (const auto& [entry, other] : findings_.conflicting) {
      demand(conflict(entry, other), "no conflict: " + name_of(entry));
      demand(dead_behaviors_.contains(entry.behavior), "a conflict of a live behavior");
    }
    for_each_entry([this](const RequirementEntry& entry) {
      if (!is_first_of_its_task(entry)) return;
      for (std::size_t i = 0; i < entry.place; ++i) {
        demand(!conflict(entry, {entry.behavior, i}) || findings_.conflicting.contains(entry),
               "conflicting-requirements misses " + name_of(entry));
      }
    });
  }

  std::string rounded_down(const Integer& performance, std::size_t task) const {
    const Integer degree = performance * whole_degree / oracle_.scale(task);
    return percent_text(degree.convert_to<Millionths>());
  }

  bool is_below(const Integer& performance, Millionths minimum, std::size_t task) const {
    return performance * whole_degree < oracle_.scale(task) * minimum;
  }

  // The best performance of a task, if it can run, but never as well as it should.
  std::optional<std::string> unreached(std::size_t task, ConstraintSet in_force,
                                       Millionths minimum) const {
    const std::optional<Integer> best = oracle_.best_performance(task, in_force);
    if (!best || !is_below(*best, minimum, task)) return std::nullopt;
    return rounded_down(*best, task);
  }

  template <typename Key>
  static std::optional<std::string> find(const std::map<Key, std::string>& findings,
                                         const Key& key) {
    const auto found = findings.find(key);
    return found == findings.end() ? std::nullopt : std::optional(found->second);
  }

  void check_minimums() const {
    for_each_entry([this](const RequirementEntry& entry) {
      const Requirement& one = requirement(entry);
      demand(find(findings_.unreachable, entry) ==
                 unreached(one.task, all_of_task(one.task), one.minimum),
             "unreachable-performance is wrong about " + name_of(entry));
    });
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      demand(
          find(findings_.unreachable_minimums, task) ==
              unreached(task, all_of_task(task) & ~minimum_of(task), catalog_.tasks[task].minimum),
          "unreachable-performance is wrong about the minimum of " + name_of_task(task));
    }
  }

  // Whose constraints

  ConstraintSet minimum_of(std::size_t task) const {
    return oracle_.those(facts_.group_of[task], [task](const Constraint& constraint) {
      return constraint.kind == Constraint::Kind::performance && constraint.behavior == none &&
             constraint.task == task;
    });
  }

  ConstraintSet requirements_of(std::size_t behavior) const {
    return oracle_.those(
        oracle_.group_of_behavior(behavior),
        [behavior](const Constraint& constraint) { return constraint.behavior == behavior; });
  }

  // The finding about a task without behaviors explains these.
  ConstraintSet requirements_without_behaviors(std::size_t group) const {
    return oracle_.those(group, [this](const Constraint& constraint) {
      return constraint.behavior != none && !has_behaviors(constraint.task);
    });
  }

  // Dead tasks and behaviors

  bool has_task_finding(std::size_t task) const {
    return findings_.dead_tasks.contains(task) || findings_.unreachable_minimums.contains(task);
  }

  bool has_special_finding(std::size_t behavior) const {
    const auto is_of_it = [behavior](const auto& one) { return one.first.behavior == behavior; };
    return std::any_of(findings_.exclusive.begin(), findings_.exclusive.end(),
                       [behavior](const auto& one) { return one.behavior == behavior; }) ||
           std::any_of(findings_.conflicting.begin(), findings_.conflicting.end(), is_of_it) ||
           std::any_of(findings_.unreachable.begin(), findings_.unreachable.end(), is_of_it);
  }

  bool has_finding(std::size_t behavior) const {
    return has_special_finding(behavior) || findings_.dead_behaviors.contains(behavior);
  }

  // The tasks that some may come to need, whatever behaviors are chosen.
  std::set<std::size_t> below(const std::vector<std::size_t>& behaviors) const {
    std::vector<std::size_t> open = behaviors;
    std::set<std::size_t> tasks;
    while (!open.empty()) {
      const std::size_t behavior = open.back();
      open.pop_back();
      for (const Requirement& one : catalog_.behaviors[behavior].requirements) {
        if (!tasks.insert(one.task).second) continue;
        for (const std::size_t other : facts_.behaviors_of[one.task]) open.push_back(other);
      }
    }
    return tasks;
  }

  // The constraints that may explain something dead, without those of what has an explanation
  // itself. `explained`: values that have one.
  ConstraintSet unexplained(std::size_t group, const std::set<std::size_t>& tasks_below,
                            const std::set<Value>& explained) const {
    ConstraintSet dropped = requirements_without_behaviors(group);
    for (const std::size_t task : tasks_below) {
      if (has_task_finding(task)) dropped |= minimum_of(task);
      for (const std::size_t behavior : facts_.behaviors_of[task]) {
        if (dead_tasks_.contains(task) || is_explained(behavior, explained)) {
          dropped |= requirements_of(behavior);
        }
      }
    }
    return oracle_.all(group) & ~dropped;
  }

  bool is_explained(std::size_t behavior, const std::set<Value>& explained) const {
    if (!dead_behaviors_.contains(behavior)) return false;
    if (has_finding(behavior)) return true;
    const std::vector<Value> values = values_of(behavior);
    return std::all_of(values.begin(), values.end(),
                       [&](const Value& value) { return explained.contains(value); });
  }

  // The dead values that have an explanation: a finding, or what is explained below them. What the
  // finding on one task explains may be left out.
  std::set<Value> explain_values(std::size_t but_for = none) const {
    std::set<Value> explained;
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (const Value& value : dead_values_) {
        const auto& [task, behavior] = value;
        if (explained.contains(value)) continue;
        if ((has_task_finding(task) && task != but_for) ||
            (dead_behaviors_.contains(behavior) && has_finding(behavior)) ||
            oracle_.can_have(task, behavior,
                             unexplained(facts_.group_of[task], below({behavior}), explained))) {
          explained.insert(value);
          has_grown = true;
        }
      }
    }
    return explained;
  }

  // Nothing impossible is left without an explanation, and no finding says again what another one
  // says.
  void check_explanations() {
    const std::set<Value> explained = explain_values();
    for (const std::size_t behavior : dead_behaviors_) {
      const std::vector<Value> values = values_of(behavior);
      const bool has_one = has_finding(behavior) ||
                           std::any_of(values.begin(), values.end(),
                                       [&](const Value& one) { return explained.contains(one); });
      demand(has_one, "no explanation of the dead behavior " + name_of_behavior(behavior));
      const ConstraintSet in_force =
          unexplained(oracle_.group_of_behavior(behavior), below({behavior}), explained);
      const bool is_shown_elsewhere =
          std::any_of(values.begin(), values.end(), [&](const Value& value) {
            return findings_.unreachable_minimums.contains(value.first) ||
                   (values.size() == 1 && has_task_finding(value.first)) ||
                   oracle_.can_have(value.first, behavior, in_force);
          });
      if (findings_.dead_behaviors.contains(behavior)) {
        demand(!has_special_finding(behavior), name_of_behavior(behavior) + " has two findings");
        demand(!is_shown_elsewhere, "a cascade: dead-behavior " + name_of_behavior(behavior));
      } else if (!has_special_finding(behavior)) {
        statistics_.count("dead behavior without a finding of its own");
      }
    }
    for (const std::size_t task : dead_tasks_) {
      if (!has_behaviors(task)) continue;
      ConstraintSet in_force =
          unexplained(facts_.group_of[task], below(facts_.behaviors_of[task]),
                      has_task_finding(task) ? explain_values(task) : explained);
      for (const std::size_t behavior : facts_.behaviors_of[task]) {
        if (has_finding(behavior)) in_force &= ~requirements_of(behavior);
      }
      const bool is_explained_below = oracle_.can_run(task, in_force);
      demand(is_explained_below || has_task_finding(task),
             "no explanation of the dead task " + name_of_task(task));
      if (findings_.dead_tasks.contains(task)) {
        demand(!findings_.unreachable_minimums.contains(task),
               name_of_task(task) + " has two findings");
        demand(!is_explained_below, "a cascade: dead-task " + name_of_task(task));
      } else if (!has_task_finding(task)) {
        statistics_.count("dead task without a finding of its own");
      }
    }
  }

  // Each reason leaves no assignment; with any part of it left out, there is one.
  void check_minimal(ConstraintSet reason, const std::function<bool(ConstraintSet)>& has_any,
                     const std::string& what) const {
    demand(!has_any(reason), "the reason is not enough: " + what);
    for_each(reason, [&](ConstraintSet one) {
      demand(has_any(reason & ~one), "a part of the reason is superfluous: " + what);
    });
  }

  void check_dead_findings() const {
    for (const auto& [task, reason] : findings_.dead_tasks) {
      demand(dead_tasks_.contains(task) && has_behaviors(task),
             "dead-task is wrong about " + name_of_task(task));
      check_minimal(
          reason, [&, dead = task](ConstraintSet set) { return oracle_.can_run(dead, set); },
          "dead-task " + name_of_task(task));
    }
    for (const auto& [behavior, reason] : findings_.dead_behaviors) {
      demand(dead_behaviors_.contains(behavior),
             "dead-behavior is wrong about " + name_of_behavior(behavior));
      check_minimal(
          reason, [&, dead = behavior](ConstraintSet set) { return can_be_active(dead, set); },
          "dead-behavior " + name_of_behavior(behavior));
    }
  }

  bool can_be_active(std::size_t behavior, ConstraintSet in_force) const {
    return has_row(behavior, in_force, [](const Row&) { return true; });
  }

  // Whether there is an assignment in which the behavior is active.
  bool has_row(std::size_t behavior, ConstraintSet in_force,
               const std::function<bool(const Row&)>& holds) const {
    return oracle_.any(oracle_.group_of_behavior(behavior), in_force, [&](const Row& row) {
      return std::find(row.values.begin(), row.values.end(), behavior) != row.values.end() &&
             holds(row);
    });
  }

  // Redundant requirements

  // The requirement of the task that counts: the first of the strongest.
  std::size_t strongest(std::size_t behavior, std::size_t task) const {
    const std::vector<Requirement>& requirements = catalog_.behaviors[behavior].requirements;
    std::size_t best = none;
    for (std::size_t i = 0; i < requirements.size(); ++i) {
      if (requirements[i].task != task) continue;
      if (best == none || requirements[i].minimum > requirements[best].minimum) best = i;
    }
    return best;
  }

  void check_repetitions() const {
    for_each_entry([this](const RequirementEntry& entry) {
      const bool found = std::find(findings_.repeated.begin(), findings_.repeated.end(), entry) !=
                         findings_.repeated.end();
      const bool is_repeated = strongest(entry.behavior, requirement(entry).task) != entry.place;
      demand(found == (is_repeated && !dead_behaviors_.contains(entry.behavior)),
             "redundant-requirement is wrong about the repeated " + name_of(entry));
    });
  }

  void check_redundancy(std::size_t behavior) const {
    for (std::size_t i = 0; i < catalog_.behaviors[behavior].requirements.size(); ++i) {
      const RequirementEntry entry{behavior, i};
      const std::size_t task = requirement(entry).task;
      const std::size_t group = oracle_.group_of_behavior(behavior);
      const ConstraintSet own = oracle_.those(group, [&](const Constraint& constraint) {
        return constraint.behavior == behavior && constraint.task == task;
      });
      const auto can_be_broken = [&](ConstraintSet in_force) {
        return has_row(behavior, in_force,
                       [own](const Row& row) { return (row.violated & own) != 0; });
      };
      const bool is_redundant =
          strongest(behavior, task) == i && !dead_behaviors_.contains(behavior) &&
          !can_be_broken(oracle_.all(group) & ~own) && !is_margin(group, behavior, task);
      const auto found = findings_.redundant.find(entry);
      demand((found != findings_.redundant.end()) == is_redundant,
             "redundant-requirement is wrong about " + name_of(entry));
      if (!is_redundant) continue;
      demand((found->second & own) == 0, "redundant because of itself: " + name_of(entry));
      check_minimal(found->second, can_be_broken, "redundant-requirement " + name_of(entry));
    }
  }

  // Whether a requirement has a minimum that no assignment misses, whatever minimums there are.
  bool is_margin(std::size_t group, std::size_t behavior, std::size_t task) const {
    const ConstraintSet minimums = oracle_.those(group, [](const Constraint& constraint) {
      return constraint.kind == Constraint::Kind::performance;
    });
    const ConstraintSet own = minimums & oracle_.those(group, [&](const Constraint& constraint) {
      return constraint.behavior == behavior && constraint.task == task;
    });
    return own != 0 && !oracle_.any(group, oracle_.all(group) & ~minimums,
                                    [own](const Row& row) { return (row.violated & own) != 0; });
  }

  // Tasks to request first

  void check_on_request(std::size_t behavior) const {
    std::set<std::size_t> requested;
    std::set<std::size_t> may_need;
    for (std::size_t i = 0; i < catalog_.behaviors[behavior].requirements.size(); ++i) {
      const RequirementEntry entry{behavior, i};
      const std::size_t task = requirement(entry).task;
      const auto found = findings_.on_request.find(entry);
      const bool is_found = found != findings_.on_request.end();
      demand(is_found ==
                 (catalog_.tasks[task].start_on_request && !dead_behaviors_.contains(behavior)),
             "requires-on-request is wrong about " + name_of(entry));
      if (!is_found) continue;
      check_requests(behavior, task, found->second,
                     "what requires-on-request says to request for " + name_of(entry));
      requested.insert(found->second.begin(), found->second.end());
      may_need.merge(below(facts_.behaviors_of[task]));
    }
    demand(requested.empty() || runs_with(behavior, may_need, requested),
           "the requests for " + name_of_behavior(behavior) + " do not go together");
  }

  // Of all that the required task may need, only these and what starts by itself run.
  void check_requests(std::size_t behavior, std::size_t task,
                      const std::vector<std::size_t>& requests, const std::string& what) const {
    demand(requests.back() == task, what + " does not end with the task");
    const std::set<std::size_t> may_need = below(facts_.behaviors_of[task]);
    for (std::size_t i = 0; i + 1 < requests.size(); ++i) {
      demand(may_need.contains(requests[i]) && catalog_.tasks[requests[i]].start_on_request,
             what + " is not needed");
      demand(level_of(requests[i]) <= level_of(requests[i + 1]), what + " is out of order");
    }
    const auto is_enough = [&](const std::set<std::size_t>& requested) {
      return runs_with(behavior, may_need, requested);
    };
    const std::set<std::size_t> all(requests.begin(), requests.end());
    demand(all.size() == requests.size(), what + " names one twice");
    demand(is_enough(all), what + " is not enough");
    for (const std::size_t one : all) {
      if (one == task) continue;
      std::set<std::size_t> less = all;
      less.erase(one);
      demand(!is_enough(less), what + " is more than needed");
    }
    if (requests.size() > 1) statistics_.count("requires-on-request: more than one request");
  }

  // Whether the behavior can be active while of some tasks only those run that are requested or
  // start by themselves.
  bool runs_with(std::size_t behavior, const std::set<std::size_t>& tasks,
                 const std::set<std::size_t>& requested) const {
    return has_row(behavior, oracle_.all(oracle_.group_of_behavior(behavior)), [&](const Row& row) {
      return std::all_of(tasks.begin(), tasks.end(), [&](std::size_t task) {
        return row.values[task] == none || requested.contains(task) ||
               !catalog_.tasks[task].start_on_request;
      });
    });
  }

  std::size_t level_of(std::size_t task) const {
    std::size_t level = 0;
    for (const std::size_t behavior : facts_.behaviors_of[task]) {
      level = std::max(level, facts_.level_of[behavior]);
    }
    return level;
  }

  // Statistics

  void count(bool has_happened, const std::string& what) const {
    if (has_happened) statistics_.count(what);
  }

  void count_all() const {
    count(!findings_.exclusive.empty(), "exclusive-requirement");
    count(!findings_.conflicting.empty(), "conflicting-requirements");
    count(!findings_.unreachable.empty(), "unreachable-performance");
    count(!findings_.unreachable_minimums.empty(), "unreachable-performance of a task");
    count(!findings_.dead_tasks.empty(), "dead-task");
    count(!findings_.dead_behaviors.empty(), "dead-behavior");
    count(!findings_.redundant.empty(), "redundant-requirement");
    count(!findings_.repeated.empty(), "redundant-requirement: repeated");
    count(!findings_.on_request.empty(), "requires-on-request");
    count(dead_behaviors_.empty() && dead_tasks_.empty(), "nothing is dead");
    for (const auto& [entry, reason] : findings_.redundant) {
      count(requirement(entry).minimum > 0, "redundant-requirement with a minimum");
      count_reason("redundant-requirement", reason);
    }
    for (const auto& [task, reason] : findings_.dead_tasks) count_reason("dead-task", reason);
    for (const auto& [behavior, reason] : findings_.dead_behaviors) {
      count_reason("dead-behavior", reason);
      count(catalog_.behaviors[behavior].performs.size() > 1, "dead-behavior of several tasks");
    }
  }

  void count_reason(const std::string& rule, ConstraintSet reason) const {
    std::size_t size = 0;
    for_each(reason, [&size](ConstraintSet) { ++size; });
    statistics_.count(rule + ": reason of " + (size < 5 ? std::to_string(size) : "5 or more"));
  }

  const LintOracle& oracle_;
  const CatalogFacts& facts_;
  const Catalog& catalog_;
  const Findings& findings_;
  Statistics& statistics_;
  std::set<Value> dead_values_;
  std::set<std::size_t> dead_behaviors_;
  std::set<std::size_t> dead_tasks_;
};

}  // namespace

void check_findings(const LintOracle& oracle, const Findings& findings, Statistics& statistics) {
  Checker(oracle, findings, statistics).check();
}

}  // namespace cbc::oracle
