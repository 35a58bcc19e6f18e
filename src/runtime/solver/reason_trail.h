#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/literal.h"
#include "runtime/solver/nogoods.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// Works out reasons only when they are asked for.
class LazyReasons {
 public:
  virtual ~LazyReasons() = default;
  /// Appends what the literal follows from: literals that held before it. `data`: of its reason.
  virtual void append_reason(Literal literal, std::uint32_t data,
                             std::vector<Literal>& reason) const = 0;
};

/// What a search with learning has decided and inferred in one group, in order, with the reason of
/// each inference. The domains always say the same.
///
/// Exclusivity, requirements and "a running task has one value" are propagated here, as far as the
/// propagator does, and so are the learned no-goods. A reason that follows from the catalog is
/// worked out only when asked for; others are stored.
class ReasonTrail final : public Inferences {
 public:
  /// Why a literal holds.
  struct Reason {
    enum class Kind : std::uint8_t {
      given,        ///< a decision, or a fact of the problem
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
  };

  ReasonTrail(const CompiledCatalog& catalog, Domains& domains);
  /// To be called once, before reasons of kind lazy are used.
  void set_lazy_reasons(const LazyReasons& reasons) { lazy_reasons_ = &reasons; }

  /// Begins with the facts of the problem; the domains must be loaded. Forgets all no-goods. False:
  /// see conflict().
  [[nodiscard]] bool load(const Problem& problem);

  [[nodiscard]] static Literal runs(std::uint32_t task) { return 2 * task; }
  [[nodiscard]] Literal has_value(std::uint32_t task, std::uint32_t index) const {
    return 2 * (task_count_ + first_value(task) + index);
  }
  [[nodiscard]] std::uint32_t task_of(std::uint32_t variable) const {
    return variable < task_count_
               ? variable
               : catalog_.value_tasks[first_value_ + variable - task_count_] - first_task_;
  }

  [[nodiscard]] bool is_about_running(Literal literal) const {
    return variable_of(literal) < task_count_;
  }
  /// The tasks with a request, most important first.
  [[nodiscard]] std::span<const std::uint32_t> requests() const { return requests_; }

  [[nodiscard]] bool is_true(Literal literal) const { return truth_[literal] > 0; }
  [[nodiscard]] bool is_false(Literal literal) const { return truth_[literal] < 0; }
  [[nodiscard]] std::uint32_t level_of(Literal literal) const {
    return levels_[variable_of(literal)];
  }
  /// Of a literal that holds: its place in literals().
  [[nodiscard]] std::uint32_t place_of(Literal literal) const {
    return literal_places_[variable_of(literal)];
  }
  [[nodiscard]] std::uint32_t level() const { return static_cast<std::uint32_t>(marks_.size()); }
  [[nodiscard]] std::size_t variable_count() const { return variable_count_; }
  /// What holds, in the order of inference.
  [[nodiscard]] std::span<const Literal> literals() const override { return literals_; }
  [[nodiscard]] std::span<const std::uint32_t> levels() const override { return levels_; }

  void decide(Literal literal);
  /// Propagates to a fixpoint. False: see conflict().
  [[nodiscard]] bool propagate();
  /// Infers a literal, which may hold already. False if it is false.
  [[nodiscard]] bool imply(Literal literal, Reason reason);
  /// Stores a reason, up to the end of the present level: all of it holds. Several inferences may
  /// share it.
  [[nodiscard]] Reason store(std::span<const Literal> reason);
  /// Makes literals that all hold, and cannot in any solution of interest, the conflict.
  void set_conflict(std::span<const Literal> literals);

  /// Literals that hold and cannot all hold.
  [[nodiscard]] const std::vector<Literal>& conflict() const { return conflict_; }
  [[nodiscard]] bool is_given(Literal literal) const override {
    return reason_of(literal).kind == Reason::Kind::given;
  }
  void append_reason(Literal literal, std::vector<Literal>& reason) const override {
    append_reason(literal, reason_of(literal), reason);
  }
  /// Notes that the reason of a literal has taken part in a conflict.
  void note_use_of_reason(Literal literal) {
    const Reason& reason = reason_of(literal);
    if (reason.kind == Reason::Kind::nogood) nogoods_.note_use(reason.data);
  }
  /// Learns a no-good, and infers its first literal: to be called after going back. `levels`: see
  /// Nogoods::add. False if the literal is false.
  [[nodiscard]] bool learn(std::span<const Literal> clause, std::uint32_t levels);

  void backtrack_to(std::uint32_t level);
  [[nodiscard]] Nogoods& nogoods() { return nogoods_; }
  /// Changes with every inference and every way back.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Inferences since the load.
  [[nodiscard]] std::uint64_t propagations() const { return propagations_; }

 private:
  [[nodiscard]] const Reason& reason_of(Literal literal) const {
    return reasons_[variable_of(literal)];
  }

  struct LevelMark {
    std::size_t literals = 0;
    std::size_t stored = 0;
    Domains::Mark domains;
  };

  void set(Literal literal, Reason reason);
  void append_reason(Literal literal, const Reason& reason, std::vector<Literal>& result) const;
  void append_removals(std::uint32_t task, const std::uint64_t* kept,
                       std::vector<Literal>& result) const;
  [[nodiscard]] bool follow_catalog(Literal literal);
  [[nodiscard]] bool follow_running(std::uint32_t task);
  [[nodiscard]] bool follow_not_running(std::uint32_t task);
  [[nodiscard]] bool follow_value(std::uint32_t task, std::uint32_t index);
  [[nodiscard]] bool follow_removal(std::uint32_t task);
  [[nodiscard]] bool follow_remaining_values(std::uint32_t task);
  [[nodiscard]] bool follow_nogoods(Literal literal);

  [[nodiscard]] std::uint32_t first_value(std::uint32_t task) const {
    return catalog_.values.begin[first_task_ + task] - first_value_;
  }

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Nogoods nogoods_;
  TaskId first_task_ = 0;
  std::uint32_t task_count_ = 0;
  ValueId first_value_ = 0;
  std::size_t variable_count_ = 0;
  std::vector<std::int8_t> truth_;  ///< by literal: 1 true, -1 false, 0 undecided
  const LazyReasons* lazy_reasons_ = nullptr;
  std::span<const std::uint32_t> requests_;
  std::vector<std::uint32_t> levels_;
  std::vector<std::uint32_t> literal_places_;
  std::vector<Reason> reasons_;
  std::vector<Literal> literals_;
  std::size_t next_ = 0;  ///< the first of literals_ that is not yet propagated
  std::vector<LevelMark> marks_;
  std::vector<Literal> stored_;  ///< each reason after its length
  std::vector<Literal> conflict_;
  std::uint64_t version_ = 0;
  std::uint64_t propagations_ = 0;
};

}  // namespace cbc
