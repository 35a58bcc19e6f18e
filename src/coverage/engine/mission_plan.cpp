// Short paths that cover goals: set cover, where a set is what a path meets. Prices of goals come
// from the multiplicative weights method (S. Arora, E. Hazan and S. Kale, "The multiplicative
// weights update method: a meta-algorithm and applications", Theory of Computing 8 (2012)): goals
// that the heaviest path meets lose weight, so that those that are hard to meet together stay
// heavy. Any weights also bound from below how many paths are needed. Then paths are taken
// greedily. A goal counts only once on a path, so what a move is worth depends on the moves before
// it, and a beam search finds the next path in place of an exact one.
//
// An integer program would find the least number of paths, but has a variable for each of them, of
// which there are far too many.

#include "coverage/engine/mission_plan.h"

#include <algorithm>
#include <set>
#include <utility>

namespace cbc {
namespace {

constexpr std::uint32_t never_reached = UINT32_MAX;
constexpr std::uint64_t first_weight = std::uint64_t{1} << 32U;
/// Of the search for a path that meets most: the partial paths that are kept of each length.
constexpr std::size_t beam_width = 48;

/// Goes along a path, and tells which items count.
class Walk {
 public:
  explicit Walk(const GoalGraph& graph) : graph_(&graph), seen_(2 * graph.goal_count, 0) {}

  /// Calls `function` for each goal that the move would meet, and that none before met.
  template <typename Function>
  void look(const GoalGraph::Edge& edge, Function&& function) const {
    for (const std::uint32_t item : graph_->items_of(edge)) {
      if (graph_->is_goal(item) && counts(item)) function(item);
    }
  }
  void take(const GoalGraph::Edge& edge) {
    look(edge, [&](std::uint32_t goal) { seen_[goal] = 1; });
    // Whoever gives way does not return in the same move.
    for (const std::uint32_t item : graph_->items_of(edge)) {
      if (!graph_->is_goal(item)) seen_[item] = 1;
    }
  }

 private:
  [[nodiscard]] bool counts(std::uint32_t goal) const {
    return seen_[goal] == 0 &&
           (graph_->is_return[goal] == 0 || seen_[graph_->way_given_for(goal)] != 0);
  }

