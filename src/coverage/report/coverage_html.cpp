#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "coverage/report/coverage_report.h"
#include "page/table_page.h"

// The page needs no script: what a line shows on demand is in elements that unfold.

namespace cbc {
namespace {

/// The text of a catalog, with the goals of each line.
class SourceTable {
 public:
  explicit SourceTable(const CatalogCoverage& coverage)
      : coverage_(coverage), of_lines_(coverage.goals_of_lines()) {}

  std::string write() && {
    html_ = "<table class=\"source\">\n";
    const std::string_view text = coverage_.text();
    std::size_t begin = 0;
    for (std::size_t line = 1; begin < text.size(); ++line) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      write_line(line, text.substr(begin, end - begin));
      begin = end + 1;
    }
    return html_ + "</table>\n";
  }

 private:
  void write_line(std::size_t line, std::string_view text) {
    const std::vector<std::uint32_t>& goals = of_lines_.at(line);
    GoalCount count;
    for (const std::uint32_t goal : goals) {
      count.add(coverage_.is_met(goal), coverage_.is_unreachable(goal));
    }
    const std::string_view kind = count.goals == 0           ? ""
                                  : count.met == count.goals ? "met"
                                  : count.met == 0           ? "missed"
                                                             : "part";
    html_ +=
        fmt::format(R"(<tr id="L{0}" class="{1}"><td class="number">{0}</td><td>)", line, kind);
    const std::string source = "<code>" + xml_text(text) + "</code>";
    if (goals.empty()) {
      html_ += source + "</td><td class=\"count\"></td></tr>\n";
      return;
    }
    html_ += fmt::format("<details><summary>{}</summary><ul>\n", source);
    for (const std::uint32_t goal : goals) write_goal(goal);
    html_ += fmt::format("</ul></details></td><td class=\"count\">{} of {}</td></tr>\n", count.met,
                         count.goals);
  }

  void write_goal(std::uint32_t goal) {
    const std::string what = xml_text(describe(coverage_.catalog(), coverage_.goals()[goal]));
    if (coverage_.is_unreachable(goal)) {
      html_ += fmt::format("<li class=\"by\">impossible: {} ({})</li>\n", what,
                           xml_text(coverage_.reason_of(goal)));
      return;
    }
    if (!coverage_.is_met(goal)) {
      html_ += fmt::format("<li class=\"missed\">missed: {}</li>\n", what);
      return;
    }
    const auto name = [&](std::uint32_t mission) {
      return xml_text(coverage_.missions()[mission]);
    };
    const std::string by = join(coverage_.missions_of(goal), ", ", name);
    html_ += fmt::format("<li>{} <span class=\"by\">({})</span></li>\n", what, by);
  }

  const CatalogCoverage& coverage_;
  const std::vector<std::vector<std::uint32_t>> of_lines_;
  std::string html_;
};

}  // namespace

std::string coverage_to_html(const Coverage& coverage) {
  const GoalCount total = coverage.total();
  TablePage page;
  page.add(
      "<p>A line is <span class=\"met\">covered</span> if missions meet all of its goals, "
      "<span class=\"part\">partly covered</span> if they meet some, and "
      "<span class=\"missed\">not covered</span> if they meet none. Open a line for its "
      "goals.</p>\n");
  for (const CatalogCoverage& catalog : coverage.catalogs) {
    add_counts(catalog, page);
    page.add("<details><summary>missions</summary><ul>\n");
    for (const std::string& mission : catalog.missions()) {
      page.add(fmt::format("<li>{}</li>\n", xml_text(mission)));
    }
    page.add("</ul></details>\n" + SourceTable(catalog).write());
  }
  return page.page(
      fmt::format("Coverage: {} of {} goals, {}", total.met, total.goals, describe_percent(total)));
}

}  // namespace cbc
