#pragma once

#include <string>

#include "draw/catalog_graph.h"

namespace cbc::draw {

/// What stands at a line: the suitability, unless it is 100 %; the minimum performance. Of two
/// catalogs, what has changed.
[[nodiscard]] std::string label_of(const CatalogGraph::Performance& performance);
[[nodiscard]] std::string label_of(const CatalogGraph::Requirement& requirement);

/// The label of a line with a sign for its mark: "+ 90 %", "− 90 %", "~ 90 %" if it is added,
/// removed, changed.
[[nodiscard]] std::string with_sign(Mark mark, std::string label);

}  // namespace cbc::draw
