#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "draw/mark.h"

/// A picture as data: what is drawn, apart from the format it is written in.
namespace cbc::draw {

enum class View : std::uint8_t { full, tasks, constraints, behaviors };

enum class NodeKind : std::uint8_t {
  task,
  behavior,
  hub  ///< an exclusivity list, with a line to each of its tasks
};

enum class EdgeKind : std::uint8_t {
  performed_by,   ///< from a task to a behavior
  requirement,    ///< to what is required
  exclusion,      ///< without a direction
  same_behavior,  ///< between tasks that one behavior performs; without a direction
};

struct Node {
  NodeKind kind = NodeKind::task;
  std::string id;         ///< unique, from the name
  std::string_view name;  ///< as in the catalog; empty: it has none
  std::string_view package;
  std::uint32_t group = none;
  Millionths minimum_performance = 0;    ///< 0: none
  std::optional<std::int32_t> priority;  ///< of a task: of its request, in a state
  std::uint32_t left_out = 0;            ///< of a hub: tasks of the list that are not drawn
  std::string label;                     ///< on one line, fit to be shown
  std::vector<std::string> notes;        ///< each on a line below
  Mark mark = Mark::plain;
  bool is_defined = true;
  std::uint32_t color = none;    ///< number of a color; none: that of the kind
  std::uint32_t cluster = none;  ///< in Diagram::clusters
};

struct Edge {
  EdgeKind kind = EdgeKind::performed_by;
  std::uint32_t from = 0;  ///< in Diagram::nodes
  std::uint32_t to = 0;
  std::optional<Millionths> degree;  ///< the suitability, the minimum performance
  std::string label;
  Mark mark = Mark::plain;
};

/// Nodes in a common frame.
struct Cluster {
  std::string id;
  std::string label;
};

/// When the state was that a picture shows.
struct Moment {
  std::string script;       ///< its file
  std::uint64_t index = 0;  ///< of the last event; 0: none yet
  Microseconds time = 0;    ///< of this event
  std::string event;  ///< what it was and what came of it: "start HOVER, priority 2: accepted"
};

struct Diagram {
  View view = View::full;
  std::string_view file;
  std::optional<Moment> moment;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<Cluster> clusters;
};

}  // namespace cbc::draw
