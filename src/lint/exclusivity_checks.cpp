#include "lint/exclusivity_checks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// The tasks of a list, each once, in order.
std::vector<TaskIndex> distinct_tasks(const ExclusivityList& list) {
  std::vector<TaskIndex> tasks = list.tasks;
  std::sort(tasks.begin(), tasks.end());
  tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
  return tasks;
}

void check_own_tasks(const Catalog& catalog, const ExclusivityList& list, Reporter& reporter) {
  std::unordered_map<TaskIndex, Range> known;
  bool has_repetition = false;
  // A list of one task, given twice, must have been meant to have another one.
  const bool is_mendable = distinct_tasks(list).size() > 1;
  for (std::size_t place = 0; place < list.tasks.size(); ++place) {
    const auto [first, is_new] = known.try_emplace(list.tasks[place], list.ranges[place]);
    if (is_new) continue;
    has_repetition = true;
    std::vector<Edit> edits;
    if (is_mendable) edits.push_back({Edit::Kind::remove_entry, list.ranges[place], {}});
    reporter.report(rule::self_exclusion, list.ranges[place],
                    "task " + quote(catalog.tasks[list.tasks[place]].name) +
                        " stands twice in one list; a task does not exclude itself",
                    {reporter.note(first->second, "first given here")}, std::move(edits));
  }
  if (known.size() < 2 && !has_repetition && list.is_complete) {
    reporter.report(rule::trivial_exclusion, list.range,
                    list.tasks.empty() ? "the list has no task, so it excludes nothing"
                                       : "the list has one task only, so it excludes nothing");
  }
}

/// Finds lists that another list contains. Each list is compared only with those that have its
/// rarest task.
class Containment {
 public:
  explicit Containment(const Catalog& catalog)
      : catalog_(catalog), lists_of_(catalog.tasks.size()) {
    for (const ExclusivityList& list : catalog.exclusivity) tasks_.push_back(distinct_tasks(list));
    for (std::size_t list = 0; list < tasks_.size(); ++list) {
      for (const TaskIndex task : tasks_[list]) lists_of_[task].push_back(list);
    }
  }

  void report(Reporter& reporter) {
    for (std::size_t list = 0; list < tasks_.size(); ++list) {
      if (tasks_[list].size() < 2 || !catalog_.exclusivity[list].is_complete) continue;
      const std::size_t other = find_container(list);
      if (other == tasks_.size()) continue;
      std::vector<Edit> edits;
      if (const auto& entry = catalog_.exclusivity[list].entry) {
        edits.push_back({Edit::Kind::remove_entry, *entry, {}});
      }
      const bool has_more =
          tasks_[other].size() > tasks_[list].size() || !catalog_.exclusivity[other].is_complete;
      reporter.report(
          rule::duplicate_exclusion, catalog_.exclusivity[list].range,
          std::string("another list has ") + (has_more ? "all of these tasks" : "the same tasks") +
              ", so this one excludes nothing new",
          {reporter.note(catalog_.exclusivity[other].range, "it is here")}, std::move(edits));
    }
  }

 private:
  /// A list with all tasks of `list`; of equal lists an earlier one. The number of lists if there
  /// is none.
  std::size_t find_container(std::size_t list) {
    const auto rarest = *std::min_element(
        tasks_[list].begin(), tasks_[list].end(),
        [this](TaskIndex a, TaskIndex b) { return lists_of_[a].size() < lists_of_[b].size(); });
    for (const std::size_t other : lists_of_[rarest]) {
      if (other == list || tasks_[other].size() < tasks_[list].size()) continue;
      if (tasks_[other].size() == tasks_[list].size() && other > list) continue;
      if (work_left_ < tasks_[list].size() + tasks_[other].size()) break;
      work_left_ -= tasks_[list].size() + tasks_[other].size();
      if (std::includes(tasks_[other].begin(), tasks_[other].end(), tasks_[list].begin(),
                        tasks_[list].end())) {
        return other;
      }
    }
    return tasks_.size();
  }

  const Catalog& catalog_;
  std::vector<std::vector<TaskIndex>> tasks_;       ///< by list
  std::vector<std::vector<std::size_t>> lists_of_;  ///< by task
  std::size_t work_left_ = 100'000'000;  ///< so that no catalog takes long; it is only advice
};

}  // namespace

void check_exclusivity(const Catalog& catalog, Reporter& reporter) {
  for (const ExclusivityList& list : catalog.exclusivity) {
    check_own_tasks(catalog, list, reporter);
  }
  Containment(catalog).report(reporter);
}

}  // namespace cbc
