#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/reasons.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/literal.h"
#include "runtime/solver/nogoods.h"

namespace cbc {

/// What a search with only some constraints in force has decided and inferred, in order, with the
/// cause of each inference. Propagates exclusions, requirements, "a running task has one value",
/// and no-goods. Every no-good comes with the constraints that it was derived from.
class RelaxedTrail final : public Inferences {
 public:
  /// Why a literal holds.
  struct Cause {
    enum class Kind : std::uint8_t {
      given,       ///< a decision, a demand, or a reason that implies it alone
      literal,     ///< `data` is a literal that implies it
      last_value,  ///< the task runs, and has no other value left
      no_value,    ///< the task has no value left
      nogood       ///< `data` is a no-good of which everything else is false
    };
    Kind kind = Kind::given;
    std::uint32_t data = 0;
    std::uint32_t reason = none;  ///< index of the constraint that applies, or none
    std::uint32_t origin = none;  ///< of what was learned: number of the set of its constraints
  };

  RelaxedTrail(const CompiledCatalog& catalog, std::uint32_t group);

  /// Begins anew, without anything that holds or was learned. `reasons`: the constraints in force;
  /// to be kept until the next load.
  void load(std::span<const Reason> reasons);

  [[nodiscard]] Literal runs(TaskId task) const { return 2 * (task - first_task_); }
  [[nodiscard]] Literal has_value(ValueId value) const {
    return 2 * (task_count_ + value - first_value_);
  }
  [[nodiscard]] Literal has_value(TaskId task, std::uint32_t index) const {
    return has_value(catalog_.values.begin[task] + index);
  }
  [[nodiscard]] std::size_t variable_count() const { return levels_.size(); }
  [[nodiscard]] TaskId task_of(std::uint32_t variable) const {
    return variable < task_count_ ? first_task_ + variable
                                  : catalog_.task_of(first_value_ + variable - task_count_);
  }

  [[nodiscard]] bool is_true(Literal literal) const { return truth_[literal] > 0; }
  [[nodiscard]] bool is_false(Literal literal) const { return truth_[literal] < 0; }
  /// Number of values that the task may have.
  [[nodiscard]] std::uint32_t count(TaskId task) const { return counts_[task - first_task_]; }
  [[nodiscard]] std::uint32_t value_count(TaskId task) const {
    return static_cast<std::uint32_t>(catalog_.values[task].size());
  }
  /// Index of the most suitable value that the task may have; there must be one.
  [[nodiscard]] std::uint32_t best(TaskId task) const;
  /// The behavior of a task that runs with only one value left; otherwise none.
  [[nodiscard]] BehaviorId fixed_behavior(TaskId task) const;
  [[nodiscard]] std::uint32_t level() const { return static_cast<std::uint32_t>(marks_.size()); }

  void decide(Literal literal);
  /// The decision of each level.
  [[nodiscard]] Literal decision(std::uint32_t level) const { return literals_[marks_[level - 1]]; }
  /// Infers a literal, which may hold already. False if it is false: see conflict().
  [[nodiscard]] bool imply(Literal literal, const Cause& cause);
  /// Propagates to a fixpoint. False: see conflict().
  [[nodiscard]] bool propagate();
  void backtrack_to(std::uint32_t level);

  /// Literals that hold and cannot all hold, by the constraint conflict_cause() and the catalog.
  [[nodiscard]] const std::vector<Literal>& conflict() const { return conflict_; }
  [[nodiscard]] const Cause& conflict_cause() const { return conflict_cause_; }
  void set_conflict(std::span<const Literal> literals, const Cause& cause);

  /// Learns a no-good, and infers its first literal: to be called after going back. False if it is
  /// false: see conflict().
  [[nodiscard]] bool learn(std::span<const Literal> clause, std::uint32_t levels,
                           std::span<const std::uint32_t> reasons);

  /// The constraints that a learned no-good was derived from.
  [[nodiscard]] std::span<const std::uint32_t> reasons_of(std::uint32_t origin) const {
    const std::uint32_t begin = origin_begins_[origin];
    return {origin_reasons_.data() + begin, origin_begins_[origin + 1] - begin};
  }

  [[nodiscard]] std::span<const Literal> literals() const override { return literals_; }
  [[nodiscard]] std::span<const std::uint32_t> levels() const override { return levels_; }
  [[nodiscard]] bool is_given(Literal literal) const override {
    return cause_of(literal).kind == Cause::Kind::given;
  }
  void append_reason(Literal literal, std::vector<Literal>& reason) const override {
    append_reason(literal, cause_of(literal), reason);
  }
  [[nodiscard]] const Cause& cause_of(Literal literal) const {
    return causes_[variable_of(literal)];
  }

  /// Literals and constraints visited so far.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

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

  /// The constraints to look at when one of these changes.
  struct Index {
    Lists exclusions;    ///< by task of the group
    Lists required_by;   ///< by task of the group
    Lists requirements;  ///< by behavior of the group
  };

  void index_constraints();
  void append_reason(Literal literal, const Cause& cause, std::vector<Literal>& result) const;
  void set(Literal literal, const Cause& cause);
  [[nodiscard]] bool follow(Literal literal);
  [[nodiscard]] bool follow_running(TaskId task);
  [[nodiscard]] bool follow_not_running(TaskId task);
  [[nodiscard]] bool follow_value(ValueId value);
  [[nodiscard]] bool follow_remaining_values(TaskId task);
  [[nodiscard]] bool follow_nogoods(Literal literal);

  const CompiledCatalog& catalog_;
  const TaskId first_task_;
  const std::uint32_t task_count_;
  const ValueId first_value_;
  const BehaviorId first_behavior_;
  const std::uint32_t behavior_count_;
  std::span<const Reason> constraints_;
  Index index_;
  std::vector<std::int8_t> truth_;     ///< by literal: 1 true, -1 false, 0 undecided
  std::vector<std::uint32_t> levels_;  ///< by variable
  std::vector<Cause> causes_;          ///< by variable
  std::vector<std::uint32_t> counts_;  ///< by task of the group
  std::vector<Literal> literals_;
  std::size_t next_ = 0;  ///< the first of literals_ that is not yet propagated
  std::vector<std::size_t> marks_;
  std::vector<Literal> conflict_;
  Cause conflict_cause_;
  Nogoods nogoods_;
  std::vector<std::uint32_t> nogood_origins_;
  std::vector<std::uint32_t> origin_begins_;
  std::vector<std::uint32_t> origin_reasons_;
  std::uint64_t effort_ = 0;
};

}  // namespace cbc
