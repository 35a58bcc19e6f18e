// The coordinator itself is asked: it takes the first request from idle, then from that state the
// second one. Tasks of different groups do not meet (docs/semantics.md, "Groups"), so of these
// each is as it is alone, and nothing is asked.

#include "verify/engine/overrides.h"

#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc {
namespace {

/// Keeps the outcome of the last event.
class LastOutcome final : public EventListener {
 public:
  void on_event(const EventRecord& record) override {
    if (record.origin == Origin::script) outcome = record.outcome;
  }

  Outcome outcome = Outcome::unchanged;
};

class OverrideSearch {
 public:
  OverrideSearch(const CompiledCatalog& catalog, std::span<const TaskId> tasks,
                 const SituationPart& situation)
      : catalog_(catalog), coordinator_(catalog, {}, last_) {
    matrix_.tasks.assign(tasks.begin(), tasks.end());
    std::vector<Availability> own;
    for (const SituationPart::Own& one : situation.behaviors) {
      own.push_back({catalog.behaviors[one.behavior].catalog_index, one.available});
    }
    coordinator_.begin(own, situation.variables);
    idle_ = coordinator_.snapshot();
  }

  OverrideMatrix find(const Budget& budget) {
    for (const TaskId task : matrix_.tasks) {
      if (!keeps_on(budget, 0) || !start_from(idle_, task, 1)) return std::move(matrix_);
      alone_.push_back(coordinator_.state().behavior(task));
      matrix_.is_alone.push_back(alone_.back() != none);
    }
    for (std::size_t row = 0; row < matrix_.tasks.size(); ++row) {
      if (!keeps_on(budget, row) || !add_row(row)) return std::move(matrix_);
    }
    matrix_.complete = true;
    return std::move(matrix_);
  }

 private:
  static constexpr std::int32_t first_priority = 2;
  static constexpr std::array<std::int32_t, priorities_of_second> second_priority{2, 3, 1};

  /// False if the coordinator fails.
  [[nodiscard]] bool start_from(const Snapshot& state, TaskId task, std::int32_t priority) {
    coordinator_.resume(state);
    Event start;
    start.verb = Verb::start;
    start.subject = catalog_.tasks[task].catalog_index;
    start.priority = priority;
    if (coordinator_.handle(start) == Coordinator::Status::ok) return true;
    matrix_.error = coordinator_.internal_error();
    return false;
  }

  [[nodiscard]] bool add_row(std::size_t row) {
    if (!start_from(idle_, matrix_.tasks[row], first_priority)) return false;
    const Snapshot after_first = coordinator_.snapshot();
    std::vector<OverrideMatrix::Cell> cells(matrix_.tasks.size());
    for (std::size_t column = 0; column < cells.size(); ++column) {
      for (std::size_t priority = 0; priority < priorities_of_second; ++priority) {
        Override& override_of = cells[column][priority];
        if (row == column || alone_[row] == none) continue;
        if (!decide(after_first, row, column, second_priority[priority], override_of)) return false;
      }
    }
    matrix_.cells.insert(matrix_.cells.end(), cells.begin(), cells.end());
    return true;
  }

  /// False if the coordinator fails.
  [[nodiscard]] bool decide(const Snapshot& after_first, std::size_t row, std::size_t column,
                            std::int32_t priority, Override& found) {
    const TaskId first = matrix_.tasks[row];
    const TaskId second = matrix_.tasks[column];
    if (catalog_.tasks[first].group != catalog_.tasks[second].group) {
      found.kind = alone_[column] == none ? Override::Kind::rejected : Override::Kind::both;
      return true;
    }
    if (!start_from(after_first, second, priority)) return false;
    const State& state = coordinator_.state();
    if (last_.outcome == Outcome::rejected) {
      found.kind = Override::Kind::rejected;
    } else if (!state.is_running(first)) {
      found.kind = Override::Kind::stops;
    } else {
      found.kind = Override::Kind::both;
      for (const std::size_t place : {row, column}) compare_with_alone(place, found);
    }
    return true;
  }

  [[nodiscard]] bool keeps_on(const Budget& budget, std::size_t rows) const {
    if (budget.tell) {
      budget.tell(std::string(catalog_.file),
                  [rows] { return fmt::format(" ({} decided)", quantity(rows, "task")); });
    }
    return !budget.find_end();
  }

  void compare_with_alone(std::size_t place, Override& found) const {
    const TaskId task = matrix_.tasks[place];
    const BehaviorId now = coordinator_.state().behavior(task);
    const BehaviorId alone = alone_[place];
    if (alone == none || now == alone) return;
    found.changes.push_back({task, alone, now});
    const bool is_worse = suitability(task, now) < suitability(task, alone);
    if (is_worse) {
      found.kind = Override::Kind::worse;
    } else if (found.kind == Override::Kind::both) {
      found.kind = Override::Kind::other;
    }
  }

  [[nodiscard]] Millionths suitability(TaskId task, BehaviorId behavior) const {
    for (const Value& value : catalog_.values[task]) {
      if (value.behavior == behavior) return value.suitability;
    }
    return 0;
  }

  const CompiledCatalog& catalog_;
  LastOutcome last_;
  Coordinator coordinator_;
  Snapshot idle_;
  std::vector<BehaviorId> alone_;  ///< by row: with which the task runs alone, or none
  OverrideMatrix matrix_;
};

}  // namespace

std::string_view name_of(Override::Kind kind) {
  constexpr std::array<std::string_view, 6> names = {"both",  "other",    "worse",
                                                     "stops", "rejected", "not_started"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(PriorityOfSecond priority) {
  constexpr std::array<std::string_view, priorities_of_second> names = {"same", "higher", "lower"};
  return names[static_cast<std::size_t>(priority)];
}

OverrideMatrix find_overrides(const CompiledCatalog& catalog, std::span<const TaskId> tasks,
                              const SituationPart& situation, const Budget& budget) {
  return OverrideSearch(catalog, tasks, situation).find(budget);
}

}  // namespace cbc
