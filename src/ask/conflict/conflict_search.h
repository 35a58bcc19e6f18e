#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "ask/conflict/effort.h"
#include "ask/conflict/reasons.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/trail.h"

// Why there is no assignment. The solver takes all constraints of a catalog; this search takes some
// of them, and tells which ones its proof has used. From these a minimal conflict set is made
// (reasons.h).

namespace cbc {

/// The trail of a search with only some constraints in force: exclusions and requirements, as they
/// are listed. Every no-good comes with the constraints that it was derived from.
class RelaxedTrail final : public Trail {
 public:
  RelaxedTrail(const CompiledCatalog& catalog, GroupId group, Domains& domains);

  /// Begins anew: every task of the group may have any of its values, or none. `reasons`: the
  /// constraints in force; to be kept until the next load.
  void load(std::span<const Reason> reasons);

  /// As in Trail; `reasons`: those that the no-good was derived from.
  [[nodiscard]] bool learn(std::span<const Literal> clause, std::uint32_t levels,
                           std::span<const std::uint32_t> reasons);
  /// The constraints that a learned no-good was derived from; nothing for other causes.
  [[nodiscard]] std::span<const std::uint32_t> reasons_of(const Cause& cause) const;

  /// Literals and constraints visited so far.
  [[nodiscard]] std::uint64_t effort() const {
    return effort_ + propagations() + nogoods_.visits();
  }

 private:
  /// Lists of numbers, in one array. Each number is counted first, and then added.
  class Lists {
   public:
    void begin(std::size_t count) { begins_.assign(count + 2, 0); }
    void count(std::uint32_t list, std::uint32_t /*item*/) { ++begins_[list + 2]; }
    void end_count() {
      std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
      items_.resize(begins_.back());
    }
    void add(std::uint32_t list, std::uint32_t item) { items_[begins_[list + 1]++] = item; }

    [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t list) const {
      return {items_.data() + begins_[list], begins_[list + 1] - begins_[list]};
    }

   private:
    std::vector<std::uint32_t> begins_;  ///< by list; while it is filled, of the list before it
    std::vector<std::uint32_t> items_;
  };

  void index_constraints();
  [[nodiscard]] bool follow_running(LocalTask task) override;
  [[nodiscard]] bool follow_not_running(LocalTask task) override;
  [[nodiscard]] bool follow_value(LocalTask task, ValueId value) override;
  [[nodiscard]] bool follow_choice(LocalTask /*task*/) override { return true; }

  const BehaviorId first_behavior_;
  const std::uint32_t behavior_count_;
  std::span<const Reason> constraints_;
  // The constraints to look at when one of these changes.
  Lists exclusions_;                           ///< by task of the group
  Lists limits_;                               ///< by task of the group
  Lists required_by_;                          ///< by task of the group
  Lists requirements_;                         ///< by behavior of the group
  std::vector<std::uint32_t> nogood_origins_;  ///< by no-good: the place of its reasons
  std::vector<std::uint32_t> origin_begins_;   ///< by origin, and the end
  std::vector<std::uint32_t> origin_reasons_;
  std::uint64_t effort_ = 0;  ///< constraints
};

/// Whether a problem has a solution; unknown at a limit of effort.
enum class Feasibility : std::uint8_t { no, yes, unknown };

/// Searches for a solution with only some of the reasons in force: the demands hold; otherwise
/// every task of the group may have any of its behaviors or none, and the reasons are all
/// constraints. A proof of no solution yields the reasons that it used.
class ConflictSearch {
 public:
  /// `present`: by task of the group, its value index, or none; has to stay where it is.
  ConflictSearch(const CompiledCatalog& catalog, GroupId group,
                 std::span<const std::uint32_t> present, Demands demands);

  [[nodiscard]] const Demands& demands() const { return demands_; }

  /// Admits only solutions in which `task` runs and its performance is below `minimum`.
  void keep_below(TaskId task, Millionths minimum) {
    low_task_ = task - first_task_;
    low_minimum_ = minimum;
  }

  /// The answer is unknown where that takes more than the effort, which is spent.
  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons, Effort& left);

  /// After the answer yes: the values of a task and of all that it requires; empty if nothing needs
  /// the task.
  [[nodiscard]] std::vector<ValueId> values_of(TaskId task);

  /// After the answer no: by reason, whether the proof used it. The reasons that it used leave no
  /// solution by themselves.
  [[nodiscard]] const std::vector<std::uint8_t>& is_used() const { return is_used_; }

 private:
  /// Literals, reasons and values visited so far: a measure of time that does not depend on the
  /// machine.
  [[nodiscard]] std::uint64_t effort() const { return effort_ + trail_.effort(); }

  [[nodiscard]] bool begin(std::span<const Reason> reasons);
  [[nodiscard]] bool demand(const Demand& demand);
  void sort(std::span<const Reason> reasons);
  [[nodiscard]] bool apply(const Reason& reason, std::uint32_t index);

  [[nodiscard]] bool propagate(std::span<const Reason> reasons);
  [[nodiscard]] bool may_perform(const Reason& reason, std::uint32_t index);
  [[nodiscard]] bool may_reach(LocalTask reached, Millionths minimum);
  void explain_performance(const Trail::Cause& cause);

  [[nodiscard]] bool learn();
  [[nodiscard]] bool leave_dead_end();
  void begin_derivation();
  void add_cause(const Trail::Cause& cause);
  void add_reason(std::uint32_t reason);
  void trace_facts(std::span<const Literal> facts);

  [[nodiscard]] LocalTask choose_task() const;
  [[nodiscard]] std::uint32_t choose_value(LocalTask task);
  [[nodiscard]] LocalTask optional_factor() const;

  // Tasks are counted within the group.
  const CompiledCatalog& catalog_;
  const std::span<const std::uint32_t> present_;
  const Demands demands_;
  const TaskId first_task_;
  const std::uint32_t task_count_;
  LocalTask low_task_ = none;
  Millionths low_minimum_ = 0;
  std::unique_ptr<Domains> domains_;  ///< stay where they are when the search is moved
  RelaxedTrail trail_;
  ConflictAnalysis analysis_;
  std::vector<std::uint32_t> performances_;  ///< the reasons of that kind
  std::vector<std::uint32_t> state_;         ///< the reasons that apply once
  std::uint64_t effort_ = 0;                 ///< apart from that of the trail

  std::vector<std::uint32_t> saved_;  ///< by task: the value chosen last, or none
  Activities activities_;             ///< by task
  Restarts restarts_;

  // The derivation of a no-good.
  std::vector<std::uint8_t> is_used_;  ///< by reason
  std::vector<std::uint32_t> used_;
  std::vector<Literal> facts_;
  std::vector<std::uint8_t> is_known_fact_;  ///< by variable
  std::vector<std::uint32_t> known_facts_;

  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<LocalTask> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task
  std::vector<Literal> literals_;
};

}  // namespace cbc
