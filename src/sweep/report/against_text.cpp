#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/layout.h"
#include "runtime/base/text.h"
#include "sweep/engine/against.h"
#include "sweep/report/sweep_report.h"

namespace cbc {
namespace {

void add_names(const SweepResult& result, Text& text) {
  const CatalogNames& names = result.against->names;
  const auto add = [&](const std::string& label, const std::vector<std::string>& of_label) {
    const Table table(text.style(), {{{}, {}, width_of(label)}, {}},
                      {.columns = text_width, .breaks = Breaks::after_commas});
    if (!of_label.empty()) text.add(table.line({label, join(of_label, ", ")}));
  };
  add("renamed", names.renamed);
  add("only " + printable(result.against->old_catalog) + " has", names.only_old);
  add("only " + printable(result.catalog) + " has", names.only_new);
}

void add_differences(const SweptComparison& comparison, const std::string& new_catalog,
                     Text& text) {
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
  text.add(table.text());
  if (comparison.differences.size() > shown) {
    text.line("  and {} more", comparison.differences.size() - shown);
  }
  text.line("");
  text.line("after events: the length of the shortest script that shows it (--scripts DIR)");
}

}  // namespace

std::string against_to_text(const SweepResult& result, const Style& style) {
  const SweptComparison& comparison = *result.against;
  Text text(style);
  text.line("{}: {}",
            style.paint(style.strong, fmt::format("{} against {}", printable(result.catalog),
                                                  printable(comparison.old_catalog))),
            describe(result.settings));
  add_names(result, text);
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
  return text.take();
}

}  // namespace cbc
