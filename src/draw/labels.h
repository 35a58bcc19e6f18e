#pragma once

#include <string>
#include <vector>

#include "draw/catalog_graph.h"
#include "draw/diagram.h"

namespace cbc::draw {

/// What stands at a line: the suitability, unless it is 100 %; the minimum performance. Of two
/// catalogs, what has changed.
[[nodiscard]] std::string label_of(const CatalogGraph::Performance& performance);
[[nodiscard]] std::string label_of(const CatalogGraph::Requirement& requirement);

/// The lines above a picture of a state: "mission.yaml, after event 3 at 4.5 s", and the event.
[[nodiscard]] std::vector<std::string> caption_of(const Moment& moment);

/// The label of a line with a sign for its mark: "+ 90 %" if it is added or started, "− 90 %" if it
/// is removed or stopped, "~ 90 %" if it is changed.
[[nodiscard]] std::string with_sign(Mark mark, std::string label);

}  // namespace cbc::draw
