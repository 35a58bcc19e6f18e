// The report for people, as text and as a page, and the tests for CI.

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/report/blocks.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "page/table_page.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"

namespace cbc {
namespace {

/// Its line; "-" if it stands nowhere.
std::string line_of(const TunableNumber& number) {
  return number.range ? std::to_string(number.line()) : "-";
}

/// "85.0001 to 100"
std::string describe(const Interval& values) {
  const std::string low = format_decimal(values.low, 4);
  return values.low == values.high ? low : low + " to " + format_decimal(values.high, 4);
}

std::string lines_of(const std::vector<std::uint32_t>& lines) {
  return join(lines, ", ", [](std::uint32_t line) { return std::to_string(line); });
}

/// "the numbers in lines 6, 12"; line 0 stands for the default that is written nowhere.
std::string numbers_in(const std::vector<std::uint32_t>& lines) {
  if (lines == std::vector<std::uint32_t>{0}) return "the default suitability";
  if (lines.back() == 0) {
    return numbers_in({lines.begin(), lines.end() - 1}) + " and the default suitability";
  }
  return (lines.size() == 1 ? "the number in line " : "the numbers in lines ") + lines_of(lines);
}

/// "mission.yaml:3, 8; other.yaml:12": what a repair changes.
std::string describe_changed(const TuneResult& result, const NumberRepair& repair) {
  std::vector<std::string> parts;
  for (std::size_t mission = 0; mission < repair.changed.size(); ++mission) {
    if (repair.changed[mission].empty()) continue;
    parts.push_back(fmt::format("{}:{}", printable(result.missions[mission]),
                                lines_of(repair.changed[mission])));
  }
  return join(parts, "; ");
}

/// Whether there are repairs, and whether that is all.
std::string describe_repairs(const TuneResult& result) {
  if (!nearest_repairs(result).empty()) {
    return "each of these numbers alone makes all expectations hold";
  }
  const bool is_complete =
      std::all_of(result.tuned.begin(), result.tuned.end(),
                  [](const TunedNumber& one) { return one.repairs.is_complete; });
  return is_complete ? "no number alone makes all expectations hold, whatever its value"
                     : "none was found, but the numbers were not searched to the end";
}

/// Of each number with repairs, with what else they change.
Table repairs_table(const TuneResult& result, const Blocks& report) {
  Table table(report.style(),
              {number_column("line", 4),
               {"number"},
               number_column("value"),
               number_column("nearest"),
               {"of"},
               {"changes"}},
              {.columns = report.columns()});
  for (const auto& [number, repair, change] : nearest_repairs(result)) {
    const TunableNumber& of = result.numbers[number];
    table.add({line_of(of),
               describe(of, result.source),
               format_decimal(of.value, 4),
               {format_decimal(repair->nearest, 4), report.style().good},
               join(result.tuned[number].repairs.intervals, "; ",
                    [](const NumberRepair& one) { return describe(one.values); }),
               describe_changed(result, *repair)});
  }
  return table;
}

/// The numbers that may have any value, and those that nothing has or no decision uses.
std::vector<std::string> describe_unaffected(const TuneResult& result) {
  std::size_t unaffected = 0;
  std::vector<std::uint32_t> unused;
  std::vector<std::uint32_t> undecisive;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const TunableNumber& of = result.numbers[number];
    if (of.uses.empty()) {
      unused.push_back(of.line());
    } else if (!result.tuned[number].is_used) {
      undecisive.push_back(of.line());
    } else if (!result.tuned[number].tolerance.distance(of.value)) {
      ++unaffected;
    }
  }
  std::vector<std::string> lines;
  if (unaffected > 0) {
    lines.push_back(
        fmt::format("{} may have any value from 0 to 100", quantity(unaffected, "number")));
  }
  if (!unused.empty()) lines.push_back("nothing has " + numbers_in(unused));
  if (!undecisive.empty()) {
    lines.push_back("no decision of any state uses " + numbers_in(undecisive));
  }
  return lines;
}

/// The numbers with a bound, the most fragile first.
std::vector<std::size_t> fragile_first(const TuneResult& result) {
  std::vector<std::pair<Millionths, std::size_t>> found;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const auto distance = result.tuned[number].tolerance.distance(result.numbers[number].value);
    if (distance) found.emplace_back(*distance, number);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> numbers;
  numbers.reserve(found.size());
  for (const auto& [distance, number] : found) numbers.push_back(number);
  return numbers;
}

void add_repairs(const TuneResult& result, Blocks& report) {
  if (result.present.failures.empty()) return;
  report.line("");
  for (const auto& failure : result.present.failures) {
    report.painted(report.style().bad, std::string_view(describe(result, failure)));
  }
  report.title(describe_repairs(result));
  if (!nearest_repairs(result).empty()) report.table(repairs_table(result, report));
}

/// The nearer a bound, the louder.
std::string_view color_of(const TuneResult& result, std::size_t number, const Style& style) {
  constexpr Millionths near = 10'000;
  constexpr Millionths rather_near = 50'000;
  const Millionths distance =
      *result.tuned[number].tolerance.distance(result.numbers[number].value);
  if (result.is_fragile(number) || distance < near) return style.bad;
  return distance < rather_near ? style.warning : std::string_view();
}

/// A percent is a unit of the picture. A single value is seen, too.
std::string bar_of(const Interval& values, std::string_view look) {
  constexpr Millionths least_width = 2'000;
  return fmt::format(R"(<rect class="{}" x="{}" width="{}" height="8"/>)", look,
                     format_decimal(values.low, 4),
                     format_decimal(values.high - values.low + least_width, 4));
}

/// A number as a bar from 0 to 100: what it may be without a change, where it is, and the values
/// that repair expectations.
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

Table tolerances_table(const TuneResult& result, const Blocks& report) {
  Table table(report.style(),
              {number_column("line", 4),
               {"number", {}, 6},
               number_column("value", 8),
               {.title = "0 to 100", .is_picture = true},
               {"the same from"},
               {}},
              {.columns = report.columns(), .column = 1});
  table.set_caption(
      fmt::format("A bar is what the number may be while {}; the dot is its value{}.",
                  result.states ? "all events in all reachable states are decided as they are now"
                                : "all missions go as they do now",
                  result.states ? "" : ", and values that repair expectations are framed"));
  for (const std::size_t number : fragile_first(result)) {
    const TunableNumber& of = result.numbers[number];
    const Tolerance& tolerance = result.tuned[number].tolerance;
    table.add({line_of(of), describe(of, result.source), format_decimal(of.value, 4),
               picture_of(result, number), describe(tolerance.values)},
              color_of(result, number, report.style()));
    for (const auto& [label, beyond] :
         {std::pair("below", &tolerance.below), std::pair("above", &tolerance.above)}) {
      if (*beyond) table.add_note(fmt::format("{}: {}", label, describe(result, **beyond)));
    }
  }
  return table;
}

void add_numbers(const TuneResult& result, Blocks& report) {
  const Recording& present = result.present;
  report.heading(fmt::format(
      "{}: {}, {}, {}", printable(result.source.file), quantity(result.numbers.size(), "number"),
      result.states ? quantity(result.states->states, "state")
                    : quantity(result.missions.size(), "mission"),
      quantity(result.states ? result.states->decisions : present.decisions.size(),
               "different decision")));
  if (result.states) {
    const PropertyFile& file = result.states->file;
    report.paragraph(describe_assumptions(result.catalog, {file.assumptions, file.path}));
  }
  add_repairs(result, report);
  report.title("tolerances, the most fragile first");
  if (!fragile_first(result).empty()) report.table(tolerances_table(result, report), "tune");
  for (const std::string& line : describe_unaffected(result)) report.line("  {}", line);
  if (result.states) return;
  report.line("");
  report.painted(present.failures.empty() ? report.style().good : report.style().bad,
                 "expectations: {} passed, {} failed", present.passed, present.failures.size());
}

/// A suite for each mission with expectations that fail, and one for the numbers.
std::string tune_to_junit(const TuneResult& result) {
  std::vector<TestSuite> suites;
  for (std::size_t mission = 0; mission < result.missions.size(); ++mission) {
    suites.push_back({result.missions[mission], result.source.file, {}});
  }
  for (const auto& failure : result.present.failures) {
    const FailedExpectation& of = failure.expectation;
    TestSuite& suite = suites[failure.mission];
    suite.cases.push_back({fmt::format("line {}", of.range.begin.line)});
    suite.cases.back().fail(
        {"expectation failed", Severity::error, suite.file, of.range, of.message, {}});
  }
  for (TestSuite& suite : suites) {
    if (suite.cases.empty()) suite.cases.push_back({"expectations hold"});
  }
  TestSuite& numbers = suites.emplace_back(TestSuite{result.source.file});
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const TunableNumber& of = result.numbers[number];
    const Tolerance& tolerance = result.tuned[number].tolerance;
    TestCase& test = numbers.cases.emplace_back();
    test.name = fmt::format("line {}: {}", line_of(of), describe(of, result.source));
    if (!result.is_fragile(number)) continue;
    std::string message =
        fmt::format("{} may be {}, less than {} away from a bound", format_decimal(of.value, 4),
                    describe(tolerance.values), format_decimal(*result.fail_under, 4));
    for (const auto* const beyond : {&tolerance.below, &tolerance.above}) {
      if (*beyond) message += "\n" + describe(result, **beyond);
    }
    test.fail(
        {"tolerance", Severity::error, numbers.file, of.range.value_or(whole_file), message, {}});
  }
  return tests_to_text(junit_format, "cbc tune", suites);
}

}  // namespace

std::string tune_to_html(const TuneResult& result) {
  TablePage page;
  add_numbers(result, page);
  return page.page("Numbers of " + result.source.file);
}

std::span<const ReportFormat<TuneResult>> tune_formats() {
  static constexpr ReportFormat<TuneResult> formats[] = {
      {"text", as_text<add_numbers>},
      {"json", for_programs<tune_to_json>},
      {"junit", for_programs<tune_to_junit>},
  };
  return formats;
}

}  // namespace cbc
