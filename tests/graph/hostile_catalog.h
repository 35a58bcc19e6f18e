// Random catalogs with names that mean something in one of the formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cbc::graph_test {

struct HostileCatalog {
  std::string text;                 // JSON, which is YAML
  std::vector<std::string> labels;  // that its tasks and behaviors should have
  std::size_t edges = 0;            // if exclusive tasks are drawn as pairs
};

[[nodiscard]] HostileCatalog hostile_catalog(std::uint64_t seed);

}  // namespace cbc::graph_test
