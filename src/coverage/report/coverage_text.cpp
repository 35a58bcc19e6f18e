#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/blocks.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "coverage/engine/first_goals.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

// Coverage, and what is missing of it, as text; coverage as a tracefile of LCOV and as annotations.

namespace cbc {
namespace {

std::string place_of(const CatalogCoverage& coverage, const Goal& goal) {
  const std::string file = printable(coverage.catalog().file);
  return goal.lines.empty() ? file : fmt::format("{}:{}", file, goal.lines.front());
}

void add_list(const CatalogCoverage& coverage, std::string_view heading,
              bool (CatalogCoverage::*is_listed)(std::size_t) const, Text& text) {
  bool is_empty = true;
  for (std::size_t goal = 0; goal < coverage.goals().size(); ++goal) {
    if (!(coverage.*is_listed)(goal)) continue;
    if (is_empty) text.line("");
    if (is_empty) text.line(heading);
    is_empty = false;
    text.line("  {}: {}", place_of(coverage, coverage.goals()[goal]),
              describe(coverage.catalog(), coverage.goals()[goal]));
    if (coverage.is_unreachable(goal)) text.line("    " + coverage.reason_of(goal));
  }
}

/// Whether many goals are missed.
bool is_long(const CatalogCoverage& coverage) {
  constexpr std::size_t few_goals = 30;
  const GoalCount total = coverage.total();
  return total.goals - total.met > few_goals;
}

/// Where long lists of missed goals begin.
void add_first_goals(const CatalogCoverage& coverage, Text& text) {
  constexpr std::size_t shown = 10;
  if (!is_long(coverage)) return;
  text.line("");
  text.line("begin with these, which guard the most: no mission shows that");
  for (const std::uint32_t goal : first_goals(coverage, shown)) {
    text.line("  {}: {}", place_of(coverage, coverage.goals()[goal]),
              describe(coverage.catalog(), coverage.goals()[goal]));
  }
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

/// The goals of each section, met and missed.
Table counts_table(const CatalogCoverage& coverage, const Style& style) {
  const bool is_proved = coverage.assumptions().has_value();
  std::vector<Table::Column> columns = {{{}, {}, 14},
                                        number_column("goals", 7, 1),
                                        number_column("met", 7, 1),
                                        number_column("missed", 7, 1),
                                        number_column("covered", 9, 1)};
  if (is_proved) columns.push_back(number_column("unreachable", 12, 1));
  Table table(style, std::move(columns));
  const auto add = [&](std::string_view what, const GoalCount& count) {
    Table::Row row = {what, count.goals, count.met, count.goals - count.met,
                      describe_percent(count)};
    if (is_proved) row.emplace_back(count.unreachable);
    table.add(std::move(row));
  };
  const auto sections = coverage.by_section();
  for (std::size_t section = 0; section < goal_sections; ++section) {
    const GoalCount& count = sections.at(section);
    if (count.goals + count.unreachable > 0) add(name_of(static_cast<GoalSection>(section)), count);
  }
  add("total", coverage.total());
  return table;
}

}  // namespace

void add_counts(const CatalogCoverage& coverage, Blocks& report) {
  report.heading(fmt::format("{}, {}", printable(coverage.catalog().file),
                             quantity(coverage.missions().size(), "mission")));
  if (coverage.assumptions()) {
    report.paragraph(describe_assumptions(coverage.catalog(), *coverage.assumptions()));
  }
  report.line("");
  report.table(counts_table(coverage, report.style()), "counts");
  if (coverage.is_proved()) return;
  report.line("");
  report.line(
      "incomplete: a limit or an interrupt ended the proof, and goals that nothing is proven of "
      "may "
      "be impossible");
}

namespace {

void add_coverage(const Coverage& coverage, Text& text) {
  for (const CatalogCoverage& catalog : coverage.catalogs) {
    add_counts(catalog, text);
    add_first_goals(catalog, text);
    add_list(catalog, is_long(catalog) ? "all that no mission shows" : "no mission shows that",
             &CatalogCoverage::is_missed, text);
    add_list(catalog, "under these assumptions no mission can show, and so it does not count, that",
             &CatalogCoverage::is_unreachable, text);
  }
  if (coverage.catalogs.size() > 1) {
    const GoalCount total = coverage.total();
    text.line("");
    text.line("all catalogs: {} of {} goals, {}", total.met, total.goals, describe_percent(total));
  }
}

std::string coverage_to_lcov(const Coverage& coverage) {
  std::string text;
  for (const CatalogCoverage& catalog : coverage.catalogs) text += catalog_to_lcov(catalog);
  return text;
}

/// Of each line that has some.
std::vector<Diagnostic> missed_goals(const Coverage& coverage) {
  std::vector<Diagnostic> findings;
  for (const CatalogCoverage& of : coverage.catalogs) {
    const auto of_lines = of.goals_of_lines();
    for (std::uint32_t line = 1; line < of_lines.size(); ++line) {
      for (const std::uint32_t goal : of_lines[line]) {
        if (!of.is_missed(goal)) continue;
        findings.push_back(notice_of_line(of.catalog().file, line,
                                          "coverage: no mission shows that",
                                          describe(of.catalog(), of.goals()[goal])));
      }
    }
  }
  return findings;
}

}  // namespace

std::span<const ReportFormat<Coverage>> coverage_formats() {
  static constexpr ReportFormat<Coverage> formats[] = {
      {"text", as_text<add_coverage>},          {"json", for_programs<coverage_to_json>},
      {"html", for_programs<coverage_to_html>}, {"lcov", for_programs<coverage_to_lcov>},
      {"github", as_annotations<missed_goals>},
  };
  return formats;
}

namespace {

void list_goals(const WrittenMissions& tests, const char* heading,
                const std::vector<MissingMissions::Unmet>& goals, Text& text) {
  if (goals.empty()) return;
  text.line("");
  text.line(heading);
  for (const MissingMissions::Unmet& goal : goals) {
    text.line("  " + describe(*tests.catalog, tests.goals[goal.goal]));
    text.line("    " + goal.reason);
  }
}

std::string count_tests(const MissingMissions& missing) {
  if (missing.missions.empty()) {
    return missing.unmet.empty() && missing.is_complete() ? "nothing is missing"
                                                          : "no test was found";
  }
  std::uint64_t events = 0;
  for (const MissingMissions::Mission& mission : missing.missions) events += mission.events;
  std::string line = fmt::format("{} with {}", quantity(missing.missions.size(), "test"),
                                 quantity(events, "event"));
  if (missing.lower_bound) {
    const std::uint64_t least = *missing.lower_bound;
    line += fmt::format("; at least {} needed, with at most {} each",
                        least == 1 ? "one is" : fmt::format("{} are", least),
                        quantity(missing.most_events, "event"));
  }
  return line;
}

}  // namespace

std::string written_missions_to_text(const WrittenMissions& tests, std::size_t columns) {
  const MissingMissions& missing = *tests.missing;
  Text text(plain_style(), columns);
  std::string beside;
  if (tests.missions) {
    beside =
        " beside " + (*tests.missions == 0 ? "no mission" : quantity(*tests.missions, "mission"));
  }
  text.line(printable(tests.catalog->file) + beside);
  text.paragraph(describe_assumptions(*tests.catalog, tests.assumptions));
  text.line("");
  std::uint64_t met = 0;
  for (const MissingMissions::Mission& mission : missing.missions) met += mission.goals.size();
  Table counts(text.style(), {{{}, {}, 18}, number_column({}, 8, 0)});
  counts.add({"goals", tests.goals.size()});
  counts.add({"met before", tests.goals.size() - missing.wanted});
  counts.add({"unreachable", missing.unreachable.size()});
  counts.add({"met by tests", met});
  counts.add({"not met", missing.unmet.size()});
  text.table(counts);
  text.line("");
  text.line(count_tests(missing));
  Table files(text.style(), {{}, {}});
  for (std::size_t place = 0; place < tests.paths.size(); ++place) {
    const MissingMissions::Mission& mission = missing.missions[place];
    files.add({printable(tests.paths[place]),
               quantity(mission.events, "event") + "  " + quantity(mission.goals.size(), "goal")});
  }
  text.table(files);
  if (!tests.incomplete.empty()) {
    text.line("");
    text.line("incomplete: " + tests.incomplete);
  }
  for (const GroupId group : missing.partial) {
    if (group >= missing.unexplored) continue;
    text.line("");
    text.line("a limit ended the exploration of group {}: what it has beyond is not known", group);
  }
  if (missing.unexplored < tests.catalog->group_count()) {
    const std::size_t left = tests.catalog->group_count() - missing.unexplored;
    text.line("");
    text.line("{} {} not explored", quantity(left, "group"), left == 1 ? "was" : "were");
  }
  list_goals(tests, "no test shows that", missing.unmet, text);
  list_goals(tests, "under these assumptions no test can show that", missing.unreachable, text);
  if (!tests.next.empty()) {
    text.line("");
    text.line("changes of the catalog that all of these leave unnoticed, with a test for each:");
    // The command is for a shell, and stays on one line.
    text.add("  " + tests.next + "\n");
  }
  return text.take();
}

}  // namespace cbc
