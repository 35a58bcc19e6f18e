#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"

namespace cbc {

/// A variable or its negation, in one number: 2 v says that variable v is true, 2 v + 1 that it is
/// false. The variables of a group are "the task runs", task by task, and then "the task has this
/// value", value by value.
using Literal = std::uint32_t;

[[nodiscard]] constexpr Literal negate(Literal literal) { return literal ^ 1U; }
[[nodiscard]] constexpr std::uint32_t variable_of(Literal literal) { return literal >> 1U; }
[[nodiscard]] constexpr bool is_negated(Literal literal) { return (literal & 1U) != 0; }

/// The no-goods that a search has learned, each as a clause: one of its literals holds in every
/// solution that is still of interest. Two literals of each clause are watched: only when one of
/// them becomes false can the clause imply something (M. W. Moskewicz et al., "Chaff: engineering
/// an efficient SAT solver", DAC 2001).
class Nogoods {
 public:
  /// Forgets everything. `variables` are to come.
  void clear(std::size_t variables);

  /// Adds a clause of two literals or more, and watches the first two. `levels`: the number of
  /// decision levels of its literals; the fewer, the more useful the clause is.
  std::uint32_t add(std::span<const Literal> literals, std::uint32_t levels);

  [[nodiscard]] std::span<const Literal> literals(std::uint32_t nogood) const {
    return {literals_.data() + nogoods_[nogood].begin, nogoods_[nogood].size};
  }

  /// Propagates that a literal holds: every clause that watches its negation needs another literal
  /// to watch; where none is left, the other watched literal follows. `truth` of a literal: 1 true,
  /// -1 false, 0 undecided. `imply` of a literal and a clause: infers it; false ends the
  /// propagation. False if it did.
  template <typename Imply>
  [[nodiscard]] bool follow(Literal literal, std::span<const std::int8_t> truth,
                            const Imply& imply);
  /// Literals that follow() has looked at, ever.
  [[nodiscard]] std::uint64_t visits() const { return visits_; }

  /// Notes that a clause has taken part in a conflict.
  void note_use(std::uint32_t nogood);
  void age() { increment_ *= growth; }

  [[nodiscard]] std::size_t size() const { return nogoods_.size(); }
  /// Forgets about half of the clauses, those used least. To be called where no clause is a
  /// reason.
  void forget_half();

 private:
  struct Watch {
    std::uint32_t nogood = 0;
    Literal other = 0;  ///< if it holds, the clause does
  };
  struct Nogood {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t levels = 0;
    double activity = 0;
  };
  static constexpr double growth = 1.001;

  void watch(std::uint32_t nogood);

  std::vector<Nogood> nogoods_;
  std::vector<Literal> literals_;
  std::vector<std::vector<Watch>> watches_;  ///< by literal
  std::vector<double> activities_;
  double increment_ = 1;
  std::uint64_t visits_ = 0;
};

/// Works out reasons only when they are asked for.
class LazyReasons {
 public:
  virtual ~LazyReasons() = default;
  /// Appends what the literal follows from: literals that held before it. `data`: of its cause.
  virtual void append_reason(Literal literal, std::uint32_t data,
                             std::vector<Literal>& reason) const = 0;
};

/// What a search that learns has decided and inferred in one group, in order, with the cause of
/// each inference. It lies on top of the domains, which always say the same and undo what they
/// say; a search that does not learn has the domains alone.
///
/// "A running task has one value" and the learned no-goods are propagated here, the constraints of
/// the catalog by those that derive from it. A reason that follows from the catalog is worked out
/// only when asked for; others are stored.
class Trail {
 public:
  Trail& operator=(Trail&&) = delete;
  virtual ~Trail() = default;

  /// Why a literal holds.
  struct Cause {
    enum class Kind : std::uint8_t {
      given,        ///< a decision, or a fact of the problem
      learned,      ///< a fact from a conflict; `data` is for the search
      literal,      ///< `data` is a literal that implies it
      nogood,       ///< `data` is a no-good of which everything else is false
      last_value,   ///< the task runs, and has no other value left
      no_value,     ///< the task has no value left
      requirement,  ///< all values that are left at the source of arc `data` require it
      stored,       ///< `data` is the place of a stored reason
      lazy          ///< LazyReasons knows it; `data` is for it
    };
    Kind kind = Kind::given;
    std::uint32_t data = 0;
    std::uint32_t constraint = none;  ///< that applies, where only some are in force
  };

