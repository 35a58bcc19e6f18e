// The formats of a verification, those for continuous integration, and the page.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "page/html_report.h"
#include "page/simulator.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

constexpr std::string_view command = "cbc verify";

TestCase case_of(const VerifyResult& result, const VerifyPart& part,
                 const ReportedAnswer& reported) {
  const Answer& answer = *reported.answer;
  const Property& property = *answer.property;
  const std::string title = title_of(*result.catalog, property);
  TestCase test{fmt::format("line {}: {}", property.line, title)};
  if (answer.verdict.is_vacuous) {
    test.message = "proved only since " + describe_vacuity(property);
    test.annotations.push_back({Severity::warning, place_of_line(property.line),
                                "cbc property proved vacuously", title + "\n" + test.message});
  }
  if (answer.verdict.result == Verdict::Result::proved) return test;
  const bool is_violated = answer.verdict.result == Verdict::Result::violated;
  test.status = is_violated ? TestCase::Status::failed : TestCase::Status::error;
  test.type = is_violated ? "property" : "limit";
  test.message = describe_answer(result, part, answer);
  const std::string statement = describe_property(*result.catalog, property) + "\n";
  test.details = statement;
  std::string message = title + "\n";
  if (!property.name.empty()) message += statement;
  message += test.message;
  if (reported.replay) {
    std::vector<std::string> lines = reported.replay->idle_queue;
    lines.insert(lines.end(), reported.replay->explanation.begin(),
                 reported.replay->explanation.end());
    const std::string reasons = join(lines, "\n");
    test.details += reasons + "\n\n" + answer.witness->text;
    message += "\n" + reasons;
  }
  test.annotations.push_back({Severity::error, place_of_line(property.line),
                              fmt::format("cbc property {}", name_of(answer.verdict.result)),
                              message});
  return test;
}

/// Groups without properties: whether everything was explored.
TestCase case_of(const VerifyResult& result, const Exploration& exploration) {
  TestCase test{fmt::format("explored: {}", join(exploration.groups, ", ", [](GroupId group) {
                              return fmt::format("group {}", std::uint32_t{group});
                            }))};
  if (exploration.complete) return test;
  test.status = TestCase::Status::error;
  test.type = "limit";
  test.message = describe_limit(result, exploration);
  test.annotations.push_back({Severity::error, {}, "cbc exploration incomplete", test.message});
  return test;
}

/// Something of two catalogs that should be alike, and how they differ in it.
TestCase comparison_case(std::string name, const std::vector<std::string>& lines) {
  TestCase test{std::move(name)};
  if (lines.empty()) return test;
  test.status = TestCase::Status::failed;
  test.type = "difference";
  test.message = lines.front();
  if (lines.size() > 1) test.message += fmt::format(" (and {} more)", lines.size() - 1);
  test.details = join(lines, "\n") + "\n";
  return test;
}

/// "LAND and 2 other tasks"
std::string name_of_groups(const GroupComparison& groups) {
  const std::string first = printable(groups.tasks.front());
  const std::size_t others = groups.tasks.size() - 1;
  return others == 0 ? first : fmt::format("{} and {}", first, quantity(others, "other task"));
}

constexpr std::string_view nothing_compared = "no start, stop or finish comes in both";

/// The events of groups of both catalogs. `differences`: those of the groups.
TestCase case_of(const VerifyResult& result, const GroupComparison& groups,
                 std::span<const ReportedDifference> differences) {
  const auto lines_of = [](const ReportedDifference& reported) {
    std::vector<std::string> lines;
    for (const TaskDifference& task : reported.difference->tasks) lines.push_back(task.line);
    return lines;
  };
  std::vector<std::string> all_lines;
  for (const ReportedDifference& reported : differences) {
    for (std::string& line : lines_of(reported)) all_lines.push_back(std::move(line));
  }
  TestCase test = comparison_case("events of " + name_of_groups(groups), all_lines);
  for (const ReportedDifference& reported : differences) {
    const std::string& script = reported.difference->witness.text;
    test.details += "\n" + script;
    test.annotations.push_back({Severity::error,
                                {},
                                "cbc decided differently",
                                join(lines_of(reported), "\n") + "\n" + script});
  }
  if (!differences.empty()) return test;
  if (groups.end) {
    test.status = TestCase::Status::error;
    test.type = "limit";
    test.message = "undecided: " + result.limits.describe(*groups.end);
    test.annotations.push_back({Severity::error, {}, "cbc comparison undecided", test.message});
  } else if (!groups.is_compared) {
    test.status = TestCase::Status::skipped;
    test.message = nothing_compared;
  }
  return test;
}

