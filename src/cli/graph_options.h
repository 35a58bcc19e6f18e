#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "draw/catalog_graph.h"
#include "draw/part.h"
#include "draw/view.h"

namespace CLI {
class App;
}

namespace cbc::cli {

/// What `cbc graph` draws of a catalog, and how.
struct DrawingOptions {
  std::string view;
  std::string exclusivity;
  std::string cluster;
  bool reduce = false;
  bool legend = false;
  std::vector<std::string> tasks;
  bool up = false;
  bool down = false;
  std::optional<std::uint32_t> depth;
  std::optional<std::uint32_t> group;

  [[nodiscard]] bool operator==(const DrawingOptions&) const = default;
};

void add_drawing_options(CLI::App& command, DrawingOptions& options);

/// What is wrong with the combination of options; empty if nothing is.
[[nodiscard]] std::string find_misuse(const DrawingOptions& options);

[[nodiscard]] draw::ViewOptions view_options(const DrawingOptions& options);

/// The part of the catalog that is drawn. Empty if it has no such tasks or group, which is
/// complained of.
[[nodiscard]] std::optional<draw::Part> find_part(const draw::CatalogGraph& graph,
                                                  const DrawingOptions& options);

}  // namespace cbc::cli