  [[nodiscard]] static Literal runs(LocalTask task) { return 2 * task; }
  [[nodiscard]] Literal has_value(ValueId value) const {
    return 2 * (task_count_ + value - first_value_);
  }
  [[nodiscard]] Literal has_value(LocalTask task, std::uint32_t index) const {
    return has_value(ValueId(catalog_.values.begin[first_task_ + task] + index));
  }
  /// The value of a variable that says that a task has it.
  [[nodiscard]] ValueId value_of(std::uint32_t variable) const {
    return ValueId(first_value_ + variable - task_count_);
  }
  [[nodiscard]] LocalTask task_of(std::uint32_t variable) const {
    return variable < task_count_ ? LocalTask(variable)
                                  : catalog_.value_tasks[value_of(variable)] - first_task_;
  }
  [[nodiscard]] std::size_t variable_count() const { return variable_count_; }

  [[nodiscard]] bool is_true(Literal literal) const { return truth_[literal] > 0; }
  [[nodiscard]] bool is_false(Literal literal) const { return truth_[literal] < 0; }
  /// What holds, in the order of inference.
  [[nodiscard]] std::span<const Literal> literals() const { return literals_; }
  // Of a literal that holds: its place in literals(), the number of decisions before it, its cause.
  [[nodiscard]] std::uint32_t place_of(Literal literal) const {
    return places_[variable_of(literal)];
  }
  [[nodiscard]] std::uint32_t level_of(Literal literal) const {
    return levels_[variable_of(literal)];
  }
  [[nodiscard]] const Cause& cause_of(Literal literal) const {
    return causes_[variable_of(literal)];
  }
  [[nodiscard]] bool is_given(Literal literal) const {
    return cause_of(literal).kind == Cause::Kind::given;
  }
  /// Appends what a literal that holds follows from.
  void append_reason(Literal literal, std::vector<Literal>& reason) const {
    append_reason(literal, cause_of(literal), reason);
  }
  /// Appends that the task does not have any of the removed values that matter, by index.
  template <typename Matters>
  void append_removals(LocalTask task, const Matters& matters, std::vector<Literal>& reason) const;

  void decide(Literal literal);
  [[nodiscard]] std::uint32_t level() const { return static_cast<std::uint32_t>(marks_.size()); }
  /// The decision that began a level.
  [[nodiscard]] Literal decision(std::uint32_t level) const {
    return literals_[marks_[level - 1].literals];
  }
  /// Infers a literal, which may hold already. False if it is false: see conflict().
  [[nodiscard]] bool imply(Literal literal, Cause cause);
  /// Stores a reason, up to the end of the present level: all of it holds. Several inferences may
  /// share it.
  [[nodiscard]] Cause store(std::span<const Literal> reason);
  /// To be called once, before causes of kind lazy are used.
  void set_lazy_reasons(const LazyReasons& reasons) { lazy_reasons_ = &reasons; }
  /// Propagates to a fixpoint. False: see conflict().
  [[nodiscard]] bool propagate();
  void backtrack_to(std::uint32_t level);

  /// Literals that hold and cannot all hold, by the cause and the catalog.
  [[nodiscard]] const std::vector<Literal>& conflict() const { return conflict_; }
  [[nodiscard]] const Cause& conflict_cause() const { return conflict_cause_; }
  /// Makes literals that all hold, and cannot in any solution of interest, the conflict.
  void set_conflict(std::span<const Literal> literals, Cause cause);

  /// Learns a no-good, and infers its first literal: to be called after going back. `levels`: see
  /// Nogoods::add. False if the literal is false.
  [[nodiscard]] bool learn(std::span<const Literal> clause, std::uint32_t levels);
  [[nodiscard]] Nogoods& nogoods() { return nogoods_; }
  /// Notes that the reason of a literal has taken part in a conflict.
  void note_use_of_reason(Literal literal) {
    const Cause& cause = cause_of(literal);
    if (cause.kind == Cause::Kind::nogood) nogoods_.note_use(cause.data);
  }

