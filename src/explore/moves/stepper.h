#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "explore/model/model.h"
#include "explore/moves/decisions.h"
#include "runtime/coordinator/may_need.h"

namespace cbc {

/// What the events of one move did, as far as it can be observed. For comparing two catalogs.
struct MoveTrace {
  struct Change {
    std::uint32_t behavior = 0;  ///< as the model counts them
    bool is_activation = false;
    bool success = true;
  };
  struct Happening {
    Verb verb = Verb::start;
    Origin origin = Origin::script;
    std::uint32_t subject = none;  ///< task of start and stop, behavior of finish; none: situation
    Outcome outcome = Outcome::unchanged;
    std::vector<Change> changes;
    std::vector<std::pair<std::uint32_t, FinishCause>> stopped;  ///< tasks
    std::vector<std::uint16_t> queue;    ///< by reactive task: its set, or 0
    std::vector<std::uint16_t> waiting;  ///< by reactive task
    /// Tasks whose requests are suspended, the most important one first, and their ranks.
    std::vector<std::pair<std::uint32_t, Model::Rank>> suspended;
    bool is_closed = false;  ///< nothing is added any more
  };
  std::vector<Happening> events;
};

/// What a move may ask about the environment that it leads to: the situation, and what is faulty.
struct EnvironmentQuery {
  enum class Kind : std::uint8_t {
    fits,       ///< the behavior
    available,  ///< the behavior
    permitted,  ///< the behavior is available, but for X
    faulty,     ///< the behavior
    is_broken,  ///< before the move: the behavior is faulty, or in X
    gains       ///< a behavior of the group (its place in Model::groups) has become available
  };
  Kind kind = Kind::fits;
  std::uint32_t subject = 0;
};

/// Stands for the environment, which is no part of a control.
class EnvironmentOracle {
 public:
  virtual ~EnvironmentOracle() = default;
  [[nodiscard]] virtual bool holds(EnvironmentQuery query) = 0;
};

class AnswerListener;

/// Makes moves (docs/verify.md, "Moves"): the coordinator's events on packed states, without
/// records. It exists beside the coordinator because an exploration makes millions of moves, and
/// because it knows of a state only the control: all but the environment, which is asked about
/// where a decision depends on it, so that one move stands for that of all environments with the
/// same answers. Not for use by several threads.
///
/// A decision is first made as if all were available that is not known to be unavailable. If what
/// it uses is available, it is the decision: the best of more choices is the best of fewer that it
/// is one of, and where more have no solution, fewer have none.
class Stepper {
 public:
  struct Trigger {
    enum class Kind : std::uint8_t { start, stop, finish, reconsider };
    Kind kind = Kind::start;
    std::uint32_t group = 0;
    std::uint32_t task = none;
    std::uint32_t behavior = none;
    FinishCause cause = FinishCause::goal_achieved;
    Model::Rank ranks = 0;  ///< of start and stop: requests of ranks below it are not protected
    Model::Rank rank = 0;   ///< of start: that of its request
    bool is_reactive = false;

    /// A reactive start that nobody asked for.
    [[nodiscard]] bool is_unasked() const { return is_reactive && rank == 0; }
  };
  /// What an event is answered with.
  struct Answer {
    const Trigger& trigger;
    Model::Rank first = 0;           ///< the protection at first,
    Model::Rank ranks = 0;           ///< and that of the answer
    const Word* solution = nullptr;  ///< the values of its group; null: it is rejected
  };
  struct Options {
    bool reduce = false;                                 ///< see ExplorationOptions
    std::size_t decision_bytes = std::size_t{64} << 20;  ///< for remembered decisions
    DecisionListener on_decision = {};                   ///< may be empty
  };

  Stepper(const Model& model, const Options& options);
  explicit Stepper(const Model& model) : Stepper(model, Options()) {}

  [[nodiscard]] bool was_accepted() const { return accepted_; }
  /// Which behaviors fit or are available in some environment, and the values that they perform.
  struct Possible {
    std::vector<Word> fitting;    ///< behaviors
    std::vector<Word> available;  ///< behaviors
    std::vector<Word> fitting_values;
    std::vector<Word> available_values;

    void clear(const Model& model);
    /// The behavior fits.
    void add(const Model& model, std::uint32_t behavior, bool is_available);
    void remove_available(const Model& model, std::uint32_t behavior);
    void remove(const Model& model, std::uint32_t behavior);
  };
  /// Takes up a control. `packed` is read at once.
  void load(const std::uint32_t* packed);
  /// Whether the control has this move in some environment.
  [[nodiscard]] bool may_have(const Model::Choice& choice) const;
  /// Makes a move from the control, of which the environment cells do not count; of a repair what
  /// comes of it besides. `possible`: after the move.
  void take(const Model::Choice& choice, const Possible& possible, EnvironmentOracle& environment);

