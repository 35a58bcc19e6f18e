#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/explainer.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/explain/reasons.h"
#include "runtime/solver/problem.h"

// Questions that come after the events: why tasks do not have the values that somebody expected.

namespace cbc {

/// A reactive task that does not start by itself, since tasks run that it excludes.
struct BlockedStart {
  struct Rival {
    TaskId task = none;
    std::uint32_t line = 0;  ///< of the catalog, that says so; 0 if there is none
  };
  TaskId task = none;
  std::vector<Rival> rivals;
};

/// Why the tasks of a group do not meet some demands.
struct WhyUnmet {
  enum class Kind : std::uint8_t {
    undecided,  ///< no event has decided anything about the group
    blocked,    ///< reactive tasks would have to start, but do not: see `blocked`
    due,        ///< a task that should run is in the queue of reactive tasks
    rejected,   ///< the event that asked for it was rejected: see its conflict set
    decided     ///< the last accepted event of the group has a better answer, or no such answer
  };
  Kind kind = Kind::undecided;
  TaskId queued_task = none;  ///< of due
  Microseconds due = 0;       ///< of due
  /// Of rejected and decided: the event, without its changes. Its explanation has the answer that
  /// was chosen. Valid until the next event or question.
  const EventRecord* event = nullptr;
  /// Of decided. Of blocked, and of undecided where a reactive task has no available behavior: the
  /// conflict set alone.
  WhyNot why_not;
  std::uint64_t last_event = 0;  ///< the last one that was accepted in the group; 0: none
  /// Also of decided, where they are not the whole answer.
  std::vector<BlockedStart> blocked;
  /// Of decided: the state before the event, for what has changed in other groups since. It has
  /// what runs, and of the group also its requests.
  std::shared_ptr<const State> before;
};

/// Remembers for each group the last event that was accepted, with the state before it, and a start
/// or stop that was rejected since. That takes memory in proportion to the catalog.
class LastDecisions {
 public:
  /// `ranks`: those of the solver. Catalog, ranks and state must outlive this object.
  LastDecisions(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks,
                const State& state);

  /// To be called while the state is still the one before the answer.
  void note_answer(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment& solution);
  void note_rejection(const EventRecord& record, const Trigger& trigger);

  /// Why the present values of a group meet the demands of none of the `ways`.
  [[nodiscard]] WhyUnmet why_unmet(GroupId group, std::span<const Demands> ways);

 private:
  struct Decision {
    EventRecord event;
    SearchRecord search;
    Trigger trigger;
    std::vector<BehaviorId> failed;
    Snapshot before;  ///< what runs, and the rest of what it has of the group
    ObjectiveValues elsewhere;
    Assignment solution;
  };
  struct Rejection {
    EventRecord event;
    SearchRecord search;
    Trigger::Kind kind = Trigger::Kind::start;
  };

  [[nodiscard]] std::vector<BlockedStart> find_blocked(std::span<const Demands> ways,
                                                       const State* before) const;
  [[nodiscard]] std::vector<BlockedStart::Rival> running_rivals(TaskId task) const;
  [[nodiscard]] bool is_met(const Demand& demand) const;
  [[nodiscard]] bool explains(std::span<const BlockedStart> blocked,
                              std::span<const Demands> ways) const;
  [[nodiscard]] std::vector<Reason> reasons_of(std::span<const BlockedStart> blocked,
                                               std::span<const Demands> ways) const;
  [[nodiscard]] std::vector<Reason> reasons_why_unavailable(std::span<const Demands> ways) const;
  void save_state(const Circumstances& circumstances, Snapshot& before) const;
  [[nodiscard]] const Rejection* find_rejection(GroupId group, std::span<const Demands> ways) const;
  [[nodiscard]] WhyNot explain(Decision& decision, const State& before,
                               std::span<const Demands> ways);

  const CompiledCatalog& catalog_;
  const State& state_;
  Explainer explainer_;
  std::map<GroupId, Decision> decisions_;
  std::map<GroupId, Rejection> rejections_;
};

}  // namespace cbc
