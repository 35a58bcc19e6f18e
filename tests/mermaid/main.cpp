// Prints pictures for check.js, one on a line: {"name", "mermaid", "nodes", "edges", "labels"}.
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "graph/samples.h"

namespace {

void print(const std::vector<cbc::graph_test::Sample>& samples) {
  for (const auto& sample : samples) {
    const nlohmann::ordered_json line{{"name", sample.name},
                                      {"mermaid", sample.mermaid},
                                      {"nodes", sample.nodes},
                                      {"edges", sample.edges},
                                      {"labels", sample.labels}};
    fmt::print("{}\n", line.dump());
  }
}

}  // namespace

int main() {
  print(cbc::graph_test::samples_of_files());
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    print(cbc::graph_test::random_samples(seed));
    print(cbc::graph_test::random_diff_samples(seed));
  }
}
