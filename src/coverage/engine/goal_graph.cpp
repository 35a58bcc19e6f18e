// The exploration finds what moves do to controls, in sets of environments, on all threads. The
// graph of single states is read off from it, depth by depth: no decision is made again, so that a
// move of a state takes some look-ups.

#include "coverage/engine/goal_graph.h"

#include <utility>

#include "explore/sets/state_store.h"
#include "explore/space/state_walker.h"

namespace cbc {
namespace {

class GraphBuilder {
 public:
  GraphBuilder(const CompiledCatalog& catalog, std::span<const Goal> goals,
               const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
               const GoalSearchOptions& options)
      : catalog_(catalog),
        question_{goals, wanted, true},
        assumptions_(assumptions),
        options_(options),
        bound_(bound_variables(catalog, assumptions)),
        is_met_(goals.size(), 0) {
    graph_.goal_count = goals.size();
    graph_.facts = GoalFacts(catalog, goals.size());
    for (const Goal& goal : goals) {
      graph_.is_return.push_back(goal.kind == Goal::Kind::reactive_returned ? 1 : 0);
    }
  }

  GoalGraph build() {
    for (GroupId group(0); group < catalog_.group_count(); ++group) {
      // To begin the searches of very many groups takes long, too.
      if (options_.budget_of(group, catalog_.group_count()).find_end()) break;
      if (group == 0) add_free_variables();
      if (!add_part({group}, {group, next_state()})) break;
    }
    if (!graph_.error && graph_.parts.size() == catalog_.group_count()) add_bound_variables();
    return std::move(graph_);
  }

 private:
  /// The states of one search, while they get numbers in the graph.
  struct States {
    explicit States(GoalSearch& goal_search)
        : search(goal_search),
          control_words(goal_search.systems().front()->first_control().size()),
          store(control_words + words_for(goal_search.systems().front()->sets().bits()) * 2) {
      for (const auto& part : search.space().parts()) walkers.emplace_back(*part);
    }

    /// The number of a state, which may be new.
    std::uint32_t insert(const std::uint32_t* control, const std::vector<std::uint8_t>& string) {
      words.assign(control, control + control_words);
      words.resize(store.words(), 0);
      for (std::size_t bit = 0; bit < string.size(); ++bit) {
        words[control_words + bit / 32] |= std::uint32_t{string[bit]} << (bit % 32);
      }
      return store.insert(words.data(), store.hash(words.data()));
    }
    /// Lets a walker of its part go to a state.
    StateWalker& go_to(std::uint32_t state) {
      const std::uint32_t* const packed = store.state(state);
      place = search.space().parts().front()->part_of(packed);
      StatePart& part = *search.space().parts()[place];
      environment.resize(part.system().sets().bits());
      for (std::size_t bit = 0; bit < environment.size(); ++bit) {
        environment[bit] = (packed[control_words + bit / 32] >> (bit % 32)) & 1U;
      }
      walkers[place].go_to(part.controls().find(packed), environment);
      return walkers[place];
    }

    GoalSearch& search;
    const std::size_t control_words;
    StateStore store;
    std::vector<StateWalker> walkers;  ///< by part
    std::size_t place = 0;             ///< of the part of the present state
    std::vector<std::uint32_t> words;
    std::vector<std::uint8_t> environment;
    std::uint32_t depth = 0;     ///< of the next layer
    std::uint32_t expanded = 0;  ///< states
  };

  [[nodiscard]] std::uint32_t next_state() const {
    return static_cast<std::uint32_t>(graph_.state_count());
  }

  /// False if nothing can be explored.
  bool add_part(GoalScope scope, GoalGraph::Part part) {
    GoalSearch search(catalog_, scope, assumptions_, question_, options_);
    std::optional<States> states;
    std::vector<std::uint8_t> met(is_met_.size(), 0);
    const GoalSearchResult result = search.run(graph_.facts, met, [&] {
      if (!states) {
        states.emplace(search);
        const GoalSystem& system = *search.systems().front();
        states->insert(system.first_control().data(), system.first_environment());
      }
      while (search.space().is_expanded(states->depth) && expand_layer(part.first_state, *states)) {
        ++states->depth;
      }
    });
    graph_.error = result.error;
    if (graph_.error) return false;
    part.is_complete = result.is_complete;
    graph_.parts.push_back(part);
    end_states_before(part.first_state + (states ? states->store.size() : 1));
    return true;
  }