  /// Changes with every inference and every way back.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Literals that were propagated, ever.
  [[nodiscard]] std::uint64_t propagations() const { return propagations_; }

 protected:
  Trail(const CompiledCatalog& catalog, Domains& domains);
  Trail(Trail&&) = default;

  /// Begins anew with the group of the domains: nothing holds or was learned.
  void clear();
  [[nodiscard]] bool imply_all_removed(LocalTask task, Literal but, Cause cause);
  /// Where as many tasks of a limit run as may, no other one does. `constraint`: of the causes.
  [[nodiscard]] bool close_limited(std::uint32_t limit, std::uint32_t constraint = none);

  // What follows from the constraints: where a task runs; where it does not, and has lost its
  // values; where it has the value; where it runs and several values are left.
  [[nodiscard]] virtual bool follow_running(LocalTask task) = 0;
  [[nodiscard]] virtual bool follow_not_running(LocalTask task) = 0;
  [[nodiscard]] virtual bool follow_value(LocalTask task, ValueId value) = 0;
  [[nodiscard]] virtual bool follow_choice(LocalTask task) = 0;

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Nogoods nogoods_;
  TaskId first_task_;
  std::uint32_t task_count_ = 0;

 private:
  struct LevelMark {
    std::size_t literals = 0;
    std::size_t stored = 0;
    Domains::Mark domains;
  };

  void set(Literal literal, Cause cause);
  void append_reason(Literal literal, const Cause& cause, std::vector<Literal>& result) const;
  [[nodiscard]] bool follow(Literal literal);
  [[nodiscard]] bool follow_remaining_values(LocalTask task);

  ValueId first_value_;
  std::size_t variable_count_ = 0;
  std::vector<std::int8_t> truth_;     ///< by literal: 1 true, -1 false, 0 undecided
  std::vector<std::uint32_t> levels_;  ///< by variable, as those below
  std::vector<std::uint32_t> places_;
  std::vector<Cause> causes_;
  std::vector<Literal> literals_;
  std::size_t next_ = 0;  ///< the first of literals_ that is not yet propagated
  std::vector<LevelMark> marks_;
  std::vector<Literal> stored_;  ///< each reason after its length
  std::vector<Literal> running_;
  const LazyReasons* lazy_reasons_ = nullptr;
  std::vector<Literal> conflict_;
  Cause conflict_cause_;
  std::uint64_t version_ = 0;
  std::uint64_t propagations_ = 0;
};

template <typename Matters>
void Trail::append_removals(LocalTask task, const Matters& matters,
                            std::vector<Literal>& reason) const {
  const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
  for (std::uint32_t index = 0; index < values; ++index) {
    if (!domains_.has(task, index) && matters(index)) {
      reason.push_back(negate(has_value(task, index)));
    }
  }
}

template <typename Imply>
bool Nogoods::follow(Literal literal, std::span<const std::int8_t> truth, const Imply& imply) {
  const Literal lost = negate(literal);
  std::vector<Watch>& watches = watches_[lost];
  std::size_t kept = 0;
  std::size_t next = 0;
  std::uint64_t visits = 0;
  bool is_consistent = true;
  while (is_consistent && next < watches.size()) {
    const Watch watch = watches[next++];
    ++visits;
    if (truth[watch.other] > 0) {
      watches[kept++] = watch;
      continue;
    }
    const Nogood& nogood = nogoods_[watch.nogood];
    const std::span<Literal> clause(literals_.data() + nogood.begin, nogood.size);
    if (clause[0] == lost) std::swap(clause[0], clause[1]);
    const Watch again{watch.nogood, clause[0]};
    ++visits;
    const auto other = truth[clause[0]] > 0
                           ? clause.end()
                           : std::find_if(clause.begin() + 2, clause.end(), [&](Literal some) {
                               ++visits;
                               return truth[some] >= 0;
                             });
    if (other != clause.end()) {
      std::swap(clause[1], *other);
      watches_[clause[1]].push_back(again);
      continue;
    }
    watches[kept++] = again;
    is_consistent = imply(clause[0], watch.nogood);
  }
  watches.erase(watches.begin() + static_cast<std::ptrdiff_t>(kept),
                watches.begin() + static_cast<std::ptrdiff_t>(next));
  visits_ += visits;
  return is_consistent;
}

}  // namespace cbc