  /// Instead of a move: leaves the state as it is.
  void stay();
  /// Whether the reactive task joined the queue in the move.
  [[nodiscard]] bool has_joined(std::uint32_t reactive) const {
    return now_.cells[model_.layout().queue + reactive] == joined_set_ && joined_set_ != 0;
  }
  /// The cells after the move.
  [[nodiscard]] const std::uint16_t* cells_after() const { return now_.cells.data(); }
  /// Behaviors that are in X after the move, or not, whatever was before.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, bool>>& changes_of_x() const {
    return changes_of_x_;
  }
  [[nodiscard]] std::uint32_t suspended_after() const;

  /// Records what moves do from now on; null: nothing.
  void set_trace(MoveTrace* trace) { trace_ = trace; }

  /// Tells of the answers of moves from now on; null: to nobody.
  void set_listener(AnswerListener* listener) { listener_ = listener; }

  // For the listener, while it is told of an answer.

  /// The answer of some decisions, perhaps about a catalog with fewer constraints, at the
  /// protection `ranks` or, of a finish, the least after it that has one, which `ranks` becomes.
  /// Null: there is none. The environment is asked if `is_asked`; otherwise all counts as available
  /// that is not known to be unavailable.
  [[nodiscard]] const Word* solve(Decisions& decisions, const Trigger& trigger, Model::Rank& ranks,
                                  bool is_asked);
  /// What would have been answered if no request were protected.
  [[nodiscard]] const Word* answer_unprotected(const Trigger& trigger);
  /// The values that may be in an answer, as far as is known of the environment.
  [[nodiscard]] const std::vector<Word>& domains() const { return domains_; }
  /// Asks the environment whether a value of these may be in an answer.
  [[nodiscard]] bool may_have(const Trigger& trigger, std::uint32_t value);
  /// Whether the behavior that has finished performed the task.
  [[nodiscard]] bool has_finished(const Trigger& trigger, std::uint32_t task) const {
    if (trigger.kind != Trigger::Kind::finish || now_.cells[task] == 0) return false;
    const std::uint32_t value = model_.tasks()[task].values.begin + now_.cells[task] - 1;
    return model_.behavior_of(value) == trigger.behavior;
  }

  // The control that load took up.

  [[nodiscard]] const std::uint16_t* cells() const { return before_.cells.data(); }
  [[nodiscard]] const std::vector<Word>& running() const { return before_.running; }
  [[nodiscard]] const std::vector<Word>& active() const { return before_.active; }
  [[nodiscard]] const std::vector<Word>& values() const { return before_.values; }
  [[nodiscard]] bool is_settled() const;
  /// The rank of the task's request, plus 1; 0: none.
  [[nodiscard]] Model::Rank request_of(std::uint32_t task) const { return rank_in(before_, task); }
  [[nodiscard]] bool is_suspended(std::uint32_t task) const {
    return before_.cells[task] == 0 && request_of(task) > 0;
  }

  [[nodiscard]] const Decisions& decisions() const { return decisions_; }

 private:
  /// A control: its cells, and bit sets that follow from them.
  struct State {
    std::vector<std::uint16_t> cells;
    std::vector<Word> values;   ///< that tasks have
    std::vector<Word> running;  ///< tasks
    std::vector<Word> active;   ///< behaviors
    Possible possible;          ///< what is not known to be impossible
  };

  /// The set of a task that has joined the queue during the present move.
  static constexpr std::uint16_t joined_now = UINT16_MAX;

  void derive(State& state) const;
  [[nodiscard]] Model::Rank rank_in(const State& state, std::uint32_t task) const;

