#include "cli/findings.h"

#include <cstddef>
#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/terminal.h"
#include "diagnostic/text.h"
#include "text/quote.h"

namespace cbc::cli {

void print_findings(const std::vector<Diagnostic>& findings,
                    const std::map<std::string, std::string>& texts) {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts) sources.add(file, text);
  const Style style = style_for(stderr);
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.severity == Severity::error ||
        ++warnings[{finding.file, finding.rule}] <= most_warnings) {
      fmt::print(stderr, "{}", render(finding, sources, style));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

}  // namespace cbc::cli
