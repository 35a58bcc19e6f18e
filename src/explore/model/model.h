#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "explore/model/state_situation.h"
#include "explore/sets/bit_sets.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/task_rules.h"

namespace cbc {

// What the states and moves of some groups consist of (docs/verify.md, "States" and "Moves"): the
// tasks, behaviors and variables with numbers of their own, the layout of a packed state, and all
// moves in their order.

/// One move. Moves are compared in the order of the kinds, then by `subject`, then by `choice` in
/// the order in which priorities or values are listed.
struct Move {
  enum class Kind : std::uint8_t {
    start,
    stop,
    success,           ///< finish with goal_achieved
    failure,           ///< finish with process_failure
    situation_change,  ///< finish with situation_change
    fault,
    repair,
    variable,  ///< a situation variable gets another value
    own,       ///< own(b) becomes the other of the two
    together,  ///< some variables of a list of `together` get other values at once
    due        ///< the first set of the queue comes due
  };
  Kind kind = Kind::due;
  /// Place in the catalog of the task (start, stop), the behavior, or the variable; of together the
  /// place of the list; 0 if due.
  std::uint32_t subject = 0;
  /// Of start: the priority. Of variable: the value. Of own: whether the behavior is available now.
  /// Of together: the values of its variables (combination_of()); of those that are not part of the
  /// state, that at first.
  std::int32_t choice = 0;

  bool operator==(const Move&) const = default;
};

/// A set of values, one after the other: of a task, of a group.
struct BitRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

/// Numbers that follow one another make sets of tasks and values short strings of bits, and states
/// a few words: an exploration goes through millions of them.
class Model {
 public:
  /// A priority is counted by its rank among those that occur; that of reactive starts is 0.
  using Rank = std::uint16_t;
  /// The most tasks, behaviors of a task, values of a variable and priorities: a cell holds their
  /// numbers, one more for none, and Stepper needs a number that nothing else has.
  static constexpr std::size_t most_in_cell = 65'000;

  struct Task {
    TaskId id;
    std::uint32_t group = 0;  ///< place in groups()
    BitRange values;
    bool start_on_request = true;
    bool achieves_goal = false;
    Improve improve = Improve::at_events;
    bool resumes = false;
    std::uint32_t reactive = none;  ///< its number among the reactive tasks
    Rank reactive_rank = 0;         ///< of its reactive start
    /// Other tasks of which one at most may run where it runs. Of a reactive task only, since a
    /// list of many tasks has very many pairs.
    std::vector<std::uint32_t> rivals;
    std::vector<std::uint32_t> limits;           ///< places in limits(); of a reactive task only
    std::vector<std::uint32_t> reactive_rivals;  ///< of both; numbers among the reactive tasks
  };
  /// An exclusivity list of which several may run.
  struct Limit {
    std::vector<std::uint32_t> tasks;
    std::uint32_t most = 0;
  };
  struct Group {
    GroupId number;  ///< in the catalog
    BitRange tasks;
    BitRange values;
    BitRange behaviors;
    std::vector<std::uint32_t> reactive;  ///< its reactive tasks, by their numbers
    bool has_faults = false;              ///< a behavior of it can become faulty
    bool is_reconsidered = false;         ///< a task of it improves at once, or resumes
  };
  struct Behavior {
    BehaviorId id;
    std::uint32_t group = 0;  ///< place in groups()
    std::vector<std::uint32_t> values;
    std::uint32_t own = none;    ///< its number among the own flags
    std::uint32_t fault = none;  ///< its number among those that can become faulty
    Retry retry = Retry::at_events;
    /// Its number among those whose failure is remembered, and that can fail; these may be in X.
    std::uint32_t failed = none;
  };
  /// A behavior whose own(b) is part of the state, as it may change: one of the groups, or another
  /// one that `never` ties to something in the state.
  struct OwnFlag {
    BehaviorId id;
    std::uint32_t behavior = none;  ///< as the model counts; none: it is of another group
  };
  struct Variable {
    std::uint32_t id = 0;  ///< place in the catalog
    std::uint32_t initial = 0;
    std::uint32_t values = 0;
    std::uint32_t cell = none;  ///< place among the cells of a state; none: it does not change
    /// By value: the behaviors that do not fit.
    std::vector<std::vector<Word>> misfits;
  };
  /// Values that several variables get at once. It is a move where at least two have other ones.
  struct JointChange {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> values;  ///< variables, ascending; values
  };
  struct Choice {
    Move move;
    /// Task, behavior, variable, own flag or joint change as the model counts them.
    std::uint32_t subject = 0;
    std::uint32_t choice = 0;  ///< of start: the rank; of variable: the value
  };

