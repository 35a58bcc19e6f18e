#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ask/conflict/reasons.h"
#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"
#include "why/explainer.h"
#include "why/explanation.h"
#include "why/moment.h"

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
  /// Of rejected and decided: the event, without its changes. It has the conflict set, or in its
  /// explanation the answer that was chosen. Valid until the next event or question.
  const ExplainedRecord* event = nullptr;
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

/// Why the values of a group in the present state meet the demands of none of the `ways`: asks the
/// last accepted event of the group, or the last rejected one.
[[nodiscard]] WhyUnmet why_unmet(const CompiledCatalog& catalog, const State& present,
                                 Journal& journal, Explainer& explainer, GroupId group,
                                 std::span<const Demands> ways);

}  // namespace cbc
