#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/comparison.h"
#include "explain/configuration.h"
#include "explain/reason.h"

namespace cbc {

/// A task or a behavior, by its place in the catalog.
struct Subject {
  bool is_task = true;
  std::uint32_t place = 0;
};

/// What to explain of accepted events. Only answers that are proven best are explained.
struct ExplanationOptions {
  bool displaced = false;          ///< why requested tasks do not run any more
  std::vector<Subject> why;        ///< why these have the value they have
  std::uint32_t alternatives = 0;  ///< number of best configurations to list

  [[nodiscard]] bool asks_for_any() const { return displaced || !why.empty() || alternatives > 0; }
};

/// Why something was not chosen: the best alternative with it loses, or there is none.
struct WhyNot {
  bool is_cut = false;  ///< a limit of effort came first; the rest is empty
  std::optional<Configuration> alternative;
  Difference difference;  ///< of what was chosen to the alternative, if there is one
  /// If there is none, a minimal set of reasons. Empty: the event itself rules it out.
  std::vector<Reason> conflict;
};

/// A task with an active request that does not run any more.
struct Displacement {
  TaskId task = none;
  WhyNot why_not;
};

/// Why a task has its value and no other, or a behavior is active or not.
struct Why {
  TaskId task = none;
  BehaviorId behavior = none;  ///< if it is asked about
  BehaviorId chosen = none;    ///< behavior of the task, if that is asked about
  bool is_active = false;      ///< of the behavior
  WhyNot why_not;
};

/// What was asked for about one event.
struct Explanation {
  std::vector<Displacement> displaced;
  std::vector<Why> why;
  std::vector<Configuration> alternatives;  ///< the best first, which is the one chosen
  bool is_list_cut = false;                 ///< a limit of effort came before the last of them
  Configuration chosen;                     ///< set if there are displaced or why

  void clear() {
    displaced.clear();
    why.clear();
    alternatives.clear();
    is_list_cut = false;
  }
};

}  // namespace cbc
