#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "coverage/report/coverage_report.h"
#include "explore/properties/explore.h"
#include "page_files.h"

// The page needs no script: what a line shows on demand is in elements that unfold.

namespace cbc {
namespace {

class CatalogPage {
 public:
  explicit CatalogPage(const CatalogCoverage& coverage)
      : coverage_(coverage), of_lines_(coverage.goals_of_lines()) {}

  std::string write() {
    html_ = fmt::format("<section>\n<h2>{}</h2>\n", xml_text(coverage_.catalog().file));
    if (coverage_.assumptions()) {
      html_ += fmt::format("<p>{}</p>\n", xml_text(describe_assumptions(coverage_.catalog(),
                                                                        *coverage_.assumptions())));
    }
    html_ += counts_table(coverage_, plain_style()).html("counts");
    if (!coverage_.is_proved()) html_ += fmt::format("<p>{}</p>\n", incomplete_proof);
    write_missions();
    write_source();
    return html_ + "</section>\n";
  }

 private:
  void write_missions() {
    html_ += fmt::format("<details><summary>{}</summary><ul>\n",
                         quantity(coverage_.missions().size(), "mission"));
    for (const std::string& mission : coverage_.missions()) {
      html_ += fmt::format("<li>{}</li>\n", xml_text(mission));
    }
    html_ += "</ul></details>\n";
  }

  void write_source() {
    html_ += "<table class=\"source\">\n";
    const std::string_view text = coverage_.text();
    std::size_t begin = 0;
    for (std::size_t line = 1; begin < text.size(); ++line) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      write_line(line, text.substr(begin, end - begin));
      begin = end + 1;
    }
    html_ += "</table>\n";
  }

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
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src {}; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<title>Coverage {}</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>Coverage: {} of {} goals, {}</h1>\n"
      "<p>A line is <span class=\"met\">covered</span> if missions meet all of its goals, "
      "<span class=\"part\">partly covered</span> if they meet some, and "
      "<span class=\"missed\">not covered</span> if they meet none. Open a line for its "
      "goals.</p>\n",
      coverage_style_hash, describe_percent(total), coverage_style, total.met, total.goals,
      describe_percent(total));
  for (const CatalogCoverage& catalog : coverage.catalogs) html += CatalogPage(catalog).write();
  return html + "</body>\n</html>\n";
}

}  // namespace cbc
