#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "cbc/units.h"
#include "runtime/base/natural.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/components.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// An exact product of degrees, which decides where sums of logarithms are too close to tell.
class ExactProduct {
 public:
  /// Products of up to `factors` factors allocate nothing from here on.
  void reserve(std::size_t factors);
  void clear();
  void multiply(Millionths degree);

  /// Compares the products. Brings both to one denominator first.
  static std::strong_ordering compare(ExactProduct& a, ExactProduct& b);

 private:
  Natural numerator_;
  std::uint32_t factors_ = 0;  ///< the denominator is 10^6 to this power
};

/// The order of the values of each task that decides where all objectives are equal
/// (docs/semantics.md, "Canonical order").
class CanonicalOrder {
 public:
  explicit CanonicalOrder(const CompiledCatalog& catalog);

  /// Sets the problem. Allocates nothing.
  void load(const Problem& problem);

  /// Rank of a value (or none) of a task: lower is better, and no two values have the same.
  [[nodiscard]] std::uint32_t key(LocalTask task, std::uint32_t index) const {
    if (index == none) return empty_first_[task] != 0 ? 0U : none;
    return index == kept_first_[task] ? 0 : index + 1;
  }

 private:
  const CompiledCatalog& catalog_;
  std::vector<std::uint8_t> empty_first_;  ///< by task: "not running" comes first
  std::vector<std::uint32_t> kept_first_;  ///< by task: the value index that comes first, or none
};

/// The product of the suitabilities of what was asked for: of the tasks with a request of priority
/// 1 or more, and of what they require (docs/semantics.md, "Objectives").
class AskedProduct {
 public:
  struct Factors {
    std::vector<Millionths> degrees;  ///< apart from 1
    std::int64_t cost = 0;
    bool is_zero = false;
  };

  explicit AskedProduct(const CompiledCatalog& catalog);

  /// A bound on that of the solutions in a subtree: of what runs in all of them, each with its most
  /// suitable behavior. `requests`: what was asked for. Valid until the next call.
  [[nodiscard]] const Factors& bound(const Domains& domains, std::span<const LocalTask> requests);
  /// That of an assignment of a group. Valid until the next call.
  [[nodiscard]] const Factors& of(TaskId first_task, const Assignment& assignment,
                                  std::span<const LocalTask> requests);
  /// "less" is better: the higher product.
  [[nodiscard]] std::strong_ordering compare(const Factors& ours, const Factors& theirs);
  /// Whether what was asked for would run worse in an answer than before: the answer to a start
  /// that nobody asked for is none then.
  [[nodiscard]] bool is_worse(TaskId first_task, const Problem& problem, const Assignment& answer);

 private:
  void clear();
  void add(LocalTask task, const Value& value);

  const CompiledCatalog& catalog_;
  std::vector<LocalTask> closure_;
  std::vector<std::uint64_t> in_closure_;  ///< by task: number of the last closure it was in
  std::uint64_t number_ = 0;
  Factors factors_;
  Factors present_;
  ExactProduct ours_;
  ExactProduct theirs_;
};

/// The best solution so far, and its objectives.
struct Incumbent {
  bool exists = false;
  Assignment assignment;           ///< by task
  std::vector<LocalTask> running;  ///< tasks that run
  std::uint32_t satisfied = 0;     ///< requests, for f1
  AskedProduct::Factors asked;     ///< only where it is compared
  Domains::Sums sums;              ///< for f2 and f3
  std::uint32_t changes = 0;       ///< for f4
};

/// The lexicographic objective: f1 to f4, then the canonical order (docs/semantics.md,
/// "Objectives").
class Objective {
 public:
  Objective(const CompiledCatalog& catalog, const Domains& domains, const Components& components);

  /// To be called after Domains::load. `has_all_answers`: also answers are compared in which a task
  /// runs for nothing, so that the product of what was asked for says more than f2.
  void load(const Problem& problem, bool has_all_answers = false);

  /// The first objective that tells two solutions apart.
  enum class Decider : std::uint8_t { requests, asked, unasked, suitability, idle, changes, order };
  struct Comparison {
    std::strong_ordering order = std::strong_ordering::equal;  ///< "less" is better
    Decider decider = Decider::order;
  };

