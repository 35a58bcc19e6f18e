#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ask/assignment_search.h"
#include "ask/conflict/conflict_search.h"
#include "ask/conflict/effort.h"
#include "ask/conflict/reasons.h"
#include "ask/situation_space.h"
#include "runtime/compiled/compiled_catalog.h"

// The one question of all proofs: is there a situation, and are there assignments, of this group
// and of that one, which meet some demands with behaviors that all fit in it? An answer is
// assignments with their situation, or a minimal set of constraints that leave none, or that a
// limit of effort came first.

namespace cbc {

/// What is demanded of an assignment of one group.
struct GroupDemands {
  GroupId group;
  Demands demands;
  /// Of questions with only some constraints in force: a task that runs with a performance below
  /// a minimum.
  TaskId low_task = none;
  Millionths low_minimum = 0;
};

/// Assignments that are asked for. Two may be of the same group.
using Asked = std::vector<GroupDemands>;

/// The demands, group by group.
[[nodiscard]] Asked asked_of(const CompiledCatalog& catalog, std::span<const Demand> demands);

/// Demands that no task runs with a behavior.
void add_fault(const CompiledCatalog& catalog, BehaviorId behavior, Demands& demands);

/// Looks for a situation in which some search succeeds. It splits the situations by conditions of
/// behaviors, as there may be too many to go through them one by one.
class SituationSplits {
 public:
  /// The space must outlive this object.
  explicit SituationSplits(const SituationSpace& space)
      : space_(&space), refuted_(space.catalog().variables.size(), 0) {}

  /// Searches for assignments whose behaviors may fit in some of the situations, each by itself. If
  /// there are any, `active` gets these behaviors.
  using Search = std::function<Feasibility(const ValueSets& sets, BehaviorSet& active)>;

  /// `only`: the conditions of behaviors that count; null: all.
  [[nodiscard]] Feasibility find(const ValueSets& sets, const Search& search,
                                 const ConditionSet* only = nullptr);

  // What was found:
  [[nodiscard]] const BehaviorSet& active() const { return active_; }
  [[nodiscard]] const VariableValues& situation() const { return situation_; }

 private:
  /// The condition of a behavior on a variable.
  struct Split {
    BehaviorId behavior;
    std::uint32_t variable = 0;
  };

  [[nodiscard]] ValueSets take_part(const ValueSets& sets, const Split& split, bool meets) const;
  [[nodiscard]] Split choose_split(const ValueSets& sets, const ValueSets& fitting,
                                   const ConditionSet* only) const;

  const SituationSpace* space_;
  /// By variable: how often there was no assignment on either side of its condition.
  std::vector<std::uint64_t> refuted_;
  BehaviorSet active_;
  VariableValues situation_;
};

/// Answers questions under all constraints.
class Ask {
 public:
  /// Both must outlive this object.
  Ask(AssignmentSearch& search, const SituationSpace& space)
      : search_(search), space_(space), situations_(space) {}

  /// In one of the situations that has values of the sets. The best assignments can be asked for
  /// where these are of one situation.
  [[nodiscard]] Feasibility find(const Asked& question, const ValueSets& sets,
                                 AssignmentSearch::Wanted wanted = AssignmentSearch::Wanted::any);
  [[nodiscard]] Feasibility find(const Asked& question) { return find(question, space_.all()); }

  // What was found:
  [[nodiscard]] const Assignment& assignment(std::size_t place) const { return found_[place]; }
  [[nodiscard]] const BehaviorSet& active() const { return situations_.active(); }
  [[nodiscard]] const VariableValues& situation() const { return situations_.situation(); }

 private:
  AssignmentSearch& search_;
  const SituationSpace& space_;
  SituationSplits situations_;
  std::vector<Assignment> found_;
};

/// Constraints that are examined for one proof; among more it would take too long.
inline constexpr std::size_t most_constraints = 20'000;

/// The constraints that bear on some tasks and on what performs them. If there are more than
/// `most_constraints`, some are left out.
[[nodiscard]] std::vector<Reason> constraints_on(const CompiledCatalog& catalog,
                                                 const RelevantTasks& relevant);
/// The constraints that bear on a question. `with_conditions`: conditions of behaviors, too, one
/// for each variable that a behavior names: of the kind `situation`, without a value.
[[nodiscard]] std::vector<Reason> constraints_on(const CompiledCatalog& catalog,
                                                 const Asked& question, bool with_conditions);

/// Answers questions with only some of the constraints in force: whether one of several questions
/// has an answer, and if not, why.
class RelaxedQuestions {
 public:
  /// All must outlive this object. `present`: by task of the only group, the value index that it
  /// may keep although its behavior is unavailable, or none; empty: nothing runs.
  RelaxedQuestions(const SituationSpace& space, Effort& effort,
                   std::vector<std::uint32_t> present = {})
      : space_(space), effort_(effort), present_(std::move(present)) {}

  /// One more question, in the situations of a space that have values of the sets; null: in all,
  /// and in the space of the other questions.
  void add(Asked question, const ValueSets* sets = nullptr, const SituationSpace* space = nullptr);

  /// Whether one of the questions has an answer.
  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons) {
    return solve(reasons, nullptr);
  }
  /// After the answer yes: the values of a task of the last question's group and of all that it
  /// requires.
  [[nodiscard]] std::vector<ValueId> values_of(TaskId task);

  /// A minimal set out of `candidates` with which no question has an answer. Empty if one has, or
  /// if it takes too long to find.
  [[nodiscard]] std::vector<Reason> conflict(std::span<const Reason> candidates);

 private:
  struct Part {
    GroupId group;
    ConflictSearch search;
  };
  struct One {
    std::vector<Part> parts;
    const SituationSpace* space = nullptr;
    ValueSets sets;
    bool has_situation = false;
  };

  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons, std::vector<bool>* is_used);
  [[nodiscard]] Feasibility solve(One& one, std::span<const Reason> reasons,
                                  std::vector<bool>* is_used);
  [[nodiscard]] Feasibility solve(Part& part, std::span<const Reason> reasons,
                                  const ValueSets& sets, std::vector<bool>* is_used);
  void add_active(Part& part, BehaviorSet& active) const;

  const SituationSpace& space_;
  Effort& effort_;
  std::vector<One> questions_;
  std::vector<std::uint32_t> present_;
  One* answered_ = nullptr;  ///< the last question that had an answer
};

}  // namespace cbc
