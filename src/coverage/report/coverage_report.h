#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/report/table.h"
#include "coverage/engine/coverage.h"

// The reports of `cbc coverage`.

namespace cbc {

/// The goals of each section, met and missed.
[[nodiscard]] Table counts_table(const CatalogCoverage& coverage, const Style& style);

/// A table of the goals of each section, and a list of those that are not met. `columns`: of the
/// terminal, see wrap_line.
[[nodiscard]] std::string coverage_to_text(const Coverage& coverage, const Style& style,
                                           std::size_t columns = 0);

[[nodiscard]] std::string coverage_to_json(const Coverage& coverage);
[[nodiscard]] std::string coverage_schema();

/// A page with the lines of the catalogs, marked as covered, partly covered or not.
[[nodiscard]] std::string coverage_to_html(const Coverage& coverage);

/// A tracefile of LCOV: a line counts the missions that meet one of its goals at least, and its
/// goals are its branches.
[[nodiscard]] std::string coverage_to_lcov(const Coverage& coverage);

/// Workflow commands of GitHub Actions: one for each line with goals that are not met.
[[nodiscard]] std::string coverage_to_github(const Coverage& coverage);

/// Adds the missions of a JSON report on the same catalog. Returns why it cannot, for people, or
/// nothing. Whatever the text, the coverage may be reported.
[[nodiscard]] std::string add_coverage_json(std::string_view text, CatalogCoverage& coverage);

struct CoverageFormat {
  std::string_view name;
  std::string (*write)(const Coverage& coverage, const Style& style, std::size_t columns);
};

/// The first one is the default.
[[nodiscard]] std::span<const CoverageFormat> coverage_formats();

}  // namespace cbc
