#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ask/formula.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

// What is said of one state, by a condition of a property file or by an expectation of a script: an
// expression. A new kind of atom needs a row in describe_condition() and one in ConditionFormula,
// the reader of its key (core/property/condition_reader.cpp), and its test in a state
// (explore/controls/state_test.cpp).

namespace cbc {

/// A condition on a state. Situation variables are counted as the catalog does.
struct StateCondition {
  enum class Kind : std::uint8_t {
    all,          ///< all parts hold; without parts it always holds
    any,          ///< one of the parts holds
    negated,      ///< the only part does not hold
    running,      ///< the task runs, with one of the behaviors if some are listed
    stopped,      ///< the task does not run
    active,       ///< the behavior is active
    only_active,  ///< the behaviors of the parts are active, and no other one of the groups
                  ///< explored
    faulty,       ///< the behavior is faulty
    none_faulty,  ///< no behavior of the groups explored is faulty
    failed,       ///< the behavior is in X
    available,    ///< the behavior fits, own(b) is true, and it is not in X
    requested,    ///< the task has a request with at least this priority, suspended or not
    suspended,    ///< the task has a suspended request
    variable,     ///< the situation variable has one of the values
    own           ///< own(b) of the behavior is as wanted
  };
  Kind kind = Kind::all;
  TaskId task = none;
  BehaviorId behavior = none;
  std::vector<BehaviorId> behaviors = {};
  std::int32_t priority = 1;
  std::uint32_t variable = none;
  std::vector<std::uint32_t> values = {};  ///< distinct, in the order of the file
  bool wanted = true;
  std::vector<StateCondition> parts = {};
  Range range = {};                         ///< of the name, or of the key, that says so
  std::vector<Range> behavior_ranges = {};  ///< of `behaviors`

  static StateCondition join(Kind kind, std::vector<StateCondition> parts) {
    StateCondition condition{kind};
    condition.parts = std::move(parts);
    return condition;
  }
  static StateCondition of_task(Kind kind, TaskId task, std::vector<BehaviorId> behaviors = {}) {
    return {kind, task, none, std::move(behaviors)};
  }
  static StateCondition requested(TaskId task, std::int32_t priority) {
    return {Kind::requested, task, none, {}, priority};
  }
  static StateCondition of_behavior(Kind kind, BehaviorId behavior) {
    return {kind, none, behavior};
  }
  static StateCondition own(BehaviorId behavior, bool wanted) {
    return {Kind::own, none, behavior, {}, 1, none, {}, wanted};
  }
  static StateCondition of_variable(std::uint32_t variable, std::vector<std::uint32_t> values) {
    return {Kind::variable, none, none, {}, 1, variable, std::move(values)};
  }
};

/// Calls `visit` with the condition and all that stand in it.
template <typename Visit>
void for_each_condition(const StateCondition& condition, Visit&& visit) {
  visit(condition);
  for (const StateCondition& part : condition.parts) for_each_condition(part, visit);
}

/// "HOVER runs", "HOVER runs with HOVER_WITH_MPC or HOVER_WITH_PID". `behaviors`: empty: any.
[[nodiscard]] std::string describe_running(const CompiledCatalog& catalog, TaskId task,
                                           std::span<const BehaviorId> behaviors);

/// A condition in words: "DRIVE runs with CREEP or WALK and not (PEOPLE is near and HORN is
/// active)". Alternatives stand in parentheses beside other parts.
[[nodiscard]] std::string describe_condition(const CompiledCatalog& catalog,
                                             const StateCondition& condition);

/// Makes formulas of conditions.
class ConditionFormula {
 public:
  /// `groups`: those explored, ascending. The catalog must outlive this object.
  ConditionFormula(const CompiledCatalog& catalog, std::vector<GroupId> groups);
  /// Of all groups.
  explicit ConditionFormula(const CompiledCatalog& catalog);

  /// `holds`: of the condition, or else of its negation. It holds wherever the condition does, and
  /// perhaps elsewhere: of requests and X only what follows for tasks and situations is said.
  [[nodiscard]] Formula make(const StateCondition& condition, bool holds) const;
  /// No behavior of the groups is active beside those of the parts, or else one is.
  [[nodiscard]] Formula no_other(const StateCondition& only_active, bool holds) const;

 private:
  [[nodiscard]] std::vector<BehaviorId> behaviors() const;

  const CompiledCatalog& catalog_;
  const FormulaMaker maker_;
  const std::vector<GroupId> groups_;
};

}  // namespace cbc
