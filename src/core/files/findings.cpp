#include "core/files/findings.h"

#include <cstddef>
#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/diagnostic/rules.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts) {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts) sources.add(file, *text);
  const Style style = style_for(stderr);
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.severity == Severity::error ||
        (++warnings[{finding.file, finding.rule}] <= most_warnings &&
         finding.rule != rule::deprecated_key.name)) {
      fmt::print(stderr, "{}", render(finding, sources, style));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (kind.second == rule::deprecated_key.name) {
      fmt::print(stderr, "{}: {}: {} {}; see 'cbc lint', or 'cbc lint --fix' [{}]\n",
                 printable(kind.first), style.paint(style.warning, "warning"),
                 quantity(count, "key"), count == 1 ? "has an older name" : "have older names",
                 kind.second);
      continue;
    }
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

}  // namespace cbc::cli
