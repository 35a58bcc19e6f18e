// Pictures of catalogs, with what somebody who reads them has to find in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cbc::graph_test {

struct Sample {
  std::string name;  // of the catalog, and how it is drawn
  std::string dot;
  std::string mermaid;
  std::size_t nodes = 0;  // those of the legend and of exclusivity lists included
  std::size_t edges = 0;
  std::vector<std::string> labels;  // of all tasks and behaviors, sorted; empty: not known
  std::string caption;              // of a state: its lines together
};

// All catalogs of the repository, and of the folder in CBC_SHARED (default: ../shared of the
// repository) if it is there; good and bad ones, in every view; of good ones a state, too.
[[nodiscard]] std::vector<Sample> samples_of_files();

// A random catalog with names that are meant to break things; half of them have errors.
[[nodiscard]] std::vector<Sample> random_samples(std::uint64_t seed);

// What changes in such a catalog, there and back; nothing if it has errors.
[[nodiscard]] std::vector<Sample> random_diff_samples(std::uint64_t seed);

}  // namespace cbc::graph_test
