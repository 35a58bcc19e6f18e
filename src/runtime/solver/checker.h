#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// Checks an answer against the catalog before anyone acts on it. It shares nothing with the search
/// but the catalog and the problem: no costs, arcs or masks, and arithmetic of its own.
class Checker {
 public:
  explicit Checker(const CompiledCatalog& catalog);

  /// What is wrong with `answer`, or nothing.
  [[nodiscard]] std::optional<std::string> find_violation(const Problem& problem,
                                                          const Assignment& answer);

  /// Stops tasks of `answer` that violate something, one by one, until nothing does. "Not running"
  /// must be in all domains.
  void stop_violating_tasks(const Problem& problem, Assignment& answer);

 private:
  [[nodiscard]] BehaviorId behavior_of(TaskId task) const;
  [[nodiscard]] bool is_in_domain(const Problem& problem, TaskId task) const;
  [[nodiscard]] std::optional<std::string> check_domains(const Problem& problem);
  [[nodiscard]] std::optional<std::string> check_exclusivity();
  [[nodiscard]] std::optional<std::string> check_limits();
  [[nodiscard]] std::optional<std::string> check_requirements();
  [[nodiscard]] bool performs_at_least(TaskId task, Millionths minimum);
  [[nodiscard]] std::string describe(TaskId task) const;

  const CompiledCatalog& catalog_;
  const Assignment* answer_ = nullptr;
  TaskId first_task_;
  TaskId end_task_;
  TaskId violating_;                          ///< the task that the last violation is about
  std::uint64_t number_ = 0;                  ///< of the present check; marks what it has seen
  std::vector<std::uint64_t> clique_marks_;   ///< by clique
  std::vector<TaskId> clique_holders_;        ///< by clique: its running task, if marked
  std::vector<std::uint32_t> running_;        ///< by limit: its running tasks
  std::vector<std::uint64_t> closure_marks_;  ///< by task
  std::vector<TaskId> closure_;
  std::vector<std::uint32_t> digits_;
};

}  // namespace cbc
