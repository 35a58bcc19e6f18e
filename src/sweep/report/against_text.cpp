#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "core/report/blocks.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "sweep/engine/against.h"
#include "sweep/report/sweep_report.h"

namespace cbc {
namespace {

void add_differences(const SweptComparison& comparison, const std::string& new_catalog,
                     Blocks& text) {
  constexpr std::size_t most_shown = 20;
  text.line("");
  Table table(text.style(), {number_column("sequences", 9, 0),
                             number_column("after events", 14, 0),
                             {"with " + printable(new_catalog)}});
  const std::size_t shown = std::min(comparison.differences.size(), most_shown);
  for (std::size_t place = 0; place < shown; ++place) {
    const SweptDifference& difference = comparison.differences[place];
    table.add({difference.sequences, difference.events, difference.line});
  }
  text.table(table);
  if (comparison.differences.size() > shown) {
    text.line("  and {} more", comparison.differences.size() - shown);
  }
  text.line("");
  text.line("after events: the length of the shortest script that shows it (--scripts DIR)");
}

}  // namespace

void add_against(const SweepResult& result, Blocks& text) {
  const SweptComparison& comparison = *result.against;
  const Style& style = text.style();
  text.line("{}: {}",
            style.paint(style.strong, fmt::format("{} against {}", printable(result.catalog),
                                                  printable(comparison.old_catalog))),
            describe(result.settings));
  comparison.names.add_to(text, printable(comparison.old_catalog), printable(result.catalog));
  const auto add = [&](std::string_view color, std::string_view words, const std::string& more) {
    text.line("  {}{}", style.paint(color, words), more);
  };
  if (comparison.sequences > 0) {
    add(style.bad, "decided differently",
        fmt::format(" in {} of {}", comparison.sequences,
                    quantity(result.settings.sequences, "sequence")));
    add_differences(comparison, result.catalog, text);
  } else if (comparison.events == 0) {
    add(style.bad, "nothing was compared", ": no start, stop or finish comes in both");
  } else {
    add(style.good, "all were decided alike",
        fmt::format(": {} starts, stops and finishes", comparison.events));
  }
}

}  // namespace cbc
