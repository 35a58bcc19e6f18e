#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/catalog/renaming.h"
#include "core/diagnostic/diagnostic.h"
#include "versions/lockstep/same_as.h"

namespace cbc::cli {

/// A file that was changed, or would be.
struct RenamedFile {
  std::string name;
  std::size_t places = 0;
};

/// What was found out about one catalog.
struct ReportedProof {
  std::string catalog;
  CatalogComparison comparison;
  std::uint64_t max_states = 0;
};

/// A line for each file, and one for all. `is_done`: they have been changed.
[[nodiscard]] std::string renamed_files_text(const Renaming& renaming,
                                             const std::vector<RenamedFile>& files, bool is_done);

/// Whether the catalog decides as before, in one line.
[[nodiscard]] std::string proof_text(const ReportedProof& proof, const Style& style);

}  // namespace cbc::cli