  /// Adds the moves of the states that have numbers, but no moves yet. False: a limit ended it.
  bool expand_layer(std::uint32_t first_state, States& states) {
    constexpr std::uint32_t states_between_looks = 16;
    const std::uint32_t end = states.store.size();
    for (; states.expanded < end; ++states.expanded) {
      const std::uint64_t bytes = states.store.bytes() +
                                  graph_.edges.capacity() * sizeof(GoalGraph::Edge) +
                                  graph_.items.capacity() * sizeof(std::uint32_t);
      const bool is_due = states.expanded % states_between_looks == 0;
      if (is_due && !states.search.space().may_go_on_beside(bytes)) return false;
      expand(first_state, states);
    }
    return true;
  }

  void expand(std::uint32_t first_state, States& states) {
    StateWalker& walker = states.go_to(states.expanded);
    const GoalSystem& system = *states.search.systems()[states.place];
    const auto& moves = system.moves();
    end_states_before(first_state + states.expanded);
    for (std::size_t place = 0; place < moves.size(); ++place) {
      const auto outcome = walker.try_move(place);
      if (!outcome || outcome->control == none) continue;
      items_ = system.items_of(outcome->note);
      for (const std::uint32_t item : items_) {
        if (item < is_met_.size()) is_met_[item] = 1;
      }
      const std::uint32_t to = states.insert(walker.control_after(), walker.environment_after());
      add_edge(first_state + states.expanded, first_state + to, moves[place].move);
    }
  }

  /// Values of these that no group shows, as nothing ties them to any.
  void add_bound_variables() {
    if (catalog_.group_count() == 0) return;
    for (const std::uint32_t variable : bound_) {
      bool is_wanted = false;
      for (std::uint32_t goal = 0; goal < is_met_.size(); ++goal) {
        const bool is_open = question_.wanted[goal] != 0 && is_met_[goal] == 0;
        is_wanted = is_wanted || (is_open && question_.goals[goal].variable == variable);
      }
      if (!is_wanted) continue;
      if (!add_part({std::nullopt, variable}, {GroupId(0), next_state(), false, variable})) return;
    }
  }

  /// The edges of the states before this one are complete.
  void end_states_before(std::uint32_t state) {
    graph_.begin.resize(state + 1, static_cast<std::uint32_t>(graph_.edges.size()));
  }

  /// Leaves out a move if another one does the same, and meets these goals and perhaps more.
  void add_edge(std::uint32_t from, std::uint32_t to, const Move& move) {
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

  /// Variables that neither a behavior nor `never` names are no part of any state.
  void add_free_variables() {
    for (std::uint32_t goal = 0; goal < is_met_.size(); ++goal) {
      const std::uint32_t variable = question_.goals[goal].variable;
      if (question_.wanted[goal] == 0 || variable == none || !may_change(assumptions_, variable) ||
          std::find(bound_.begin(), bound_.end(), variable) != bound_.end() ||
          std::any_of(catalog_.fitting_values.begin(), catalog_.fitting_values.end(),
                      [&](const FittingValue& one) { return one.variable == variable; })) {
        continue;
      }
      items_ = {goal};
      const std::uint32_t state = next_state();
      add_edge(
          state, state,
          {Move::Kind::variable, variable, static_cast<std::int32_t>(question_.goals[goal].value)});
    }
  }

  const CompiledCatalog& catalog_;
  const GoalQuestion question_;
  const Assumptions& assumptions_;
  const GoalSearchOptions& options_;
  GoalGraph graph_;
  const std::vector<std::uint32_t> bound_;  ///< see bound_variables()
  std::vector<std::uint8_t> is_met_;        ///< by goal: by an edge
  std::vector<std::uint32_t> items_;        ///< of the present edge
};

}  // namespace

GoalGraph explore_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                        const std::vector<std::uint8_t>& wanted, const Assumptions& assumptions,
                        const GoalSearchOptions& options) {
  return GraphBuilder(catalog, goals, wanted, assumptions, options).build();
}

}  // namespace cbc
