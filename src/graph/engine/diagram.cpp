// A picture is made in steps, each of them data: the catalog as a graph, the part of it that is
// drawn, the nodes and edges of a view (views.cpp), and the legend, which explains what is in the
// finished picture and nothing else. Writers of formats (graph/report) then decide on syntax and
// colors only.
//
// Nothing here places a node. Graphviz does that (E. R. Gansner, E. Koutsofios, S. C. North and
// K.-P. Vo, "A technique for drawing directed graphs", IEEE Transactions on Software Engineering 19
// (1993)), or Mermaid. A layout of our own would have to be as good as theirs for catalogs of any
// shape, and Mermaid has no way to be told one.

#include "graph/engine/diagram.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::draw {
namespace {

/// Characters with a special meaning in ids, or in the formats of pictures.
bool is_special(char32_t character) {
  return character == '%' || character == '#' || character == '\\' || character == '&';
}

}  // namespace

std::string id_of(std::string_view kind, std::string_view name) {
  std::string id(kind);
  id += ':';
  for (std::size_t offset = 0; offset < name.size();) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    const std::string_view bytes = name.substr(offset, decoded.bytes);
    if (!decoded.valid || is_control(decoded.character) || is_special(decoded.character)) {
      for (const char byte : bytes) append_percent_encoded(id, byte);
    } else {
      id += bytes;
    }
    offset += decoded.bytes;
  }
  return id;
}

std::string label_of(std::string_view name) {
  const bool is_blank = std::all_of(name.begin(), name.end(), [](char c) { return c == ' '; });
  return is_blank ? quote(name) : printable(name);
}

std::string at_least(Millionths degree) { return "≥ " + format_percent(degree); }

std::string_view sign_of(Mark mark) {
  if (mark == Mark::added) return "+";
  if (mark == Mark::removed) return "−";
  // A plus or minus before a number would read as a part of it.
  if (mark == Mark::started) return "▶";
  if (mark == Mark::stopped) return "■";
  if (mark == Mark::changed) return "~";
  return {};
}

std::string with_sign(Mark mark, std::string label) {
  const std::string_view sign = sign_of(mark);
  if (sign.empty()) return label;
  return std::string(sign) + (label.empty() ? "" : " ") + std::move(label);
}

std::vector<std::string> caption_of(const Moment& moment) {
  const std::string script = label_of(std::string_view(moment.script));
  std::vector<std::string> lines;
  if (moment.index == 0) {
    lines.push_back(script + ", before the first event");
  } else {
    lines.push_back(script + ", after event " + std::to_string(moment.index) + " at " +
                    format_decimal(moment.time, 6) + " s");
    lines.push_back(moment.event);
  }
  if (!moment.situation.empty()) lines.push_back(moment.situation);
  return lines;
}

std::string label_of(const CatalogGraph::Performance& performance) {
  const Millionths suitability = performance.suitability;
  if (performance.before) {
    return format_decimal(*performance.before, 4) + " → " + format_percent(suitability);
  }
  return with_sign(performance.mark,
                   suitability == one_million ? std::string() : format_percent(suitability));
}

std::string label_of(const CatalogGraph::Requirement& requirement) {
  const Millionths minimum = requirement.minimum_performance;
  const std::string label = minimum > 0 ? at_least(minimum) : std::string();
  if (!requirement.before) return with_sign(requirement.mark, label);
  const std::string before = *requirement.before > 0 ? at_least(*requirement.before) : "no minimum";
  return before + " → " + (minimum > 0 ? label : "no minimum");
}

std::vector<std::vector<const Node*>> cluster_members(const Diagram& diagram) {
  std::vector<std::vector<const Node*>> members(diagram.clusters.size());
  for (const Node& node : diagram.nodes) {
    if (node.cluster != none) members[node.cluster].push_back(&node);
  }
  return members;
}

namespace {

/// More of them would distract from what was asked for.
constexpr std::size_t most_excluded_beside = 8;

Part nothing(const CatalogGraph& graph) {
  Part part;
  part.has_task.resize(graph.tasks.size());
  part.has_behavior.resize(graph.behaviors.size());
  part.is_beside.resize(graph.tasks.size());
  part.is_named.resize(graph.tasks.size());
  return part;
}

std::vector<std::uint32_t> places_of(const std::vector<bool>& is_there) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t place = 0; place < is_there.size(); ++place) {
    if (is_there[place]) places.push_back(place);
  }
  return places;
}

