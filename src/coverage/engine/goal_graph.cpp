#include "coverage/engine/goal_graph.h"

#include <algorithm>

namespace cbc {
namespace {

class GraphBuilder {
 public:
  GraphBuilder(const CompiledCatalog& catalog, std::span<const Goal> goals,
               const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
               const GoalSearchOptions& options)
      : catalog_(catalog),
        goals_(goals),
        assumptions_(assumptions),
        options_(options),
        monitor_(catalog, goals, {}),
        returns_(catalog.tasks.size(), none) {
    monitor_.take_failures_for_timeouts();
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
    for (GroupId group(0); group < catalog_.group_count(); ++group) {
      // To begin the searches of very many groups takes long, too.
      if (options_.on_progress && !options_.on_progress(group, 0)) break;
      first_state_ = static_cast<std::uint32_t>(graph_.state_count());
      if (group == 0) add_free_variables();
      const GoalSearchResult result =
          search_goals(catalog_, group, assumptions_, monitor_, &unwanted_, options_,
                       [this](const SeenMove& move) { add_move(move); });
      graph_.error = result.error;
      if (graph_.error) break;
      graph_.parts.push_back({group, first_state_, result.is_complete});
      graph_.moves += result.moves;
      end_states_before(first_state_ + static_cast<std::uint32_t>(result.states));
    }
    graph_.facts = monitor_.facts();
    return std::move(graph_);
  }

 private:
  void add_move(const SeenMove& seen) {
    items_.clear();
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      if (monitor_.met()[goal] != 0 && unwanted_[goal] == 0 &&
          is_shown_by(goals_[goal], seen.move)) {
        items_.push_back(goal);
      }
    }
    for (const TaskId task : seen.started) add_return(task, 0);
    for (const TaskId task : seen.gave_way) add_return(task, graph_.goal_count);
    end_states_before(first_state_ + seen.from);
    add_edge(first_state_ + seen.from, first_state_ + seen.to, seen.move);
  }

  /// The edges of the states before this one are complete.
  void end_states_before(std::uint32_t state) {
    graph_.begin.resize(state + 1, static_cast<std::uint32_t>(graph_.edges.size()));
  }

  /// A monitor notes the values in each state. A path shows those at its beginning anyway.
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
  void add_free_variables() {
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
      add_edge(first_state_, first_state_,
               {Move::Kind::variable, variable, static_cast<std::int32_t>(goals_[goal].value)});
    }
  }

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  const Assumptions& assumptions_;
  const GoalSearchOptions& options_;
  GoalMonitor monitor_;
  GoalGraph graph_;
  std::vector<std::uint8_t> unwanted_;  ///< by goal: not asked about
  std::vector<std::uint32_t> returns_;  ///< by task: its goal of returning, if it is wanted
  std::uint32_t first_state_ = 0;       ///< of the present group
  std::vector<std::uint32_t> items_;    ///< of the present edge
};

}  // namespace

GoalGraph explore_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                        const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
                        const GoalSearchOptions& options) {
  return GraphBuilder(catalog, goals, wanted, assumptions, options).build();
}

}  // namespace cbc
