#include "coordinator/snapshot.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "solver/checker.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

class SnapshotCheck {
 public:
  SnapshotCheck(const CompiledCatalog& catalog, const Snapshot& snapshot)
      : catalog_(catalog),
        snapshot_(snapshot),
        places_(catalog.tasks.size(), none),
        activated_at_(catalog.behaviors.size(), never) {}

  std::optional<std::string> run() && {
    check_clock();
    for (const auto& [behavior, time] : snapshot_.active) check_activation(behavior, time);
    for (const Snapshot::RunningTask& entry : snapshot_.running) check_task(entry);
    check_active();
    for (const auto& [task, due] : snapshot_.queue) check_queued(task, due);
    if (problem_.empty()) check_constraints();
    if (problem_.empty()) return std::nullopt;
    return std::move(problem_);
  }

 private:
  static constexpr Microseconds never = -1;

  /// The first one counts.
  void refuse(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }
  [[nodiscard]] bool is_past(Microseconds time) const { return time >= 0 && time <= snapshot_.now; }
  [[nodiscard]] static std::string seconds(Microseconds time) {
    return format_decimal(time, 6) + " s";
  }

  void check_clock() {
    if (snapshot_.now < 0 || snapshot_.now > longest_time) {
      refuse("its time is not between 0 and " + seconds(longest_time));
    }
    if (snapshot_.reactive_delay <= 0 || snapshot_.reactive_delay > longest_time) {
      refuse("its reactive delay is not over 0 and at most " + seconds(longest_time));
    }
    if (snapshot_.events > UINT64_MAX / 2) refuse("its number of events is beyond reach");
  }

  void check_activation(BehaviorId behavior, Microseconds time) {
    const std::string name = quote(catalog_.name_of_behavior(behavior));
    if (activated_at_[behavior] != never) refuse(fmt::format("behavior {} is active twice", name));
    if (!is_past(time)) {
      refuse(
          fmt::format("behavior {} became active after the time of the state, or before 0", name));
      return;
    }
    activated_at_[behavior] = time;
  }

  void check_task(const Snapshot::RunningTask& entry) {
    const std::string name = quote(catalog_.name_of_task(entry.task));
    const BehaviorId behavior = catalog_.values[entry.task][entry.place].behavior;
    if (places_[entry.task] != none) refuse(fmt::format("task {} runs twice", name));
    places_[entry.task] = entry.place;
    if (!is_past(entry.since)) {
      refuse(fmt::format("task {} runs since a time after that of the state, or before 0", name));
      return;
    }
    if (activated_at_[behavior] == never) {
      refuse(fmt::format("task {} runs with {}, which is not active", name,
                         quote(catalog_.name_of_behavior(behavior))));
    }
    if (entry.request) check_request(name, *entry.request);
    check_timeout(name, entry);
  }

  void check_request(const std::string& name, const Request& request) {
    if (request.priority < 0) refuse(fmt::format("the request of {} has no priority", name));
    if (request.event == 0 || request.event > snapshot_.events) {
      refuse(fmt::format("the request of {} is of an event that was not", name));
    } else if (!events_.insert(request.event).second) {
      refuse(fmt::format("the request of {} is of the same event as another one", name));
    }
  }

  void check_timeout(const std::string& name, const Snapshot::RunningTask& entry) {
    const CompiledTask& task = catalog_.tasks[entry.task];
    const BehaviorId behavior = catalog_.values[entry.task][entry.place].behavior;
    const Microseconds own = catalog_.behaviors[behavior].timeout;
    const Microseconds timeout = task.keep_running != 0 ? 0 : own > 0 ? own : task.timeout;
    const Microseconds due =
        timeout == 0 ? never : std::max(entry.since, activated_at_[behavior]) + timeout;
    if (entry.waits_for_timeout ? due < snapshot_.now : due > snapshot_.now) {
      refuse(fmt::format("task {} {} for a timeout", name,
                         entry.waits_for_timeout ? "cannot wait" : "does not wait"));
    }
  }

  void check_active() {
    std::vector<std::uint8_t> is_used(catalog_.behaviors.size(), 0);
    for (const Snapshot::RunningTask& entry : snapshot_.running) {
      is_used[catalog_.values[entry.task][entry.place].behavior] = 1;
    }
    for (const auto& [behavior, time] : snapshot_.active) {
      if (is_used[behavior] != 0) continue;
      refuse(fmt::format("behavior {} is active, but performs no task",
                         quote(catalog_.name_of_behavior(behavior))));
    }
  }

  void check_queued(TaskId task, Microseconds due) {
    const std::string name = quote(catalog_.name_of_task(task));
    if (catalog_.tasks[task].reactive_start == 0) {
      refuse(fmt::format("task {} is in the queue, but does not start reactively", name));
    }
    if (places_[task] != none) refuse(fmt::format("task {} is in the queue, but runs", name));
    if (!queued_.insert(task).second) {
      refuse(fmt::format("task {} is in the queue twice", name));
    }
    if (due < snapshot_.now || due - snapshot_.now > snapshot_.reactive_delay) {
      refuse(fmt::format("task {} is in the queue for a time that cannot be", name));
    }
  }

  /// By the code that checks the answers of the solver.
  void check_constraints() {
    Checker checker(catalog_);
    for (std::uint32_t group = 0; group < catalog_.group_count(); ++group) {
      const TaskId first = catalog_.group_tasks[group];
      const TaskId end = catalog_.group_tasks[group + 1];
      Problem anything;
      anything.group = group;
      anything.domains.assign(catalog_.words[end] - catalog_.words[first], ~std::uint64_t{0});
      anything.may_stop.assign(end - first, 1);
      const Assignment answer(places_.begin() + first, places_.begin() + end);
      if (auto violation = checker.find_violation(anything, answer)) refuse(std::move(*violation));
    }
  }

  const CompiledCatalog& catalog_;
  const Snapshot& snapshot_;
  Assignment places_;                       ///< by task
  std::vector<Microseconds> activated_at_;  ///< by behavior
  std::set<std::uint64_t> events_;          ///< those of the requests
  std::set<TaskId> queued_;
  std::string problem_;
};

}  // namespace

std::optional<std::string> find_inconsistency(const CompiledCatalog& catalog,
                                              const Snapshot& snapshot) {
  return SnapshotCheck(catalog, snapshot).run();
}

}  // namespace cbc
