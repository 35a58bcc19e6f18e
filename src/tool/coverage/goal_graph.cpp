#include "coverage/goal_graph.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "coverage/goal_watch.h"
#include "coverage/state_replay.h"
#include "coverage/timeout_race.h"
#include "verify/model.h"
#include "verify/stepper.h"

namespace cbc {
namespace {

class GraphBuilder {
 public:
  GraphBuilder(const CompiledCatalog& catalog, std::span<const Goal> goals,
               const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
               const GoalGraphOptions& options)
      : catalog_(catalog),
        goals_(goals),
        assumptions_(assumptions),
        options_(options),
        watch_(catalog, goals, {}),
        forestalled_by_(catalog.values.items.size(), none),
        returns_(catalog.tasks.size(), none) {
    watch_.take_failures_for_timeouts();
    graph_.goal_count = goals.size();
    for (const Goal& goal : goals) {
      const bool is_return = goal.kind == Goal::Kind::reactive_returned;
      graph_.is_return.push_back(is_return ? 1 : 0);
    }
    for (std::uint32_t goal = 0; goal < goals.size(); ++goal) {
      unwanted_.push_back(wanted[goal] == 0 || graph_.is_return[goal] != 0 ? 1 : 0);
      if (wanted[goal] != 0 && graph_.is_return[goal] != 0) returns_[goals[goal].task] = goal;
    }
  }

  GoalGraph build() {
    for (std::uint32_t group = 0; group < catalog_.group_count(); ++group) {
      const Model model(catalog_, {group}, assumptions_);
      if (model.is_excluded(model.first_state().data())) {
        graph_.error = "the first state is in a situation that 'never' excludes";
        break;
      }
      graph_.parts.push_back({group, static_cast<std::uint32_t>(graph_.state_count()), false});
      graph_.parts.back().is_complete = explore(model, graph_.parts.back());
    }
    graph_.facts = watch_.facts();
    graph_.facts.forestalled_by = std::move(forestalled_by_);
    return std::move(graph_);
  }

 private:
  /// False: a limit came first. Then the moves of the states that are left are missing.
  bool explore(const Model& model, const GoalGraph::Part& part) {
    Stepper stepper(model, {.reduce = true});
    StateReplay replay(model, watch_);
    TimeoutRace race(catalog_, part.group);
    numbers_.clear();
    states_.clear();
    std::vector<std::uint32_t> packed(model.packed_words());
    model.pack(model.first_state().data(), packed.data());
    find(packed);
    bool goes_on = true;
    for (std::size_t state = 0; state < states_.size(); ++state) {
      goes_on = goes_on && states_.size() <= options_.max_states &&
                (!options_.on_progress || options_.on_progress(part.group, states_.size()));
      if (goes_on) {
        stepper.load(states_[state].data());
        replay.load(stepper);
        for (const Model::Choice& choice : model.moves()) {
          if (!stepper.has_move(choice)) continue;
          const Move move = stepper.move_of(choice);
          if (!stepper.take(choice)) continue;
          ++graph_.moves;
          stepper.pack(packed.data());
          watch_.restart(unwanted_);
          replay.take(move);
          race.note(replay, move);
          add_edge(part.first_state + static_cast<std::uint32_t>(state),
                   part.first_state + find(packed), move, replay);
        }
        if (state == 0 && part.group == 0) add_free_variables(part.first_state);
      }
      graph_.begin.push_back(static_cast<std::uint32_t>(graph_.edges.size()));
    }
    if (goes_on) race.tell(forestalled_by_);
    return goes_on;
  }

  std::uint32_t find(const std::vector<std::uint32_t>& packed) {
    const std::string_view bytes(reinterpret_cast<const char*>(packed.data()),
                                 packed.size() * sizeof(packed.front()));
    const auto [entry, is_new] =
        numbers_.try_emplace(std::string(bytes), static_cast<std::uint32_t>(states_.size()));
    if (is_new) states_.push_back(packed);
    return entry->second;
  }

  void add_edge(std::uint32_t from, std::uint32_t to, const Move& move, const StateReplay& replay) {
    items_.clear();
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      if (watch_.met()[goal] != 0 && unwanted_[goal] == 0 && is_shown_by(goals_[goal], move)) {
        items_.push_back(goal);
      }
    }
    for (const TaskId task : replay.started()) add_return(task, 0);
    for (const TaskId task : replay.gave_way()) add_return(task, graph_.goal_count);
    add_edge(from, to, move);
  }

  /// A watch notes the values in each state. A path shows those at its beginning anyway.
  static bool is_shown_by(const Goal& goal, const Move& move) {
    return goal.kind != Goal::Kind::variable_value ||
           (move.kind == Move::Kind::variable && move.subject == goal.variable &&
            static_cast<std::uint32_t>(move.choice) == goal.value);
  }

  void add_return(TaskId task, std::size_t offset) {
    if (returns_[task] == none) return;
    items_.push_back(returns_[task] + static_cast<std::uint32_t>(offset));
  }

  /// Leaves out a move if another one does the same, and meets these goals and perhaps more.
  void add_edge(std::uint32_t from, std::uint32_t to, const Move& move) {
    std::sort(items_.begin(), items_.end());
    if (from == to && items_.empty()) return;
    for (std::size_t other = graph_.begin.back(); other < graph_.edges.size(); ++other) {
      const auto items = graph_.items_of(graph_.edges[other]);
      if (graph_.edges[other].to == to &&
          std::includes(items.begin(), items.end(), items_.begin(), items_.end())) {
        return;
      }
    }
    graph_.edges.push_back({to, static_cast<std::uint32_t>(graph_.items.size()),
                            static_cast<std::uint32_t>(items_.size()), move});
    graph_.items.insert(graph_.items.end(), items_.begin(), items_.end());
  }

  /// Variables that no behavior names are no part of any state.
  void add_free_variables(std::uint32_t state) {
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      const std::uint32_t variable = goals_[goal].variable;
      const auto& may_change = assumptions_.variables;
      if (unwanted_[goal] != 0 || variable == none ||
          std::find(may_change.begin(), may_change.end(), variable) == may_change.end() ||
          std::any_of(catalog_.fitting_values.begin(), catalog_.fitting_values.end(),
                      [&](const FittingValue& one) { return one.variable == variable; })) {
        continue;
      }
      items_ = {goal};
      add_edge(state, state,
               {Move::Kind::variable, variable, static_cast<std::int32_t>(goals_[goal].value)});
    }
  }

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  const Assumptions& assumptions_;
  const GoalGraphOptions& options_;
  GoalWatch watch_;
  GoalGraph graph_;
  std::vector<ValueId> forestalled_by_;  ///< see GoalFacts
  std::vector<std::uint8_t> unwanted_;   ///< by goal: not asked about
  std::vector<std::uint32_t> returns_;   ///< by task: its goal of returning, if it is wanted
  std::unordered_map<std::string, std::uint32_t> numbers_;  ///< of the states of the group
  std::vector<std::vector<std::uint32_t>> states_;          ///< packed
  std::vector<std::uint32_t> items_;                        ///< of the present edge
};

}  // namespace

GoalGraph explore_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                        const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
                        const GoalGraphOptions& options) {
  return GraphBuilder(catalog, goals, wanted, assumptions, options).build();
}

}  // namespace cbc
