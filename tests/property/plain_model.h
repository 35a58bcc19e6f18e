#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "happening.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"

namespace cbc::plain {

/// The delay of the models below. Moves take no time beside it, so no timeout of a catalog is due
/// before hundreds of them.
inline constexpr Microseconds reactive_delay = 1000;

/// What a move led to.
struct Step {
  Snapshot next;
  bool exists = true;  ///< false: more requests would be suspended than may be
  /// Of a start, stop or finish: of this event itself.
  std::optional<Outcome> outcome;
  /// By set of the new queue: its place in the queue before the move, or nothing if its tasks
  /// joined by the move.
  std::vector<std::optional<std::size_t>> old_place;
};

/// States and moves of some groups as docs/verify.md defines them, one by one, by an ordinary
/// coordinator that resumes from a state, handles one move, and is thrown away.
///
/// A state is a snapshot in which the clock is at 0, everything runs since then, requests are
/// numbered from 1, and the k-th set of the queue is due at k microseconds. Only the given groups
/// have anything in the queue.
class PlainModel {
 public:
  /// The catalog and the assumptions must outlive the model.
  /// `variables` are part of the state, too.
  PlainModel(const CompiledCatalog& catalog, std::vector<GroupId> groups,
             const Assumptions& assumptions, const std::set<std::uint32_t>& variables = {});

  [[nodiscard]] Snapshot first_state() const;
  /// Whether `never` excludes the situation of the state.
  [[nodiscard]] bool is_excluded(const Snapshot& state) const;
  /// In the order in which scripts are compared. Some may not exist; see Step.
  [[nodiscard]] std::vector<Move> moves(const Snapshot& state) const;
  /// The move need not be one of moves(), but it must be possible. `happenings`: receives all
  /// events, if not null.
  [[nodiscard]] Step step(const Snapshot& state, const Move& move,
                          std::vector<Happening>* happenings = nullptr) const;
  /// What can be seen of a state.
  [[nodiscard]] VisibleState visible(const Snapshot& state) const;

  /// Brings what any coordinator for the catalog has saved into the form of a state.
  [[nodiscard]] Snapshot as_state(Snapshot saved) const;
  /// Equal for equal states, and no others.
  [[nodiscard]] std::string key(const Snapshot& state) const;
  /// The queue, in order of due time.
  [[nodiscard]] static std::vector<std::vector<TaskId>> sets_of_queue(const Snapshot& state);

  [[nodiscard]] bool holds(const StateCondition& condition, const Snapshot& state) const;

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }
  [[nodiscard]] const Assumptions& assumptions() const { return assumptions_; }
  /// Those of the groups, in catalog order.
  [[nodiscard]] const std::vector<TaskId>& tasks() const { return tasks_; }
  [[nodiscard]] const std::vector<BehaviorId>& behaviors() const { return behaviors_; }
  /// Those of the state, in catalog order.
  [[nodiscard]] const std::vector<std::uint32_t>& variables() const { return variables_; }
  /// Those whose own(b) is part of the state, in catalog order.
  [[nodiscard]] const std::vector<BehaviorId>& own() const { return own_; }

 private:
  [[nodiscard]] bool has_group(GroupId group) const;
  bool add_tied();
  void add_starts(const Snapshot& state, std::vector<Move>& moves) const;
  void add_finishes(const Snapshot& state, std::vector<Move>& moves) const;
  void add_faults(const Snapshot& state, std::vector<Move>& moves) const;
  void add_situations(const Snapshot& state, std::vector<Move>& moves) const;
  [[nodiscard]] bool may_change_to(const Snapshot& state,
                                   const std::vector<VariableValue>& values) const;

  const CompiledCatalog& catalog_;
  const Assumptions& assumptions_;
  std::vector<GroupId> groups_;
  std::vector<TaskId> tasks_;
  std::vector<BehaviorId> behaviors_;
  std::vector<std::uint32_t> variables_;
  std::vector<BehaviorId> own_;
  std::vector<SituationPart> never_;  ///< without those about what is not part of it
};

/// The entry of a task that runs, or null.
[[nodiscard]] const Snapshot::RunningTask* find_running(const Snapshot& state, TaskId task);
/// Its request, suspended or not; or null.
[[nodiscard]] const Request* find_request(const Snapshot& state, TaskId task);
[[nodiscard]] bool is_active(const Snapshot& state, BehaviorId behavior);
/// Whether it is in X.
[[nodiscard]] bool has_failed(const Snapshot& state, BehaviorId behavior);

/// Handles one move at the present instant, for which the first set is due if the move is that.
/// Throws std::runtime_error if the coordinator fails.
void handle_move(const CompiledCatalog& catalog, const Assumptions& assumptions, const Move& move,
                 Coordinator& coordinator);

/// Of some variables, all values that they may have together, in the order of values.
[[nodiscard]] std::vector<std::vector<VariableValue>> combinations_of(
    const CompiledCatalog& catalog, const std::vector<std::uint32_t>& variables);

}  // namespace cbc::plain
