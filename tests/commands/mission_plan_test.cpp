// Paths planned in small random graphs of goals, against all paths.
#include "coverage/engine/mission_plan.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "coverage/engine/goal_search.h"

namespace cbc::mission_plan_test {
namespace {

using Goals = MissionPlanner::Goals;
using GoalSet = std::set<std::uint32_t>;

constexpr std::uint32_t goal_count = 6;
constexpr std::uint32_t returning = goal_count - 1;  ///< counts only after it has been left

/// Two groups of a few states, numbered breadth first: each state has a move to the next one.
GoalGraph random_graph(std::mt19937& random) {
  const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
  GoalGraph graph;
  graph.goal_count = goal_count;
  graph.is_return.assign(goal_count, 0);
  graph.is_return[returning] = 1;
  for (GroupId group(0); group < 2; ++group) {
    const auto first = static_cast<std::uint32_t>(graph.state_count());
    const std::uint32_t states = 1 + below(4);
    graph.parts.push_back({group, first, true});
    std::uint32_t reached = 1;
    for (std::uint32_t state = 0; state < states; ++state) {
      const std::uint32_t moves = 1 + below(3);
      for (std::uint32_t move = 0; move < moves; ++move) {
        std::uint32_t to = below(reached);
        if (move == 0 && reached <= state + 1 && reached < states) to = reached++;
        GoalSet items;
        while (below(3) == 0) items.insert(below(goal_count));
        if (below(6) == 0) items.insert(goal_count + returning);
        graph.edges.push_back({first + to,
                               static_cast<std::uint32_t>(graph.items.size()),
                               static_cast<std::uint32_t>(items.size()),
                               {}});
        graph.items.insert(graph.items.end(), items.begin(), items.end());
      }
      graph.begin.push_back(static_cast<std::uint32_t>(graph.edges.size()));
    }
  }
  return graph;
}

/// The sets of goals of all paths of at most `left` more moves.
void add_paths(const GoalGraph& graph, std::uint32_t state, std::uint32_t left,
               const GoalSet& goals, bool has_left, std::set<GoalSet>& found) {
  found.insert(goals);
  if (left == 0) return;
  for (std::uint32_t edge = graph.begin[state]; edge < graph.begin[state + 1]; ++edge) {
    GoalSet more = goals;
    bool leaves = has_left;
    for (const std::uint32_t item : graph.items_of(graph.edges[edge])) {
      if (item == goal_count + returning) leaves = true;
      if (item < goal_count && (item != returning || has_left)) more.insert(item);
    }
    add_paths(graph, graph.edges[edge].to, left - 1, more, leaves, found);
  }
}

std::size_t fewest(const std::set<GoalSet>& paths, const GoalSet& wanted) {
  if (wanted.empty()) return 0;
  std::size_t best = goal_count;
  for (const GoalSet& path : paths) {
    if (!path.contains(*wanted.begin())) continue;
    GoalSet rest;
    std::set_difference(wanted.begin(), wanted.end(), path.begin(), path.end(),
                        std::inserter(rest, rest.end()));
    best = std::min(best, 1 + fewest(paths, rest));
  }
  return best;
}

TEST(MissionPlan, MeetsAllAndIsBounded) {
  std::mt19937 random(7);
  std::size_t best = 0;
  std::size_t planned = 0;
  std::size_t bounds = 0;
  for (int round = 0; round < 400; ++round) {
    const GoalGraph graph = random_graph(random);
    MissionPlanner planner(graph, 1 + static_cast<std::uint32_t>(random() % 4));
    std::set<GoalSet> paths;
    GoalSet reachable;
    for (std::uint32_t part = 0; part < graph.parts.size(); ++part) {
      add_paths(graph, graph.parts[part].first_state, planner.most_events(part), {}, false, paths);
      // Nothing is further away than each state twice: before and after something was left.
      std::set<GoalSet> all;
      add_paths(graph, graph.parts[part].first_state, 8, {}, false, all);
      for (const GoalSet& goals : all) reachable.insert(goals.begin(), goals.end());
    }
    for (std::uint32_t goal = 0; goal < goal_count; ++goal) {
      ASSERT_EQ(planner.reachable()[goal] != 0, reachable.contains(goal)) << round;
    }
    const Goals wanted(goal_count, 1);
    const std::uint64_t bound = planner.lower_bound(wanted);
    const std::vector<MissionPlanner::Path> plan = planner.plan(wanted);
    GoalSet met;
    for (const MissionPlanner::Path& path : plan) {
      EXPECT_LE(path.edges.size(), planner.most_events(path.part));
      for (const std::uint32_t goal : planner.goals_of(path)) met.insert(goal);
    }
    ASSERT_EQ(met, reachable) << round;
    const std::size_t least = fewest(paths, reachable);
    ASSERT_LE(bound, least) << round;
    ASSERT_LE(least, plan.size()) << round;
    best += least;
    planned += plan.size();
    bounds += bound;
  }
  // They are worth something, too.
  EXPECT_LE(planned * 100, best * 115);
  EXPECT_GE(bounds * 100, best * 70);
}

TEST(MissionPlan, NeedsNothingForNothing) {
  std::mt19937 random(1);
  const GoalGraph graph = random_graph(random);
  MissionPlanner planner(graph, 3);
  const Goals nothing(goal_count, 0);
  EXPECT_EQ(planner.lower_bound(nothing), 0U);
  EXPECT_TRUE(planner.plan(nothing).empty());
}

TEST(MissionPlan, AllowsTheEventsOfTheFurthestGoal) {
  GoalGraph graph;
  graph.goal_count = 1;
  graph.is_return = {0};
  graph.parts = {{GroupId(0), 0, true}};
  graph.edges = {{1, 0, 0, {}}, {2, 0, 0, {}}, {2, 0, 1, {}}};
  graph.begin = {0, 1, 2, 3};
  graph.items = {0};
  MissionPlanner planner(graph, 1);
  EXPECT_EQ(planner.most_events(0), 3U);
  ASSERT_EQ(planner.plan({1}).size(), 1U);
  EXPECT_EQ(planner.plan({1}).front().edges, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace cbc::mission_plan_test
