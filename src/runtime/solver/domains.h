#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

namespace cbc {

[[nodiscard]] inline bool has_bit(const std::uint64_t* words, std::uint32_t index) {
  return ((words[index / 64] >> (index % 64)) & 1) != 0;
}

/// The indices of the bits that are set among the first `end`, ascending: a range, and its own
/// iterator.
class Bits {
 public:
  Bits(const std::uint64_t* words, std::uint32_t end) : words_(words), end_(end) { skip(); }
  [[nodiscard]] Bits begin() const { return *this; }
  [[nodiscard]] std::default_sentinel_t end() const { return {}; }
  [[nodiscard]] std::uint32_t operator*() const { return at_; }
  Bits& operator++() {
    ++at_;
    skip();
    return *this;
  }
  [[nodiscard]] bool operator==(std::default_sentinel_t /*end*/) const { return at_ == end_; }

 private:
  void skip() {
    while (at_ < end_ && !has_bit(words_, at_)) ++at_;
  }

  const std::uint64_t* words_;
  std::uint32_t end_;
  std::uint32_t at_ = 0;
};

/// The domains of the tasks of one group during a search, with a trail to undo changes, and sums
/// over the *needed* tasks: those that run in every solution of the present subtree ("not running"
/// has left their domain). The most suitable value of each bounds its share of the objective.
///
/// All other tasks can be left at "not running": to run a task that nothing needs never improves
/// f2, and makes f3 worse. So a subtree is solved when each needed task has one value.
class Domains {
 public:
  /// Sums over the needed tasks, each with the most suitable behavior in its domain.
  struct Sums {
    std::int64_t cost = 0;      ///< log_cost of the suitabilities, zeros left out
    std::uint32_t factors = 0;  ///< suitabilities other than 1 and 0
    std::uint32_t zeros = 0;    ///< suitabilities of 0
    std::uint32_t idle = 0;     ///< tasks that can start without a request (f3)
  };

  struct Mark {
    std::size_t trail = 0;
    std::size_t needed = 0;
    Sums sums;
  };

  explicit Domains(const CompiledCatalog& catalog);
  /// For one group only.
  Domains(const CompiledCatalog& catalog, GroupId group);

  void load(const Problem& problem) { load(problem.group, problem.domains); }
  /// `words`: the domains, as those of a Problem.
  void load(GroupId group, std::span<const std::uint64_t> words);

  /// Tasks and values of the largest group that it can load.
  [[nodiscard]] std::size_t most_variables() const { return most_variables_; }
  [[nodiscard]] std::uint32_t task_count() const { return task_count_; }
  [[nodiscard]] TaskId first_task() const { return first_task_; }
  [[nodiscard]] BehaviorId first_behavior() const { return first_behavior_; }

  [[nodiscard]] bool may_stop(LocalTask task) const { return tasks_[task].may_stop; }
  [[nodiscard]] bool needed(LocalTask task) const { return !tasks_[task].may_stop; }
  /// Number of behaviors in the domain.
  [[nodiscard]] std::uint32_t count(LocalTask task) const { return tasks_[task].count; }
  /// Value index of the most suitable behavior in the domain; needs count > 0.
  [[nodiscard]] std::uint32_t best(LocalTask task) const { return tasks_[task].best; }
  [[nodiscard]] bool has(LocalTask task, std::uint32_t index) const {
    return has_bit(&words_[tasks_[task].word], index);
  }
  /// The value indices of the behaviors in the domain.
  [[nodiscard]] Bits indices(LocalTask task) const {
    return {words_.data() + tasks_[task].word, tasks_[task].value_count};
  }
  /// First word of the task among those of the group.
  [[nodiscard]] std::uint32_t word_begin(LocalTask task) const { return tasks_[task].word; }
  [[nodiscard]] const Value& value(LocalTask task, std::uint32_t index) const {
    return tasks_[task].values[index];
  }
  [[nodiscard]] std::span<const Value> values(LocalTask task) const {
    return {tasks_[task].values, tasks_[task].value_count};
  }
  /// Whether all behaviors in the domain are among those of `mask` (words as those of the task).
  [[nodiscard]] bool all_within(LocalTask task, const std::uint64_t* mask) const;
  /// Whether any of them is.
  [[nodiscard]] bool any_within(LocalTask task, const std::uint64_t* mask) const;

  [[nodiscard]] const std::vector<LocalTask>& needed_tasks() const { return needed_; }
  [[nodiscard]] const Sums& sums() const { return sums_; }

  // Changes. Each returns false if a needed task has no behavior left.

  /// Takes "not running" out of the domain.
  [[nodiscard]] bool need(LocalTask task);
  /// Takes all behaviors out of the domain.
  [[nodiscard]] bool close(LocalTask task);
  [[nodiscard]] bool remove(LocalTask task, std::uint32_t index);
  [[nodiscard]] bool remove_all(LocalTask task, const std::uint64_t* mask);
  /// Leaves one behavior; "not running", if it is in the domain, stays.
  [[nodiscard]] bool keep_only(LocalTask task, std::uint32_t index);
  [[nodiscard]] bool assign(LocalTask task, std::uint32_t index) {
    return keep_only(task, index) && need(task);
  }

  [[nodiscard]] Mark mark() const { return {trail_.size(), needed_.size(), sums_}; }
  void undo_to(const Mark& mark);
  /// The task of a change, counted as the trail of a Mark is.
  [[nodiscard]] LocalTask changed_task(std::size_t change) const { return trail_[change].task; }

  // Tasks whose change may matter to others: needed ones that changed, and those with no behavior
  // left.

  [[nodiscard]] bool has_changed() const { return !changed_.empty(); }
  [[nodiscard]] LocalTask next_changed();
  void forget_changes();

 private:
  struct TaskState {
    const Value* values = nullptr;
    std::uint32_t value_count = 0;
    std::uint32_t word = 0;
    std::uint32_t word_count = 0;
    std::uint32_t count = 0;
    std::uint32_t best = 0;
    bool may_stop = true;
    bool start_on_request = true;
    bool is_changed = false;
  };
  struct Change {
    LocalTask task;
    std::uint32_t word = 0;  ///< or none: "not running" left the domain
    std::uint64_t before = 0;
  };

  Domains(const CompiledCatalog& catalog, std::size_t most_tasks, std::size_t most_values);

  [[nodiscard]] bool narrow(LocalTask task, std::uint32_t word, std::uint64_t after);
  void add_share(const Value& best, std::int32_t times);
  void find_best(TaskState& state) const;
  void note_change(LocalTask task);

  const CompiledCatalog& catalog_;
  const std::size_t most_variables_;
  std::uint32_t task_count_ = 0;
  TaskId first_task_;
  BehaviorId first_behavior_;
  std::vector<TaskState> tasks_;
  std::vector<std::uint64_t> words_;
  std::vector<LocalTask> needed_;
  std::vector<Change> trail_;
  std::vector<LocalTask> changed_;
  Sums sums_;
};

}  // namespace cbc
