#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check/controls.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/reasons.h"

/// Which tasks can run at the same time. A search decides, since exclusivity lists alone do not
/// tell: what two tasks require may exclude one another.
namespace cbc {

/// Whether two tasks can run at the same time.
enum class Together : std::uint8_t {
  possible,             ///< some assignment that satisfies all constraints runs both
  excluded,             ///< an exclusivity list has both
  excluded_indirectly,  ///< no assignment runs both, though no list has both
  /// Some assignment runs both, but with behaviors that fit in no common situation; there are
  /// situations in which either task can run.
  excluded_in_each_situation,
  excluded_by_situation,  ///< the same, and there is no situation in which either task can run
  undecided               ///< the search reached its limit
};

/// "possible", "excluded", "excluded_indirectly", "excluded_in_each_situation",
/// "excluded_by_situation", "undecided".
[[nodiscard]] std::string_view name_of(Together together);

/// Two tasks, and whether they can run at the same time.
struct TaskPair {
  TaskId first;  ///< the earlier one in the catalog
  TaskId second;
  Together together = Together::possible;
  /// Why not: of two tasks in a list this exclusion; otherwise a minimal set of constraints, in the
  /// order of the chain that they form, or nothing if it takes too long to find. A condition of a
  /// behavior is of the kind `situation`, without a value.
  std::vector<Reason> reasons;
  bool is_forbidden = false;  ///< possible, though the settings say that it must not be
};

/// All pairs of the tasks that start on request; of all tasks if none does.
struct TogetherTable {
  bool is_of_all_tasks = false;
  std::vector<TaskId> tasks;      ///< those that can run, in catalog order
  std::vector<TaskId> never_run;  ///< those that cannot, in catalog order
  std::vector<TaskPair> pairs;    ///< of `tasks`: by the first one, then by the second one

  [[nodiscard]] std::size_t count(Together together) const;
  [[nodiscard]] std::size_t count_forbidden() const;
};

/// How the pairs are decided.
struct TogetherOptions {
  std::uint64_t max_nodes = 100'000;  ///< decisions that the search for one answer may take
  /// What the settings forbid.
  std::span<const NeverTogether> never_together = {};
};

/// The most tasks whose pairs are looked at: time and memory grow with the square of their number.
inline constexpr std::size_t most_tasks_in_pairs = 2'000;

/// The number of the tasks that the table would be about, those that never run included.
[[nodiscard]] std::size_t count_tasks_in_pairs(const CompiledCatalog& catalog);

/// Of a catalog with at most `most_tasks_in_pairs` of these tasks.
[[nodiscard]] TogetherTable make_together_table(const CompiledCatalog& catalog,
                                                const TogetherOptions& options);

}  // namespace cbc
