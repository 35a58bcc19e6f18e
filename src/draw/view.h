#pragma once

#include <cstdint>
#include <optional>

#include "draw/catalog_graph.h"
#include "draw/diagram.h"
#include "draw/part.h"

namespace cbc::draw {

/// How the lists of tasks of which at most one runs are drawn.
enum class ExclusivityStyle : std::uint8_t {
  readable,  ///< short lists as pairs, others as hubs
  pairs,     ///< a line between each two
  hubs,      ///< a node for each list of more than two tasks, and a line to each of them
  hidden
};

/// What frames are drawn around; a group of one node needs none.
enum class Clustering : std::uint8_t { nothing, packages, groups };

struct ViewOptions {
  View view = View::full;
  std::optional<ExclusivityStyle> exclusivity;  ///< empty: what suits the view
  std::optional<Clustering> clustering;         ///< the same
  bool reduce = false;  ///< in View::tasks: leave out requirements that follow from others
};

/// The picture of a part of a catalog. `graph`, and what it was made of, must outlive it.
[[nodiscard]] Diagram make_diagram(const CatalogGraph& graph, const Part& part,
                                   const ViewOptions& options);

/// Adds a key to the kinds of nodes and edges that a picture has.
void add_legend(Diagram& diagram);

}  // namespace cbc::draw
