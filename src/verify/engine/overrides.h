#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/property/properties.h"
#include "core/support/budget.h"
#include "runtime/compiled/compiled_catalog.h"

// Which of two requests gives way (docs/verify.md, "Who gives way to whom").

namespace cbc {

/// The priority of the second request, compared with that of the first one.
enum class PriorityOfSecond : std::uint8_t { same, higher, lower };
inline constexpr std::size_t priorities_of_second = 3;

/// What becomes of two requests, one after the other, from idle.
struct Override {
  enum class Kind : std::uint8_t {
    both,        ///< both tasks run, each with the behavior that it has alone
    other,       ///< both run, one with another behavior than alone, none with a worse one
    worse,       ///< both run, one with a less suitable behavior than alone
    stops,       ///< the first one stops
    rejected,    ///< the second one is rejected
    not_started  ///< the first one is rejected already
  };
  /// A task that runs with another behavior than alone.
  struct Change {
    TaskId task;
    BehaviorId alone;
    BehaviorId now;
  };
  Kind kind = Kind::not_started;
  std::vector<Change> changes;  ///< of the first task, then of the second one; if both run
};

/// "both", "other", "worse", "stops", "rejected", "not_started".
[[nodiscard]] std::string_view name_of(Override::Kind kind);
/// "same", "higher", "lower".
[[nodiscard]] std::string_view name_of(PriorityOfSecond priority);

/// What becomes of each ordered pair of some tasks.
struct OverrideMatrix {
  using Cell = std::array<Override, priorities_of_second>;  ///< by PriorityOfSecond

  std::vector<TaskId> tasks;
  std::vector<Cell> cells;     ///< row by row; the first task has the row
  std::vector<bool> is_alone;  ///< by row: whether the task starts from idle
  bool complete = false;       ///< false: the search was stopped, and rows at the end are missing
  std::string error;           ///< of a coordinator that refused an answer of its own; else empty

  [[nodiscard]] const Cell& at(std::size_t row, std::size_t column) const {
    return cells[row * tasks.size() + column];
  }
  /// The number of rows that are there.
  [[nodiscard]] std::size_t row_count() const {
    return tasks.empty() ? 0 : cells.size() / tasks.size();
  }
};

/// `situation`: variables that it leaves out have their first values. The budget is asked before
/// each row.
[[nodiscard]] OverrideMatrix find_overrides(const CompiledCatalog& catalog,
                                            std::span<const TaskId> tasks,
                                            const SituationPart& situation, const Budget& budget);

}  // namespace cbc
