#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "page/table_page.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"

// A number is a bar from 0 to 100: what it may be without a change, where it is, and the values
// that repair expectations.

namespace cbc {
namespace {

/// A percent is a unit of the picture. A single value is seen, too.
std::string bar_of(const Interval& values, std::string_view look) {
  constexpr Millionths least_width = 2'000;
  return fmt::format(R"(<rect class="{}" x="{}" width="{}" height="8"/>)", look,
                     format_decimal(values.low, 4),
                     format_decimal(values.high - values.low + least_width, 4));
}

std::string picture_of(const TuneResult& result, std::size_t number) {
  const std::string value = format_decimal(result.numbers[number].value, 4);
  const Interval& same = result.tuned[number].tolerance.values;
  std::string svg = fmt::format(
      R"(<svg viewBox="-1 0 102 8" role="img" aria-label="{} in {}"><rect class="scale" width="100" height="8"/>)",
      value, describe(same));
  svg += bar_of(same, "same");
  for (const NumberRepair& repair : result.tuned[number].repairs.intervals) {
    svg += bar_of(repair.values, "repair");
  }
  return svg + fmt::format(R"(<circle class="value" cx="{}" cy="4" r="1.5"/></svg>)", value);
}

std::string row_of(const TuneResult& result, std::size_t number) {
  const TunableNumber& of = result.numbers[number];
  const Tolerance& tolerance = result.tuned[number].tolerance;
  std::string beyond;
  for (const auto& [label, difference] :
       {std::pair("below", &tolerance.below), std::pair("above", &tolerance.above)}) {
    if (!*difference) continue;
    beyond += fmt::format("<p>{}: {}</p>", label, xml_text(describe(result, **difference)));
  }
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      line_of(of), xml_text(describe(of, result.source)), format_decimal(of.value, 4),
      picture_of(result, number), describe(tolerance.values), beyond);
}

std::string failures_of(const TuneResult& result) {
  if (result.present.failures.empty()) return {};
  std::string html = "<h2>Expectations that fail</h2>\n<ul>\n";
  for (const auto& failure : result.present.failures) {
    html += fmt::format("<li>{}</li>\n", xml_text(describe(result, failure)));
  }
  html += fmt::format("</ul>\n<p>{}</p>\n", describe_repairs(result));
  if (nearest_repairs(result).empty()) return html;
  return html + repairs_table(result, plain_style()).html("repairs");
}

}  // namespace

std::string tune_to_html(const TuneResult& result) {
  std::string html = failures_of(result);
  if (result.states) {
    const PropertyFile& file = result.states->file;
    html +=
        fmt::format("<p>{}; {}, {}</p>\n",
                    xml_text(describe_assumptions(result.catalog, {file.assumptions, file.path})),
                    quantity(result.states->states, "state"),
                    quantity(result.states->decisions, "different decision"));
  }
  html += fmt::format(
      "<h2>Tolerances</h2>\n<p>The most fragile first. A bar is what the number may be while {}; "
      "the "
      "dot is its value{}.</p>\n",
      result.states ? "all events in all reachable states are decided as they are now"
                    : "all missions go as they do now",
      result.states ? "" : ", and values that repair expectations are framed");
  html +=
      "<table class=\"tune\">\n<tr><th scope=\"col\">line</th><th scope=\"col\">number</th><th "
      "scope=\"col\">value</th><th scope=\"col\">0 to 100</th><th scope=\"col\">the same from</th>"
      "<th scope=\"col\">beyond</th></tr>\n";
  for (const std::size_t number : fragile_first(result)) html += row_of(result, number);
  html += "</table>\n";
  for (const std::string& line : describe_unaffected(result)) {
    html += fmt::format("<p>{}</p>\n", xml_text(line));
  }
  return table_page("Numbers of " + result.source.file, html);
}

}  // namespace cbc