  const GoalGraph* graph_;
  std::vector<std::uint8_t> seen_;  ///< by item
};

}  // namespace

/// A path in the making.
struct MissionPlanner::Partial {
  std::uint32_t state = 0;
  Path path;
  Walk walk;
  std::uint64_t gained = 0;
};

MissionPlanner::MissionPlanner(const GoalGraph& graph, std::uint32_t events,
                               std::function<bool()> is_stopped)
    : graph_(graph),
      is_stopped_(std::move(is_stopped)),
      source_(graph.edges.size()),
      reachable_(graph.goal_count, 0),
      returning_(graph.goal_count),
      weights_(graph.goal_count, first_weight) {
  for (std::uint32_t state = 0; state < graph.state_count(); ++state) {
    std::fill(source_.begin() + graph.begin[state], source_.begin() + graph.begin[state + 1],
              state);
  }
  find_depths();
  find_limits(events);
}

std::uint32_t MissionPlanner::end_of(std::uint32_t part) const {
  return std::size_t{part} + 1 < graph_.parts.size()
             ? graph_.parts[part + 1].first_state
             : static_cast<std::uint32_t>(graph_.state_count());
}

std::uint32_t MissionPlanner::part_of(std::uint32_t state) const {
  std::uint32_t part = 0;
  while (end_of(part) <= state) ++part;
  return part;
}

/// States are numbered breadth first, so the first edge to a state is of a shortest path.
void MissionPlanner::find_depths() {
  depths_.assign(graph_.state_count(), never_reached);
  entrance_.assign(graph_.state_count(), none);
  for (const GoalGraph::Part& part : graph_.parts) depths_[part.first_state] = 0;
  for (std::uint32_t edge = 0; edge < graph_.edges.size(); ++edge) {
    const std::uint32_t to = graph_.edges[edge].to;
    if (depths_[to] != never_reached) continue;
    depths_[to] = depths_[source_[edge]] + 1;
    entrance_[to] = edge;
  }
}

/// Each goal counts in the group where it is nearest.
void MissionPlanner::find_limits(std::uint32_t events) {
  limits_.assign(graph_.parts.size(), events);
  nearest_.assign(graph_.goal_count, none);
  std::vector<std::uint32_t> least(graph_.goal_count, never_reached);
  std::vector<std::uint32_t> home(graph_.goal_count, 0);
  const auto note = [&](std::uint32_t goal, std::uint32_t part, std::uint32_t length) {
    reachable_[goal] = 1;
    if (length >= least[goal]) return false;
    least[goal] = length;
    home[goal] = part;
    return true;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> returns;  // part and goal
  for (std::uint32_t part = 0; part < graph_.parts.size(); ++part) {
    const std::uint32_t first_edge = graph_.begin[graph_.parts[part].first_state];
    const std::uint32_t last_edge = graph_.begin[end_of(part)];
    const std::size_t first_return = returns.size();
    for (std::uint32_t edge = first_edge; edge < last_edge; ++edge) {
      for (const std::uint32_t item : graph_.items_of(graph_.edges[edge])) {
        if (!graph_.is_goal(item)) continue;
        if (graph_.is_return[item] == 0) {
          if (note(item, part, depths_[source_[edge]] + 1)) nearest_[item] = edge;
          continue;
        }
        const std::pair entry(part, item);
        const auto of_part = returns.begin() + static_cast<std::ptrdiff_t>(first_return);
        if (std::find(of_part, returns.end(), entry) == returns.end()) returns.push_back(entry);
      }
    }
  }
  for (const auto& [part, goal] : returns) {
    if (is_stopped()) break;
    Path path = path_that_returns(part, goal);
    if (path.edges.empty()) continue;
    if (note(goal, part, static_cast<std::uint32_t>(path.edges.size()))) {
      returning_[goal] = std::move(path);
    }
  }
  for (std::size_t goal = 0; goal < graph_.goal_count; ++goal) {
    if (least[goal] == never_reached) continue;
    limits_[home[goal]] = std::max(limits_[home[goal]], least[goal]);
  }
  for (const std::uint32_t limit : limits_) longest_ = std::max(longest_, limit);
}

std::vector<std::uint32_t> MissionPlanner::shortest_to(std::uint32_t state) const {
  std::vector<std::uint32_t> edges;
  for (; entrance_[state] != none; state = source_[edges.back()]) edges.push_back(entrance_[state]);
  std::reverse(edges.begin(), edges.end());
  return edges;
}

/// Breadth first, over states together with whether the task has given way.
MissionPlanner::Path MissionPlanner::path_that_returns(std::uint32_t part,
                                                       std::uint32_t goal) const {
  const std::uint32_t first = graph_.parts[part].first_state;
  const std::uint32_t gave_way = graph_.way_given_for(goal);
  struct Visit {
    std::uint32_t state = 0;  ///< twice the state, plus 1 if the task has given way
    std::uint32_t edge = none;
    std::size_t before = 0;
  };
  std::vector<Visit> visits{{2 * first, none, 0}};
  std::vector<std::uint8_t> is_seen(std::size_t{2} * (end_of(part) - first), 0);
  is_seen[0] = 1;
  for (std::size_t place = 0; place < visits.size(); ++place) {
    const std::uint32_t state = visits[place].state / 2;
    const bool had_given_way = visits[place].state % 2 != 0;
    for (std::uint32_t edge = graph_.begin[state]; edge < graph_.begin[state + 1]; ++edge) {
      const auto items = graph_.items_of(graph_.edges[edge]);
      const auto has = [&](std::uint32_t item) {
        return std::find(items.begin(), items.end(), item) != items.end();
      };
      if (had_given_way && has(goal)) {
        Path path{part, {edge}};
        for (std::size_t at = place; visits[at].edge != none; at = visits[at].before) {
          path.edges.push_back(visits[at].edge);
        }
        std::reverse(path.edges.begin(), path.edges.end());
        return path;
      }
      const bool has_given_way = had_given_way || has(gave_way);
      const std::uint32_t to = 2 * graph_.edges[edge].to + (has_given_way ? 1 : 0);
      if (std::exchange(is_seen[to - 2 * first], std::uint8_t{1}) != 0) continue;
      visits.push_back({to, edge, place});
    }
  }
  return {};
}

/// Of one part, or of all (none).
void MissionPlanner::weigh(const std::vector<Weight>& weights, std::uint32_t part) {
  const std::uint32_t first = part == none ? 0 : graph_.parts[part].first_state;
  const std::uint32_t end = end_of(part == none ? none - 1 : part);
  edge_weights_.resize(graph_.edges.size());
  for (std::uint32_t edge = graph_.begin[first]; edge < graph_.begin[end]; ++edge) {
    edge_weights_[edge] = 0;
    for (const std::uint32_t item : graph_.items_of(graph_.edges[edge])) {
      if (graph_.is_goal(item)) edge_weights_[edge] += weights[item];
    }
  }
  const std::uint32_t longest = part == none ? longest_ : limits_[part];
  collected_.resize(longest_ + 1);
  for (std::vector<Weight>& layer : collected_) layer.resize(graph_.state_count());
  std::fill(collected_[0].begin() + first, collected_[0].begin() + end, 0);
  for (std::uint32_t left = 1; left <= longest && !is_stopped(); ++left) {
    const std::vector<Weight>& next = collected_[left - 1];
    for (std::uint32_t state = first; state < end; ++state) {
      Weight most = 0;
      for (std::uint32_t edge = graph_.begin[state]; edge < graph_.begin[state + 1]; ++edge) {
        most = std::max(most, edge_weights_[edge] + next[graph_.edges[edge].to]);
      }
      collected_[left][state] = most;
    }
  }
}

/// The part with the path that collects most.
std::uint32_t MissionPlanner::best_part() const {
  std::uint32_t best = 0;
  Weight most = 0;
  for (std::uint32_t part = 0; part < graph_.parts.size(); ++part) {
    const Weight weight = collected_[limits_[part]][graph_.parts[part].first_state];
    if (weight <= most) continue;
    most = weight;
    best = part;
  }
  return best;
}

/// The path that collects most, where several moves may count the same goal.
MissionPlanner::Path MissionPlanner::heaviest_path(std::uint32_t part) const {
  Path path{part, {}};
  std::uint32_t state = graph_.parts[part].first_state;
  for (std::uint32_t left = limits_[part]; left > 0 && collected_[left][state] > 0; --left) {
    std::uint32_t edge = graph_.begin[state];
    while (edge_weights_[edge] + collected_[left - 1][graph_.edges[edge].to] !=
           collected_[left][state]) {
      ++edge;
    }
    path.edges.push_back(edge);
    state = graph_.edges[edge].to;
  }
  return path;
}

/// By goal: the only part with moves that meet it; none if there are several.
std::vector<std::uint32_t> MissionPlanner::find_homes() const {
  constexpr std::uint32_t unknown = none - 1;
  std::vector<std::uint32_t> homes(graph_.goal_count, unknown);
  for (std::uint32_t part = 0; part < graph_.parts.size(); ++part) {
    const std::uint32_t end = graph_.begin[end_of(part)];
    for (std::uint32_t edge = graph_.begin[graph_.parts[part].first_state]; edge < end; ++edge) {
      for (const std::uint32_t item : graph_.items_of(graph_.edges[edge])) {
        if (!graph_.is_goal(item)) continue;
        homes[item] = homes[item] == unknown || homes[item] == part ? part : none;
      }
    }
  }
  return homes;
}

std::uint64_t MissionPlanner::lower_bound(const Goals& wanted) {
  const auto weight_of = [&](std::size_t goal) {
    return wanted[goal] != 0 && reachable_[goal] != 0 ? first_weight : 0;
  };
  const std::vector<std::uint32_t> homes = find_homes();
  std::uint64_t bound = 0;
  bool is_any_shared = false;
  std::vector<Weight> weights(graph_.goal_count);
  for (std::uint32_t part = 0; part < graph_.parts.size(); ++part) {
    for (std::size_t goal = 0; goal < weights.size(); ++goal) {
      weights[goal] = homes[goal] == part ? weight_of(goal) : 0;
    }
    bound += improve(weights, part);
    for (std::size_t goal = 0; goal < weights.size(); ++goal) {
      if (homes[goal] == part) weights_[goal] = weights[goal];
    }
  }
  for (std::size_t goal = 0; goal < weights.size(); ++goal) {
    weights[goal] = weight_of(goal);
    is_any_shared = is_any_shared || (weights[goal] != 0 && homes[goal] == none);
  }
  return is_any_shared ? std::max(bound, improve(weights, none)) : bound;
}

/// Improves weights, and returns the best bound that they were.
std::uint64_t MissionPlanner::improve(std::vector<Weight>& weights, std::uint32_t part) {
  constexpr std::uint64_t most_work = 400'000'000;
  const std::uint64_t work = (graph_.edges.size() + 1) * (longest_ + 1);
  const std::uint64_t rounds = std::clamp<std::uint64_t>(most_work / work, 16, 600);
  std::uint64_t bound = 0;
  std::vector<Weight> best = weights;
  for (std::uint64_t round = 0; round < rounds && !is_stopped(); ++round) {
    Weight sum = 0;
    for (const Weight weight : weights) sum += weight;
    if (sum == 0) return 0;
    weigh(weights, part);
    if (is_stopped()) break;
    const std::uint32_t at = part == none ? best_part() : part;
    const Weight most = collected_[limits_[at]][graph_.parts[at].first_state];
    // Rounded up, as paths are whole.
    const std::uint64_t found = (sum + most - 1) / most;
    if (found > bound) {
      bound = found;
      best = weights;
    }
    // Goals that are easy to meet lose weight, first faster, then slower.
    const unsigned shift = round < rounds / 4 ? 2 : round < rounds / 2 ? 3 : 4;
    for (const std::uint32_t edge : heaviest_path(at).edges) {
      for (const std::uint32_t item : graph_.items_of(graph_.edges[edge])) {
        if (graph_.is_goal(item)) weights[item] -= weights[item] >> shift;
      }
    }
    const Weight heaviest = *std::max_element(weights.begin(), weights.end());
    if (heaviest >= first_weight / 2) continue;
    for (Weight& weight : weights) weight *= 2;
  }
  weights = std::move(best);
  return bound;
}

/// A beam search for the path that collects most, where each goal counts once. The weights are
/// those that were weighed last.
MissionPlanner::Path MissionPlanner::search(std::uint32_t part,
                                            const std::vector<Weight>& weights) const {
  const std::uint32_t limit = limits_[part];
  std::vector<Partial> beam;
  beam.push_back({graph_.parts[part].first_state, {part, {}}, Walk(graph_), 0});
  Partial best = beam.front();
  for (std::uint32_t left = limit; left > 0 && !beam.empty() && !is_stopped(); --left) {
    struct Extension {
      std::size_t partial = 0;
      std::uint32_t edge = 0;
      std::uint64_t gained = 0;
      std::uint64_t promise = 0;
    };
    std::vector<Extension> extensions;
    for (std::size_t place = 0; place < beam.size(); ++place) {
      const std::uint32_t state = beam[place].state;
      for (std::uint32_t edge = graph_.begin[state]; edge < graph_.begin[state + 1]; ++edge) {
        const Weight ahead = collected_[left - 1][graph_.edges[edge].to];
        if (edge_weights_[edge] + ahead == 0) continue;
        std::uint64_t gained = beam[place].gained;
        beam[place].walk.look(graph_.edges[edge],
                              [&](std::uint32_t goal) { gained += weights[goal]; });
        extensions.push_back({place, edge, gained, gained + ahead});
      }
    }
    const auto is_better = [](const Extension& a, const Extension& b) {
      if (a.promise != b.promise) return a.promise > b.promise;
      if (a.gained != b.gained) return a.gained > b.gained;
      return a.partial != b.partial ? a.partial < b.partial : a.edge < b.edge;
    };
    std::sort(extensions.begin(), extensions.end(), is_better);
    std::vector<Partial> next;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> taken;
    for (const Extension& extension : extensions) {
      if (next.size() == beam_width) break;
      const std::pair<std::uint32_t, std::uint64_t> key{graph_.edges[extension.edge].to,
                                                        extension.gained};
      if (std::find(taken.begin(), taken.end(), key) != taken.end()) continue;
      taken.push_back(key);
      Partial& partial = next.emplace_back(beam[extension.partial]);
      partial.state = key.first;
      partial.path.edges.push_back(extension.edge);
      partial.walk.take(graph_.edges[extension.edge]);
      partial.gained = extension.gained;
      if (partial.gained > best.gained) best = partial;
    }
    beam = std::move(next);
  }
  return best.path;
}

std::vector<MissionPlanner::Path> MissionPlanner::cover(const Goals& wanted,
                                                        const std::vector<Weight>& weights) {
  std::vector<Path> paths;
  Goals missing = wanted;
  for (std::size_t goal = 0; goal < missing.size(); ++goal) missing[goal] &= reachable_[goal];
  const auto take = [&](const Path& path) {
    bool is_new = false;
    for (const std::uint32_t goal : goals_of(path)) {
      is_new = is_new || missing[goal] != 0;
      missing[goal] = 0;
    }
    if (is_new) paths.push_back(path);
    return is_new;
  };
  for (;;) {
    std::vector<Weight> left(weights.size(), 0);
    for (std::size_t goal = 0; goal < missing.size(); ++goal) {
      if (missing[goal] != 0) left[goal] = weights[goal];
    }
    if (std::all_of(left.begin(), left.end(), [](Weight weight) { return weight == 0; })) {
      return paths;
    }
    weigh(left, none);
    if (is_stopped()) return paths;
    if (take(search(best_part(), left))) continue;
    // Returns collect weight on paths that do not meet them.
    bool is_new = false;
    for (std::size_t goal = 0; goal < missing.size(); ++goal) {
      if (missing[goal] != 0 && take(returning_[goal])) is_new = true;
    }
    if (!is_new) return paths;
  }
}

std::vector<MissionPlanner::Path> MissionPlanner::plan(const Goals& wanted) {
  std::vector<Weight> by_price = weights_;
  // What has lost all its weight has to be met, too.
  for (Weight& weight : by_price) weight = weight / 64 + 1;
  std::vector<Path> paths = cover(wanted, by_price);
  drop_and_cut(paths, wanted);
  if (is_stopped()) {
    add_shortest(paths, wanted);
    return paths;
  }
  std::vector<Path> others = cover(wanted, std::vector<Weight>(graph_.goal_count, 1));
  drop_and_cut(others, wanted);
  return others.size() < paths.size() && !is_stopped() ? others : paths;
}

/// The longest first, which meet others on their way.
void MissionPlanner::add_shortest(std::vector<Path>& paths, const Goals& wanted) const {
  Goals missing = wanted;
  for (const Path& path : paths) {
    for (const std::uint32_t goal : goals_of(path)) missing[goal] = 0;
  }
  std::vector<std::pair<std::uint32_t, Path>> candidates;  // by goal
  for (std::uint32_t goal = 0; goal < graph_.goal_count; ++goal) {
    if (missing[goal] == 0 || reachable_[goal] == 0) continue;
    if (nearest_[goal] == none) {
      candidates.emplace_back(goal, returning_[goal]);
      continue;
    }
    const std::uint32_t state = source_[nearest_[goal]];
    Path path{part_of(state), shortest_to(state)};
    path.edges.push_back(nearest_[goal]);
    candidates.emplace_back(goal, std::move(path));
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.second.edges.size() > b.second.edges.size();
  });
  for (auto& [wanted_goal, path] : candidates) {
    if (missing[wanted_goal] == 0) continue;
    for (const std::uint32_t goal : goals_of(path)) missing[goal] = 0;
    paths.push_back(std::move(path));
  }
}

/// Drops paths that meet nothing alone, those with the fewest goals first, and ends each path where
/// it has met what it alone meets.
void MissionPlanner::drop_and_cut(std::vector<Path>& paths, const Goals& wanted) const {
  std::vector<std::uint32_t> times(graph_.goal_count, 0);
  std::vector<std::vector<std::uint32_t>> goals;
  std::vector<std::size_t> order;
  for (const Path& path : paths) {
    order.push_back(order.size());
    goals.push_back(goals_of(path));
    for (const std::uint32_t goal : goals.back()) ++times[goal];
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return goals[a].size() < goals[b].size(); });
  const auto is_needed = [&](std::uint32_t goal) { return wanted[goal] != 0 && times[goal] == 1; };
  for (const std::size_t place : order) {
    if (is_stopped()) return;
    Path& path = paths[place];
    while (!path.edges.empty()) {
      const std::uint32_t last = path.edges.back();
      path.edges.pop_back();
      std::vector<std::uint32_t> lost = goals[place];
      const std::vector<std::uint32_t> kept = goals_of(path);
      std::erase_if(lost, [&](std::uint32_t goal) {
        return std::find(kept.begin(), kept.end(), goal) != kept.end();
      });
      if (std::any_of(lost.begin(), lost.end(), is_needed)) {
        path.edges.push_back(last);
        break;
      }
      for (const std::uint32_t goal : lost) --times[goal];
      goals[place] = kept;
    }
  }
  std::erase_if(paths, [](const Path& path) { return path.edges.empty(); });
}

