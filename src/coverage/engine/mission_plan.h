#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "coverage/engine/goal_graph.h"

namespace cbc {

/// Plans short missions that meet goals together: paths in a graph of goals (docs/coverage.md, "The
/// missing missions").
class MissionPlanner {
 public:
  /// A path from the first state of a group.
  struct Path {
    std::uint32_t part = 0;            ///< of the graph
    std::vector<std::uint32_t> edges;  ///< of the graph

    bool operator==(const Path&) const = default;
  };
  /// By goal: whether it is met.
  using Goals = std::vector<std::uint8_t>;

  /// The graph must outlive this object. A path has at most `events` moves, or as many as it takes
  /// to meet the goal of its group that is furthest away. `is_stopped`: asked now and then; once it
  /// is true, what is planned comes soon. May be empty.
  MissionPlanner(const GoalGraph& graph, std::uint32_t events,
                 std::function<bool()> is_stopped = {});

  /// By goal: whether a path meets it.
  [[nodiscard]] const Goals& reachable() const { return reachable_; }
  /// The most moves of a path.
  [[nodiscard]] std::uint32_t most_events(std::uint32_t part) const { return limits_[part]; }

  /// No fewer paths meet all of these reachable goals, if all parts of the graph are complete. Two
  /// paths cannot do more than paths that count what they meet several times. So any weights of
  /// goals are a bound: the sum of all, divided by that of the path that collects most (duality of
  /// linear programs). Some rounds improve the weights. Goals of one group need paths of that
  /// group, so the bounds of groups add up.
  [[nodiscard]] std::uint64_t lower_bound(const Goals& wanted);

  /// Paths that together meet the reachable ones of these goals. Each ends with a move that meets a
  /// goal that no other path meets. Once it is stopped, goals that no path meets yet are met by
  /// shortest paths, but for some returns, and there may be more paths than it takes.
  [[nodiscard]] std::vector<Path> plan(const Goals& wanted);

  /// Shortest paths to the states whose moves meet some of the goals: at most `count`, those with
  /// the most goals first, of these the shortest.
  [[nodiscard]] std::vector<Path> paths_toward(const Goals& wanted, std::size_t count) const;

  /// The goals that a path meets, in order; each once.
  [[nodiscard]] std::vector<std::uint32_t> goals_of(const Path& path) const;

 private:
  using Weight = std::uint64_t;

  struct Partial;

  [[nodiscard]] bool is_stopped() const { return is_stopped_ && is_stopped_(); }
  void find_depths();
  void find_limits(std::uint32_t events);
  [[nodiscard]] std::vector<std::uint32_t> shortest_to(std::uint32_t state) const;
  [[nodiscard]] Path path_that_returns(std::uint32_t part, std::uint32_t goal) const;
  [[nodiscard]] std::uint32_t end_of(std::uint32_t part) const;
  [[nodiscard]] std::uint32_t part_of(std::uint32_t state) const;
  [[nodiscard]] std::vector<std::uint32_t> find_homes() const;
  [[nodiscard]] std::uint64_t improve(std::vector<Weight>& weights, std::uint32_t part);
  void weigh(const std::vector<Weight>& weights, std::uint32_t part);
  [[nodiscard]] std::uint32_t best_part() const;
  [[nodiscard]] Path heaviest_path(std::uint32_t part) const;
  [[nodiscard]] Path search(std::uint32_t part, const std::vector<Weight>& weights) const;
  [[nodiscard]] std::vector<Path> cover(const Goals& wanted, const std::vector<Weight>& weights);
  void add_shortest(std::vector<Path>& paths, const Goals& wanted) const;
  void drop_and_cut(std::vector<Path>& paths, const Goals& wanted) const;

  const GoalGraph& graph_;
  const std::function<bool()> is_stopped_;
  std::vector<std::uint32_t> source_;    ///< by edge: its state
  std::vector<std::uint32_t> entrance_;  ///< by state: the edge of a shortest path; none: first
  std::vector<std::uint32_t> depths_;    ///< by state
  std::vector<std::uint32_t> limits_;    ///< by part
  std::uint32_t longest_ = 0;            ///< of limits_
  Goals reachable_;
  std::vector<std::uint32_t> nearest_;  ///< by goal, but for returns: the first edge that meets it
  std::vector<Path> returning_;  ///< by goal: a shortest path that meets a return; else empty
  std::vector<Weight> weights_;  ///< by goal: those that the rounds ended with

  // Of the weights that were weighed last.
  std::vector<Weight> edge_weights_;
  /// By number of moves that are left, then by state: the most that a path collects from there.
  std::vector<std::vector<Weight>> collected_;
};

}  // namespace cbc
