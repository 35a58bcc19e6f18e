#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "ask/ask.h"

// What a state may satisfy, as far as the constraints say something about it: which task runs with
// which behavior, the situation, and what is faulty. A state has an assignment that satisfies all
// constraints, with behaviors that fit in its situation. Own(b) and faults do not end a behavior
// that is active. What no such state satisfies is proven for all reachable states, without
// exploring them.

namespace cbc {

/// A condition on a state, in negation normal form.
struct Formula {
  enum class Kind : std::uint8_t {
    all,         ///< all parts hold
    any,         ///< one of the parts holds
    task,        ///< runs with one of the values (ValueId), or if it may, does not run
    variable,    ///< has one of the values
    own,         ///< own(b) is as wanted
    fault,       ///< the behavior is faulty, or it is not, as wanted
    some_fault,  ///< one of the behaviors among the values is faulty
  };
  Kind kind = Kind::all;
  std::uint32_t subject = 0;
  std::vector<std::uint32_t> values = {};
  bool may_stop = false;
  bool wanted = true;
  std::vector<Formula> parts = {};
};

/// Makes formulas of what holds, or else of what does not.
class FormulaMaker {
 public:
  explicit FormulaMaker(const CompiledCatalog& catalog) : catalog_(catalog) {}

  /// Of parts of which all hold, or else of which one does.
  static Formula join(bool all) { return {all ? Formula::Kind::all : Formula::Kind::any}; }
  static Formula own(BehaviorId behavior, bool available) {
    return {Formula::Kind::own, behavior, {}, false, available};
  }
  static Formula faulty(BehaviorId behavior, bool holds) {
    return {Formula::Kind::fault, behavior, {}, false, holds};
  }
  /// The task runs with one of the behaviors; empty: with any.
  [[nodiscard]] Formula runs(TaskId task, const std::vector<BehaviorId>& behaviors,
                             bool holds) const;
  /// A behavior is active if it performs some task.
  [[nodiscard]] Formula active(BehaviorId behavior, bool holds) const;
  [[nodiscard]] Formula has_value(std::uint32_t variable, const std::vector<std::uint32_t>& listed,
                                  bool holds) const;
  /// None of the behaviors is faulty.
  static Formula none_faulty(const std::vector<BehaviorId>& behaviors, bool holds);
  /// It fits, and own(b) is true.
  [[nodiscard]] Formula available(BehaviorId behavior, bool holds) const;

 private:
  const CompiledCatalog& catalog_;
};

/// What states may be like, beside what the constraints say.
struct PossibleStates {
  SituationPart constant;                    ///< what does not change, as it is
  std::vector<SituationPart> never;          ///< situations that do not occur
  std::uint32_t faults = UINT32_MAX;         ///< the most behaviors that are faulty at a time
  std::function<bool(BehaviorId)> can_fail;  ///< empty: all can
};

/// Answers whether some state satisfies a formula.
class StateAsk {
 public:
  /// The catalog must outlive this object. The effort is that of all questions together.
  StateAsk(const CompiledCatalog& catalog, const PossibleStates& possible, std::uint64_t effort);

  [[nodiscard]] Effort& effort() { return search_.effort(); }

  /// Formulas that all hold.
  using Formulas = std::vector<const Formula*>;

  /// Under all constraints.
  [[nodiscard]] Feasibility find(const Formulas& formulas);

  /// Which constraints count.
  using Counts = std::function<bool(const Reason&)>;
  /// Under some of the constraints.
  [[nodiscard]] Feasibility find_under(const Formulas& formulas, const Counts& counts);
  /// Where no state satisfies the formulas under some of the constraints: a minimal set of them
  /// with which none does. Empty if it takes too long to find.
  [[nodiscard]] std::vector<Reason> conflict(const Formulas& formulas, const Counts& counts);

 private:
  struct OfTask {
    bool runs = false;
    std::vector<std::uint8_t> is_open;  ///< by place among the values of the task
  };
  /// What one way to satisfy a formula demands of a state.
  struct Case {
    std::map<TaskId, OfTask> tasks;
    ValueSets values;
    std::map<BehaviorId, bool> own;  ///< of those that may change
    std::map<BehaviorId, bool> faulty;
    std::vector<const Formula*> some_faults;
  };
  /// Takes a case that may have a state; no: go on.
  using OnCase = std::function<Feasibility(const SituationSpace&, const Asked&, const ValueSets&)>;

  [[nodiscard]] Feasibility go_through(const Formulas& formulas, const OnCase& on_case);
  [[nodiscard]] Feasibility go_on(Case of_state, Formulas open, const OnCase& on_case);
  [[nodiscard]] bool add(const Formula& literal, Case& of_state) const;
  [[nodiscard]] bool add_task(const Formula& literal, OfTask& task) const;
  [[nodiscard]] bool add_variable(const Formula& literal, ValueSets& values) const;
  [[nodiscard]] bool add_fault(BehaviorId behavior, bool wanted, Case& of_state) const;
  [[nodiscard]] bool may_have_faults(const Case& of_state) const;
  [[nodiscard]] bool can_fail(BehaviorId behavior) const;
  [[nodiscard]] Feasibility settle(Case of_state, const OnCase& on_case);
  [[nodiscard]] std::optional<BehaviorId> find_open_own(const Case& of_state) const;
  [[nodiscard]] std::vector<SituationPart> never_in(const Case& of_state) const;
  [[nodiscard]] Asked asked_of(const Case& of_state) const;
  [[nodiscard]] bool collect(const Formulas& formulas, const Counts& counts,
                             RelaxedQuestions& questions, std::vector<Reason>& constraints,
                             std::deque<SituationSpace>& spaces);

  const CompiledCatalog& catalog_;
  const PossibleStates possible_;
  const SituationSpace space_;  ///< without `never`
  AssignmentSearch search_;
};

}  // namespace cbc
