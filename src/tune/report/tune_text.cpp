// The text for people, and the tests for CI.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/layout.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"

namespace cbc {
namespace {

void add_repairs(const TuneResult& result, Text& text) {
  if (result.present.failures.empty()) return;
  text.line("");
  for (const auto& failure : result.present.failures) {
    text.painted(text.style().bad, describe(result, failure));
  }
  text.title(describe_repairs(result));
  if (!nearest_repairs(result).empty())
    text.add(repairs_table(result, text.style(), text.columns()).text());
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

void add_tolerances(const TuneResult& result, Text& text) {
  const std::vector<std::size_t> numbers = fragile_first(result);
  std::size_t width = 6;
  for (const std::size_t number : numbers) {
    width = std::max(width, width_of(describe(result.numbers[number], result.source)));
  }
  const Table table(text.style(), {number_column("line", 4),
                                   {"number", {}, width},
                                   number_column("value", 8),
                                   {"the same from"}});
  text.title("tolerances, the most fragile first");
  if (!numbers.empty()) text.add(table.titles());
  for (const std::size_t number : numbers) {
    const TunableNumber& of = result.numbers[number];
    const Tolerance& tolerance = result.tuned[number].tolerance;
    text.add(table.line({line_of(of), describe(of, result.source), format_decimal(of.value, 4),
                         describe(tolerance.values)},
                        color_of(result, number, text.style())));
    for (const auto& [label, beyond] :
         {std::pair("below", &tolerance.below), std::pair("above", &tolerance.above)}) {
      if (*beyond) text.line("        {}: {}", label, describe(result, **beyond));
    }
  }
  for (const std::string& line : describe_unaffected(result)) text.line("  {}", line);
}

std::string tune_to_text(const TuneResult& result, const Style& style, std::size_t columns) {
  Text text(style, columns);
  const Recording& present = result.present;
  text.line("{}: {}, {}, {}", style.paint(style.strong, printable(result.source.file)),
            quantity(result.numbers.size(), "number"),
            result.states ? quantity(result.states->states, "state")
                          : quantity(result.missions.size(), "mission"),
            quantity(result.states ? result.states->decisions : present.decisions.size(),
                     "different decision"));
  if (result.states) {
    const PropertyFile& file = result.states->file;
    text.add(assumptions_to_text(result.catalog, {file.assumptions, file.path}, columns));
  }
  add_repairs(result, text);
  add_tolerances(result, text);
  if (result.states) return text.take();
  text.line("");
  text.painted(present.failures.empty() ? style.good : style.bad,
               "expectations: {} passed, {} failed", present.passed, present.failures.size());
  return text.take();
}

/// A suite for each mission with expectations that fail, and one for the numbers.
std::string tune_to_junit(const TuneResult& result) {
  std::vector<TestSuite> suites;
  for (std::size_t mission = 0; mission < result.missions.size(); ++mission) {
    suites.push_back({result.missions[mission], result.source.file, {}});
  }
  for (const auto& failure : result.present.failures) {
    suites[failure.mission].cases.push_back(
        {fmt::format("line {}", failure.expectation.range.begin.line),
         TestCase::Status::failed,
         "expectation",
         failure.expectation.message,
         describe(result, failure),
         {}});
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
    test.status = TestCase::Status::failed;
    test.type = "tolerance";
    test.message =
        fmt::format("{} may be {}, less than {} away from a bound", format_decimal(of.value, 4),
                    describe(tolerance.values), format_decimal(*result.fail_under, 4));
    for (const auto* const beyond : {&tolerance.below, &tolerance.above}) {
      if (*beyond) test.details += describe(result, **beyond) + "\n";
    }
  }
  return tests_to_text(junit_format, "cbc tune", suites);
}

}  // namespace

std::span<const TuneFormat> tune_formats() {
  using Given = const TuneResult&;
  static constexpr TuneFormat formats[] = {
      {"text", tune_to_text},
      {"json", [](Given result, const Style&, std::size_t) { return tune_to_json(result); }},
      {"junit", [](Given result, const Style&, std::size_t) { return tune_to_junit(result); }},
  };
  return formats;
}

}  // namespace cbc
