#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/github.h"
#include "core/report/table_parts.h"
#include "core/report/wrap.h"
#include "core/support/wording.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

// Coverage as text, as a tracefile of LCOV and as annotations.

namespace cbc {
namespace {

/// `is_proved`: what is unreachable has a column.
std::string table_row(std::string_view what, const GoalCount& count, bool is_proved) {
  return fmt::format("  {:<14} {:>7} {:>7} {:>7} {:>9}{}\n", what, count.goals, count.met,
                     count.goals - count.met, describe_percent(count),
                     is_proved ? fmt::format(" {:>12}", count.unreachable) : std::string());
}

std::string place_of(const CatalogCoverage& coverage, const Goal& goal) {
  const std::string file = printable(coverage.catalog().file);
  return goal.lines.empty() ? file : fmt::format("{}:{}", file, goal.lines.front());
}

void add_list(const CatalogCoverage& coverage, std::string_view heading,
              bool (CatalogCoverage::*is_listed)(std::size_t) const, std::size_t columns,
              std::string& text) {
  bool is_empty = true;
  for (std::size_t goal = 0; goal < coverage.goals().size(); ++goal) {
    if (!(coverage.*is_listed)(goal)) continue;
    if (is_empty) text += "\n" + wrap_line(heading, columns, 2) + "\n";
    is_empty = false;
    const std::string line = fmt::format("  {}: {}", place_of(coverage, coverage.goals()[goal]),
                                         describe(coverage.catalog(), coverage.goals()[goal]));
    text += wrap_line(line, columns, 6) + "\n";
    if (coverage.is_unreachable(goal)) {
      text += wrap_line("    " + coverage.reason_of(goal), columns, 6) + "\n";
    }
  }
}

std::string catalog_to_text(const CatalogCoverage& coverage, const Style& style,
                            std::size_t columns) {
  std::string text = fmt::format("{}{}{}, {}\n", style.strong, printable(coverage.catalog().file),
                                 style.reset, quantity(coverage.missions().size(), "mission"));
  const bool is_proved = coverage.assumptions().has_value();
  if (is_proved) {
    text += assumptions_to_text(coverage.catalog(), *coverage.assumptions(), columns);
  }
  text += fmt::format("\n  {:<14} {:>7} {:>7} {:>7} {:>9}{}\n", "", "goals", "met", "missed",
                      "covered", is_proved ? "  unreachable" : "");
  const auto sections = coverage.by_section();
  for (std::size_t section = 0; section < goal_sections; ++section) {
    if (sections.at(section).goals + sections.at(section).unreachable == 0) continue;
    text += table_row(name_of(static_cast<GoalSection>(section)), sections.at(section), is_proved);
  }
  const GoalCount total = coverage.total();
  text += table_row("total", total, is_proved);
  add_list(coverage, "no mission shows that", &CatalogCoverage::is_missed, columns, text);
  add_list(coverage, "under these assumptions no mission can show, and so it does not count, that",
           &CatalogCoverage::is_unreachable, columns, text);
  return text;
}

/// The missions that meet one of the goals at least.
std::size_t count_missions(const CatalogCoverage& coverage,
                           const std::vector<std::uint32_t>& goals) {
  std::vector<bool> is_counted(coverage.missions().size(), false);
  for (const std::uint32_t goal : goals) {
    for (const std::uint32_t mission : coverage.missions_of(goal)) is_counted[mission] = true;
  }
  return static_cast<std::size_t>(std::count(is_counted.begin(), is_counted.end(), true));
}

std::string catalog_to_lcov(const CatalogCoverage& coverage) {
  const auto of_lines = coverage.goals_of_lines();
  std::string branches;
  std::string lines;
  GoalCount of_branches;
  GoalCount found;
  for (std::size_t line = 1; line < of_lines.size(); ++line) {
    std::vector<std::uint32_t> goals = of_lines[line];
    std::erase_if(goals, [&](std::uint32_t goal) { return coverage.is_unreachable(goal); });
    if (goals.empty()) continue;
    const std::size_t hits = count_missions(coverage, goals);
    lines += fmt::format("DA:{},{}\n", line, hits);
    found.add(hits > 0);
    if (goals.size() == 1) continue;
    for (std::size_t branch = 0; branch < goals.size(); ++branch) {
      const std::size_t taken = coverage.missions_of(goals[branch]).size();
      // A dash says that the line was never reached.
      branches +=
          fmt::format("BRDA:{},0,{},{}\n", line, branch, hits == 0 ? "-" : std::to_string(taken));
      of_branches.add(taken > 0);
    }
  }
  return fmt::format("TN:\nSF:{}\n{}BRF:{}\nBRH:{}\n{}LF:{}\nLH:{}\nend_of_record\n",
                     printable(coverage.catalog().file), branches, of_branches.goals,
                     of_branches.met, lines, found.goals, found.met);
}

}  // namespace

std::string coverage_to_text(const Coverage& coverage, const Style& style, std::size_t columns) {
  std::string text;
  for (const CatalogCoverage& catalog : coverage.catalogs) {
    if (!text.empty()) text += '\n';
    text += catalog_to_text(catalog, style, columns);
  }
  if (coverage.catalogs.size() > 1) {
    const GoalCount total = coverage.total();
    text += fmt::format("\nall catalogs: {} of {} goals, {}\n", total.met, total.goals,
                        describe_percent(total));
  }
  return text;
}

std::string coverage_to_lcov(const Coverage& coverage) {
  std::string text;
  for (const CatalogCoverage& catalog : coverage.catalogs) text += catalog_to_lcov(catalog);
  return text;
}

std::string coverage_to_github(const Coverage& coverage) {
  std::string text;
  for (const CatalogCoverage& catalog : coverage.catalogs) {
    const auto of_lines = catalog.goals_of_lines();
    for (std::uint32_t line = 1; line < of_lines.size(); ++line) {
      std::string missed;
      for (const std::uint32_t goal : of_lines[line]) {
        if (!catalog.is_missed(goal)) continue;
        if (!missed.empty()) missed += '\n';
        missed += describe(catalog.catalog(), catalog.goals()[goal]);
      }
      if (missed.empty()) continue;
      const Position begin{line, 1};
      text += github_command("notice", {std::string(catalog.catalog().file), Range{begin, begin}},
                             "No mission shows that", missed);
    }
  }
  return text;
}

std::span<const CoverageFormat> coverage_formats() {
  using Given = const Coverage&;
  static constexpr CoverageFormat formats[] = {
      {"text", coverage_to_text},
      {"json", [](Given coverage, const Style& /*style*/,
                  std::size_t /*columns*/) { return coverage_to_json(coverage); }},
      {"html", [](Given coverage, const Style& /*style*/,
                  std::size_t /*columns*/) { return coverage_to_html(coverage); }},
      {"lcov", [](Given coverage, const Style& /*style*/,
                  std::size_t /*columns*/) { return coverage_to_lcov(coverage); }},
      {"github", [](Given coverage, const Style& /*style*/,
                    std::size_t /*columns*/) { return coverage_to_github(coverage); }},
  };
  return formats;
}

}  // namespace cbc
