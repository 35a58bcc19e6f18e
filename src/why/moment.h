#pragma once

#include <map>
#include <memory>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"
#include "why/explanation.h"

// Decisions that are kept, for questions that come after them.

namespace cbc {

/// A decision with the state before it, and its answer. Whatever is asked about it later is found
/// by going back to it: nothing else has to be known, and an event that nobody asks about costs no
/// more than this copy. A limit of time changes nothing, since the answer is kept, too.
struct Moment {
  ExplainedRecord event;  ///< without what came of it; it gets the answers to questions
  SearchRecord search;
  Trigger trigger;
  std::vector<BehaviorId> failed;
  Snapshot before;      ///< what runs, and what else counts for the group
  Assignment solution;  ///< empty: the event was rejected

  Moment() = default;
  Moment(const Moment&) = delete;  // `event` refers to `search`
  Moment& operator=(const Moment&) = delete;

  /// Takes over a decision, in the memory of the one before.
  void keep(const CompiledCatalog& catalog, const EventRecord& record,
            const Circumstances& circumstances, const Assignment* answer);
};

/// Goes back to a moment: the state is the one before the decision, and the problem is the one that
/// was solved.
class Return {
 public:
  /// The moment must outlive this object.
  Return(const CompiledCatalog& catalog, const Moment& moment);
  Return(const Return&) = delete;
  Return& operator=(const Return&) = delete;

  [[nodiscard]] const std::shared_ptr<const State>& before() const { return before_; }
  [[nodiscard]] const Circumstances& circumstances() const { return circumstances_; }

 private:
  const std::shared_ptr<const State> before_;
  ProblemBuilder builder_;
  Circumstances circumstances_;
};

/// Keeps of each group the last accepted event, and the last one that was rejected since.
class Journal {
 public:
  explicit Journal(const CompiledCatalog& catalog) : catalog_(catalog) {}

  /// `solution`: null if the event is rejected. To be called while the state is the one before it.
  void note(const EventRecord& record, const Circumstances& circumstances,
            const Assignment* solution);

  /// Each is null if there is none.
  [[nodiscard]] Moment* accepted(GroupId group) { return find(accepted_, group); }
  [[nodiscard]] Moment* rejected(GroupId group) { return find(rejected_, group); }

 private:
  using Moments = std::map<GroupId, Moment>;

  static Moment* find(Moments& moments, GroupId group) {
    const auto found = moments.find(group);
    return found == moments.end() ? nullptr : &found->second;
  }

  const CompiledCatalog& catalog_;
  Moments accepted_;
  Moments rejected_;
};

}  // namespace cbc