std::vector<MissionPlanner::Path> MissionPlanner::paths_toward(const Goals& wanted,
                                                               std::size_t count) const {
  std::vector<std::uint32_t> states;
  std::vector<std::size_t> ahead(graph_.state_count(), 0);
  for (std::uint32_t state = 0; state < graph_.state_count(); ++state) {
    std::set<std::uint32_t> goals;
    for (std::uint32_t edge = graph_.begin[state]; edge < graph_.begin[state + 1]; ++edge) {
      for (const std::uint32_t item : graph_.items_of(graph_.edges[edge])) {
        if (graph_.is_goal(item) && wanted[item] != 0) goals.insert(item);
      }
    }
    ahead[state] = goals.size();
    if (!goals.empty()) states.push_back(state);
  }
  std::stable_sort(states.begin(), states.end(), [&](std::uint32_t a, std::uint32_t b) {
    return ahead[a] != ahead[b] ? ahead[a] > ahead[b] : depths_[a] < depths_[b];
  });
  if (states.size() > count) states.resize(count);
  std::vector<Path> paths;
  paths.reserve(states.size());
  for (const std::uint32_t state : states) paths.push_back({part_of(state), shortest_to(state)});
  return paths;
}

std::vector<std::uint32_t> MissionPlanner::goals_of(const Path& path) const {
  std::vector<std::uint32_t> goals;
  Walk walk(graph_);
  for (const std::uint32_t edge : path.edges) {
    walk.look(graph_.edges[edge], [&](std::uint32_t goal) { goals.push_back(goal); });
    walk.take(graph_.edges[edge]);
  }
  return goals;
}

}  // namespace cbc
