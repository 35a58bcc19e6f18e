#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ask/conflict/reasons.h"
#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "why/alternatives.h"

// What can be asked about an event, and the answers.

namespace cbc {

/// A task or a behavior, by its catalog index.
struct Subject {
  bool is_task = true;
  std::uint32_t catalog_index = 0;
};

/// What is asked about each event where it is decided.
struct Questions {
  bool rejections = false;  ///< why events are rejected
  // Of accepted events, if their answer is proven optimal:
  bool displaced = false;          ///< why requested tasks do not run any more
  std::vector<Subject> why = {};   ///< why these have the value they have
  std::uint32_t alternatives = 0;  ///< number of best configurations to list
  /// Later, why something is not as expected: keeps the last moments of each group.
  bool failures = false;
};

/// A request among others.
struct RankedRequest {
  std::int32_t priority = 0;
  std::optional<Microseconds> time;  ///< of the event that last set it, if it is known
};

/// Why something was not chosen: the best alternative with it is worse, or there is none.
struct WhyNot {
  bool is_cut = false;  ///< a limit of effort came first, and the rest is empty
  std::optional<Configuration> alternative;
  Difference difference;  ///< between the choice and the alternative, if there is one
  // Where the order of requests decides: those of the two tasks of the difference.
  RankedRequest request;
  RankedRequest other_request;
  /// If there is none, a minimal conflict set. Empty: the event alone rules it out.
  std::vector<Reason> conflict;
};

/// A task with an active request that does not run any more.
struct Displacement {
  TaskId task = none;
  WhyNot why_not;
};

/// A behavior that suits a task better than the one it has, and why it was not chosen.
struct BetterBehavior {
  TaskId task = none;
  std::uint32_t value_index = none;
  WhyNot why_not;
};

/// Why a task has its value, or why a behavior is active or inactive.
struct Why {
  TaskId task = none;
  BehaviorId behavior = none;  ///< set if the question is about a behavior
  BehaviorId chosen = none;    ///< of the task, if the question is about a task
  bool is_active = false;      ///< of the behavior
  /// Of a reactive task in the queue after the event, or its behavior: when it is due. The rest
  /// then says what would hinder its start now: `why_not` has no alternative, and a conflict set if
  /// something would.
  std::optional<Microseconds> due;
  TaskId queued_task = none;  ///< the task, or that of the behavior, which is due
  WhyNot why_not;
  /// Of a running task, or of those of an active behavior: all better ones, the best first.
  std::vector<BetterBehavior> better;
};

/// The explanations of one event.
struct Explanation {
  std::vector<Displacement> displaced;
  std::vector<Why> why;
  std::vector<Configuration> alternatives;  ///< the best first: the one that was chosen
  bool is_list_cut = false;                 ///< a limit of effort came before the last of them
  Configuration chosen;                     ///< set if there are displaced or why

  void clear() {
    displaced.clear();
    why.clear();
    alternatives.clear();
    is_list_cut = false;
  }
};

/// What one event did, and why, as far as anybody asked. Valid as the record is.
struct ExplainedRecord : EventRecord {
  std::vector<Reason> conflict;  ///< of a rejected event: a minimal conflict set
  Explanation explanation;       ///< of an accepted event
};

}  // namespace cbc