  bool coordinate(const Trigger& trigger);
  [[nodiscard]] const Word* ask(Decisions& decisions, const Trigger& trigger, Model::Rank ranks);
  [[nodiscard]] bool is_silent(const Trigger& trigger) const;
  void find_domains(const Trigger& trigger);
  [[nodiscard]] bool is_possible(const Trigger& trigger, const Word* solution);
  [[nodiscard]] bool has_known_order(const Trigger& trigger, const Word* solution);
  [[nodiscard]] bool fits(std::uint32_t behavior);
  [[nodiscard]] bool is_available_now(std::uint32_t behavior);
  [[nodiscard]] bool is_confirmed(EnvironmentQuery::Kind kind, std::uint32_t behavior) const;
  [[nodiscard]] bool is_faulty_now(std::uint32_t behavior) const;
  void note_failure(std::uint32_t behavior);
  void forgive(std::uint32_t task);
  void end_forgiving();
  void note_changes_of_x();
  [[nodiscard]] bool gains(std::uint32_t group) const;
  void rank_requests(const Trigger& trigger);
  [[nodiscard]] Model::Rank first_protection(const Trigger& trigger) const;
  [[nodiscard]] bool suspends(const Trigger& trigger, std::uint32_t task) const;
  [[nodiscard]] bool has_reason_to_reconsider(std::uint32_t group) const;
  [[nodiscard]] bool may_improve(std::uint32_t task) const;
  [[nodiscard]] bool improves(const Trigger& trigger, const Word* solution) const;
  void keep_what_was_not_asked_for(std::uint32_t group);
  void remove_better(std::uint32_t task);
  void find_wanted(const Word* solution);
  [[nodiscard]] std::uint32_t first_failure() const;
  void reject(const Trigger& trigger);
  void accept(const Trigger& trigger, const Word* solution);
  void update_requests(const Trigger& trigger);
  void update_queue(const Trigger& trigger);
  void retry_waiting(std::uint32_t group);
  [[nodiscard]] bool may_enqueue(std::uint32_t reactive) const;
  void enqueue(std::uint32_t reactive);
  [[nodiscard]] bool counts_for(std::uint32_t task, Model::Rank rank) const;
  [[nodiscard]] bool is_full(const Model::Limit& limit, std::uint32_t task, Model::Rank rank) const;
  [[nodiscard]] bool is_blocked(std::uint32_t task) const;
  [[nodiscard]] bool is_blocked_by(std::uint32_t task, std::uint32_t rival) const;

  bool start(std::uint32_t task, Model::Rank ranks, Model::Rank rank, bool is_reactive);
  bool stop(std::uint32_t task);
  void finish(std::uint32_t behavior, FinishCause cause, Origin origin);
  void finish_lost();
  void reconsider(std::uint32_t group, Origin origin);
  void end_suspended_request(std::uint32_t task);
  void start_reactive(std::uint32_t reactive);
  void adapt();
  void make(const Model::Choice& choice);
  void come_due();
  void settle_queue();
  void merge_orders();

  void open_event(Verb verb, Origin origin, std::uint32_t subject);
  void note_outcome(Outcome outcome);
  void note_changes(const Word* wanted, std::uint32_t group, std::uint32_t failing);
  void note_stop(std::uint32_t task, FinishCause cause);
  void close_event();

  const Model& model_;
  const bool reduce_;
  Decisions decisions_;
  State before_;  ///< as loaded
  State now_;     ///< as the move leaves it
  bool accepted_ = false;
  std::uint16_t joined_set_ = 0;  ///< the set that joined the queue in the move; 0: none
  /// What is known of a behavior that may be in X. Until the end of the event it may be so that it
  /// is not in X, whatever was before.
  enum class InX : std::uint8_t { as_before, yes, no, forgiven };
  std::vector<InX> in_x_;  ///< by number of the failure, in the move
  std::vector<std::pair<std::uint32_t, bool>> changes_of_x_;

  // Of the event.
  std::vector<Word> excluded_values_;
  bool has_excluded_ = false;
  std::vector<Word> domains_;
  std::vector<Word> present_;
  std::vector<Word> must_run_;
  std::vector<std::uint16_t> requests_;  ///< as in Problem
  std::vector<std::uint16_t> suspended_requests_;
  std::vector<std::uint16_t> unasked_requests_;
  MayNeed needs_;
  MayNeed needs_of_others_;
  std::vector<Word> was_active_;  ///< before the event, without a behavior that has finished
  std::vector<Word> active_;      ///< in the course of the event
  std::vector<Word> wanted_;      ///< by the solution
  std::vector<std::uint16_t> values_after_;  ///< by task, as cells
  std::vector<std::uint32_t> stopped_;
  std::vector<std::uint32_t> stopped_by_others_;
  std::vector<std::uint32_t> suspended_;
  std::vector<std::uint32_t> started_;
  std::vector<std::uint32_t> lost_;  ///< behaviors of a failed rollback; the last finishes next

  std::vector<std::vector<std::uint32_t>> deactivation_order_;  ///< by group
  std::vector<std::uint32_t> order_of_reactions_;               ///< numbers of reactive tasks
  MoveTrace* trace_ = nullptr;
  AnswerListener* listener_ = nullptr;
  EnvironmentOracle* environment_ = nullptr;  ///< of the present move
};

/// Is told what the events of a move decide, while it is made: of an exploration what
/// EventListener is of a coordinator.
class AnswerListener {
 public:
  virtual ~AnswerListener() = default;
  /// An event is answered, and nothing has changed yet.
  virtual void on_answer(Stepper& stepper, const Stepper::Answer& answer) = 0;
};

}  // namespace cbc