  /// A state consists of cells. Their order: values of tasks (value index + 1, 0: not running);
  /// requests, suspended ones too, the most important first (task + 1), and their ranks; places in
  /// the queue of the reactive tasks (set + 1); whether they wait; variables; own(b) denied;
  /// faulty. Whether a behavior is in X has no cell: it is part of the environment only.
  struct Layout {
    std::uint32_t requests = 0;
    std::uint32_t request_count = 0;  ///< the most requests at a time
    std::uint32_t ranks = 0;
    std::uint32_t queue = 0;
    std::uint32_t waiting = 0;
    std::uint32_t reactive_count = 0;
    std::uint32_t variables = 0;
    std::uint32_t own = 0;
    std::uint32_t own_count = 0;
    std::uint32_t faulty = 0;
    std::uint32_t faulty_count = 0;  ///< behaviors that can become faulty
    std::uint32_t failed_count = 0;  ///< behaviors that may be in X
    std::uint32_t cells = 0;
  };
  /// Where a cell stands in a packed state.
  struct Field {
    std::uint16_t word = 0;
    std::uint8_t shift = 0;
    std::uint8_t width = 0;
  };

  /// `groups` are ascending. `variables` are part of the state even if no behavior of the groups
  /// names them, and so is what `never` ties to the state (situation_of_states). The catalog and
  /// the assumptions must outlive the model.
  Model(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
        const Assumptions& assumptions, const std::set<std::uint32_t>& variables = {});

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }
  [[nodiscard]] const Assumptions& assumptions() const { return assumptions_; }
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<Task>& tasks() const { return tasks_; }
  [[nodiscard]] const std::vector<Behavior>& behaviors() const { return behaviors_; }
  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  [[nodiscard]] const std::vector<OwnFlag>& own_flags() const { return own_flags_; }
  [[nodiscard]] const std::vector<JointChange>& joint_changes() const { return joint_changes_; }
  [[nodiscard]] const std::vector<Limit>& limits() const { return limits_; }
  /// Whether a repair may do more than to put reactive tasks into the queue.
  [[nodiscard]] bool has_repairs_that_decide() const;
  /// By value of a task: the task, the behavior.
  [[nodiscard]] std::uint32_t task_of(std::uint32_t value) const { return task_of_[value]; }
  [[nodiscard]] std::uint32_t behavior_of(std::uint32_t value) const { return behavior_of_[value]; }
  [[nodiscard]] std::size_t value_count() const { return task_of_.size(); }
  /// Reactive tasks, by their numbers.
  [[nodiscard]] const std::vector<std::uint32_t>& reactive() const { return reactive_; }
  /// By task: its interaction class, or none if no move can request it. Two requests of equal
  /// priority in different classes decide the same in either order.
  ///
  /// The order of requests decides only which of them are satisfied where not all can be
  /// (docs/semantics.md, "Objectives"). Take what a task may need: the tasks that it requires,
  /// directly or not, with any behavior. If nothing that a may need excludes anything that b may
  /// need, and no minimum performance ties the two together, a solution that satisfies some
  /// requests of the class of a, and one of that of b, make up one that satisfies both. So the most
  /// requests are satisfied where they are in each class, and so is the first choice among those.
  [[nodiscard]] const std::vector<std::uint32_t>& interaction_classes() const { return classes_; }
  /// Tasks, behaviors in catalog order.
  [[nodiscard]] const std::vector<std::uint32_t>& tasks_in_order() const { return tasks_in_order_; }
  [[nodiscard]] const std::vector<std::uint32_t>& behaviors_in_order() const {
    return behaviors_in_order_;
  }
  /// The number of a task, a behavior, a variable here; none if it is not of these groups.
  [[nodiscard]] std::uint32_t find_task(TaskId task) const;
  [[nodiscard]] std::uint32_t find_behavior(BehaviorId behavior) const;
  [[nodiscard]] std::uint32_t find_variable(std::uint32_t variable) const;
  /// The number of ranks whose priorities are at most this one; these are the lowest ones.
  [[nodiscard]] Rank ranks_up_to(std::int32_t priority) const;
  /// The lowest rank whose priority is at least this one; the number of ranks if there is none.
  [[nodiscard]] Rank rank_of(std::int32_t priority) const;

