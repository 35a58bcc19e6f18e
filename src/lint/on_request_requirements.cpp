#include "lint/on_request_requirements.h"

#include <algorithm>
#include <string>
#include <vector>

#include "catalog/describe.h"
#include "cbc/rules.h"
#include "explain/constraints.h"
#include "text/quote.h"

namespace cbc {
namespace {

bool is_on_request(const Task& task) { return task.start_on_request && !task.is_unclear; }

void report(const Behavior& behavior, const Requirement& requirement, const Task& task,
            const std::string& first, Reporter& reporter) {
  reporter.report(rule::requires_on_request, requirement.range,
                  describe(behavior) + " requires " + quote(task.name) +
                      ", which starts on request only: request " + first + " first",
                  {reporter.note(task.range, quote(task.name) + " is defined here")});
}

class OnRequestCheck {
 public:
  explicit OnRequestCheck(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  void check(BehaviorId id) {
    if (semantics_.liveness().of_behavior(id) == Liveness::State::dead) return;
    const Behavior& behavior = semantics_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      const Task& task = semantics_.catalog().tasks[requirement.task];
      if (!is_on_request(task)) continue;
      report(behavior, requirement, task,
             join(tasks_to_request(id, catalog_.task_ids[requirement.task])),
             semantics_.reporter());
    }
  }

 private:
  /// A set of tasks that start on request, none of which can be left out if the behavior is to be
  /// active: `task`, and what that requires. In the order in which they can be requested.
  std::vector<TaskId> tasks_to_request(BehaviorId behavior, TaskId task) {
    constexpr std::size_t most_candidates = 100;  // enough for a sentence
    RelevantTasks relevant(catalog_, catalog_.tasks[task].group);
    relevant.add(task);
    std::vector<TaskId> needed;
    if (relevant.close(most_candidates)) {
      std::vector<TaskId> candidates;
      for (const TaskId other : relevant.tasks()) {
        if (other != task && catalog_.tasks[other].start_on_request) candidates.push_back(other);
      }
      std::vector<TaskId> closed;
      for (const TaskId candidate : candidates) {
        closed.push_back(candidate);
        if (is_possible(behavior, closed)) continue;
        closed.pop_back();
        needed.push_back(candidate);
      }
    }
    needed.push_back(task);
    std::stable_sort(needed.begin(), needed.end(), [this](TaskId a, TaskId b) {
      return catalog_.tasks[a].level < catalog_.tasks[b].level;
    });
    return needed;
  }

  bool is_possible(BehaviorId behavior, const std::vector<TaskId>& closed) {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(), [&](ValueId value) {
      return semantics_.search().find(value, closed, solution_) == Feasibility::yes;
    });
  }

  [[nodiscard]] std::string join(const std::vector<TaskId>& tasks) const {
    constexpr std::size_t most_names = 10;
    std::string text;
    for (std::size_t place = 0; place < tasks.size(); ++place) {
      // Of a long list the beginning, and what is required in the end.
      if (tasks.size() > most_names && place == most_names - 1) {
        text += ", then " + std::to_string(tasks.size() - most_names) + " more";
        place = tasks.size() - 1;
      }
      if (!text.empty()) text += ", then ";
      text += quote(semantics_.task(tasks[place]).name);
    }
    return text;
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  Assignment solution_;
};

}  // namespace

void check_on_request_requirements(Semantics& semantics) {
  OnRequestCheck check(semantics);
  for (BehaviorId id = 0; id < semantics.compiled().behaviors.size(); ++id) check.check(id);
}

void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter) {
  for (std::size_t index = 0; index < catalog.behaviors.size(); ++index) {
    if (conflicts[index]) continue;
    for (const Requirement& requirement : catalog.behaviors[index].requirements) {
      const Task& task = catalog.tasks[requirement.task];
      if (!is_on_request(task)) continue;
      report(catalog.behaviors[index], requirement, task, quote(task.name), reporter);
    }
  }
}

}  // namespace cbc
