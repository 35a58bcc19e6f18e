#include "draw/view.h"

#include <utility>

#include "draw/builder.h"

namespace cbc::draw {
namespace {

ExclusivityStyle default_style(View view) {
  const bool has_exclusivity = view == View::full || view == View::constraints;
  return has_exclusivity ? ExclusivityStyle::readable : ExclusivityStyle::hidden;
}

Clustering default_clustering(View view) {
  return view == View::constraints ? Clustering::groups : Clustering::nothing;
}

}  // namespace

Diagram make_diagram(const CatalogGraph& graph, const Part& part, const ViewOptions& options) {
  Builder builder(graph, part, options);
  switch (options.view) {
    case View::full:
      draw_full_view(builder);
      break;
    case View::tasks:
      draw_task_view(builder, options.reduce);
      break;
    case View::constraints:
      draw_constraint_view(builder);
      break;
    case View::behaviors:
      draw_behavior_view(builder);
      break;
  }
  builder.add_exclusions(options.exclusivity.value_or(default_style(options.view)));
  builder.add_clusters(options.clustering.value_or(default_clustering(options.view)));
  return std::move(builder.diagram());
}

}  // namespace cbc::draw