/// Lists what the part has.
Part listed(Part part) {
  part.tasks = places_of(part.has_task);
  part.behaviors = places_of(part.has_behavior);
  return part;
}

class Surroundings {
 public:
  Surroundings(const CatalogGraph& graph, const std::vector<std::uint32_t>& tasks)
      : graph_(graph), named_(tasks), part_(nothing(graph)) {
    for (const std::uint32_t task : named_) {
      part_.is_named[task] = true;
      part_.has_task[task] = true;
      add_behaviors_of(task);
    }
  }

  void go_down(std::optional<std::uint32_t> depth) {
    walk(depth, [&](std::uint32_t task, auto&& reach) {
      add_behaviors_of(task);
      for (const std::uint32_t place : graph_.performances_of_task[task]) {
        const std::uint32_t behavior = graph_.performances[place].behavior;
        for (const std::uint32_t required : graph_.requirements_of_behavior[behavior]) {
          reach(graph_.requirements[required].task);
        }
      }
    });
  }

  void go_up(std::optional<std::uint32_t> depth) {
    walk(depth, [&](std::uint32_t task, auto&& reach) {
      for (const std::uint32_t place : graph_.requirements_of_task[task]) {
        const std::uint32_t behavior = graph_.requirements[place].behavior;
        // At the last step, only what is already drawn is connected.
        const auto performed = graph_.performances_of_behavior[behavior];
        bool is_reached = performed.empty();
        for (const std::uint32_t link : performed) {
          if (reach(graph_.performances[link].task)) is_reached = true;
        }
        if (is_reached) part_.has_behavior[behavior] = true;
      }
    });
  }

  Part finish() && {
    for (const std::uint32_t behavior : places_of(part_.has_behavior)) {
      for (const std::uint32_t link : graph_.performances_of_behavior[behavior]) {
        add_beside(graph_.performances[link].task);
      }
    }
    for (const std::uint32_t task : named_) {
      for (const std::uint32_t list : graph_.exclusions_of_task[task]) {
        const auto tasks = graph_.exclusions[list];
        if (tasks.size() > most_excluded_beside) continue;
        for (const std::uint32_t excluded : tasks) add_beside(excluded);
      }
    }
    return listed(std::move(part_));
  }

 private:
  /// Step by step from the tasks asked for. `expand` calls a function for each neighbor of a task,
  /// which says whether the neighbor is within reach.
  template <typename Expand>
  void walk(std::optional<std::uint32_t> depth, const Expand& expand) {
    std::vector<bool> is_known(graph_.tasks.size());
    std::vector<std::uint32_t> present = named_;
    for (const std::uint32_t task : present) is_known[task] = true;
    for (std::uint32_t step = 0; !present.empty(); ++step) {
      const bool is_last = depth && step >= *depth;
      std::vector<std::uint32_t> next;
      for (const std::uint32_t task : present) {
        expand(task, [&](std::uint32_t found) {
          if (is_known[found]) return true;
          if (is_last) return false;
          is_known[found] = true;
          part_.has_task[found] = true;
          next.push_back(found);
          return true;
        });
      }
      present = std::move(next);
    }
  }

  void add_beside(std::uint32_t task) {
    if (part_.has_task[task]) return;
    part_.has_task[task] = true;
    part_.is_beside[task] = true;
  }

  void add_behaviors_of(std::uint32_t task) {
    for (const std::uint32_t place : graph_.performances_of_task[task]) {
      part_.has_behavior[graph_.performances[place].behavior] = true;
    }
  }

  const CatalogGraph& graph_;
  const std::vector<std::uint32_t>& named_;
  Part part_;
};

}  // namespace

Part whole(const CatalogGraph& graph) {
  Part part = nothing(graph);
  part.has_task.flip();
  part.has_behavior.flip();
  return listed(std::move(part));
}

Part part_of_group(const CatalogGraph& graph, std::uint32_t group) {
  Part part = nothing(graph);
  for (std::uint32_t task = 0; task < graph.tasks.size(); ++task) {
    part.has_task[task] = graph.tasks[task].group == group;
  }
  for (std::uint32_t behavior = 0; behavior < graph.behaviors.size(); ++behavior) {
    part.has_behavior[behavior] = graph.behaviors[behavior].group == group;
  }
  return listed(std::move(part));
}

Part part_around(const CatalogGraph& graph, const std::vector<std::uint32_t>& tasks,
                 const Reach& reach) {
  Surroundings surroundings(graph, tasks);
  if (reach.down) surroundings.go_down(reach.depth);
  if (reach.up) surroundings.go_up(reach.depth);
  return std::move(surroundings).finish();
}