  [[nodiscard]] std::int32_t priority_of(Rank rank) const { return priorities_[rank]; }

  /// Own(b) at first.
  [[nodiscard]] const std::vector<Word>& denied() const { return denied_; }

  [[nodiscard]] const Layout& layout() const { return layout_; }
  /// Number of 32-bit words of a packed state.
  [[nodiscard]] std::size_t packed_words() const { return packed_words_; }
  /// The moves that some state may have, in order.
  [[nodiscard]] const std::vector<Choice>& moves() const { return moves_; }

  /// The cells of the first state.
  [[nodiscard]] std::vector<std::uint16_t> first_state() const;

  /// Why no state can be explored, if so: `never` excludes the first one, or a number is too large
  /// for a cell. Then this model must not be used for anything else.
  [[nodiscard]] std::optional<std::string> find_obstacle() const;
  /// An entry of `never`, as cells that have values; without what is so in every state.
  using Excluded = std::vector<std::pair<std::uint32_t, std::uint16_t>>;
  [[nodiscard]] const std::vector<Excluded>& excluded() const { return excluded_; }
  /// Whether `never` excludes the situation of these cells.
  [[nodiscard]] bool is_excluded(const std::uint16_t* cells) const;

  void pack(const std::uint16_t* cells, std::uint32_t* packed) const;
  void unpack(const std::uint32_t* packed, std::uint16_t* cells) const;
  /// A cell of a packed state.
  [[nodiscard]] std::uint16_t cell_of(const std::uint32_t* packed, std::uint32_t cell) const {
    const Field& field = fields_[cell];
    return static_cast<std::uint16_t>((packed[field.word] >> field.shift) &
                                      ((std::uint32_t{1} << field.width) - 1));
  }

 private:
  void add_groups(const std::vector<GroupId>& groups);
  [[nodiscard]] bool fits_into_cells() const;
  void add_behaviors(Group& group);
  void add_rivals();
  void find_interactions();
  [[nodiscard]] bool add_variables(const StateSituation& situation);
  void add_own_flags(const StateSituation& situation);
  void add_faults();
  void add_failures();
  void rank_priorities();
  void lay_out();
  void add_moves();
  void add_situation_moves();
  void add_joint_changes(std::uint32_t list);
  void add_never();
  [[nodiscard]] std::uint32_t most_requests() const;

  const CompiledCatalog& catalog_;
  const Assumptions& assumptions_;
  std::vector<Group> groups_;
  std::vector<Task> tasks_;
  std::vector<Behavior> behaviors_;  ///< of each group by level, then BehaviorId
  std::vector<Variable> variables_;
  std::vector<OwnFlag> own_flags_;
  std::vector<JointChange> joint_changes_;
  std::vector<Limit> limits_;
  std::vector<std::uint32_t> task_of_;
  std::vector<std::uint32_t> behavior_of_;
  std::vector<std::uint32_t> reactive_;
  std::vector<std::uint32_t> tasks_in_order_;
  std::vector<std::uint32_t> behaviors_in_order_;
  std::vector<std::uint32_t> classes_;
  std::vector<std::int32_t> priorities_;  ///< by rank
  std::vector<Word> denied_;
  Layout layout_;
  std::vector<Field> fields_;
  std::size_t packed_words_ = 0;
  std::vector<Choice> moves_;
  std::vector<Excluded> excluded_;
  bool is_too_large_ = false;
};

inline void Model::pack(const std::uint16_t* cells, std::uint32_t* packed) const {
  std::fill(packed, packed + packed_words_, 0);
  const Field* field = fields_.data();
  for (std::uint32_t cell = 0; cell < layout_.cells; ++cell, ++field) {
    packed[field->word] |= std::uint32_t{cells[cell]} << field->shift;
  }
}

inline void Model::unpack(const std::uint32_t* packed, std::uint16_t* cells) const {
  const Field* field = fields_.data();
  for (std::uint32_t cell = 0; cell < layout_.cells; ++cell, ++field) {
    cells[cell] = static_cast<std::uint16_t>((packed[field->word] >> field->shift) &
                                             ((std::uint32_t{1} << field->width) - 1));
  }
}

}  // namespace cbc
