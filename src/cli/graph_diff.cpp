#include "cli/graph_diff.h"

#include <fmt/format.h>

#include "cli/catalog_loader.h"
#include "cli/input.h"
#include "cli/input_files.h"
#include "draw/diff_graph.h"

namespace cbc::cli {

std::unique_ptr<const ComparedCatalogs> read_and_compare(const std::string& before,
                                                         const std::string& after) {
  auto compared = std::make_unique<ComparedCatalogs>();
  InputFiles files;
  CatalogLoader loader(files);
  compared->before = loader.load(before);
  compared->after = loader.load(after);
  files.print_findings();
  if (compared->before == nullptr || compared->after == nullptr) return nullptr;
  compared->diff = compare_catalogs(*compared->before, *compared->after);
  compared->graph = draw::to_graph(*compared->before, *compared->after, compared->diff);
  return compared;
}

}  // namespace cbc::cli