namespace {

class Legend {
 public:
  explicit Legend(Diagram& diagram) : diagram_(diagram) {}

  void add() {
    add_nodes();
    add_lines();
    add_texts();
    add_marks();
  }

 private:
  template <typename Sample>
  void explain(bool is_there, Sample&& sample, std::string meaning) {
    if (is_there) diagram_.legend.push_back({std::forward<Sample>(sample), std::move(meaning)});
  }

  template <typename Test>
  [[nodiscard]] bool has_node(const Test& test) const {
    return std::any_of(diagram_.nodes.begin(), diagram_.nodes.end(), test);
  }

  template <typename Test>
  [[nodiscard]] bool has_edge(const Test& test) const {
    return std::any_of(diagram_.edges.begin(), diagram_.edges.end(), test);
  }

  [[nodiscard]] bool has(NodeKind kind) const {
    return has_node([kind](const Node& node) { return node.kind == kind; });
  }

  [[nodiscard]] bool has(EdgeKind kind) const {
    return has_edge([kind](const Edge& edge) { return edge.kind == kind; });
  }

  void add_nodes() {
    using Frame = LegendEntry::Frame;
    const bool has_tasks = has(NodeKind::task);
    add_shape(NodeKind::task, "round", "task");
    add_shape(NodeKind::behavior, "angular", "behavior");
    explain(diagram_.clustering == Clustering::packages, Frame::package,
            has_tasks ? "package, with the tasks that it alone performs" : "package");
  }

  /// A word stands for the shape where no node has the color of its kind.
  void add_shape(NodeKind kind, std::string word, std::string meaning) {
    const bool has_color = has_node([kind](const Node& node) {
      return node.kind == kind && node.mark == Mark::plain && node.color == none;
    });
    explain(has_color, kind, meaning);
    explain(!has_color && has(kind), std::move(word), std::move(meaning));
  }

  void add_lines() {
    explain(has(EdgeKind::performed_by), EdgeKind::performed_by, "performs the task");
    explain(has(EdgeKind::requirement), EdgeKind::requirement, "requires");
    explain(has(EdgeKind::same_behavior), EdgeKind::same_behavior, "have a behavior in common");
    explain(has_edge([this](const Edge& edge) {
              return edge.kind == EdgeKind::exclusion &&
                     diagram_.nodes[edge.from].kind != NodeKind::hub;
            }),
            EdgeKind::exclusion, "not at the same time");
    const bool has_limit = has_node([](const Node& node) { return node.at_most > 1; });
    explain(has(NodeKind::hub), NodeKind::hub,
            has_limit ? "at most so many of them at a time; one without a number"
                      : "at most one of them at a time");
  }

  void add_texts() {
    const auto has_suitability = [](const Edge& edge) {
      return edge.kind == EdgeKind::performed_by && edge.label.find('%') != std::string::npos;
    };
    const auto has_minimum = [](const auto& drawn) {
      return drawn.label.find("≥") != std::string::npos;
    };
    const auto has_count = [](const Edge& edge) {
      return edge.label.find(" of ") != std::string::npos;
    };
    explain(has_edge(has_suitability), "%", "suitability, if it is not 100 %");
    explain(has_edge(has_minimum) ||
                has_node([](const Node& node) { return node.minimum_performance > 0; }),
            "≥", "minimum performance");
    explain(has_edge(has_count), "1 of 2", "one of the two behaviors requires it");
    explain(has_node([](const Node& node) { return !node.situation.empty(); }), "X: y",
            "fits only in this situation");
  }

  void add_marks() {
    constexpr std::array all = {Mark::active,      Mark::started, Mark::stopped,
                                Mark::unavailable, Mark::added,   Mark::removed,
                                Mark::changed,     Mark::faulty,  Mark::faint};
    for (const Mark mark : all) {
      const auto is_marked = [mark](const auto& drawn) { return drawn.mark == mark; };
      explain(has_node(is_marked) || has_edge(is_marked), mark, describe(mark));
    }
  }

  [[nodiscard]] std::string describe(Mark mark) const {
    if (mark == Mark::unavailable) return "cannot be activated";
    if (mark == Mark::faulty) return "has an error";
    if (mark == Mark::faint) return diagram_.moment ? "inactive" : "only a neighbor";
    return std::string(name_of(mark));
  }

  Diagram& diagram_;
};

}  // namespace

void add_legend(Diagram& diagram) { Legend(diagram).add(); }

}  // namespace cbc::draw