  /// Compares a bound on the solutions in the present subtree with `incumbent`, the best of the
  /// component entered at `depth`. Exact where the subtree is solved: each needed task of the
  /// component has one behavior left and no request is undecided.
  [[nodiscard]] Comparison compare(const Incumbent& incumbent, std::uint32_t depth);
  /// Whether a solution in the present subtree may be better than `incumbent`; see compare().
  [[nodiscard]] bool may_beat(const Incumbent& incumbent, std::uint32_t depth) {
    return !incumbent.exists || compare(incumbent, depth).order < 0;
  }

  /// f1, then the requests from the most important one down, suspended ones last: how the best of
  /// the subtree compares with `incumbent`. "less" is better.
  [[nodiscard]] std::strong_ordering compare_requests(const Incumbent& incumbent) const;
  /// Whether f2 is the first that may tell it from `incumbent`.
  [[nodiscard]] bool ties_before_suitability(const Incumbent& incumbent) {
    return compare_requests(incumbent) == 0 && compare_unasked(incumbent).order == 0;
  }

  /// Makes the solution of the present component the incumbent; each of its needed tasks has one
  /// behavior left. Needed tasks outside count with their most suitable behavior, as in may_beat.
  void record(Incumbent& incumbent);

  /// Rank of a value (or none) of a task in the canonical order: lower is better.
  [[nodiscard]] std::uint32_t key(LocalTask task, std::uint32_t index) const {
    return order_.key(task, index);
  }

  [[nodiscard]] bool was_active(BehaviorId behavior) const {
    return active_[behavior - domains_.first_behavior()] != 0;
  }
  [[nodiscard]] bool is_request(LocalTask task) const { return is_request_[task] != 0; }
  /// Whether a task may get this value without an activation of its own: the behavior was active,
  /// or performs other tasks, too.
  [[nodiscard]] bool is_free(LocalTask task, std::uint32_t index) const;
  /// Whether the task may run in a solution of the present subtree that ties with the incumbent on
  /// f1 to f3.
  [[nodiscard]] bool may_run(LocalTask task) const {
    return domains_.needed(task) || (is_request(task) && domains_.count(task) > 0);
  }

 private:
  [[nodiscard]] Comparison compare_unasked(const Incumbent& incumbent);
  [[nodiscard]] std::strong_ordering compare_suitability(const Incumbent& incumbent);
  [[nodiscard]] std::strong_ordering compare_exactly(const Incumbent& incumbent);
  [[nodiscard]] std::strong_ordering compare_keys(const Incumbent& incumbent,
                                                  std::uint32_t depth) const;
  [[nodiscard]] std::uint32_t least_changes();
  [[nodiscard]] std::uint32_t least_activations();
  [[nodiscard]] std::uint32_t least_activations_of_open_tasks() const;
  [[nodiscard]] std::uint32_t least_share(LocalTask task) const;
  [[nodiscard]] std::uint32_t least_deactivations() const;
  [[nodiscard]] bool may_stay(BehaviorId behavior) const;
  [[nodiscard]] bool has_free_value(LocalTask task) const {
    return domains_.any_within(task, &free_[domains_.word_begin(task)]);
  }
  [[nodiscard]] bool may_have(ValueId value) const;
  [[nodiscard]] bool is_counted(BehaviorId behavior) const {
    return counted_[behavior - domains_.first_behavior()] == count_number_;
  }

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  const Components& components_;
  const Problem* problem_ = nullptr;
  bool compares_asked_ = false;

  CanonicalOrder order_;
  AskedProduct asked_;
  std::vector<std::uint8_t> is_request_;  ///< by task
  std::vector<std::uint8_t> active_;      ///< by behavior of the group: active before the event
  std::vector<std::uint64_t> free_;       ///< as domains; see is_free
  std::vector<std::uint64_t> counted_;    ///< by behavior of the group: last count it was in
  std::uint64_t count_number_ = 0;
  ExactProduct ours_;
  ExactProduct theirs_;
};

}  // namespace cbc
