#include "catalog/checks.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "catalog/cycles.h"
#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc {
namespace {

// Longer cycles are shown by their beginning.
constexpr std::size_t longest_chain = 10;

// Finds lists that two tasks share. Each pair is looked up once, in the lists of the task that has
// fewer, so that no catalog makes it quadratic.
class SharedLists {
 public:
  explicit SharedLists(const Catalog& catalog) : lists_(catalog.tasks.size()) {
    for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
      for (const TaskIndex task : catalog.exclusivity[list].tasks) {
        auto& of_task = lists_[task];
        if (of_task.empty() || of_task.back() != list) of_task.push_back(list);
      }
    }
  }

  [[nodiscard]] std::optional<std::size_t> find(TaskIndex a, TaskIndex b) {
    if (lists_[a].size() > lists_[b].size()) std::swap(a, b);
    if (lists_[a].empty()) return std::nullopt;
    const std::uint64_t pair = (std::uint64_t{a} << 32U) | b;
    const auto [entry, is_new] = known_.try_emplace(pair);
    if (is_new) entry->second = search(lists_[a], lists_[b]);
    return entry->second;
  }

 private:
  static std::optional<std::size_t> search(const std::vector<std::size_t>& few,
                                           const std::vector<std::size_t>& many) {
    for (const std::size_t list : few) {
      if (std::binary_search(many.begin(), many.end(), list)) return list;
    }
    return std::nullopt;
  }

  std::vector<std::vector<std::size_t>> lists_;  // of each task, ascending
  std::unordered_map<std::uint64_t, std::optional<std::size_t>> known_;
};

// A list that excludes `task` from the first of the behavior's tasks, if there are such lists for
// all of them.
std::optional<std::size_t> excluding_list(const Behavior& behavior, TaskIndex task,
                                          SharedLists& lists) {
  std::optional<std::size_t> first;
  for (const Performance& performance : behavior.performs) {
    // What a behavior requires of itself is a cycle.
    if (performance.task == task) return std::nullopt;
    const auto list = lists.find(performance.task, task);
    if (!list) return std::nullopt;
    if (!first) first = list;
  }
  return first;
}

}  // namespace

void check_requirement_cycles(const Catalog& catalog, Reporter& reporter) {
  for (const Cycle& cycle : find_requirement_cycles(catalog)) {
    std::string chain;
    std::vector<Note> notes;
    for (const CycleStep& step : cycle) {
      const Behavior& behavior = catalog.behaviors[step.behavior];
      const Requirement& requirement = behavior.requirements[step.requirement];
      const std::string task = quote(catalog.tasks[step.task].name);
      if (notes.size() < longest_chain) chain += task + " -> ";
      notes.push_back(reporter.note(
          requirement.range, "behavior " + quote(behavior.name) + ", which performs " + task +
                                 ", requires " + quote(catalog.tasks[requirement.task].name)));
    }
    if (cycle.size() > longest_chain) chain += "... -> ";
    chain += quote(catalog.tasks[cycle.front().task].name);
    const Range place = notes.front().range;
    reporter.report(rule::requirement_cycle, place, "tasks require one another: " + chain,
                    std::move(notes));
  }
}

void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter) {
  SharedLists lists(catalog);
  std::unordered_set<TaskIndex> reported;
  for (const Behavior& behavior : catalog.behaviors) {
    if (behavior.performs.empty()) continue;
    reported.clear();
    for (const Requirement& requirement : behavior.requirements) {
      const auto list = excluding_list(behavior, requirement.task, lists);
      if (!list || !reported.insert(requirement.task).second) continue;
      const std::string own =
          behavior.performs.size() == 1
              ? quote(catalog.tasks[behavior.performs.front().task].name) + ", the task it performs"
              : std::string("every task it performs");
      reporter.report(
          rule::exclusive_requirement, requirement.range,
          "behavior " + quote(behavior.name) + " requires " +
              quote(catalog.tasks[requirement.task].name) + ", which excludes " + own,
          {reporter.note(catalog.exclusivity[*list].range, "mutually exclusive by this list")});
    }
  }
}

}  // namespace cbc