TestSuite suite_of_comparison(const VerifyResult& result) {
  const ReportedComparison& reported = *result.same_as;
  TestSuite suite{std::string(result.catalog->file), std::string(reported.old_catalog->file)};
  const CatalogComparison& comparison = reported.comparison;
  const auto add_direct = [&](std::string name, bool is_of_names) {
    std::vector<std::string> lines;
    for (const DirectDifference& difference : comparison.direct) {
      const bool is_name = difference.kind <= DirectDifference::Kind::value;
      if (is_name == is_of_names) lines.push_back(difference.line);
    }
    TestCase& test = suite.cases.emplace_back(comparison_case(std::move(name), lines));
    for (std::string& line : lines) {
      test.annotations.push_back({Severity::error, {}, "cbc catalogs differ", std::move(line)});
    }
  };
  add_direct("tasks, behaviors and variables", true);
  add_direct("timeouts, goals and parameters", false);
  std::size_t first = 0;
  for (const GroupComparison& groups : comparison.groups) {
    suite.cases.push_back(case_of(
        result, groups, std::span(reported.differences).subspan(first, groups.differences.size())));
    first += groups.differences.size();
  }
  if (!comparison.is_compared && !comparison.end) {
    TestCase& test = suite.cases.emplace_back(
        comparison_case("something was compared", {std::string(nothing_compared)}));
    test.annotations.push_back({Severity::error, {}, "cbc nothing was compared", test.message});
  }
  return suite;
}

template <const TestFormat& format>
std::string write_tests(const VerifyResult& result, const Style& /*style*/) {
  std::vector<TestSuite> suites;
  for (const VerifyPart& part : result.parts) {
    suites.push_back({part.file->path, std::string(result.catalog->file)});
    for (const ReportedAnswer& answer : part.answers) {
      suites.back().cases.push_back(case_of(result, part, answer));
    }
    if (!part.is_about_groups()) continue;
    for (const Exploration& exploration : part.verification.explorations) {
      suites.back().cases.push_back(case_of(result, exploration));
    }
  }
  if (result.same_as) suites.push_back(suite_of_comparison(result));
  return tests_to_text(format, command, suites);
}

template <const TestFormat& format>
std::string write_unreadable(const std::vector<Diagnostic>& findings) {
  return unreadable_to_text(format, command, findings);
}

}  // namespace

std::span<const VerifyFormat> verify_formats() {
  static constexpr VerifyFormat formats[] = {
      {"text", verify_to_text},
      {"json",
       [](const VerifyResult& result, const Style& /*style*/) { return verify_to_json(result); }},
      {"junit", write_tests<junit_format>, true, false, write_unreadable<junit_format>},
      {"github", write_tests<github_format>, true, false, write_unreadable<github_format>},
      {"csv", effects_to_csv, false, true},
  };
  return formats;
}

std::string verify_to_html(const VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  HtmlReport page;
  if (const auto simulator = installed_simulator()) {
    page.continue_in(*simulator,
                     [&](const CompiledCatalog& /*catalog*/) { return result.text.get(); });
  }
  std::vector<PropertyOfPage> properties;
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      const Answer& answer = *reported.answer;
      const Property& property = *answer.property;
      PropertyOfPage& item = properties.emplace_back();
      item.title =
          fmt::format("{}:{}: {}", part.file->path, property.line, title_of(catalog, property));
      item.statement = describe_property(catalog, property);
      item.result = name_of(answer.verdict.result);
      item.description = describe_answer(result, part, answer);
      item.has_run = reported.replay.has_value();
      if (!item.has_run) continue;
      for (const std::string& line : reported.replay->idle_queue) item.description += "; " + line;
      const Script& script = answer.witness->script;
      page.begin_run(catalog, script);
      const Exploration& exploration = part.verification.explorations[*answer.exploration];
      page.end_run(run_script(seen_from(catalog, exploration.groups), script, {}, page,
                              {.rejections = true}),
                   {});
    }
  }
  page.list_properties(properties);
  page.end();
  return page.page();
}

}  // namespace cbc
